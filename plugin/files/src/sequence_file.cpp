#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "learn_entry.hpp"
#include "obstacle_entry.hpp"
#include "primitive_entry.hpp"
#include "sequence_entry.hpp"
#include "yaml_text.hpp"
#include <seam/orientation.hpp>
#include <seam/primitive_file.hpp>
#include <seam/sequence_file.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

constexpr const char* format_name = "seam-sequence";
constexpr int format_version = 2;

struct Part {
  const char* name;
  Eigen::VectorXd Sample::*values;
};

constexpr std::array<Part, 4> parts{{{"position", &Sample::position},
                                     {"velocity", &Sample::velocity},
                                     {"acceleration", &Sample::acceleration},
                                     {"jerk", &Sample::jerk}}};

struct SwitchKey {
  const char* name;
  Switch::When when;
};

constexpr std::array<SwitchKey, 5> switch_keys{{{"after", Switch::When::after},
                                                {"before_end", Switch::When::before_end},
                                                {"at_phase", Switch::When::at_phase},
                                                {"near_goal", Switch::When::near_goal},
                                                {"cycles", Switch::When::cycles}}};

// The moments that a wish can have.
constexpr std::array<SwitchKey, 4> moment_keys{{{"at", Switch::When::after},
                                                {"before_end", Switch::When::before_end},
                                                {"at_phase", Switch::When::at_phase},
                                                {"cycles", Switch::When::cycles}}};

Switch read_moment(const YamlEntry& entry) {
  std::optional<Switch> moment;
  for (const SwitchKey& key : moment_keys) {
    const auto value = entry.find(key.name);
    if (!value) continue;
    if (moment) entry.fail("must have one of at, before_end, at_phase, cycles, not several");
    moment = {key.when, value->number()};
  }
  if (!moment) entry.fail("needs its moment: one of the keys at, before_end, at_phase, cycles");
  return *moment;
}

Switch read_switch(const YamlEntry& entry) {
  if (entry.is_text()) {
    entry.choice({"on_call"});
    return on_call();
  }
  entry.only({"after", "before_end", "at_phase", "near_goal", "cycles"});
  if (entry.entries().size() > 1)
    entry.fail("must have one of after, before_end, at_phase, near_goal, cycles, not several");
  Switch until;
  for (const SwitchKey& key : switch_keys)
    if (const auto value = entry.find(key.name)) until = {key.when, value->number()};
  return until;
}

Entry read_entry(const YamlEntry& entry) {
  if (!entry.is_text()) return from_phase(entry.only({"phase"}).at("phase").number());
  return entry.choice({"beginning", "least_correction"}) == 0 ? Entry{} : least_correction();
}

using Primitives = std::map<std::string, Primitive>;
using Reference = std::optional<Eigen::Quaterniond>;
using Check = std::function<void(const Primitive&)>;

Primitive read_named(const YamlEntry& entry, const Reference& reference) {
  if (const auto file = entry.find("file")) {
    entry.only({"file"});
    const std::string path = file->path();
    return at_key(*file, [&] { return read_primitive(path); });
  }
  if (entry.find("demonstration")) return learn_primitive(entry, reference);
  if (entry.find("weights")) return read_primitive(entry);
  entry.fail("needs one of the keys file, demonstration, weights");
}

void agree(const YamlEntry& entry, const Reference& given, Primitive& primitive) {
  Reference& own = primitive.reference_orientation;
  if (!given || !has_rotation_vector(primitive.coordinates)) return;
  if (!own) own = given;
  at_key(entry, [&] { require_same_reference("primitive", given, own); });
}

// Demonstrations last: they are turned from the reference orientation that the others have.
Primitives read_primitives(const YamlEntry& entry, const Reference& given) {
  Primitives primitives;
  Reference reference = given;
  for (const bool demonstrated : {false, true})
    for (const auto& [name, from] : entry.entries()) {
      if (from.find("demonstration").has_value() != demonstrated) continue;
      Primitive primitive = read_named(from, reference);
      agree(from, given, primitive);
      if (!reference) reference = primitive.reference_orientation;
      primitives.emplace(name, std::move(primitive));
    }
  return primitives;
}

