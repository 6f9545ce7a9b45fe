#pragma once

// seam on a robot in a Bullet world.
#include <seam/arm.hpp>
#include <seam/controller.hpp>
#include <seam/mesh.hpp>
#include <seam/plugin.hpp>
#include <seam/robot.hpp>
