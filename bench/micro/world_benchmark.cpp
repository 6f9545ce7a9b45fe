// Cost of a world's step with the plug-in beside without, the arms moving alike; with meshes that collide beside boxes and
// cylinders; and of each of many arms beside one alone.

#include <algorithm>
#include <memory>

#include "bench/micro/arms.hpp"
#include "bench/micro/benchmarks.hpp"
#include "bench/micro/mesh_arm.hpp"
#include "bench/micro/pair.hpp"

namespace seam::micro {

namespace {

constexpr Join join = Join::dmp3;

/// Arms that make the movement again and again, a tick at a time.
class Play {
 public:
  explicit Play(int count, const RobotModel& model = pa10())
      : arms_(count, joint_movement(), join, model) {}

  void with_plugin(int ticks) {
    for (int k = 0; k < ticks; ++k) arms_.step();
  }
  void without_plugin(int ticks) {
    for (int k = 0; k < ticks; ++k)
      arms_.step(commanded_[tick_ + static_cast<std::size_t>(k)].torque);
  }
  void control(int ticks) {
    for (int k = 0; k < ticks; ++k) arms_.tick();
  }
  /// After some ticks; from the beginning where the next ones would go beyond the end.
  void go_on(int ticks) {
    tick_ += static_cast<std::size_t>(ticks);
    if (tick_ + static_cast<std::size_t>(ticks) <= commanded_.size()) return;
    tick_ = 0;
    arms_.restart();
  }

 private:
  Arms arms_;
  std::vector<Controller::Tick> commanded_ = played(joint_movement(), join);
  std::size_t tick_ = 0;
};

using Ticks = void (Play::*)(int);

Timed ticks(const std::shared_ptr<Play>& play, Ticks kind, int count) {
  return timed([=] { ((*play).*kind)(count); });
}

/// Two arms, each with a world of its own.
Pair side_by_side(const RobotModel& model, Ticks kind, const RobotModel& beside,
                  Ticks kind_beside) {
  constexpr int together = 20;
  const auto a = std::make_shared<Play>(1, model);
  const auto b = std::make_shared<Play>(1, beside);
  return {ticks(a, kind, together), ticks(b, kind_beside, together), together, [=] {
            a->go_on(together);
            b->go_on(together);
          }};
}

Pair many_and_one(Ticks kind, int count) {
  const int together = std::max(1, 32 / count);
  const auto many = std::make_shared<Play>(count);
  const auto one = std::make_shared<Play>(1);
  return {ticks(many, kind, together), ticks(one, kind, together * count),
          static_cast<double>(together * count), [=] {
            many->go_on(together);
            one->go_on(together * count);
          }};
}

}  // namespace

void add_world_benchmarks() {
  add_pair("world step with the plug-in / without, same torques", no_bar, 3000,
           [] { return side_by_side(pa10(), &Play::with_plugin, pa10(), &Play::without_plugin); });
  add_pair("world step with rotors and friction / without", no_bar, 3000, [] {
    return side_by_side(pa10_with_drives(), &Play::with_plugin, pa10(), &Play::with_plugin);
  });
  add_pair("world step, meshes as colliders / boxes and cylinders", 1.33, 3000, [] {
    return side_by_side(mesh_arm(), &Play::without_plugin, pa10(), &Play::without_plugin);
  });
  struct Kind {
    std::string name;
    Ticks ticks;
    double bar;
  };
  for (const Kind& kind : {Kind{"control", &Play::control, 1.2},
                           {"Bullet's step", &Play::without_plugin, no_bar},
                           {"both", &Play::with_plugin, 1.2}})
    for (const int count : {2, 4, 16, 64, 256})
      add_pair(kind.name + " per arm, " + std::to_string(count) + " arms in a world / one",
               kind.bar, std::max(200, 2000 / count),
               [ticks = kind.ticks, count] { return many_and_one(ticks, count); });
}

}  // namespace seam::micro