// An orientation that is wished takes the place of rx, ry and rz.
void read_orientation(const YamlEntry& entry, const Primitive& primitive, Wish& wish) {
  const auto& names = primitive.coordinates;
  if (!primitive.reference_orientation)
    entry.fail("the primitive has no coordinates rx, ry and rz about an orientation that is known");
  const Eigen::Vector3d vector =
      rotation_vector(entry.orientation(), *primitive.reference_orientation);
  if (wish.position.size() == 0)
    wish.position.setConstant(static_cast<Eigen::Index>(names.size()), NAN);
  const auto rx = std::find(names.begin(), names.end(), "rx") - names.begin();
  wish.position.segment<3>(rx) = vector;
}

void read_wish(const YamlEntry& entry, Wish::Then then, Sequence& sequence) {
  entry.only({"position", "orientation", "velocity", "acceleration", "at", "before_end", "at_phase",
              "cycles"});
  const Primitive& primitive = sequence.steps().back().primitive;
  Wish wish;
  wish.then = then;
  wish.when = read_moment(entry);
  const auto values = [&](const char* key, Eigen::VectorXd& of) {
    if (const auto named = entry.find(key)) of = read_values(*named, primitive.coordinates);
  };
  values("position", wish.position);
  values("velocity", wish.velocity);
  values("acceleration", wish.acceleration);
  if (const auto turned = entry.find("orientation")) read_orientation(*turned, primitive, wish);
  at_key(entry, [&] { sequence.wish(std::move(wish)); });
}

void read_arrival(const YamlEntry& entry, Sequence& sequence) {
  if (entry.is_text()) {
    if (entry.choice({"no", "yes"}) == 1) at_key(entry, [&] { sequence.arrive(); });
    return;
  }
  entry.only({"at", "before_end", "at_phase", "smooth"});
  const auto smooth = entry.find("smooth");
  const bool only_smooth = entry.entries().size() == 1 && smooth;
  const Switch when = only_smooth ? at_end() : read_moment(entry);
  const bool without_step = !smooth || smooth->choice({"no", "yes"}) == 1;
  at_key(entry, [&] { sequence.arrive(when, without_step); });
}

void read_wishes(const YamlEntry& step, Sequence& sequence) {
  const Primitive& primitive = sequence.steps().back().primitive;
  if (const auto leave = step.find("leave")) {
    Values values;
    read_values(*leave, primitive.coordinates);
    for (const auto& [name, value] : leave->entries()) values[name] = value.number();
    sequence.leave(values);
  }
  if (const auto pass = step.find("pass"))
    for (const YamlEntry& one : pass->items()) read_wish(one, Wish::Then::go_on, sequence);
  if (const auto hit = step.find("hit")) read_wish(*hit, Wish::Then::hand_over, sequence);
  if (const auto arrive = step.find("arrive")) read_arrival(*arrive, sequence);
}

void read_step(const YamlEntry& step, const Primitives& primitives, const Check& check,
               SequenceFile& file) {
  step.only({"play", "enter", "leave", "pass", "hit", "arrive", "until"});
  const YamlEntry play = step.at("play");
  const auto primitive = primitives.find(play.text());
  if (primitive == primitives.end())
    play.fail("\"" + play.text() + "\", is not among the primitives");
  file.primitives.push_back(play.text());
  at_key(play, [&] {
    if (check) check(primitive->second);
    file.sequence.then(primitive->second);
  });
  if (const auto enter = step.find("enter")) {
    const Entry where = read_entry(*enter);
    at_key(*enter, [&] { file.sequence.enter(where); });
  }
  read_wishes(step, file.sequence);
  if (const auto until = step.find("until")) {
    const Switch when = read_switch(*until);
    at_key(*until, [&] { file.sequence.until(when); });
  }
}

