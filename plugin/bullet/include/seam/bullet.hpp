#pragma once

// seam on a robot in a Bullet world.
#include <seam/robot.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/computed_torque.hpp>
#include <seam/controller.hpp>
#include <seam/plugin.hpp>
