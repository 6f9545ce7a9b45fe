#pragma once

#include <Eigen/Core>

#include <seam/export.hpp>

// How Eigen's types lie in memory, and whether theirs is malloc's as it comes, depends on flags of the compiler: -mavx,
// -march=native, -fsanitize=address. An app and a library that hand such types to each other must agree in this. So a
// build of seam offers the one name that says its own, and the linker names what an app would need instead. Then
//     build seam with the app's flags; or
//     with -fsanitize=address, define EIGEN_MALLOC_ALREADY_ALIGNED=1 in the app;
//     with -mavx, define EIGEN_MAX_ALIGN_BYTES=16, EIGEN_MAX_STATIC_ALIGN_BYTES=16, EIGEN_MALLOC_ALREADY_ALIGNED=1 and
//     EIGEN_DONT_VECTORIZE in the app: without the last, Eigen reads blocks of 32 bytes from memory aligned to 16.
/// @cond
#define SEAM_EIGEN_NAME(bytes, fixed_size, malloc) \
  this_needs_seam_built_with_EIGEN_MAX_ALIGN_BYTES_##bytes##_MAX_STATIC_ALIGN_BYTES_##fixed_size##_MALLOC_ALREADY_ALIGNED_##malloc
#define SEAM_EIGEN_NAME_OF(...) SEAM_EIGEN_NAME(__VA_ARGS__)
#define SEAM_EIGEN_BUILD                                                  \
  SEAM_EIGEN_NAME_OF(EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, \
                     EIGEN_MALLOC_ALREADY_ALIGNED)

namespace SEAM_API seam {

extern const char SEAM_EIGEN_BUILD;
[[gnu::used]] static const char* const alignment_linked = &SEAM_EIGEN_BUILD;

}  // namespace seam
/// @endcond
