#pragma once

// seam on an arm, whoever moves it: (q, qd) in, torque out.
#include <seam/actuator.hpp>
#include <seam/arm_controller.hpp>
#include <seam/computed_torque.hpp>
#include <seam/fading_offset.hpp>
#include <seam/guard.hpp>
#include <seam/inverse_dynamics.hpp>
#include <seam/inverse_kinematics.hpp>
#include <seam/joint_reference.hpp>
#include <seam/kinematics.hpp>
#include <seam/robot_model.hpp>
#include <seam/sensor.hpp>
