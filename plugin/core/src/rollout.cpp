#include <algorithm>
#include <cmath>
#include <limits>

#include "shown.hpp"
#include "tool_coordinates.hpp"
#include <seam/error.hpp>
#include <seam/rollout.hpp>

namespace seam {

namespace {

constexpr double most_rows = 2e6;

void require_usable(const RolloutSettings& settings) {
  if (!(settings.dt > 0.0 && std::isfinite(settings.dt)))
    throw Error("rollout", "dt " + shown(settings.dt) + " s, must be > 0");
  const auto not_negative = [](const char* name, double value) {
    if (!(value >= 0.0 && std::isfinite(value)))
      throw Error("rollout", std::string(name) + " " + shown(value) + " s, must be >= 0");
  };
  not_negative("settle", settings.settle);
  not_negative("duration", settings.duration);
  not_negative("longest", settings.longest);
}

void require_rows(double time, const RolloutSettings& settings) {
  if (time > most_rows * settings.dt)
    throw Error("rollout", "dt " + shown(settings.dt) + " s gives more than " + shown(most_rows) +
                               " rows, must be larger");
}

// Rows as they come: the end is known when the last switch has been due.
class Rows {
 public:
  explicit Rows(int dimensions) : width_(3 * dimensions) {}

  void add(double time, const Sequencer& sequencer) {
    time_.push_back(time);
    running_.push_back(sequencer.running());
    const Sample& at = sequencer.sample();
    for (const Eigen::VectorXd* part : {&at.position, &at.velocity, &at.acceleration})
      values_.insert(values_.end(), part->begin(), part->end());
  }
  void reserve(double rows) {
    const auto N = static_cast<std::size_t>(std::min(rows + 2.0, most_rows));
    time_.reserve(N);
    running_.reserve(N);
    values_.reserve(N * static_cast<std::size_t>(width_));
  }
  void move_to(Recording& recording) const {
    const auto N = static_cast<Eigen::Index>(time_.size());
    recording.time = Eigen::Map<const Eigen::VectorXd>(time_.data(), N);
    recording.running = Eigen::Map<const Eigen::VectorXi>(running_.data(), N);
    const Eigen::Map<const Eigen::MatrixXd> all(values_.data(), width_, N);
    const Eigen::Index D = width_ / 3;
    const bool tool = recording.in_task_space();
    (tool ? recording.tool_ref : recording.ref) = all.topRows(D).transpose();
    (tool ? recording.tool_vel : recording.ref_vel) = all.middleRows(D, D).transpose();
    (tool ? recording.tool_acc : recording.ref_acc) = all.bottomRows(D).transpose();
  }

 private:
  Eigen::Index width_;
  std::vector<double> time_, values_;
  std::vector<int> running_;
};

Rows play(Sequencer& sequencer, const RolloutSettings& settings) {
  Rows rows(sequencer.dimensions());
  const double never = std::numeric_limits<double>::infinity();
  double end = settings.duration > 0.0 ? settings.duration : never;
  require_rows(settings.duration, settings);
  rows.reserve(settings.duration / settings.dt);
  for (long k = 0;; ++k) {
    const double time = static_cast<double>(k) * settings.dt;
    if (sequencer.finished() && std::isinf(end)) end = time + settings.settle;
    if (time > end + 0.5 * settings.dt) return rows;
    if (std::isinf(end) && time > settings.longest)
      throw Error("rollout", "primitive " + std::to_string(sequencer.running() + 1) +
                                 " has not handed over after " + shown(settings.longest) +
                                 " s, needs a duration");
    require_rows(time, settings);
    rows.add(time, sequencer);
    sequencer.step(settings.dt);
  }
}

// Of coordinates with a unit of length where `linear`, of angles else.
double largest_jump(const JoinEvent& event, const std::vector<bool>& slides, bool linear) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < event.acceleration_before.size(); ++i)
    if (slides[static_cast<std::size_t>(i)] == linear)
      largest =
          std::max(largest, std::abs(event.acceleration_after(i) - event.acceleration_before(i)));
  return largest;
}

}  // namespace

Recording rollout(Sequencer& sequencer, const RolloutSettings& settings) {
  require_usable(settings);
  const int first = sequencer.joins();
  const bool from_beginning = sequencer.time() == 0.0;
  const double begin = sequencer.time();
  const Rows rows = play(sequencer, settings);

  const std::vector<std::string>& names = sequencer.coordinates();
  Recording recording;
  recording.source = "rollout";
  (are_a_tools(names) ? recording.coordinates : recording.joints) = names;
  recording.effort.setConstant(static_cast<Eigen::Index>(recording.joints.size()),
                               std::numeric_limits<double>::quiet_NaN());
  rows.move_to(recording);

  std::vector<bool> slides;
  for (const std::string& name : names) slides.push_back(is_linear(name));
  if (!recording.in_task_space()) recording.slides = slides;
  for (int i = std::max(from_beginning ? 0 : first, sequencer.first_join()); i < sequencer.joins();
       ++i) {
    const JoinEvent& event = sequencer.join(i);
    recording.joins.push_back({event.time - begin, event.primitive,
                               largest_jump(event, slides, false),
                               largest_jump(event, slides, true)});
  }
  return recording;
}

Recording rollout(const Sequence& sequence, const JoinSettings& join, const Sample& start,
                  const RolloutSettings& settings) {
  Sequencer sequencer(sequence, join, start);
  return rollout(sequencer, settings);
}

Recording rollout(const Sequence& sequence, const JoinSettings& join,
                  const RolloutSettings& settings) {
  return rollout(sequence, join, sequence.start_state(), settings);
}

}  // namespace seam
