#include <algorithm>
#include <cmath>
#include <utility>

#include <seam/error.hpp>
#include <seam/metrics.hpp>
#include <seam/recording.hpp>
#include <seam/table.hpp>

namespace seam {

Recording::Recording(std::vector<std::string> joint_names, Eigen::VectorXd effort_limits, int ticks,
                     std::vector<std::string> tool_coordinates)
    : joints(std::move(joint_names)),
      effort(std::move(effort_limits)),
      time(Eigen::VectorXd::Zero(ticks)),
      running(Eigen::VectorXi::Zero(ticks)),
      coordinates(std::move(tool_coordinates)) {
  for (Eigen::MatrixXd* block : {&ref, &ref_vel, &ref_acc, &q, &qd, &torque})
    block->setZero(ticks, static_cast<Eigen::Index>(joints.size()));
  if (!in_task_space()) return;
  for (Eigen::MatrixXd* block : {&tool_ref, &tool_vel, &tool_acc})
    block->setZero(ticks, static_cast<Eigen::Index>(coordinates.size()));
  for (Eigen::VectorXd* block : {&tool_error_m, &tool_error_rad}) block->setZero(ticks);
}

namespace {

class Columns {
 public:
  explicit Columns(Eigen::Index rows) : table_{{}, Eigen::MatrixXd(rows, 0)} {}

  void add(const std::string& name, const Eigen::VectorXd& values) {
    table_.columns.push_back(name);
    table_.values.conservativeResize(Eigen::NoChange, table_.values.cols() + 1);
    table_.values.rightCols<1>() = values;
  }
  void add(const std::string& prefix, const std::vector<std::string>& names,
           const Eigen::MatrixXd& values) {
    if (values.cols() == 0) return;
    for (std::size_t i = 0; i < names.size(); ++i)
      add(prefix + names[i], values.col(static_cast<Eigen::Index>(i)));
  }
  const Table& table() const { return table_; }

 private:
  Table table_;
};

// Takes the columns of a file one after the other.
class Reader {
 public:
  Reader(const Table& table, const std::string& path)
      : table_(table), path_(path), taken_(table.columns.size(), false) {}

  /// Names behind a prefix, in the order of the columns.
  std::vector<std::string> names(const std::string& prefix) const {
    std::vector<std::string> names;
    for (const std::string& column : table_.columns)
      if (column.rfind(prefix, 0) == 0) names.push_back(column.substr(prefix.size()));
    return names;
  }
  /// Empty where there is no such column.
  Eigen::VectorXd take(const std::string& name) {
    const auto found = std::find(table_.columns.begin(), table_.columns.end(), name);
    if (found == table_.columns.end()) return {};
    const auto c = found - table_.columns.begin();
    taken_[static_cast<std::size_t>(c)] = true;
    return table_.values.col(c);
  }
  /// All of a kind or none.
  Eigen::MatrixXd take(const std::string& prefix, const std::vector<std::string>& names) {
    Eigen::MatrixXd values(table_.values.rows(), static_cast<Eigen::Index>(names.size()));
    std::size_t found = 0;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (const Eigen::VectorXd column = take(prefix + names[i]); column.size() > 0) {
        values.col(static_cast<Eigen::Index>(i)) = column;
        ++found;
      } else if (found > 0) {
        throw Error(path_, "needs the column \"" + prefix + names[i] + "\", as of the others");
      }
    if (found == 0) return {};
    if (found < names.size())
      throw Error(path_, "needs a column \"" + prefix + names[0] + "\", as of the others");
    return values;
  }
  std::vector<Signal> rest() const {
    std::vector<Signal> signals;
    for (std::size_t c = 0; c < taken_.size(); ++c)
      if (!taken_[c])
        signals.push_back({table_.columns[c], table_.values.col(static_cast<Eigen::Index>(c))});
    return signals;
  }