Sample read_start(const YamlEntry& entry, const Primitive& first) {
  entry.only({"position", "velocity", "acceleration", "jerk"});
  Sample start = Sample::at_rest(first.start_position);
  for (const Part& part : parts) {
    const auto given = entry.find(part.name);
    if (!given) continue;
    const Eigen::VectorXd named = read_values(*given, first.coordinates);
    start.*part.values = named.array().isNaN().select(start.*part.values, named);
  }
  return start;
}

std::string text_of(const Switch& until) {
  for (const SwitchKey& key : switch_keys)
    if (until.when == key.when)
      return "{" + std::string(key.name) + ": " + yaml_number(until.value) + "}";
  return "on_call";
}

std::string text_of(const Entry& entry) {
  if (entry.where == Entry::Where::phase) return "{phase: " + yaml_number(entry.phase) + "}";
  return entry.where == Entry::Where::beginning ? "beginning" : "least_correction";
}

std::string values_text(const Eigen::VectorXd& values, const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t d = 0; d < names.size(); ++d) {
    const double value = values(static_cast<Eigen::Index>(d));
    if (!std::isnan(value))
      text += (text.empty() ? "" : ", ") + yaml_text(names[d]) + ": " + yaml_number(value);
  }
  return "{" + text + "}";
}

std::string moment_text(const Switch& when) {
  for (const SwitchKey& key : moment_keys)
    if (when.when == key.when) return std::string(key.name) + ": " + yaml_number(when.value);
  return {};
}

std::string text_of(const Wish& wish, const std::vector<std::string>& names) {
  if (wish.then == Wish::Then::stay)
    return "{" + moment_text(wish.when) + ", smooth: " + (wish.smooth ? "yes" : "no") + "}";
  std::string text = "{";
  const auto add = [&](const char* key, const Eigen::VectorXd& values) {
    if (values.size() > 0 && !values.array().isNaN().all())
      text += std::string(key) + ": " + values_text(values, names) + ", ";
  };
  add("position", wish.position);
  add("velocity", wish.velocity);
  add("acceleration", wish.acceleration);
  return text + moment_text(wish.when) + "}";
}

std::string wishes_text(const Sequence::Step& step) {
  const auto& names = step.primitive.coordinates;
  std::string text, passes;
  if (step.leave.size() > 0 && !step.leave.array().isNaN().all())
    text += ", leave: " + values_text(step.leave, names);
  for (const Wish& wish : step.wishes)
    if (wish.then == Wish::Then::go_on)
      passes += (passes.empty() ? "" : ", ") + text_of(wish, names);
  if (!passes.empty()) text += ", pass: [" + passes + "]";
  for (const Wish& wish : step.wishes) {
    if (wish.then == Wish::Then::hand_over) text += ", hit: " + text_of(wish, names);
    if (wish.then == Wish::Then::stay) text += ", arrive: " + text_of(wish, names);
  }
  return text;
}

bool has_wishes(const Sequence& sequence) {
  return std::any_of(sequence.steps().begin(), sequence.steps().end(),
                     [](const Sequence::Step& step) { return !wishes_text(step).empty(); });
}

std::string start_text(const Sample& start, const std::vector<std::string>& names) {
  std::string text = "start:\n";
  for (const Part& part : parts) {
    const Eigen::VectorXd& values = start.*part.values;
    if (static_cast<std::size_t>(values.size()) != names.size() || !values.allFinite())
      throw Error("sequence", std::string("the start's ") + part.name + " must be " +
                                  std::to_string(names.size()) + " finite numbers");
    std::string list;
    for (std::size_t d = 0; d < names.size(); ++d)
      list += (d ? ", " : "") + yaml_text(names[d]) + ": " +
              yaml_number(values(static_cast<Eigen::Index>(d)));
    text += "  " + std::string(part.name) + ": {" + list + "}\n";
  }
  return text;
}

