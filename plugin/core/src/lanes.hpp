#pragma once

// The hot loops work on lanes of four doubles, in an order that is written out: they vectorise with
// any instruction set and give the same bits with each.

namespace seam {

inline constexpr int lanes = 4;

/// The next multiple of `lanes`.
inline constexpr int padded(int size) {
  return (size + lanes - 1) / lanes * lanes;
}

}  // namespace seam

// One binary, the machine's widest vectors. Not with sanitizers, whose runtime is not up when the
// choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEAM_WIDEST_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define SEAM_WIDEST_VECTORS
#endif
