#include <utility>

#include <seam/wish.hpp>

namespace seam {

Wish pass(Eigen::VectorXd position, Switch when) {
  Wish wish;
  wish.when = when;
  wish.position = std::move(position);
  return wish;
}

Wish hit(Eigen::VectorXd position, Eigen::VectorXd velocity, Switch when) {
  Wish wish = pass(std::move(position), when);
  wish.velocity = std::move(velocity);
  wish.then = Wish::Then::hand_over;
  return wish;
}

Wish arrive(Switch when, bool smooth) {
  Wish wish;
  wish.when = when;
  wish.then = Wish::Then::stay;
  wish.smooth = smooth;
  return wish;
}

}  // namespace seam
