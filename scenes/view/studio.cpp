#include "scenes/view/studio.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace seam {

namespace {

constexpr double close = 0.34;                     // [m] of a close-up from what it shows
constexpr double trail_share = 0.0018;             // radius of the trail, of the distance
constexpr double least_trail = 0.0011;             // [m]
constexpr double elevation = 16.0 * M_PI / 180.0;  // of a close-up above it
constexpr double inset_share = 0.45;               // of a panel's smaller side
constexpr Image::Colour ink{32, 34, 38};
constexpr Image::Colour pale{96, 100, 108};
constexpr Image::Colour red{205, 32, 24};
constexpr Image::Colour frame{205, 208, 214};

int inset_size(int width, int height) {
  return static_cast<int>(inset_share * std::min(width, height));
}

int line_height(int width, int height) {
  return std::clamp(std::min(width, height) / 27, 12, 64);
}

Image::Colour bytes(const Eigen::Vector3f& srgb) {
  Image::Colour colour;
  for (std::size_t i = 0; i < 3; ++i)
    colour[i] = static_cast<std::uint8_t>(std::lround(255.0F * srgb[static_cast<int>(i)]));
  return colour;
}

}  // namespace

Studio::Studio(std::vector<Replay> replays, const StudioSettings& settings)
    : settings_(settings),
      panel_width_(settings.width / static_cast<int>(replays.size())),
      renderer_(panel_width_, settings.height),
      large_(3 * line_height(panel_width_, settings.height) / 2),
      small_(line_height(panel_width_, settings.height)) {
  for (Replay& replay : replays) stages_.emplace_back(std::move(replay));
  const int side = inset_size(panel_width_, settings.height);
  if (settings.inset) inset_.emplace(side, side);
}

double Studio::duration() const {
  double longest = 0.0;
  for (const Stage& stage : stages_) longest = std::max(longest, stage.duration());
  return longest;
}

Camera Studio::camera(const Stage& stage, View view, double time, double turn) const {
  const Camera& given = stage.replay().camera;
  const Eigen::Vector3d offset = given.from - given.at;
  if (view == View::scene) return given;
  if (view == View::orbit) {
    const Eigen::AngleAxisd turned(2.0 * M_PI * turn, Eigen::Vector3d::UnitZ());
    return {given.at + turned * offset, given.at};
  }
  const Eigen::Vector3d focus = stage.focus(time);
  const double azimuth = std::atan2(offset.y(), offset.x());
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  return {focus + close * direction, focus};
}

Image Studio::at(double time, double turn) const {
  Image whole(settings_.width, settings_.height);
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    const int x = static_cast<int>(i) * panel_width_;
    whole.paste(panel(stages_[i], time, turn), x, 0);
    if (i > 0) whole.fill(x - 1, 0, 2, settings_.height, frame);
  }
  return whole;
}

Image Studio::draw(const Renderer& renderer, const Stage& stage, View view, double time,
                   double turn) const {
  const Camera seen_from = camera(stage, view, time, turn);
  const double trail = std::max(least_trail, trail_share * (seen_from.from - seen_from.at).norm());
  return renderer.draw(stage.at(time, trail), seen_from, stage.around());
}

Image Studio::panel(const Stage& stage, double time, double turn) const {
  Image image = draw(renderer_, stage, settings_.view, time, turn);
  if (inset_) {
    const Image near = draw(*inset_, stage, View::close_up, time, turn);
    const int margin = small_.width("o");
    const int x = image.width - near.width - margin;
    const int y = margin;
    image.fill(x - 2, y - 2, near.width + 4, near.height + 4, frame);
    image.paste(near, x, y);
  }
  label(stage, time, image);
  return image;
}

void Studio::label(const Stage& stage, double time, Image& image) const {
  const int line = line_height(panel_width_, settings_.height);
  const int x = line;
  const Replay& replay = stage.replay();
  int y = 2 * line;
  large_.draw(image, x, y, replay.method, ink);
  if (replay.liquid) {
    small_.draw(image, x, y += 3 * line / 2, fmt::format("wave {:.1f} mm", stage.wave(time) * 1e3),
                pale);
    const double spilled = stage.spilled(time);
    small_.draw(image, x, y += 5 * line / 4,
                spilled > 0.0 ? fmt::format("spilled {:.2f} %", spilled * 1e2) : "nothing spilled",
                spilled > 0.0 ? red : pale);
  }
  const double now = std::clamp(time, 0.0, stage.duration());
  const auto frame_now = static_cast<std::size_t>(now * replay.frame_rate + 1e-6);
  const int running = replay.running[std::min(frame_now, replay.running.size() - 1)];
  std::string clock = fmt::format("{:.2f} s", now);
  if (settings_.speed != 1.0) clock += fmt::format(", speed {:g}", settings_.speed);
  small_.draw(image, x, image.height - line, clock, pale);
  if (running >= 0)
    small_.draw(image, x, image.height - 9 * line / 4,
                replay.primitives.at(static_cast<std::size_t>(running)),
                bytes(Stage::colour(running)));
}

}  // namespace seam
