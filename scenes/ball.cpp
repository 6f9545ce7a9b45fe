#include "scenes/ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/object.hpp"
#include "scenes/solids.hpp"
#include <seam/noise.hpp>

namespace seam {

namespace {

const Eigen::Vector3d gravity(0.0, 0.0, -9.81);  // [m/s²] as in World

FlyingBall read_flight(const YamlEntry& entry) {
  FlyingBall ball;
  if (const auto radius = entry.find("radius")) ball.radius = radius->positive();
  ball.at = entry.at("at").numbers(3, "direction");
  ball.velocity = entry.at("velocity").numbers(3, "direction");
  const auto carried = entry.find("carried");
  if (!carried || carried->choice({"no", "yes"}) == 0) ball.acceleration = gravity;
  ball.thrown = entry.at("thrown").not_negative();
  const YamlEntry caught = entry.at("caught");
  ball.caught = caught.positive();
  if (!(ball.caught > ball.thrown)) caught.fail(caught.text() + ", must be > thrown");
  return ball;
}

// Index of the hit among its step's wishes.
int first_hit(const YamlEntry& entry, const Sequence& sequence) {
  for (const Sequence::Step& step : sequence.steps())
    for (std::size_t i = 0; i < step.wishes.size(); ++i)
      if (step.wishes[i].then == Wish::Then::hand_over) return static_cast<int>(i);
  entry.fail("needs a step of the sequence with a hit, which it moves");
}

Event hit_of(const Forecast& forecast, const FlyingBall& ball, std::size_t coordinates) {
  Event event;
  event.what = Event::What::hit;
  event.goal = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(coordinates),
                                         std::numeric_limits<double>::quiet_NaN());
  event.velocity = event.goal;
  event.goal.head<3>() = forecast.position();
  event.velocity.head<3>() = forecast.velocity();
  event.when = ball.caught;
  return event;
}

// A camera that sees a ball. One picture alone tells no velocity.
struct Sight {
  std::vector<double> times;  // [s] of its pictures
  double noise = 0.0;         // [m]
  std::size_t least = 2;      // pictures that a forecast takes
};

Sight read_sight(const YamlEntry& entry, const FlyingBall& ball) {
  entry.only({"from", "to", "every", "noise", "least"});
  Sight sight;
  sight.times = picture_times(entry);
  if (sight.times.front() < ball.thrown) entry.at("from").fail("must be >= thrown");
  if (!(sight.times.back() < ball.caught)) entry.at("to").fail("must be < caught");
  if (const auto noise = entry.find("noise")) sight.noise = noise->not_negative();
  if (const auto least = entry.find("least"))
    sight.least = static_cast<std::size_t>(least->count(2));
  if (sight.times.size() < sight.least) entry.fail("has fewer pictures than a forecast takes");
  return sight;
}

void watch(const YamlEntry& entry, const FlyingBall& ball, Scene& scene) {
  const Sight sight = read_sight(entry, ball);
  const int which = first_hit(entry, scene.sequence);
  Noise random(scene.seed);
  Forecast forecast(ball.caught, ball.acceleration);
  for (std::size_t i = 0; i < sight.times.size(); ++i) {
    Eigen::Vector3d place = ball.position(sight.times[i]);
    for (double& seen : place) seen += sight.noise * random.normal();
    forecast.see(sight.times[i], place);
    if (i + 1 < sight.least) continue;
    Event event = hit_of(forecast, ball, scene.sequence.coordinates().size());
    event.at = sight.times[i];
    event.which = which;
    scene.events.push_back(std::move(event));
  }
  sort_by_time(scene.events);
}

class CaughtBall final : public Object {
 public:
  CaughtBall(const Scene& scene, const Robot& robot, int ticks, double dt)
      : ball_(*scene.ball), robot_(robot), tool_(scene.tool_frame()), way_(3, ticks), dt_(dt) {}

