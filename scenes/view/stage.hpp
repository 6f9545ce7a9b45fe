#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/replay.hpp"
#include "scenes/view/drops.hpp"
#include "scenes/view/renderer.hpp"

namespace seam {

/// A replay as things that can be drawn, at any time: what lies between two frames is interpolated. Needs a current context
/// from first to last.
class Stage {
 public:
  /// @throws Error  see load_mesh
  explicit Stage(Replay replay);

  const Replay& replay() const noexcept { return replay_; }
  double duration() const;             // [s]
  Eigen::AlignedBox3d around() const;  // of all that is ever seen, with some room
  /// @param time   [s]; outside of the replay as at its ends
  /// @param trail  [m] radius of the tool's trail
  std::vector<Item> at(double time, double trail) const;
  /// What matters: the liquid's vessel, else the grains, else the tool.
  Eigen::Vector3d focus(double time) const;
  double wave(double time) const;     // [m] height at the wall
  double spilled(double time) const;  // share so far [0 to 1]

  /// Colour of a primitive's trail, sRGB 0…1.
  static Eigen::Vector3f colour(int primitive);

 private:
  struct Moment {
    Eigen::Index frame;  // and the next one
    double share;        // of the way to it
  };
  using Shapes = std::vector<Item>;

  Moment moment(double time) const;
  Eigen::VectorXd between(const Replay::Track& track, double time) const;
  Eigen::Isometry3d pose(const Moment& moment, std::size_t part) const;
  void add_part(const Replay::Part& part);
  void add_liquid(double time, std::vector<Item>& items) const;
  void add_drops(double time, std::vector<Item>& items) const;
  void add_trail(double time, double thickness, std::vector<Item>& items) const;

  Replay replay_;
  std::vector<Shapes> parts_;  // their poses are in the part
  std::shared_ptr<const GpuMesh> ball_, disc_;
  std::vector<Drop> drops_;
};

}  // namespace seam
