#pragma once

#include <cstdint>

// Hot loops work on four doubles at a time, in an order that is written out. They are compiled twice and the machine's
// widest vectors are chosen when the program starts; both give the same bits, since nothing is reassociated or
// contracted. Not with sanitizers, whose runtime is not up when the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEAM_WIDEST_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define SEAM_WIDEST_VECTORS
#endif
#define SEAM_INLINE __attribute__((always_inline)) inline

namespace seam {

inline constexpr int lanes = 4;

/// Four doubles, which may lie at any address; arithmetic is element by element.
using Lanes __attribute__((vector_size(32), aligned(8), may_alias)) = double;
using IntegerLanes __attribute__((vector_size(32), aligned(8), may_alias)) = std::uint64_t;

/// The next multiple of four.
constexpr int padded(int size) {
  return (size + lanes - 1) / lanes * lanes;
}

#define SEAM_LANES(pointer) (*reinterpret_cast<seam::Lanes*>(pointer))
#define SEAM_CONST_LANES(pointer) (*reinterpret_cast<const seam::Lanes*>(pointer))

}  // namespace seam
