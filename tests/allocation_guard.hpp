#pragma once

/// Counts this thread's allocations while it lives, whatever they come through: new, malloc, Eigen,
/// Bullet. Needs allocation_guard.cpp in the same executable, which stands in front of malloc.
///
///     AllocationGuard guard;
///     controller.step();
///     EXPECT_EQ(guard.allocations(), 0);
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Since the guard was made.
  long allocations() const noexcept;

 private:
  long at_start_;
};
