// The ticks of an arm's controller in a loop of C++, for python.py to measure beside its own.

#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <seam/arm_controller.hpp>
#include <seam/sequence_file.hpp>

namespace py = pybind11;

namespace seam::micro {

namespace {

// Of this thread on the processor, as Python's time.thread_time().
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A movement of an arm, and the states that it passes.
class Ticks {
 public:
  using States = std::vector<Eigen::VectorXd>;

  Ticks(const std::string& urdf, const std::string& sequence, States q, States qd)
      : model_(RobotModel::read(urdf)),
        sequence_(read_sequence(sequence).sequence),
        q_(std::move(q)),
        qd_(std::move(qd)) {}

  /// Plays it with a new controller.
  /// @return  the time of all ticks [s], and the last one's torque
  std::pair<double, Eigen::VectorXd> play(double dt) const {
    ArmController controller(model_, sequence_, JoinSettings{Join::dmp3}, {}, q_.front(),
                             qd_.front());
    Eigen::VectorXd torque(model_.dof());
    const double begin = now();
    for (std::size_t k = 0; k < q_.size(); ++k) torque = controller.tick(dt, q_[k], qd_[k]);
    return {now() - begin, torque};
  }

 private:
  RobotModel model_;
  Sequence sequence_;
  States q_, qd_;
};

}  // namespace

}  // namespace seam::micro

PYBIND11_MODULE(seam_micro_python, module) {
  using seam::micro::Ticks;
  py::class_<Ticks>(module, "Ticks")
      .def(py::init<const std::string&, const std::string&, Ticks::States, Ticks::States>())
      .def("play", &Ticks::play);
}
