#include <algorithm>

#include "shown.hpp"
#include <seam/error.hpp>
#include <seam/obstacles.hpp>
#include <seam/quintic.hpp>
#include <seam/sequencer.hpp>

namespace seam {

namespace {

using Vector = Eigen::Vector3d;

// How far a tool is beyond a surface, and the gradient of that.
struct Gap {
  double distance;
  Vector away;
};

Gap gap(const Steering&, const Vector& tool) noexcept {
  return {tool.norm(), Vector::Zero()};
}

Gap gap(const Ball& ball, const Vector& tool) noexcept {
  const double r = tool.norm();
  return {r - ball.radius, r > 0.0 ? Vector(tool / r) : Vector::Zero()};
}

Gap gap(const Box& box, const Vector& tool) noexcept {
  const Vector inside = box.orientation.conjugate() * tool;
  const Vector beyond = inside.cwiseAbs() - 0.5 * box.size;
  Vector away = Vector::Zero();
  Eigen::Index nearest = 0;
  double distance = beyond.maxCoeff(&nearest);
  if (distance <= 0.0) {
    away(nearest) = 1.0;
  } else {
    const Vector share = beyond.cwiseMax(0.0) / distance;  // of the largest: no power overflows
    const double whole = std::sqrt(share.array().square().matrix().norm());
    distance *= whole;
    away = (share / whole).array().cube();
  }
  away = (inside.array() < 0.0).select(-away, away);
  return {distance, box.orientation * away};
}

template <typename Shape>
double potential(const Shape& shape, double distance) noexcept {
  const double left = std::max(1.0 - distance / shape.reach, 0.0);
  return 0.25 * shape.strength * shape.reach * left * left * left * left;
}

double potential(const Steering&, double) noexcept {
  return 0.0;
}

template <typename Shape>
Vector push(const Shape& shape, const Vector& tool, const Vector&) noexcept {
  const Gap found = gap(shape, tool);
  const double left = std::max(1.0 - found.distance / shape.reach, 0.0);
  return shape.strength * left * left * left * found.away;
}

// 1 below s = 0, 0 beyond s = 1.
double window(double s) noexcept {
  return fade(std::clamp(s, 0.0, 1.0));
}

Vector push(const Steering& steering, const Vector& tool, const Vector& velocity) noexcept {
  const double distance = tool.norm();
  const double speed = velocity.norm();
  if (!(distance > 0.0 && distance < steering.reach && speed > 0.0)) return Vector::Zero();
  const Vector way = -tool / distance;
  const Vector heading = velocity / speed;
  const double ahead = heading.dot(way);
  const Vector across = way - ahead * heading;
  const double sine = across.norm();
  const double angle = std::atan2(sine, ahead);
  const double over_sine = sine > 1e-9 ? angle / sine : ahead > 0.0 ? 1.0 : 0.0;
  const double windows =
      window(2.0 * distance / steering.reach - 1.0) * window(2.0 * angle / M_PI - 1.0);
  return -steering.strength * speed * std::exp(-steering.sharpness * angle) * over_sine * windows *
         across;
}

void require(const char* name, double value, const char* unit, bool may_be_zero) {
  if (std::isfinite(value) && (may_be_zero ? value >= 0.0 : value > 0.0)) return;
  throw Error("obstacle", std::string(name) + " " + shown(value) + " " + unit + ", must be " +
                              (may_be_zero ? ">= 0" : "> 0"));
}

void require(const Steering& steering) {
  require("strength", steering.strength, "1/(rad s)", true);
  require("sharpness", steering.sharpness, "1/rad", true);
  require("reach", steering.reach, "m", false);
}

void require(const Ball& ball) {
  require("radius", ball.radius, "m", false);
  require("strength", ball.strength, "m/s^2", true);
  require("reach", ball.reach, "m", false);
}

void require(const Box& box) {
  for (const double edge : box.size) require("size", edge, "m", false);
  if (!(std::abs(box.orientation.norm() - 1.0) < 1e-6))
    throw Error("obstacle",
                "orientation has norm " + shown(box.orientation.norm()) + ", must be 1");
  require("strength", box.strength, "m/s^2", true);
  require("reach", box.reach, "m", false);
}

Eigen::Index index_of(const std::vector<std::string>& coordinates, const char* name) {
  const auto found = std::find(coordinates.begin(), coordinates.end(), name);
  return found == coordinates.end() ? -1 : found - coordinates.begin();
}

Eigen::Index require_index(const std::vector<std::string>& coordinates, const char* name) {
  const Eigen::Index found = index_of(coordinates, name);
  if (found >= 0) return found;
  std::string names;
  for (const std::string& one : coordinates) names += (names.empty() ? "" : ", ") + one;
  throw Error("obstacle", std::string("there is no coordinate ") + name + " among " + names +
                              ", must be a tool's x y z, or x y");
}

}  // namespace

ObstacleSettings ObstacleSettings::at_speed(double factor) const {
  ObstacleSettings faster = *this;
  if (auto* steering = std::get_if<Steering>(&faster.shape)) steering->strength *= factor;
  if (auto* ball = std::get_if<Ball>(&faster.shape)) ball->strength *= factor * factor;
  if (auto* box = std::get_if<Box>(&faster.shape)) box->strength *= factor * factor;
  const auto hasten = [factor](auto& change) {
    if (change) change->from /= factor, change->over /= factor;
  };
  hasten(faster.appears);
  hasten(faster.vanishes);
  hasten(faster.moves);
  return faster;
}

Obstacle::Obstacle(const std::vector<std::string>& coordinates, const ObstacleSettings& settings)
    : shape_(settings.shape),
      position_(settings.at),
      presence_(settings.appears ? 0.0 : 1.0),
      x_(require_index(coordinates, "x")),
      y_(require_index(coordinates, "y")),
      z_(index_of(coordinates, "z")) {
  std::visit([](const auto& shape) { require(shape); }, shape_);
  if (!settings.at.allFinite()) throw Error("obstacle", "at is not finite");
  const auto done = [](const char* name, bool changed) {
    if (!changed)
      throw Error("obstacle", std::string(name) + ": must be finite, and over 1e-6 to 1e6 s");
  };
  const auto& [at, shape, appears, vanishes, moves] = settings;
  if (appears && vanishes && vanishes->from < appears->from + appears->over)
    throw Error("obstacle",
                "vanishes at " + shown(vanishes->from) + " s, must be after it has appeared");
  if (appears) done("appears", appear(appears->from, appears->over));
  if (vanishes) done("vanishes", vanish(vanishes->from, vanishes->over));
  if (moves) done("moves", move(moves->to, moves->from, moves->over));
}

double Obstacle::distance(const Eigen::Vector3d& tool, double time) const noexcept {
  const Vector from_centre = tool - position(time);
  return std::visit([&](const auto& shape) { return gap(shape, from_centre).distance; }, shape_);
}

double Obstacle::potential(const Eigen::Vector3d& tool, double time) const noexcept {
  const double d = distance(tool, time);
  return presence(time) *
         std::visit([&](const auto& shape) { return seam::potential(shape, d); }, shape_);
}

void Obstacle::add(const Eigen::VectorXd& y, const Eigen::VectorXd& yd, double t,
                   Eigen::VectorXd& ydd) const noexcept {
  const double share = presence(t);
  if (share == 0.0) return;
  const Vector centre = position(t);
  const bool plane = z_ < 0;
  const Vector tool = Vector(y(x_), y(y_), plane ? centre.z() : y(z_)) - centre;
  const Vector velocity(yd(x_), yd(y_), plane ? 0.0 : yd(z_));
  const Vector c =
      share * std::visit([&](const auto& shape) { return push(shape, tool, velocity); }, shape_);
  ydd(x_) += c.x();
  ydd(y_) += c.y();
  if (!plane) ydd(z_) += c.z();
}

std::vector<std::shared_ptr<Obstacle>> add_obstacles(const std::vector<ObstacleSettings>& all,
                                                     Sequencer& sequencer) {
  std::vector<std::shared_ptr<Obstacle>> obstacles;
  for (const ObstacleSettings& one : all)
    obstacles.push_back(std::make_shared<Obstacle>(sequencer.coordinates(), one));
  for (const auto& obstacle : obstacles) sequencer.add_coupling(obstacle);
  return obstacles;
}

}  // namespace seam
