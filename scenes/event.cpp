#include "scenes/event.hpp"

#include <algorithm>

#include "plugin/files/src/sequence_entry.hpp"
#include <seam/noise.hpp>

namespace seam {

namespace {

constexpr const char* kinds = "must have one of goal, tau, amplitude, rate, hand_over, pass, hit";
constexpr double most_events = 1e5;

// What goes with a wish alone.
void read_wish(const YamlEntry& entry, const std::vector<std::string>& coordinates, Event& event) {
  const auto velocity = entry.find("velocity");
  if (event.what == Event::What::pass || event.what == Event::What::hit) {
    event.when = entry.at("when").number();
    if (event.when <= event.at) entry.at("when").fail("must be later than at");
    if (velocity) event.velocity = read_values(*velocity, coordinates);
    if (const auto which = entry.find("wish")) event.which = which->count(0);
    return;
  }
  for (const char* key : {"velocity", "when", "wish"})
    if (const auto given = entry.find(key)) given->fail("goes with pass and hit alone");
}

Event read_event(const YamlEntry& entry, const std::vector<std::string>& coordinates) {
  entry.only({"at", "goal", "tau", "amplitude", "rate", "over", "hand_over", "pass", "hit",
              "velocity", "when", "wish"});
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
  if (const auto goal = is("goal", Event::What::goal)) event.goal = read_values(*goal, coordinates);
  if (const auto tau = is("tau", Event::What::tau)) event.value = tau->positive();
  if (const auto size = is("amplitude", Event::What::amplitude)) event.value = size->number();
  if (const auto rate = is("rate", Event::What::rate)) event.value = rate->not_negative();
  if (const auto now = is("hand_over", Event::What::hand_over)) now->choice({"now"});
  if (const auto pass = is("pass", Event::What::pass)) event.goal = read_values(*pass, coordinates);
  if (const auto hit = is("hit", Event::What::hit)) event.goal = read_values(*hit, coordinates);
  if (given == 0) entry.fail(kinds);
  read_wish(entry, coordinates, event);
  if (event.what == Event::What::rate)
    event.over = entry.at("over").positive();
  else if (const auto over = entry.find("over"))
    over->fail("goes with rate alone");
  return event;
}

// Where something is that moves at a constant velocity, seen at every picture of a camera.
void watch(const YamlEntry& entry, const std::vector<std::string>& coordinates, Noise& noise_source,
           std::vector<Event>& events) {
  entry.only({"from", "to", "every", "goal", "velocity", "noise"});
  const std::vector<double> times = picture_times(entry);
  const Eigen::VectorXd goal = read_values(entry.at("goal"), coordinates);
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(goal.size());
  if (const auto moving = entry.find("velocity")) {
    const Eigen::VectorXd named = read_values(*moving, coordinates);
    velocity = named.array().isNaN().select(velocity, named);
  }
  const auto noise = entry.find("noise");
  const double spread = noise ? noise->not_negative() : 0.0;
  for (const double time : times) {
    Event event;
    event.at = time;
    event.goal = goal + (time - times.front()) * velocity;
    for (double& seen : event.goal) seen += spread * noise_source.normal();
    events.push_back(std::move(event));
  }
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
    case What::pass:
    case What::hit: {
      Wish wish =
          seam::hit(goal, velocity, seam::at(when - (sequencer.time() - sequencer.own_time())));
      if (what == What::pass) wish.then = Wish::Then::go_on;
      return sequencer.set_wish(which < 0 ? sequencer.wishes() : which, wish);
    }
  }
  return false;
}

std::vector<double> picture_times(const YamlEntry& entry) {
  const double from = entry.at("from").not_negative();
  const double to = entry.at("to").not_negative();
  const double every = entry.at("every").positive();
  if (to < from) entry.at("to").fail(entry.at("to").text() + ", must be >= from");
  if ((to - from) / every > most_events) entry.at("every").fail("gives more than 1e5 events");
  std::vector<double> times(static_cast<std::size_t>((to - from) / every + 1e-9) + 1);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = from + static_cast<double>(i) * every;
  return times;
}

void sort_by_time(std::vector<Event>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
}

std::vector<Event> read_events(const YamlEntry& entry, const std::vector<std::string>& coordinates,
                               int seed) {
  std::vector<Event> events;
  Noise noise(seed);
  for (const YamlEntry& item : entry.items()) {
    if (item.find("every"))
      watch(item, coordinates, noise, events);
    else
      events.push_back(read_event(item, coordinates));
    if (static_cast<double>(events.size()) > most_events) item.fail("more than 1e5 events");
  }
  sort_by_time(events);
  return events;
}

}  // namespace seam
