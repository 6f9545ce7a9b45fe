#include <dlfcn.h>

#include <seam/error.hpp>
#include <seam/precision.hpp>

namespace seam {

#ifdef SEAM_BULLET_FLOAT64
const char this_needs_seam_arm = 0;
#else
const char this_needs_seam_arm_float32 = 0;
#endif

void require_one_precision() {
  if (dlsym(RTLD_DEFAULT, SEAM_OTHER_LINEAR_MATH))
    throw Error("Bullet", "its float and its -float64 libraries are both in this program");
}

}  // namespace seam
