#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/view/font.hpp"
#include "scenes/view/stage.hpp"

namespace seam {

enum class View { scene, orbit, close_up };

struct StudioSettings {
  int width = 1280, height = 720;  // [pixels] of the whole picture
  View view = View::scene;
  bool inset = false;  // a close-up in a corner
  double speed = 1.0;  // at which it is shown, for the label
};

/// Pictures of runs side by side, with labels. Needs a current context from first to last.
class Studio {
 public:
  /// @throws Error  see Stage, Renderer and Font
  Studio(std::vector<Replay> replays, const StudioSettings& settings);

  const std::vector<Stage>& stages() const noexcept { return stages_; }
  double duration() const;  // [s] of the longest
  /// @param time  [s]
  /// @param turn  of an orbit [0 to 1]
  Image at(double time, double turn = 0.0) const;
  /// Where a stage is seen from.
  Camera camera(const Stage& stage, View view, double time, double turn) const;

 private:
  Image draw(const Renderer& renderer, const Stage& stage, View view, double time,
             double turn) const;
  Image panel(const Stage& stage, double time, double turn) const;
  void label(const Stage& stage, double time, Image& image) const;

  StudioSettings settings_;
  std::vector<Stage> stages_;
  int panel_width_;
  Renderer renderer_;
  std::optional<Renderer> inset_;
  Font large_, small_;
};

}  // namespace seam
