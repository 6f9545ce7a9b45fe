#include <algorithm>
#include <cmath>
#include <utility>

#include "shown.hpp"
#include "tool_coordinates.hpp"
#include <seam/error.hpp>
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

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Takes the columns of a file one after the other.
class Reader {
 public:
  Reader(const Table& table, const std::string& path)
      : table_(table), path_(path), taken_(table.columns.size(), false) {}

  /// Names behind any of some prefixes, each once, in the order of the prefixes and columns.
  Names names(const Names& prefixes) const {
    Names names;
    for (const std::string& prefix : prefixes)
      for (const std::string& column : table_.columns)
        if (column.rfind(prefix, 0) == 0 && !contains(names, column.substr(prefix.size())))
          names.push_back(column.substr(prefix.size()));
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
    std::string missing;
    bool any = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Eigen::VectorXd column = take(prefix + names[i]);
      if (column.size() > 0)
        values.col(static_cast<Eigen::Index>(i)) = column;
      else if (missing.empty())
        missing = prefix + names[i];
      any = any || column.size() > 0;
    }
    if (!any) return {};
    if (!missing.empty())
      throw Error(path_ + ":1", "needs the column \"" + missing + "\", as of the others");
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

constexpr double even = 1e-2;  // share of a tick by which ticks may differ

// As most are, so that a tick that is missing is found.
void require_even(const Eigen::VectorXd& time, const std::string& path) {
  const Eigen::Index N = time.size();
  if (N < 2) throw Error(path, "1 row, must be at least 2");
  const Eigen::VectorXd ticks = time.tail(N - 1) - time.head(N - 1);
  Eigen::VectorXd sorted = ticks;
  std::nth_element(sorted.begin(), sorted.begin() + (N - 1) / 2, sorted.end());
  const double dt = sorted((N - 1) / 2);
  for (Eigen::Index i = 0; i < N - 1; ++i)
    if (!(dt > 0.0 && std::abs(ticks(i) - dt) <= even * dt))
      throw Error(path + ":" + std::to_string(i + 3),
                  "column \"time\": a tick of " + shown(ticks(i)) + " s, must be " +
                      (dt > 0.0 ? shown(dt) + " s as most are" : "> 0"));
}

Eigen::VectorXi whole_numbers(const Eigen::VectorXd& column, const std::string& path) {
  for (Eigen::Index i = 0; i < column.size(); ++i)
    if (!(column(i) == std::floor(column(i)) && std::abs(column(i)) < 1e9))
      throw Error(path + ":" + std::to_string(i + 2),
                  "column \"switch\": " + shown(column(i)) + ", must be a whole number");
  return column.cast<int>();
}

// Those that have a state or a torque, else those that have a reference. Other references are of a tool's coordinates.
void name_joints(const Reader& reader, const std::string& path, Recording& recording) {
  recording.joints = reader.names({"torque.", "q.", "qd."});
  Names referred = reader.names({"ref.", "ref_vel.", "ref_acc."});
  if (recording.joints.empty() && !are_a_tools(referred)) recording.joints.swap(referred);
  for (const std::string& name : referred)
    if (!contains(recording.joints, name)) recording.coordinates.push_back(name);
  if (recording.in_task_space() && !are_a_tools(recording.coordinates))
    throw Error(path + ":1", "reference of \"" + recording.coordinates[0] +
                                 "\", must be of a joint that has q, qd or torque, or all be of a "
                                 "tool's x y z, or x y z rx ry rz");
  if (recording.joints.empty() && recording.coordinates.empty())
    throw Error(path + ":1", "needs columns torque.<joint> [N·m], or others of a recording");
  recording.effort.setConstant(static_cast<Eigen::Index>(recording.joints.size()),
                               std::numeric_limits<double>::quiet_NaN());
  for (const std::string& name : recording.joints) recording.slides.push_back(is_linear(name));
}

void take_joints(Reader& reader, Recording& recording) {
  recording.torque = reader.take("torque.", recording.joints);
  recording.ref = reader.take("ref.", recording.joints);
  recording.ref_vel = reader.take("ref_vel.", recording.joints);
  recording.ref_acc = reader.take("ref_acc.", recording.joints);
  recording.q = reader.take("q.", recording.joints);
  recording.qd = reader.take("qd.", recording.joints);
}

void take_tool(Reader& reader, Recording& recording) {
  recording.tool_ref = reader.take("ref.", recording.coordinates);
  recording.tool_vel = reader.take("ref_vel.", recording.coordinates);
  recording.tool_acc = reader.take("ref_acc.", recording.coordinates);
  recording.tool_error_m = reader.take("tool_error_m");
  recording.tool_error_rad = reader.take("tool_error_rad");
}

}  // namespace

Recording Recording::read(const std::string& path) {
  const Table table = Table::read(path);
  if (table.columns[0] != "time")
    throw Error(path + ":1", "column \"" + table.columns[0] + "\", must be time [s]");
  Reader reader(table, path);
  Recording recording;
  recording.source = path;
  recording.time = reader.take("time");
  require_even(recording.time, path);
  recording.running = whole_numbers(reader.take("switch"), path);
  name_joints(reader, path, recording);
  take_joints(reader, recording);
  take_tool(reader, recording);
  recording.signals = reader.rest();
  for (Eigen::Index k = 1; k < recording.running.size(); ++k)
    if (recording.running(k) != recording.running(k - 1))
      recording.joins.push_back({recording.time(k), recording.running(k)});
  return recording;
}

void Recording::validate() const {
  const auto require = [&](const std::string& name, const auto& values, Eigen::Index columns) {
    if (values.size() == 0 && (values.rows() == 0 || columns == 0 || values.cols() == 0)) return;
    if (values.rows() != time.size() || values.cols() != columns)
      throw Error(source, name + " is " + std::to_string(values.rows()) + " x " +
                              std::to_string(values.cols()) + ", must be " +
                              std::to_string(time.size()) + " x " + std::to_string(columns));
  };
  const auto n = static_cast<Eigen::Index>(joints.size());
  const auto D = static_cast<Eigen::Index>(coordinates.size());
  require("running", running, 1);
  require("ref", ref, n), require("ref_vel", ref_vel, n), require("ref_acc", ref_acc, n);
  require("q", q, n), require("qd", qd, n), require("torque", torque, n);
  if (in_task_space()) {
    require("tool_ref", tool_ref, D), require("tool_vel", tool_vel, D);
    require("tool_acc", tool_acc, D);
  }
  require("tool_error_m", tool_error_m, 1), require("tool_error_rad", tool_error_rad, 1);
  for (const Signal& signal : signals) require(signal.name, signal.values, 1);
  if (effort.size() != 0 && effort.size() != n)
    throw Error(source, "effort has " + std::to_string(effort.size()) + " values, must be " +
                            std::to_string(n));
  if (!slides.empty() && slides.size() != joints.size())
    throw Error(source, "slides has " + std::to_string(slides.size()) + " values, must be " +
                            std::to_string(n));
}

void Recording::write(const std::string& path) const {
  validate();
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
  if (tool_error_m.size() > 0) columns.add("tool_error_m", tool_error_m);
  if (tool_error_rad.size() > 0) columns.add("tool_error_rad", tool_error_rad);
  for (const Signal& signal : signals) columns.add(signal.name, signal.values);
  columns.table().write(path);
}

}  // namespace seam
