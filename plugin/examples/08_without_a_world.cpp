// Without a Bullet world: an arm that this program integrates itself plays a sequence. In place of the two lines that solve
// and integrate stands what you have: another simulator, or the arm.
//     without_a_world arm.urdf

#include <algorithm>
#include <iostream>

#include <Eigen/Cholesky>

#include "movement.hpp"
#include <seam/arm.hpp>
#include <seam/seam.hpp>

namespace {

/// What moves: M(q)·q̈ + h(q, q̇) = torque, solved for q̈.
class ForwardDynamics {
 public:
  explicit ForwardDynamics(const seam::RobotModel& model) : inverse_(model) {}

  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                               const Eigen::VectorXd& torque) const {
    const Eigen::Index n = q.size();
    Eigen::VectorXd h(n);
    Eigen::MatrixXd M(n, n);
    inverse_.torque(q, qd, Eigen::VectorXd::Zero(n), h);
    for (Eigen::Index i = 0; i < n; ++i)
      inverse_.torque(q, qd, Eigen::VectorXd::Unit(n, i), M.col(i));
    M.colwise() -= h;
    return M.ldlt().solve(torque - h);
  }

 private:
  seam::InverseDynamics inverse_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw seam::Error("usage", "without_a_world arm.urdf");
  const seam::RobotModel model = seam::RobotModel::read(argv[1]);

  // All joints that follow none go a tenth of their range there and back.
  Eigen::VectorXd q = model.neutral(), qd = Eigen::VectorXd::Zero(model.dof());
  std::vector<std::string> joints;
  std::vector<double> from, to;
  for (int i = 0; i < model.dof(); ++i) {
    const seam::Joint& joint = model.joints[static_cast<std::size_t>(i)];
    if (joint.follows()) continue;
    const double range =
        joint.type == seam::Joint::Type::continuous ? 2.0 : joint.upper - joint.lower;
    joints.push_back(joint.name);
    from.push_back(q(i));
    to.push_back(q(i) + (q(i) - joint.lower > 0.5 * range ? -0.1 : 0.1) * range);
  }
  const Eigen::Map<Eigen::VectorXd> here(from.data(), static_cast<Eigen::Index>(from.size()));
  const Eigen::Map<Eigen::VectorXd> there(to.data(), here.size());
  seam::Sequence task;
  task.then(seam::learn(movement(joints, here, there, 1.0)))
      .until(seam::before_end(0.3))
      .then(seam::learn(movement(joints, there, here, 1.0)));

  constexpr double dt = 1e-3;  // [s]
  seam::ArmController controller(model, task, seam::Join::dmp3, {}, q, qd);
  const ForwardDynamics arm(model);
  double error = 0.0;
  for (int k = 0; k < 2500; ++k) {
    const Eigen::VectorXd& torque = controller.tick(dt, q, qd);
    error = std::max(error, (controller.last_tick().reference.position - q).cwiseAbs().maxCoeff());
    qd += dt * arm.acceleration(q, qd, torque);
    q += dt * qd;
  }
  std::cout << model.name << " was " << error << " rad from its reference at most\n";
  return controller.status() == seam::ArmController::Status::following && error < 1e-11 ? 0 : 1;
} catch (const seam::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
