#pragma once

#include <utility>

#include <Eigen/Core>

#include <seam/alignment.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// A setting that is one number for all joints, or a number for each.
class PerJoint {
 public:
  /// One for all.
  PerJoint(double all) : values_(Eigen::VectorXd::Constant(1, all)) {}
  /// n values.
  PerJoint(Eigen::VectorXd each) : values_(std::move(each)) {}

  /// That of a joint, by its index.
  double operator()(Eigen::Index joint) const {
    return values_.size() == 1 ? values_(0) : values_(joint);
  }
  /// 1, or n.
  Eigen::Index size() const { return values_.size(); }
  /// For n joints.
  Eigen::VectorXd each(Eigen::Index n) const {
    return values_.size() == 1 ? Eigen::VectorXd::Constant(n, values_(0)) : values_;
  }

 private:
  Eigen::VectorXd values_;
};

}  // namespace seam
