#include <utility>

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
    for (std::size_t i = 0; i < names.size(); ++i)
      add(prefix + names[i], values.col(static_cast<Eigen::Index>(i)));
  }
  const Table& table() const { return table_; }

 private:
  Table table_;
};

}  // namespace

void Recording::write(const std::string& path) const {
  Columns columns(ticks());
  columns.add("time", time);
  columns.add("switch", running.cast<double>());
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
