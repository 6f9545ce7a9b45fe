#include "primitive_entry.hpp"
#include "yaml_text.hpp"
#include <seam/orientation.hpp>
#include <seam/primitive_file.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

constexpr const char* format_name = "seam-primitive";
constexpr int format_with_reference = 2;

std::vector<std::string> texts(const YamlEntry& entry) {
  std::vector<std::string> list;
  for (const YamlEntry& item : entry.items()) list.push_back(item.text());
  return list;
}

Gains read_gains(const YamlEntry& entry) {
  entry.only({"K", "D", "H"});
  return {entry.at("K").positive(), entry.at("D").positive(), entry.at("H").positive()};
}

Kernels read_kernels(const YamlEntry& entry) {
  entry.only({"centers", "widths"});
  const Eigen::VectorXd centers = entry.at("centers").numbers();
  return {centers, entry.at("widths").numbers(centers.size(), "kernel")};
}

Eigen::MatrixXd read_weights(const YamlEntry& entry, Eigen::Index M, Eigen::Index D) {
  const std::vector<YamlEntry> rows = entry.items();
  if (static_cast<Eigen::Index>(rows.size()) != M)
    entry.fail(std::to_string(rows.size()) + " rows, must be " + std::to_string(M) +
               " (one per kernel)");
  Eigen::MatrixXd weights(M, D);
  Eigen::Index j = 0;
  for (const YamlEntry& row : rows) weights.row(j++) = row.numbers(D, "coordinate");
  return weights;
}

void read_start(const YamlEntry& entry, Eigen::Index D, Primitive& primitive) {
  entry.only({"position", "velocity", "acceleration"});
  primitive.start_position = entry.at("position").numbers(D, "coordinate");
  primitive.start_velocity = entry.at("velocity").numbers(D, "coordinate");
  primitive.start_acceleration = entry.at("acceleration").numbers(D, "coordinate");
}

void read_reference(const YamlEntry& entry, Primitive& primitive) {
  primitive.reference_orientation = entry.orientation();
  at_key(entry, [&] {
    require_reference("primitive", primitive.coordinates, primitive.reference_orientation);
  });
}

void require_names(const Primitive& primitive) {
  for (const std::string& name : primitive.coordinates)
    if (name.empty()) throw Error("primitive", "a coordinate has no name");
}

}  // namespace

Primitive read_primitive(const YamlEntry& entry) {
  if (entry.find("format")) entry.require_format(format_name, format_with_reference);
  entry.only({"format", "reference", "kind", "coordinates", "tau", "alpha", "gains", "goal",
              "start", "kernels", "weights"});
  Primitive primitive;
  primitive.kind =
      entry.at("kind").choice({"discrete", "rhythmic"}) == 0 ? Kind::discrete : Kind::rhythmic;
  primitive.coordinates = texts(entry.at("coordinates"));
  const auto D = static_cast<Eigen::Index>(primitive.coordinates.size());
  if (const auto reference = entry.find("reference")) read_reference(*reference, primitive);
  primitive.tau = entry.at("tau").positive();
  primitive.alpha = entry.at("alpha").positive();
  primitive.gains = read_gains(entry.at("gains"));
  primitive.goal = entry.at("goal").numbers(D, "coordinate");
  read_start(entry.at("start"), D, primitive);
  primitive.kernels = read_kernels(entry.at("kernels"));
  primitive.weights = read_weights(entry.at("weights"), primitive.kernels.count(), D);
  at_key(entry, [&] { primitive.validate(); });
  return primitive;
}

std::string primitive_entries(const Primitive& primitive, const std::string& indent) {
  primitive.validate();
  require_names(primitive);
  std::string text;
  const auto line = [&](const std::string& content) { text += indent + content + "\n"; };
  line(primitive.kind == Kind::discrete ? "kind: discrete" : "kind: rhythmic");
  line("coordinates: " + yaml_list(primitive.coordinates));
  line("tau: " + yaml_number(primitive.tau) + "  # [s]");
  line("alpha: " + yaml_number(primitive.alpha));
  line("gains: {K: " + yaml_number(primitive.gains.K) + ", D: " + yaml_number(primitive.gains.D) +
       ", H: " + yaml_number(primitive.gains.H) + "}");
  line("goal: " + yaml_list(primitive.goal));
  line("start:");
  line("  position: " + yaml_list(primitive.start_position));
  line("  velocity: " + yaml_list(primitive.start_velocity));
  line("  acceleration: " + yaml_list(primitive.start_acceleration));
  line("kernels:");
  line("  centers: " + yaml_list(primitive.kernels.centers));
  line("  widths: " + yaml_list(primitive.kernels.widths));
  line("weights:  # a row per kernel, a number per coordinate");
  for (Eigen::Index j = 0; j < primitive.weights.rows(); ++j)
    line("  - " + yaml_list(primitive.weights.row(j).transpose()));
  return text;
}

Primitive read_primitive(const std::string& path) {
  const YamlEntry root = YamlEntry::read(path);
  return read_primitive(root.require_format(format_name, format_with_reference));
}

void write_primitive(const std::string& path, const Primitive& primitive) {
  const int version = primitive.reference_orientation ? format_with_reference : 1;
  const std::string entries = primitive_entries(primitive, "");
  write_whole(path, std::string("format: ") + format_name + " " + std::to_string(version) + "\n" +
                        yaml_reference(primitive.reference_orientation) + entries);
}

}  // namespace seam
