#include <cmath>
#include <limits>

#include <seam/error.hpp>
#include <seam/joint_reference.hpp>
#include <seam/orientation.hpp>

namespace seam {

namespace {

constexpr double same_posture = 1e-6;  // [rad or m]
constexpr double rounding = 1e-9;      // [rad or m]
constexpr Eigen::Index held = -1;      // in place of the coordinate that moves a joint

int tool_dimensions(const std::vector<std::string>& coordinates) {
  if (coordinates == std::vector<std::string>{"x", "y", "z"}) return 3;
  if (coordinates == std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"}) return 6;
  throw Error("sequence", "moves other coordinates than a tool's x y z or x y z rx ry rz");
}

PostureSettings resting_at(PostureSettings posture, const Eigen::VectorXd& q) {
  if (posture.rest.size() == 0) posture.rest = q;
  return posture;
}

void require_within_limits(const Joint& joint, double goal, double slack, const std::string& how) {
  if (goal >= joint.lower - slack && goal <= joint.upper + slack) return;
  throw Error("joint \"" + joint.name + "\"", "goal " + std::to_string(goal) + how +
                                                  ", must be in " + std::to_string(joint.lower) +
                                                  " to " + std::to_string(joint.upper));
}

}  // namespace

void JointReference::require_reachable_step(const Sequence::Step& step) {
  require_reachable(step.primitive);
  for (std::size_t i = 0; i < step.wishes.size(); ++i) {
    const Eigen::VectorXd& position = step.wishes[i].position;
    if (position.size() == 0 || (moves_tool() && position.head<3>().array().isNaN().any()))
      continue;
    Primitive there = step.primitive;
    there.goal = position.array().isNaN().select(step.primitive.goal, position);
    try {
      require_reachable(there);
    } catch (const Error& error) {
      throw Error("wish " + std::to_string(i + 1), error.what());
    }
  }
}

Followers::Followers(const RobotModel& robot) {
  for (int i = 0; i < robot.dof(); ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    if (joint.follows()) followers_.push_back({i, joint.leader, joint.multiplier, joint.offset});
  }
}

void Followers::place(Sample& joints) const noexcept {
  for (const auto& [joint, leader, multiplier, offset] : followers_) {
    joints.position(joint) = multiplier * joints.position(leader) + offset;
    joints.velocity(joint) = multiplier * joints.velocity(leader);
    joints.acceleration(joint) = multiplier * joints.acceleration(leader);
  }
}

void Followers::place(Eigen::VectorXd& position) const noexcept {
  for (const auto& [joint, leader, multiplier, offset] : followers_)
    position(joint) = multiplier * position(leader) + offset;
}

JointSpace::JointSpace(const RobotModel& robot, const std::vector<std::string>& coordinates)
    : followers_(robot), all_(robot.joints) {
  for (const std::string& coordinate : coordinates) {
    joints_.push_back(robot.joint(coordinate));
    const Joint& joint = robot.joints[static_cast<std::size_t>(joints_.back())];
    if (joint.follows())
      throw Error("joint \"" + joint.name + "\"",
                  "follows joint \"" + robot.joints[static_cast<std::size_t>(joint.leader)].name +
                      "\", a sequence must move that one");
  }
  moved_by_.assign(static_cast<std::size_t>(robot.dof()), held);
  for (std::size_t c = 0; c < joints_.size(); ++c)
    moved_by_[static_cast<std::size_t>(joints_[c])] = static_cast<Eigen::Index>(c);
  held_.setZero(robot.dof());
}

Sample JointSpace::measured(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  Sample part(static_cast<int>(joints_.size()));
  take_up(q, qd, part);
  return part;
}

bool JointSpace::take_up(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept {
  held_ = q;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    const auto d = static_cast<Eigen::Index>(c);
    at.position(d) = q(joints_[c]);
    at.velocity(d) = qd(joints_[c]);
  }
  at.acceleration.setZero();
  at.jerk.setZero();
  return true;
}

bool JointSpace::at_goal(const Eigen::Ref<const Eigen::VectorXd>& goal,
                         Eigen::VectorXd& joints) noexcept {
  joints = held_;
  for (std::size_t c = 0; c < joints_.size(); ++c)
    joints(joints_[c]) = goal(static_cast<Eigen::Index>(c));
  followers_.place(joints);
  return true;
}

void JointSpace::require_reachable(const Primitive& primitive) {
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    const double goal = primitive.goal(static_cast<Eigen::Index>(c));
    const Joint& moved = all_[static_cast<std::size_t>(joints_[c])];
    require_within_limits(moved, goal, 0.0, "");
    for (const Joint& joint : all_)
      if (joint.leader == joints_[c])
        require_within_limits(joint, joint.multiplier * goal + joint.offset, rounding,
                              " as it follows \"" + moved.name + "\"");
  }
}

bool JointSpace::find(const Sample& sample, Sample& joints) noexcept {
  for (Eigen::Index i = 0; i < held_.size(); ++i) {
    const Eigen::Index c = moved_by_[static_cast<std::size_t>(i)];
    joints.position(i) = c == held ? held_(i) : sample.position(c);
    joints.velocity(i) = c == held ? 0.0 : sample.velocity(c);
    joints.acceleration(i) = c == held ? 0.0 : sample.acceleration(c);
  }
  followers_.place(joints);
  return true;
}

TaskSpace::TaskSpace(const RobotModel& robot, const Sequence& sequence, const ToolSettings& tool,
                     const Eigen::VectorXd& q)
    : dimensions_(tool_dimensions(sequence.coordinates())),
      most_speed_(tool.most_speed),
      tool_(robot, tool.link, tool.X_link_tool),
      solver_(robot, tool_, resting_at(tool.posture, q)),
      followers_(robot),
      reference_(tool.orientation.value_or(Eigen::Quaterniond(tool_at(q).linear()))) {
  if (!(most_speed_ > 0.0)) throw Error("tool", "most_speed must be > 0");
  solution_.position = solution_.velocity = solution_.acceleration = found_ = q;
  target_at_.setConstant(dimensions_, std::numeric_limits<double>::quiet_NaN());
  if (!turns()) return;
  const auto& reference = sequence.steps().front().primitive.reference_orientation;
  if (!reference)
    throw Error("sequence", "turns the tool, but its primitives have no reference orientation");
  reference_ = *reference;
}

Eigen::Isometry3d TaskSpace::tool_at(const Eigen::VectorXd& q) const noexcept {
  return tool_.pose_at(q);
}

Eigen::Isometry3d TaskSpace::pose(
    const Eigen::Ref<const Eigen::VectorXd>& position) const noexcept {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = position.head<3>();
  const Eigen::Quaterniond turned =
      turns() ? orientation(position.tail<3>(), reference_) : reference_;
  X.linear() = turned.toRotationMatrix();
  return X;
}

Sample TaskSpace::measured(const Eigen::VectorXd& q, const Eigen::VectorXd& qd) {
  Sample at(dimensions_);
  const bool there = take_up(q, qd, at);
  followers_.place(solution_.position);
  if (!there || (solution_.position - q).cwiseAbs().maxCoeff() > same_posture)
    throw Error("controller", "the joints are not where the posture puts them for their tool");
  return at;
}

Eigen::VectorXd TaskSpace::reach(const Eigen::Isometry3d& pose) {
  Eigen::VectorXd q = solver_.reach(pose);
  followers_.place(q);
  return q;
}

bool TaskSpace::take_up(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept {
  const bool there = state_at(q, qd, at) && to_tool(at) && follow_target();
  if (!there) solver_.start(found_);
  return there;
}

bool TaskSpace::state_at(const Eigen::VectorXd& q, const Eigen::VectorXd& qd, Sample& at) noexcept {
  tool_.move_to(q);
  const Eigen::Isometry3d& X = tool_.X_base_tool();
  solver_.start(q);
  const Vector6d velocity = tool_.jacobian() * qd;
  at.position.head<3>() = X.translation();
  at.velocity.head<3>() = velocity.head<3>();
  at.acceleration.setZero();
  at.jerk.setZero();
  if (!turns()) return true;
  RotationState turn;
  const OrientationState is{Eigen::Quaterniond(X.linear()), velocity.tail<3>(),
                            Eigen::Vector3d::Zero()};
  if (!to_rotation(is, reference_, turn)) return false;
  at.position.tail<3>() = turn.vector;
  at.velocity.tail<3>() = turn.velocity;
  at.acceleration.tail<3>() = turn.acceleration;
  return true;
}

void TaskSpace::require_reachable(const Primitive& primitive) {
  InverseKinematics elsewhere = solver_;
  elsewhere.reach(pose(primitive.goal));
}

bool TaskSpace::to_tool(const Sample& sample) noexcept {
  OrientationState turned{reference_, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  if (turns()) {
    const RotationState turn{sample.position.tail<3>(), sample.velocity.tail<3>(),
                             sample.acceleration.tail<3>()};
    if (!to_orientation(turn, reference_, turned)) return false;
  } else if (!sample.position.allFinite()) {
    return false;
  }
  target_at_ = sample.position;
  target_.pose.translation() = sample.position.head<3>();
  target_.pose.linear() = turned.orientation.toRotationMatrix();
  target_.velocity << sample.velocity.head<3>(), turned.velocity;
  target_.acceleration << sample.acceleration.head<3>(), turned.acceleration;
  return true;
}

bool TaskSpace::follow_target() noexcept {
  using Status = InverseKinematics::Status;
  const Status status = solver_.follow(target_, solution_);
  return (status == Status::exact || status == Status::damped) &&
         solution_.velocity.cwiseAbs().maxCoeff() <= most_speed_;
}

bool TaskSpace::find(const Sample& sample, Sample& joints) noexcept {
  if (!to_tool(sample) || !follow_target()) return false;
  joints.position = found_ = solution_.position;
  joints.velocity = solution_.velocity;
  joints.acceleration = solution_.acceleration;
  followers_.place(joints);
  return true;
}

ToolError TaskSpace::miss(const Sample& sample, const Eigen::VectorXd& q) noexcept {
  const Eigen::Isometry3d is = tool_at(q);
  // Mostly it is the last one that was followed.
  const Eigen::Isometry3d should =
      sample.position == target_at_ ? target_.pose : pose(sample.position);
  return {(is.translation() - should.translation()).norm(),
          rotation_vector(is.linear(), should.linear()).norm()};
}

}  // namespace seam
