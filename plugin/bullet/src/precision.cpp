#include <dlfcn.h>

#include "one_precision.hpp"
#include <seam/error.hpp>
#include <seam/precision.hpp>

namespace seam {

// One of Bullet's functions as the libraries of the other precision name it.
#ifdef BT_USE_DOUBLE_PRECISION
const char this_needs_seam_bullet = 0;
static constexpr char other_precision[] = "_ZN11btMultiBody14addJointTorqueEif";
#else
const char this_needs_seam_bullet_float32 = 0;
static constexpr char other_precision[] = "_ZN11btMultiBody14addJointTorqueEid";
#endif

void require_one_precision() {
  if (dlsym(RTLD_DEFAULT, other_precision))
    throw Error("Bullet", "its float and its -float64 libraries are both in this program");
}

}  // namespace seam