 private:
  const Table& table_;
  const std::string& path_;
  std::vector<bool> taken_;
};

constexpr double even = 1e-3;  // share of a tick by which ticks may differ

void require_even(const Eigen::VectorXd& time, const std::string& path) {
  if (time.size() < 2) throw Error(path, "1 row, must be at least 2");
  const double dt = (time(time.size() - 1) - time(0)) / static_cast<double>(time.size() - 1);
  for (Eigen::Index i = 1; i < time.size(); ++i)
    if (!(dt > 0.0 && std::abs(time(i) - time(i - 1) - dt) <= even * dt))
      throw Error(path + ":" + std::to_string(i + 2),
                  "column \"time\": a tick of " + std::to_string(time(i) - time(i - 1)) +
                      " s, must be " + std::to_string(dt) + " s as on the whole");
}

}  // namespace

RecordedJoin Recording::estimated_join(double at, int primitive) const {
  const auto largest = [&](const Eigen::MatrixXd& acceleration) {
    if (acceleration.size() == 0) return unknown;
    const Eigen::VectorXd size = jump(time, acceleration, at).cwiseAbs();
    return size.allFinite() ? size.maxCoeff() : unknown;
  };
  RecordedJoin join{at, primitive, largest(ref_acc), 0.0};
  if (in_task_space())
    join.linear_jump = tool_acc.size() > 0 ? largest(tool_acc.leftCols<3>()) : unknown;
  return join;
}

Recording Recording::read(const std::string& path) {
  const Table table = Table::read(path);
  if (table.columns[0] != "time")
    throw Error(path + ":1", "column \"" + table.columns[0] + "\", must be time [s]");
  Reader reader(table, path);
  Recording recording;
  recording.time = reader.take("time");
  require_even(recording.time, path);
  recording.joints = reader.names("torque.");
  const auto n = static_cast<Eigen::Index>(recording.joints.size());
  if (n == 0) throw Error(path + ":1", "needs a column torque.<joint> [N·m] for each joint");
  recording.effort.setConstant(n, unknown);
  recording.torque = reader.take("torque.", recording.joints);
  recording.ref = reader.take("ref.", recording.joints);
  recording.ref_vel = reader.take("ref_vel.", recording.joints);
  recording.ref_acc = reader.take("ref_acc.", recording.joints);
  recording.q = reader.take("q.", recording.joints);
  recording.qd = reader.take("qd.", recording.joints);
  for (const std::string& name : reader.names("ref."))
    if (std::find(recording.joints.begin(), recording.joints.end(), name) == recording.joints.end())
      recording.coordinates.push_back(name);
  if (recording.in_task_space() && recording.coordinates.size() < 3)
    throw Error(path + ":1", "column \"ref." + recording.coordinates[0] +
                                 "\" is of none of the joints that have a torque");
  recording.tool_ref = reader.take("ref.", recording.coordinates);
  recording.tool_vel = reader.take("ref_vel.", recording.coordinates);
  recording.tool_acc = reader.take("ref_acc.", recording.coordinates);
  recording.tool_error_m = reader.take("tool_error_m");
  recording.tool_error_rad = reader.take("tool_error_rad");
  const Eigen::VectorXd running = reader.take("switch");
  recording.running = running.cast<int>();
  recording.signals = reader.rest();
  for (Eigen::Index k = 1; k < running.size(); ++k)
    if (running(k) != running(k - 1))
      recording.joins.push_back(
          recording.estimated_join(recording.time(k), static_cast<int>(running(k))));
  return recording;
}

void Recording::write(const std::string& path) const {
  Columns columns(ticks());
  columns.add("time", time);
  if (running.size() > 0) columns.add("switch", running.cast<double>());
  columns.add("ref.", joints, ref);
  columns.add("ref_vel.", joints, ref_vel);
  columns.add("ref_acc.", joints, ref_acc);
  columns.add("q.", joints, q);
  columns.add("qd.", joints, qd);
  columns.add("torque.", joints, torque);
  columns.add("ref.", coordinates, tool_ref);
  columns.add("ref_vel.", coordinates, tool_vel);
  columns.add("ref_acc.", coordinates, tool_acc);
  if (in_task_space()) {
    columns.add("tool_error_m", tool_error_m);
    columns.add("tool_error_rad", tool_error_rad);
  }
  for (const Signal& signal : signals) columns.add(signal.name, signal.values);
  columns.table().write(path);
}

}  // namespace seam
