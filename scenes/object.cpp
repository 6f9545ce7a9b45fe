#include "scenes/object.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

namespace seam {

namespace {

// A vessel in the hand.
Frame held(const Scene& scene, const Robot& robot, const Eigen::Isometry3d& X_link_vessel) {
  Frame frame = robot.model().frame(scene.tool->link);
  frame.X_body_frame = frame.X_body_frame * X_link_vessel;
  return frame;
}

class SloshingLiquid final : public Object {
 public:
  SloshingLiquid(const Scene& scene, Robot& robot, int ticks)
      : settings_(*scene.liquid),
        robot_(robot),
        glass_(held(scene, robot, scene.X_link_glass)),
        liquid_(robot, settings_),
        wave_(Eigen::VectorXd::Zero(ticks)) {}

  void pre_tick(Eigen::Index tick, double) override {
    liquid_.pre_tick();
    wave_(tick) = liquid_.wave();
    peak_ = std::max(peak_, wave_(tick));
  }
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    const VesselSettings glass{settings_.radius, settings_.depth + settings_.rim, 0.002,
                               settings_.glass};
    replay.parts.push_back({"glass", {}, glass});
    replay.liquid = {
        static_cast<int>(part_), settings_.radius, settings_.depth, settings_.rim, {}, {}};
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    replay.set_pose(frame, part_, robot_.X_world_frame(glass_));
    replay.liquid->waves.row(frame) = liquid_.waves().cast<float>();
    const double spilled = peak_ > settings_.rim ? share_above_rim(settings_, peak_) : 0.0;
    replay.liquid->spilled(frame, 0) = static_cast<float>(spilled);
  }
  void finish(Recording& recording) const override {
    recording.signals.push_back({"wave_m", wave_});
    recording.outcomes.push_back({"wave_peak_m", peak_});
    recording.outcomes.push_back({"spilled_share", share_above_rim(settings_, peak_)});
  }

 private:
  LiquidSettings settings_;
  Robot& robot_;
  Frame glass_;
  Liquid liquid_;
  Eigen::VectorXd wave_;
  double peak_ = 0.0;  // [m] of the wave so far
  std::size_t part_ = 0;
};

class PouredGrains final : public Object {
 public:
  PouredGrains(const Scene& scene, Robot& robot, std::size_t place)
      : pouring_(*scene.pouring),
        robot_(robot),
        X_world_glass_(Eigen::Translation3d(pouring_.glass_at + pouring_.places[place])),
        bottle_(held(scene, robot, pouring_.X_link_bottle)),
        glass_(robot.world(), X_world_glass_, pouring_.glass),
        grains_(robot.world(), robot.X_world_frame(bottle_), pouring_.bottle, pouring_.grains,
                scene.seed) {}

  void pre_tick(Eigen::Index, double) override {}
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    replay.parts.push_back({"glass", {}, pouring_.glass});
    replay.parts.push_back({"bottle", {}, pouring_.bottle});
    replay.grains = {pouring_.grains.radius, Replay::Track(0, 3 * grains_.count())};
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    replay.set_pose(frame, part_, X_world_glass_);
    replay.set_pose(frame, part_ + 1, robot_.X_world_frame(bottle_));
    for (int i = 0; i < grains_.count(); ++i)
      replay.grains->positions.block<1, 3>(frame, 3 * i) = grains_.position(i).cast<float>();
  }
  void finish(Recording& recording) const override {
    recording.outcomes.push_back({"poured_share", grains_.share_in(glass_), true});
  }

 private:
  const Pouring& pouring_;
  Robot& robot_;
  Eigen::Isometry3d X_world_glass_;
  Frame bottle_;
  StandingVessel glass_;
  Grains grains_;
  std::size_t part_ = 0;
};

// A glass that stands where the goal is seen: nothing but a sight.
class MovingGlass final : public Object {
 public:
  explicit MovingGlass(const Scene& scene) : scene_(scene) {}

  void pre_tick(Eigen::Index, double) override {}
  void finish(Recording&) const override {}
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    replay.parts.push_back({"glass", {}, VesselSettings{0.033, 0.08, 0.002, 0.0}});
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    const double time = static_cast<double>(frame) / replay.frame_rate;
    Eigen::Vector3d goal = scene_.sequence.steps().front().primitive.goal.head<3>();
    for (const Event& event : scene_.events)
      if (event.what == Event::What::goal && event.at <= time)
        for (int i = 0; i < 3; ++i)
          if (!std::isnan(event.goal(i))) goal(i) = event.goal(i);
    replay.set_pose(frame, part_, Eigen::Isometry3d(Eigen::Translation3d(goal - below_)));
  }

 private:
  const Scene& scene_;
  const Eigen::Vector3d below_{0.0, 0.0, 0.06};  // [m] of its bottom below the tool that takes it
  std::size_t part_ = 0;
};

bool has_moving_goal(const Scene& scene) {
  return scene.tool &&
         std::any_of(scene.events.begin(), scene.events.end(),
                     [](const Event& event) { return event.what == Event::What::goal; });
}

}  // namespace

std::vector<std::unique_ptr<Object>> make_objects(const Scene& scene, Robot& robot, int ticks,
                                                  double dt, std::size_t place) {
  std::vector<std::unique_ptr<Object>> objects;
  if (scene.liquid) objects.push_back(std::make_unique<SloshingLiquid>(scene, robot, ticks));
  if (scene.pouring) objects.push_back(std::make_unique<PouredGrains>(scene, robot, place));
  if (has_moving_goal(scene)) objects.push_back(std::make_unique<MovingGlass>(scene));
  if (!scene.gates.empty()) objects.push_back(make_gates(scene, robot));
  if (!scene.obstacles.empty()) objects.push_back(make_obstacles(scene, robot));
  if (scene.ball) objects.push_back(make_ball(scene, robot, ticks, dt));
  return objects;
}

}  // namespace seam
