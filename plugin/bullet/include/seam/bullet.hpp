#pragma once

// seam on a robot in a Bullet world.
#include <seam/computed_torque.hpp>
#include <seam/controller.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/plugin.hpp>
#include <seam/robot.hpp>
