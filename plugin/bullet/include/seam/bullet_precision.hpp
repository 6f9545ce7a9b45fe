#pragma once

#include <LinearMath/btScalar.h>

#include <seam/precision.hpp>

// Whether Bullet's headers are read in the precision of the seam that is linked (see seam/precision.hpp for its libraries).
#if defined(SEAM_BULLET_FLOAT64) && !defined(BT_USE_DOUBLE_PRECISION)
#error \
    "seam::bullet needs BT_USE_DOUBLE_PRECISION and Bullet's -float64 libraries: with Bullet in float, take seam::bullet-float32"
#endif
