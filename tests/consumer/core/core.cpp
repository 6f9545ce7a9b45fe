#include <iostream>

#include <seam/seam.hpp>
#include <seam/testing.hpp>

int main() {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  const Eigen::MatrixXd ramp = time.unaryExpr([](double t) { return t * t * (3.0 - 2.0 * t); });
  const auto there = seam::learn(seam::Demonstration::from_positions({"x"}, time, ramp));
  seam::Sequence task;
  task.then(there).until(seam::before_end(0.2)).then(there);
  seam::Sequencer sequencer(task, seam::Join::dmp2j, seam::Sample(1));
  while (!sequencer.finished()) sequencer.step(1e-3);
  std::cout << "x is " << sequencer.sample().position(0) << '\n';
}
