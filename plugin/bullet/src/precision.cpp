#include <dlfcn.h>

#include "one_precision.hpp"
#include <seam/error.hpp>
#include <seam/precision.hpp>

namespace seam {

#ifdef BT_USE_DOUBLE_PRECISION
const char this_needs_seam_bullet = 0;
#else
const char this_needs_seam_bullet_float32 = 0;
#endif

void require_one_precision() {
  if (dlsym(RTLD_DEFAULT, SEAM_OTHER_DYNAMICS))
    throw Error("Bullet", "its float and its -float64 libraries are both in this program");
}

}  // namespace seam
