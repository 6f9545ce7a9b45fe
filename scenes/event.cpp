#include "scenes/event.hpp"

#include <algorithm>
#include <limits>

#include "plugin/files/src/yaml_reader.hpp"

namespace seam {

namespace {

Eigen::VectorXd read_goal(const YamlEntry& entry, const std::vector<std::string>& coordinates) {
  Eigen::VectorXd goal = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(coordinates.size()),
                                                   std::numeric_limits<double>::quiet_NaN());
  for (const auto& [name, value] : entry.entries()) {
    const auto found = std::find(coordinates.begin(), coordinates.end(), name);
    if (found == coordinates.end()) value.fail("is not among the sequence's coordinates");
    goal(found - coordinates.begin()) = value.number();
  }
  return goal;
}

Event read_event(const YamlEntry& entry, const std::vector<std::string>& coordinates) {
  constexpr const char* kinds = "must have one of goal, tau, amplitude, rate, hand_over";
  entry.only({"at", "goal", "tau", "amplitude", "rate", "over", "hand_over"});
  Event event;
  event.at = entry.at("at").not_negative();
  int given = 0;
  const auto is = [&](const char* key, Event::What what) {
    const auto value = entry.find(key);
    if (!value) return value;
    event.what = what;
    if (++given > 1) entry.fail(kinds);
    return value;
  };
  if (const auto goal = is("goal", Event::What::goal)) event.goal = read_goal(*goal, coordinates);
  if (const auto tau = is("tau", Event::What::tau)) event.value = tau->positive();
  if (const auto size = is("amplitude", Event::What::amplitude)) event.value = size->number();
  if (const auto rate = is("rate", Event::What::rate)) event.value = rate->not_negative();
  if (const auto now = is("hand_over", Event::What::hand_over)) now->choice({"now"});
  if (given == 0) entry.fail(kinds);
  if (event.what == Event::What::rate)
    event.over = entry.at("over").positive();
  else if (const auto over = entry.find("over"))
    over->fail("goes with rate alone");
  return event;
}

}  // namespace

bool Event::happen(Sequencer& sequencer) const noexcept {
  switch (what) {
    case What::goal:
      return sequencer.set_goal(goal.array().isNaN().select(sequencer.goal(), goal));
    case What::tau:
      return sequencer.set_tau(value);
    case What::amplitude:
      return sequencer.set_amplitude(value);
    case What::rate:
      return sequencer.set_rate(value, over);
    case What::hand_over:
      return sequencer.hand_over();
  }
  return false;
}

std::vector<Event> read_events(const YamlEntry& entry,
                               const std::vector<std::string>& coordinates) {
  std::vector<Event> events;
  for (const YamlEntry& item : entry.items()) events.push_back(read_event(item, coordinates));
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
  return events;
}

}  // namespace seam
