#pragma once

// seam on a robot in a Bullet world.
#include <seam/actuator.hpp>
#include <seam/computed_torque.hpp>
#include <seam/controller.hpp>
#include <seam/fading_offset.hpp>
#include <seam/guard.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/inverse_kinematics.hpp>
#include <seam/joint_reference.hpp>
#include <seam/kinematics.hpp>
#include <seam/plugin.hpp>
#include <seam/robot.hpp>
#include <seam/sensor.hpp>
