#include "scenes/gates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plugin/files/src/yaml_reader.hpp"
#include "scenes/object.hpp"
#include "scenes/solids.hpp"

namespace seam {

namespace {

constexpr double bar = 0.008;  // [m] thickness of a frame
constexpr std::size_t most_gates = 100;

Gate read_gate(const YamlEntry& entry) {
  entry.only({"at", "axis", "opening"});
  Gate gate;
  const YamlEntry axis = entry.at("axis");
  const Eigen::Vector3d along = axis.numbers(3, "direction");
  if (!(along.norm() > 1e-6)) axis.fail("must have a direction");
  const Eigen::Vector3d x = along.normalized();
  const Eigen::Vector3d up =
      std::abs(x.z()) > 0.999 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d y = up.cross(x).normalized();
  gate.X_world_gate.linear() << x, y, x.cross(y);
  gate.X_world_gate.translation() = entry.at("at").numbers(3, "direction");
  if (const auto opening = entry.find("opening")) gate.opening = opening->positive();
  return gate;
}

Replay::Part frame_of(const Gate& gate) {
  Replay::Part part{"gate", {}, {}};
  const double middle = 0.5 * (gate.opening + bar);
  const auto add = [&](double y, double z, const Eigen::Vector3d& edges) {
    const Eigen::Isometry3d X(Eigen::Translation3d(0.0, y, z));
    part.visuals.push_back(coloured(box(X, edges), 0.13, 0.38, 0.62));
  };
  for (const double side : {-middle, middle}) {
    add(side, 0.0, {bar, bar, gate.opening + 2.0 * bar});
    add(0.0, side, {bar, gate.opening, bar});
  }
  return part;
}

class Gates final : public Object {
 public:
  Gates(const Scene& scene, const Robot& robot)
      : gates_(scene.gates),
        robot_(robot),
        tool_(scene.tool_frame()),
        passages_(gates_.begin(), gates_.end()) {
    if (scene.tool) to_link_ = scene.tool->X_link_tool.inverse().translation();
  }

  void pre_tick(Eigen::Index, double) override {
    const Eigen::Vector3d place = robot_.X_world_frame(tool_).translation();
    for (Passage& passage : passages_) passage.go_to(place);
  }
  void appear(Replay& replay) override {
    part_ = replay.parts.size();
    for (const Gate& gate : gates_) replay.parts.push_back(frame_of(gate));
    if (!has_rod()) return;
    const Geometry solid = coloured(rod(to_link_, 0.4 * bar), 0.25, 0.27, 0.30);
    replay.parts.push_back({"rod", {solid}, {}});
  }
  void film(Eigen::Index frame, Replay& replay) const override {
    for (std::size_t i = 0; i < gates_.size(); ++i)
      replay.set_pose(frame, part_ + i, gates_[i].X_world_gate);
    if (has_rod()) replay.set_pose(frame, part_ + gates_.size(), robot_.X_world_frame(tool_));
  }
  void finish(Recording& recording) const override {
    double least = std::numeric_limits<double>::infinity();
    for (const Passage& passage : passages_) least = std::min(least, passage.clearance());
    recording.outcomes.push_back({"clearance_m", least, true});
  }

 private:
  bool has_rod() const { return to_link_.norm() > bar; }

  const std::vector<Gate>& gates_;
  const Robot& robot_;
  Frame tool_;
  Eigen::Vector3d to_link_ = Eigen::Vector3d::Zero();  // [m] in the tool's frame
  std::vector<Passage> passages_;
  std::size_t part_ = 0;
};

}  // namespace

void Passage::go_to(const Eigen::Vector3d& place) {
  const Eigen::Vector3d here = gate_.X_world_gate.inverse() * place;
  if (last_ && last_->x() < 0.0 && here.x() >= 0.0) {
    const double share = last_->x() / (last_->x() - here.x());
    const Eigen::Vector3d crossing = *last_ + share * (here - *last_);
    best_ = std::max(best_, 0.5 * gate_.opening - crossing.tail<2>().cwiseAbs().maxCoeff());
  }
  last_ = here;
}

double Passage::clearance() const {
  return std::isfinite(best_) ? best_ : -gate_.opening;
}

std::vector<Gate> read_gates(const YamlEntry& entry) {
  std::vector<Gate> gates;
  for (const YamlEntry& item : entry.items()) {
    if (gates.size() == most_gates) entry.fail("more than 100 gates");
    gates.push_back(read_gate(item));
  }
  return gates;
}

std::unique_ptr<Object> make_gates(const Scene& scene, const Robot& robot) {
  return std::make_unique<Gates>(scene, robot);
}

}  // namespace seam
