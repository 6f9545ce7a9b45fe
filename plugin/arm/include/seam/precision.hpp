#pragma once

#include <seam/export.hpp>

// Bullet is built in double or in float, and so is what computes with it: seam::arm and seam::bullet, seam::arm-float32 and
// seam::bullet-float32. One program takes one kind. Mixing them would go wrong at run time, so it is stopped here, or by the
// linker.
//     undefined reference to `seam::this_needs_seam_arm...'         compiled for one kind of seam, linked with the other
//     ...: TLS reference in ... mismatches non-TLS ... in LIBRARY   LIBRARY is, or needs, Bullet of the other kind
#if defined(SEAM_BULLET_MIXED)
#error \
    "this target links seam in one precision and Bullet in the other: take seam::arm or seam::bullet with Bullet's -float64 libraries, or seam::arm-float32 or seam::bullet-float32 with its float libraries"
#elif defined(SEAM_BULLET_FLOAT64) && defined(SEAM_BULLET_FLOAT32)
#error \
    "seam is linked in both precisions: take seam::arm or seam::bullet, or the same with -float32"
#elif defined(SEAM_BULLET_FLOAT32) && defined(BT_USE_DOUBLE_PRECISION)
#error \
    "seam::bullet-float32 does not go with BT_USE_DOUBLE_PRECISION: with Bullet in double, take seam::bullet"
#endif

namespace SEAM_API seam {

/// In seam::arm alone: a program that is linked with the other library misses it, and the linker names it.
extern const char this_needs_seam_arm;
/// In seam::arm-float32 alone, likewise.
extern const char this_needs_seam_arm_float32;

/// The last guard against mixed precisions, for libraries that come by ways which neither compiler nor linker see.
/// InverseDynamics and Robot call it as they are made.
/// @throws Error  Bullet's libraries of the other precision are loaded, too
void require_one_precision();

/// @cond
#if defined(SEAM_BULLET_FLOAT64) || defined(BT_USE_DOUBLE_PRECISION)
[[gnu::used]] static const char* const precision_linked = &this_needs_seam_arm;
#define SEAM_OTHER_SCALAR "f"
#else
[[gnu::used]] static const char* const precision_linked = &this_needs_seam_arm_float32;
#define SEAM_OTHER_SCALAR "d"
#endif

// Functions that only Bullet's libraries of the other kind define, one of each library. Here they are named as variables
// of a thread, which nobody reads and nothing need define. As no linker takes one name for both, it takes none of those
// libraries, by whatever way they come.
#define SEAM_OTHER_LINEAR_MATH "_ZN20btPolarDecompositionC1E" SEAM_OTHER_SCALAR "j"
#define SEAM_OTHER_COLLISION "_ZN14btCapsuleShapeC1E" SEAM_OTHER_SCALAR SEAM_OTHER_SCALAR
#define SEAM_OTHER_DYNAMICS "_ZN11btMultiBody14addJointTorqueEi" SEAM_OTHER_SCALAR
#if defined(__ELF__)
#define SEAM_REFUSE(name)                                 \
  asm(".weak " name "\n.type " name                       \
      ", STT_TLS\n.pushsection .seam, \"e\", %progbits\n" \
      ".byte 0\n.reloc .-1, BFD_RELOC_NONE, " name "\n.popsection")
SEAM_REFUSE(SEAM_OTHER_LINEAR_MATH);
SEAM_REFUSE(SEAM_OTHER_COLLISION);
SEAM_REFUSE(SEAM_OTHER_DYNAMICS);
#undef SEAM_REFUSE
#endif
/// @endcond

}  // namespace seam
