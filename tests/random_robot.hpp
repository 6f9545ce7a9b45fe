#pragma once

#include <random>
#include <sstream>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

/// Random robots and states, the same on every machine for one seed.
class RandomRobot {
 public:
  explicit RandomRobot(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low +
           (high - low) * static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max());
  }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  Eigen::VectorXd vector(Eigen::Index size, double bound) {
    Eigen::VectorXd v(size);
    for (double& x : v) x = uniform(-bound, bound);
    return v;
  }
  Eigen::Isometry3d pose() {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() =
        Eigen::Quaterniond(Eigen::Vector4d(vector(4, 1.0))).normalized().toRotationMatrix();
    X.translation() = vector(3, 1.0);
    return X;
  }

  /// A tree of `links` links: any branching, joints of every kind (a third of them fixed), skew
  /// axes, inertias with off-diagonal terms in rotated frames, links without mass where they are
  /// fixed.
  std::string urdf(int links) {
    std::ostringstream out;
    out.precision(17);
    out << "<robot name=\"random\">\n" << link(0, integer(0, 1) == 0);
    for (int i = 1; i < links; ++i) {
      const char* const types[] = {"revolute", "continuous", "prismatic",
                                   "fixed",    "fixed",      "revolute"};
      const std::string type = i == 1 ? "revolute" : types[integer(0, 5)];
      out << link(i, type != "fixed" || integer(0, 1) == 0) << joint(i, integer(0, i - 1), type);
    }
    out << "</robot>\n";
    return out.str();
  }

 private:
  std::string numbers(const Eigen::VectorXd& v) {
    std::ostringstream out;
    out.precision(17);
    for (double x : v) out << x << " ";
    return out.str();
  }
  std::string origin() {
    return R"(<origin xyz=")" + numbers(vector(3, 0.4)) + R"(" rpy=")" + numbers(vector(3, 3.0)) +
           R"("/>)";
  }
  std::string inertial() {
    const double mass = uniform(0.5, 8.0);
    const Eigen::Vector3d spread =
        mass * Eigen::Vector3d(uniform(1e-3, 2e-2), uniform(1e-3, 2e-2), uniform(1e-3, 2e-2));
    const Eigen::Matrix3d R = pose().linear();
    const Eigen::Matrix3d I =
        spread.sum() * Eigen::Matrix3d::Identity() - R * spread.asDiagonal() * R.transpose();
    std::ostringstream out;
    out.precision(17);
    out << "<inertial>" << origin() << R"(<mass value=")" << mass << R"("/><inertia ixx=")"
        << I(0, 0) << R"(" ixy=")" << I(0, 1) << R"(" ixz=")" << I(0, 2) << R"(" iyy=")" << I(1, 1)
        << R"(" iyz=")" << I(1, 2) << R"(" izz=")" << I(2, 2) << R"("/></inertial>)";
    return out.str();
  }
  std::string link(int i, bool has_mass) {
    return R"(<link name="l)" + std::to_string(i) + R"(">)" + (has_mass ? inertial() : "") +
           "</link>\n";
  }
  std::string joint(int i, int parent, const std::string& type) {
    return R"(<joint name="j)" + std::to_string(i) + R"(" type=")" + type + R"("><parent link="l)" +
           std::to_string(parent) + R"("/><child link="l)" + std::to_string(i) + R"("/>)" +
           origin() + R"(<axis xyz=")" + numbers(vector(3, 1.0)) +
           "\"/><limit lower=\"-3\" upper=\"3\" effort=\"50\" velocity=\"2\"/></joint>\n";
  }

  std::mt19937 engine_;
};
