#include <utility>

#include <seam/recording.hpp>
#include <seam/table.hpp>

namespace seam {

Recording::Recording(std::vector<std::string> joint_names, Eigen::VectorXd effort_limits, int ticks)
    : joints(std::move(joint_names)),
      effort(std::move(effort_limits)),
      time(Eigen::VectorXd::Zero(ticks)),
      running(Eigen::VectorXi::Zero(ticks)) {
  for (Eigen::MatrixXd* block : {&ref, &ref_vel, &ref_acc, &q, &qd, &torque})
    block->setZero(ticks, static_cast<Eigen::Index>(joints.size()));
}

void Recording::write(const std::string& path) const {
  const std::pair<const char*, const Eigen::MatrixXd*> blocks[] = {
      {"ref.", &ref}, {"ref_vel.", &ref_vel}, {"ref_acc.", &ref_acc},
      {"q.", &q},     {"qd.", &qd},           {"torque.", &torque}};
  const auto n = static_cast<Eigen::Index>(joints.size());
  Table table{{"time", "switch"}, Eigen::MatrixXd(ticks(), 2 + 6 * n)};
  table.values.col(0) = time;
  table.values.col(1) = running.cast<double>();
  Eigen::Index column = 2;
  for (const auto& [prefix, block] : blocks) {
    for (const std::string& joint : joints) table.columns.push_back(prefix + joint);
    table.values.middleCols(column, n) = *block;
    column += n;
  }
  table.write(path);
}

}  // namespace seam
