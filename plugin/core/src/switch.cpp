#include <cmath>
#include <limits>

#include <seam/switch.hpp>

namespace seam {

double due(const Switch& until, const Basis& basis, const Reached& now) noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  switch (until.when) {
    case Switch::When::after:
      return until.value;
    case Switch::When::before_end:
      return now.time + now.tau - basis.time_to(now.phase, basis.start_phase(), now.tau) -
             until.value;
    case Switch::When::cycles:
      return now.time + now.tau * (2.0 * M_PI * until.value - now.turned);
    case Switch::When::at_phase: {
      const double phase = basis.next(until.value, now.phase - now.turned);
      return std::isnan(phase) ? never : now.time + basis.time_to(phase, now.phase, now.tau);
    }
    case Switch::When::near_goal:
    case Switch::When::on_call:
      break;
  }
  return never;
}

}  // namespace seam