std::string primitives_text(const SequenceFile& file) {
  const auto& steps = file.sequence.steps();
  if (file.primitives.size() != steps.size())
    throw Error("sequence", std::to_string(file.primitives.size()) + " names for " +
                                std::to_string(steps.size()) + " primitives");
  std::map<std::string, std::string> written;
  std::string text = "primitives:\n";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string& name = file.primitives[i];
    if (name.empty()) throw Error("sequence", "a primitive has no name");
    const std::string entries = primitive_entries(steps[i].primitive, "    ");
    const auto [known, is_new] = written.emplace(name, entries);
    if (known->second != entries)
      throw Error("sequence", "\"" + name + "\" is the name of two different primitives");
    if (is_new) text += "  " + yaml_text(name) + ":\n" + entries;
  }
  return text;
}

std::string steps_text(const SequenceFile& file) {
  std::string text = "steps:\n";
  for (std::size_t i = 0; i < file.primitives.size(); ++i) {
    const Sequence::Step& step = file.sequence.steps()[i];
    text += "  - {play: " + yaml_text(file.primitives[i]);
    if (step.primitive.kind == Kind::rhythmic) text += ", enter: " + text_of(step.entry);
    text += wishes_text(step) + ", until: " + text_of(step.until) + "}\n";
  }
  return text;
}

}  // namespace

Eigen::VectorXd read_values(const YamlEntry& entry, const std::vector<std::string>& names) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(names.size()), NAN);
  for (const auto& [name, value] : entry.entries()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) value.fail("is not among the primitives' coordinates");
    values(found - names.begin()) = value.number();
  }
  return values;
}

Sample SequenceFile::start_state() const {
  return start ? *start : sequence.start_state();
}

SequenceFile read_sequence(const YamlEntry& entry, const Check& check) {
  if (entry.find("format")) entry.require_format(format_name, format_version);
  entry.only({"format", "start", "start_after", "reference", "primitives", "steps", "couplings"});
  SequenceFile file;
  const auto reference = entry.find("reference");
  if (const auto delay = entry.find("start_after"))
    file.sequence.start_after(delay->not_negative());
  const Primitives primitives = read_primitives(
      entry.at("primitives"), reference ? Reference(reference->orientation()) : std::nullopt);
  for (const YamlEntry& step : entry.at("steps").items()) read_step(step, primitives, check, file);
  if (reference && !file.sequence.steps().front().primitive.reference_orientation)
    reference->fail("the primitives have no coordinates rx, ry and rz");
  if (const auto start = entry.find("start"))
    file.start = read_start(*start, file.sequence.steps().front().primitive);
  if (const auto couplings = entry.find("couplings"))
    for (const YamlEntry& one : couplings->items())
      file.couplings.push_back(read_obstacle(one, file.sequence.coordinates()));
  return file;
}

SequenceFile read_sequence(const std::string& path, std::vector<std::string> allowed) {
  const YamlEntry root = YamlEntry::read(path, {}, std::move(allowed));
  return read_sequence(root.require_format(format_name, format_version), nullptr);
}

void write_sequence(const std::string& path, const SequenceFile& file) {
  std::string text = std::string("format: ") + format_name +
                     (has_wishes(file.sequence) || !file.couplings.empty() ? " 2" : " 1");
  text += "\n";
  const auto& names = file.sequence.coordinates();
  if (file.start) text += start_text(*file.start, names);
  text += "start_after: " + yaml_number(file.sequence.start_delay()) + "  # [s]\n";
  text += yaml_reference(file.sequence.steps().front().primitive.reference_orientation);
  write_whole(path, text + primitives_text(file) + steps_text(file) +
                        couplings_text(file.couplings, names));
}

}  // namespace seam
