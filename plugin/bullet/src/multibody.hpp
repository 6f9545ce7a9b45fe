#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <seam/robot_model.hpp>

namespace seam {

/// Bullet's frame of a link in the body frame: at the centre of mass along the principal axes.
struct LinkFrame {
  Eigen::Isometry3d X_body_link = Eigen::Isometry3d::Identity();
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  // [kg m²] principal moments
};
LinkFrame link_frame(const Inertial& inertial);

/// The model as a multibody with a fixed base, at its neutral position, ready to be added to a world. `frames` holds one
/// frame per body. Borrows the model's names.
std::unique_ptr<btMultiBody> make_multibody(const RobotModel& model,
                                            const std::vector<LinkFrame>& frames);

}  // namespace seam
