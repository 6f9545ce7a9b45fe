#include "allocation_guard.hpp"

#include <memory>

#include <Eigen/Core>
#include <LinearMath/btAlignedAllocator.h>
#include <gtest/gtest.h>

// The guard that all "allocates nothing" tests rest on counts what there is.
TEST(AllocationGuard, CountsNewMallocEigenAndBullet) {
  const AllocationGuard guard;
  const auto plain = std::make_unique<int>(1);
  EXPECT_GE(guard.allocations(), 1);
  const Eigen::VectorXd vector(100);
  EXPECT_GE(guard.allocations(), 2);
  btAlignedFree(btAlignedAlloc(64, 16));
  EXPECT_GE(guard.allocations(), 3);
}
