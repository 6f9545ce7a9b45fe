#include "scenes/object.hpp"

#include <utility>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

namespace seam {

namespace {

class SloshingLiquid final : public Object {
 public:
  SloshingLiquid(const LiquidSettings& settings, Robot& robot, int ticks)
      : settings_(settings), liquid_(robot, settings), wave_(Eigen::VectorXd::Zero(ticks)) {}

  void pre_tick(Eigen::Index tick) override {
    liquid_.pre_tick();
    wave_(tick) = liquid_.wave();
  }
  void finish(Recording& recording) const override {
    const double peak = wave_.maxCoeff();
    recording.signals.push_back({"wave_m", wave_});
    recording.outcomes.push_back({"wave_peak_m", peak});
    recording.outcomes.push_back({"spilled_share", share_above_rim(settings_, peak)});
  }

 private:
  LiquidSettings settings_;
  Liquid liquid_;
  Eigen::VectorXd wave_;
};

class PouredGrains final : public Object {
 public:
  PouredGrains(const Scene& scene, Robot& robot, std::size_t place)
      : glass_(robot.world(), glass_pose(*scene.pouring, place), scene.pouring->glass),
        grains_(robot.world(), bottle_pose(scene, robot), scene.pouring->bottle,
                scene.pouring->grains, scene.seed) {}

  void pre_tick(Eigen::Index) override {}
  void finish(Recording& recording) const override {
    recording.outcomes.push_back({"poured_share", grains_.share_in(glass_)});
  }

 private:
  static Eigen::Isometry3d glass_pose(const Pouring& pouring, std::size_t place) {
    return Eigen::Isometry3d(Eigen::Translation3d(pouring.glass_at + pouring.places[place]));
  }
  static Eigen::Isometry3d bottle_pose(const Scene& scene, const Robot& robot) {
    return robot.X_world_frame(robot.model().frame(scene.tool->link)) *
           scene.pouring->X_link_bottle;
  }

  StandingVessel glass_;
  Grains grains_;
};

}  // namespace

std::vector<std::unique_ptr<Object>> make_objects(const Scene& scene, Robot& robot, int ticks,
                                                  std::size_t place) {
  std::vector<std::unique_ptr<Object>> objects;
  if (scene.liquid)
    objects.push_back(std::make_unique<SloshingLiquid>(*scene.liquid, robot, ticks));
  if (scene.pouring) objects.push_back(std::make_unique<PouredGrains>(scene, robot, place));
  return objects;
}

}  // namespace seam
