#pragma once

// What the pieces of programs in the README and the guide may take for granted: all of seam, and the things that the
// README's program has.

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>

#include <seam/bullet.hpp>
#include <seam/primitive_file.hpp>
#include <seam/seam.hpp>
#include <seam/sequence_file.hpp>
#include <seam/testing.hpp>

// A piece stands in braces of its own, so that it may name things anew.
#define SEAM_PIECE(name)                                                                         \
  void name([[maybe_unused]] btMultiBodyDynamicsWorld& world, [[maybe_unused]] seam::Robot& arm, \
            [[maybe_unused]] const seam::Primitive& reach,                                       \
            [[maybe_unused]] const seam::Primitive& back,                                        \
            [[maybe_unused]] const seam::Primitive& wipe, [[maybe_unused]] seam::Sequence& task, \
            [[maybe_unused]] seam::Controller& controller) {