  void pre_tick(Eigen::Index tick, double time) override {
    const Eigen::Isometry3d X_world_tool = robot_.X_world_frame(tool_);
    way_.col(tick) = X_world_tool.translation();
    const bool is_in_hand = !in_hand_ && time >= ball_.caught && time - dt_ < ball_.caught &&
                            (ball_.position(time) - way_.col(tick)).norm() <= ball_.radius;
    if (is_in_hand) in_hand_ = X_world_tool.inverse() * ball_.position(time);
    place_ = in_hand_ ? X_world_tool * *in_hand_ : ball_.position(time);
  }
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    replay.parts.push_back({"ball", {coloured(sphere(ball_.radius), 0.93, 0.48, 0.10)}, {}});
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    replay.set_pose(frame, part_, Eigen::Isometry3d(Eigen::Translation3d(place_)));
  }
  void finish(Recording& recording) const override {
    const bool is_over = way_.cols() > 2 && static_cast<double>(way_.cols()) * dt_ > ball_.caught;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Miss missed = is_over ? miss(ball_, way_, dt_) : Miss{none, none, none};
    recording.outcomes.push_back({"miss_m", missed.place});
    recording.outcomes.push_back({"velocity_miss_m_s", missed.velocity});
    recording.outcomes.push_back({"time_miss_s", missed.time});
  }

 private:
  const FlyingBall& ball_;
  const Robot& robot_;
  Frame tool_;
  Eigen::Matrix3Xd way_;
  double dt_;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> in_hand_;  // where in the tool's frame
  std::size_t part_ = 0;
};

// Of values at -1, 0 and 1 the least of the parabola through them, if it lies between.
double least_of(double before, double now, double after) {
  const double curvature = after - 2.0 * now + before;
  return curvature > 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

double nearest(const FlyingBall& ball, const Eigen::Matrix3Xd& way, double dt) {
  Eigen::VectorXd square(way.cols());
  for (Eigen::Index k = 0; k < way.cols(); ++k)
    square(k) = (way.col(k) - ball.position(static_cast<double>(k) * dt)).squaredNorm();
  Eigen::Index k = 0;
  square.minCoeff(&k);
  if (k == 0 || k == way.cols() - 1) return static_cast<double>(k) * dt;
  return (static_cast<double>(k) + least_of(square(k - 1), square(k), square(k + 1))) * dt;
}

}  // namespace

Eigen::Vector3d FlyingBall::position(double time) const {
  const double t = std::max(time - thrown, 0.0);
  return at + t * velocity + 0.5 * t * t * acceleration;
}

Eigen::Vector3d FlyingBall::velocity_at(double time) const {
  if (time < thrown) return Eigen::Vector3d::Zero();
  return velocity + (time - thrown) * acceleration;
}

void Forecast::see(double time, const Eigen::Vector3d& place) {
  const double s = time - time_;
  const Eigen::Vector3d y = place - 0.5 * s * s * acceleration_;
  n_ += 1.0;
  s_ += s;
  ss_ += s * s;
  y_ += y;
  sy_ += s * y;
}

Eigen::Vector3d Forecast::velocity() const {
  return (n_ * sy_ - s_ * y_) / (n_ * ss_ - s_ * s_);
}

Eigen::Vector3d Forecast::position() const {
  return (y_ - s_ * velocity()) / n_;
}

Miss miss(const FlyingBall& ball, const Eigen::Matrix3Xd& way, double dt) {
  const double tick = ball.caught / dt;
  const auto k = std::clamp<Eigen::Index>(std::lround(tick), 1, way.cols() - 2);
  const double s = tick - static_cast<double>(k);
  const Eigen::Vector3d slope = 0.5 * (way.col(k + 1) - way.col(k - 1));
  const Eigen::Vector3d curvature = way.col(k + 1) - 2.0 * way.col(k) + way.col(k - 1);
  const Eigen::Vector3d place = way.col(k) + s * slope + 0.5 * s * s * curvature;
  const Eigen::Vector3d velocity = (slope + s * curvature) / dt;
  return {(place - ball.position(ball.caught)).norm(),
          (velocity - ball.velocity_at(ball.caught)).norm(),
          std::abs(nearest(ball, way, dt) - ball.caught)};
}

void FlyingBall::hasten(double factor) {
  thrown /= factor;
  caught /= factor;
  velocity *= factor;
  acceleration *= factor * factor;
}

void read_ball(const YamlEntry& entry, Scene& scene) {
  entry.only({"radius", "at", "velocity", "carried", "thrown", "caught", "seen"});
  if (!scene.tool) entry.fail("needs a tool that catches it");
  const FlyingBall ball = read_flight(entry);
  if (!(ball.caught < scene.duration)) entry.at("caught").fail("must be before the run ends");
  if (const auto seen = entry.find("seen")) watch(*seen, ball, scene);
  scene.ball = ball;
}

std::unique_ptr<Object> make_ball(const Scene& scene, const Robot& robot, int ticks, double dt) {
  return std::make_unique<CaughtBall>(scene, robot, ticks, dt);
}

}  // namespace seam
