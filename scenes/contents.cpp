#include "scenes/contents.hpp"

#include "scenes/solids.hpp"

namespace seam {

namespace {

constexpr int most_grains = 1000;

LiquidSettings read_liquid_settings(const YamlEntry& entry) {
  LiquidSettings liquid;
  const auto set = [&](const char* key, double& value) {
    if (const auto given = entry.find(key)) value = given->not_negative();
  };
  set("radius", liquid.radius);
  set("depth", liquid.depth);
  set("rim", liquid.rim);
  set("density", liquid.density);
  set("viscosity", liquid.viscosity);
  set("glass", liquid.glass);
  return liquid;
}

VesselSettings read_vessel(const YamlEntry& entry, const char* where) {
  entry.only({where, "radius", "height", "wall", "mass"});
  VesselSettings vessel;
  const auto set = [&](const char* key, double& value) {
    if (const auto given = entry.find(key)) value = given->positive();
  };
  set("radius", vessel.radius);
  set("height", vessel.height);
  set("wall", vessel.wall);
  set("mass", vessel.mass);
  return vessel;
}

GrainSettings read_grains(const YamlEntry& entry) {
  entry.only({"count", "radius", "mass", "friction", "restitution", "frozen"});
  GrainSettings grains;
  if (const auto count = entry.find("count")) grains.count = count->count(1, most_grains);
  if (const auto radius = entry.find("radius")) grains.radius = radius->positive();
  if (const auto mass = entry.find("mass")) grains.mass = mass->positive();
  if (const auto friction = entry.find("friction")) grains.friction = friction->not_negative();
  if (const auto bounce = entry.find("restitution")) grains.restitution = bounce->not_negative();
  return grains;
}

}  // namespace

ToolSettings read_tool(const YamlEntry& entry, const Scene& scene) {
  entry.only({"link", "offset", "turned", "orientation"});
  ToolSettings tool;
  const YamlEntry link = entry.at("link");
  tool.link = link.text();
  at_key(link, [&] { return scene.robot.frame(tool.link).body; });
  if (const auto offset = entry.find("offset"))
    tool.X_link_tool.translation() = offset->numbers(3, "direction");
  if (const auto turned = entry.find("turned"))
    tool.X_link_tool.linear() = turned->orientation().toRotationMatrix();
  tool.orientation = Eigen::Quaterniond::Identity();
  if (const auto orientation = entry.find("orientation"))
    tool.orientation = orientation->orientation();
  tool.posture.rest = scene.start;
  return tool;
}

// In a glass that the tool holds upright.
void read_liquid(const YamlEntry& entry, Scene& scene) {
  entry.only({"bottom", "radius", "depth", "rim", "density", "viscosity", "glass", "frozen"});
  if (!scene.tool) entry.fail("needs a tool that holds it");
  const LiquidSettings liquid = read_liquid_settings(entry);
  const Eigen::Isometry3d X_link_glass =
      scene.tool->X_link_tool * Eigen::Translation3d(entry.at("bottom").numbers(3, "direction"));
  const auto still = entry.find("frozen");
  at_key(entry, [&] {
    const std::string& link = scene.tool->link;
    add_frozen_liquid(scene.robot, link, X_link_glass, liquid);
    if (still && still->choice({"no", "yes"}) == 1) {
      scene.simulated = scene.robot;
      return;
    }
    scene.liquid = liquid;
    scene.X_link_glass = X_link_glass;
    add_liquid(scene.simulated, link, X_link_glass, liquid);
  });
}

void read_pouring(const YamlEntry& entry, Scene& scene) {
  entry.only({"bottle", "grains", "glass", "places"});
  if (!scene.tool) entry.fail("needs a tool that holds the bottle");
  Pouring pouring;
  const YamlEntry bottle = entry.at("bottle");
  const YamlEntry glass = entry.at("glass");
  pouring.bottle = read_vessel(bottle, "bottom");
  pouring.glass = read_vessel(glass, "at");
  pouring.X_link_bottle =
      scene.tool->X_link_tool * Eigen::Translation3d(bottle.at("bottom").numbers(3, "direction"));
  pouring.glass_at = glass.at("at").numbers(3, "direction");
  if (const auto grains = entry.find("grains")) pouring.grains = read_grains(*grains);
  pouring.places = {Eigen::Vector3d::Zero()};
  if (const auto places = entry.find("places"))
    for (const YamlEntry& place : places->items())
      pouring.places.emplace_back(place.numbers(3, "direction"));
  const auto grains = entry.find("grains");
  const auto still = grains ? grains->find("frozen") : std::nullopt;
  const bool frozen = still && still->choice({"no", "yes"}) == 1;
  if (frozen) pouring.bottle.mass += pouring.grains.count * pouring.grains.mass;
  at_key(entry, [&] {
    for (RobotModel* robot : {&scene.robot, &scene.simulated})
      add_vessel(*robot, scene.tool->link, pouring.X_link_bottle, pouring.bottle);
  });
  if (!frozen) scene.pouring = std::move(pouring);
}

Camera read_camera(const YamlEntry& entry) {
  entry.only({"from", "at"});
  const Camera camera{entry.at("from").numbers(3, "direction"),
                      entry.at("at").numbers(3, "direction")};
  const Eigen::Vector3d view = camera.at - camera.from;
  if (!(view.head<2>().norm() > 1e-3 * view.norm()))
    entry.fail("looks straight up or down, or nowhere");
  return camera;
}

// Down to the floor.
Geometry read_table(const YamlEntry& entry) {
  entry.only({"at", "size"});
  const YamlEntry at = entry.at("at");
  const YamlEntry size = entry.at("size");
  const Eigen::Vector3d top = at.numbers(3, "direction");
  const Eigen::VectorXd edges = size.numbers(2, "edge");
  if (!(top.z() > 0.0)) at.fail("must be above the floor");
  if (!(edges.minCoeff() > 0.0)) size.fail("must be > 0");
  const Eigen::Isometry3d X(Eigen::Translation3d(top - Eigen::Vector3d(0.0, 0.0, 0.5 * top.z())));
  return coloured(box(X, {edges.x(), edges.y(), top.z()}), 0.83, 0.78, 0.71);
}

}  // namespace seam
