#include "obstacle_entry.hpp"

#include "yaml_text.hpp"

namespace seam {

namespace {

Eigen::Vector3d read_point(const YamlEntry& entry) {
  return entry.numbers(3, "axis");
}

void set(const YamlEntry& entry, const char* key, double& value) {
  if (const auto given = entry.find(key)) value = given->not_negative();
}

Steering read_steering(const YamlEntry& entry) {
  entry.only({"at", "strength", "sharpness", "reach"});
  Steering steering;
  set(entry, "strength", steering.strength);
  set(entry, "sharpness", steering.sharpness);
  set(entry, "reach", steering.reach);
  return steering;
}

Ball read_ball(const YamlEntry& entry) {
  entry.only({"at", "radius", "strength", "reach"});
  Ball ball;
  ball.radius = entry.at("radius").positive();
  set(entry, "strength", ball.strength);
  set(entry, "reach", ball.reach);
  return ball;
}

Box read_box(const YamlEntry& entry) {
  entry.only({"at", "size", "orientation", "strength", "reach"});
  Box box;
  box.size = read_point(entry.at("size"));
  if (const auto orientation = entry.find("orientation"))
    box.orientation = orientation->orientation();
  set(entry, "strength", box.strength);
  set(entry, "reach", box.reach);
  return box;
}

void read_shape(const YamlEntry& entry, ObstacleSettings& settings) {
  int shapes = 0;
  const auto read = [&](const char* key, auto read_as) {
    const auto shape = entry.find(key);
    if (!shape) return;
    settings.shape = read_as(*shape);
    settings.at = read_point(shape->at("at"));
    ++shapes;
  };
  read("steer", read_steering);
  read("ball", read_ball);
  read("box", read_box);
  if (shapes != 1) entry.fail("must have one of the keys steer, ball, box");
}

std::optional<Fading> read_fading(const YamlEntry& entry, const char* key) {
  const auto given = entry.find(key);
  if (!given) return std::nullopt;
  given->only({"from", "over"});
  Fading fading;
  fading.from = given->at("from").number();
  if (const auto over = given->find("over")) fading.over = over->positive();
  return fading;
}

Moving read_moving(const YamlEntry& entry) {
  entry.only({"to", "from", "over"});
  return {read_point(entry.at("to")), entry.at("from").number(), entry.at("over").positive()};
}

std::string pair(const char* key, const std::string& value) {
  return std::string(", ") + key + ": " + value;
}

std::string pair(const char* key, double value) {
  return pair(key, yaml_number(value));
}

std::string text_of(const Steering& steering) {
  return pair("strength", steering.strength) + pair("sharpness", steering.sharpness) +
         pair("reach", steering.reach);
}

std::string text_of(const Ball& ball) {
  return pair("radius", ball.radius) + pair("strength", ball.strength) + pair("reach", ball.reach);
}

std::string text_of(const Box& box) {
  return pair("size", yaml_list(Eigen::VectorXd(box.size))) +
         pair("orientation", yaml_list(Eigen::VectorXd(box.orientation.coeffs()))) +
         pair("strength", box.strength) + pair("reach", box.reach);
}

std::string text_of(const char* key, const std::optional<Fading>& fading) {
  if (!fading) return {};
  return std::string("    ") + key + ": {from: " + yaml_number(fading->from) +
         pair("over", fading->over) + "}\n";
}

std::string text_of(const std::optional<Moving>& moving) {
  if (!moving) return {};
  return "    moves: {to: " + yaml_list(Eigen::VectorXd(moving->to)) + pair("from", moving->from) +
         pair("over", moving->over) + "}\n";
}

}  // namespace

ObstacleSettings read_obstacle(const YamlEntry& entry,
                               const std::vector<std::string>& coordinates) {
  entry.only({"steer", "ball", "box", "appears", "vanishes", "moves"});
  ObstacleSettings settings;
  read_shape(entry, settings);
  settings.appears = read_fading(entry, "appears");
  settings.vanishes = read_fading(entry, "vanishes");
  if (const auto moves = entry.find("moves")) settings.moves = read_moving(*moves);
  at_key(entry, [&] { Obstacle(coordinates, settings); });
  return settings;
}

std::string couplings_text(const std::vector<ObstacleSettings>& obstacles,
                           const std::vector<std::string>& coordinates) {
  constexpr const char* names[] = {"steer", "ball", "box"};
  std::string text = obstacles.empty() ? "" : "couplings:\n";
  for (const ObstacleSettings& one : obstacles) {
    Obstacle(coordinates, one);
    text += std::string("  - ") + names[one.shape.index()] +
            ": {at: " + yaml_list(Eigen::VectorXd(one.at)) +
            std::visit([](const auto& shape) { return text_of(shape); }, one.shape) + "}\n" +
            text_of("appears", one.appears) + text_of("vanishes", one.vanishes) +
            text_of(one.moves);
  }
  return text;
}

}  // namespace seam
