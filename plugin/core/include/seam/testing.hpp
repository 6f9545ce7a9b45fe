#pragma once

// For users' tests: what a recording should be. Each is a matcher of GoogleTest (1.11 or later) and needs nothing of it:
//
//     EXPECT_THAT(recording, seam::TorqueIsContinuousAt(1.25).within(0.5 /*N·m*/));
//     EXPECT_THAT(noisy, seam::TorqueIsContinuousAt(1.25).within(0.5).fitting(20 /*ticks*/));
//
// and for other test frameworks a function: why_not(recording) is empty, or says what is wrong.

#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include <seam/export.hpp>
#include <seam/metrics.hpp>

namespace SEAM_API seam {

namespace detail {

inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace detail

/// A property of a recording. Derived classes say `why_not` and `wanted`.
template <typename Derived>
class RecordingMatcher {
 public:
  using is_gtest_matcher = void;  // by which GoogleTest knows it

  /// For GoogleTest: whether there is nothing wrong, and else what.
  bool MatchAndExplain(const Recording& recording, std::ostream* explanation) const {
    const std::string reason = static_cast<const Derived&>(*this).why_not(recording);
    if (explanation) *explanation << reason;
    return reason.empty();
  }
  /// For GoogleTest: what is wanted.
  void DescribeTo(std::ostream* text) const {
    *text << static_cast<const Derived&>(*this).wanted();
  }
  /// For GoogleTest: what Not() wants.
  void DescribeNegationTo(std::ostream* text) const { *text << "not: ", DescribeTo(text); }
};

/// No joint's signal steps by more than a limit at some times (see `jump`: the difference of the one-sided limits).
class NoJump : public RecordingMatcher<NoJump> {
 public:
  /// The signal.
  struct Of {
    const char* name;                    // in the message
    const char* unit;                    // likewise
    Eigen::MatrixXd Recording::*values;  // where it is recorded
  };

  /// @param signal  what must not step
  /// @param times   [s]; empty: all joins of the recording
  /// @param limit   in the signal's unit
  NoJump(const Of& signal, std::vector<double> times, double limit)
      : signal_(signal), times_(std::move(times)), limit_(limit) {}

  /// The same with lines through more ticks than 3, for what is noisy (see `jump`).
  NoJump fitting(int line_ticks) const {
    NoJump fitted = *this;
    fitted.line_ticks_ = line_ticks;
    return fitted;
  }
  /// Empty if so, else the joint that steps most, by how much and when.
  std::string why_not(const Recording& recording) const {
    std::vector<double> times = times_;
    if (times.empty())
      for (const RecordedJoin& join : recording.joins) times.push_back(join.time);
    if (times.empty()) return "there is no join in the recording";
    double worst = -1.0;
    std::string reason;
    for (const double time : times) {
      const Eigen::VectorXd size =
          jump(recording.time, recording.*signal_.values, time, line_ticks_);
      if (size.size() == 0)
        return std::string(signal_.name) + " cannot be measured: it is not in the recording";
      if (!size.allFinite())
        return std::string(signal_.name) + " cannot be measured at " + detail::number(time) +
               " s: needs " + std::to_string(line_ticks_ + 1) + " finite ticks to either side";
      Eigen::Index joint = 0;
      const double largest = size.cwiseAbs().maxCoeff(&joint);
      if (largest <= limit_ || largest <= worst) continue;
      worst = largest;
      reason = std::string(signal_.name) + " of joint " +
               recording.joints[static_cast<std::size_t>(joint)] + " steps by " +
               detail::number(size(joint)) + " " + signal_.unit + " at " + detail::number(time) +
               " s, must be within " + detail::number(limit_) + " " + signal_.unit;
    }
    return reason;
  }
  /// What is wanted, in words.
  std::string wanted() const {
    std::string text = std::string(signal_.name) + " steps by no more than " +
                       detail::number(limit_) + " " + signal_.unit;
    if (times_.empty()) return text + " at any join";
    for (const double time : times_)
      text += (text.back() == 's' ? ", " : " at ") + detail::number(time) + " s";
    return text;
  }

 private:
  Of signal_;
  std::vector<double> times_;
  double limit_;
  int line_ticks_ = 3;
};

/// Torque at a time [s]: `TorqueIsContinuousAt(join).within(0.5 /*N·m*/)`.
class TorqueIsContinuousAt {
 public:
  /// @param time  [s]
  explicit TorqueIsContinuousAt(double time) : time_(time) {}
  /// @param limit_nm  [N·m]
  NoJump within(double limit_nm) const {
    return {{"torque", "N·m", &Recording::torque}, {time_}, limit_nm};
  }

 private:
  double time_;
};

/// Torque at every join of the recording: `TorqueIsContinuousAtAllJoins().within(0.5 /*N·m*/)`.
class TorqueIsContinuousAtAllJoins {
 public:
  /// @param limit_nm  [N·m]
  NoJump within(double limit_nm) const {
    return {{"torque", "N·m", &Recording::torque}, {}, limit_nm};
  }
};

/// Acceleration of the joints' reference at a time [s], within a limit [rad/s²].
class AccelerationIsContinuousAt {
 public:
  /// @param time  [s]
  explicit AccelerationIsContinuousAt(double time) : time_(time) {}
  /// @param limit_rad_s2  [rad/s²]
  NoJump within(double limit_rad_s2) const {
    return {{"reference acceleration", "rad/s²", &Recording::ref_acc}, {time_}, limit_rad_s2};
  }

 private:
  double time_;
};

/// No joint is further from its reference than a limit [rad], at any tick: `TracksWithin(1e-3)`.
class TracksWithin : public RecordingMatcher<TracksWithin> {
 public:
  /// @param limit_rad  [rad]
  explicit TracksWithin(double limit_rad) : limit_(limit_rad) {}

  /// Empty if so, else the joint that is furthest off, by how much and when.
  std::string why_not(const Recording& recording) const {
    if (recording.ref.size() == 0 || recording.ref.size() != recording.q.size())
      return "tracking cannot be measured: needs ref and q of the joints";
    Eigen::Index tick = 0, joint = 0;
    const Eigen::MatrixXd error = recording.q - recording.ref;
    if (!error.allFinite()) return "tracking cannot be measured: there is a NaN among ref and q";
    if (error.cwiseAbs().maxCoeff(&tick, &joint) <= limit_) return {};
    return "joint " + recording.joints[static_cast<std::size_t>(joint)] + " is " +
           detail::number(error(tick, joint)) + " rad from its reference at " +
           detail::number(recording.time(tick)) + " s, must be within " + detail::number(limit_) +
           " rad";
  }
  /// What is wanted, in words.
  std::string wanted() const {
    return "joints stay within " + detail::number(limit_) + " rad of their references";
  }

 private:
  double limit_;
};

/// How GoogleTest shows a recording.
inline void PrintTo(const Recording& recording, std::ostream* text) {
  *text << "a recording of " << recording.joints.size() << " joints, " << recording.ticks()
        << " ticks, " << recording.joins.size() << " joins";
}

}  // namespace seam
