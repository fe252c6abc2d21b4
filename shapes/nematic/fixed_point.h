// Fixed points x = g(x) of moments, by repeated substitution that is mixed by D. G. Anderson's rule (J. ACM 12, 547,
// 1965): of the last few rounds the combination is taken whose residual g(x) - x would be least were g linear. Plain
// substitution takes thousands of rounds where fluids are next to losing their order, or where two kinds align across
// each other and it swings.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace vex {

class FixedPoint {
 public:
  /// `x` is moved on, `of_x` being g(x). By how much x was off: the largest component of g(x) - x.
  double step(std::vector<double>& x, const std::vector<double>& of_x);

 private:
  struct Round {
    Eigen::VectorXd x, residual;
  };
  std::deque<Round> differences_;  // between rounds, the latest at the end
  Round last_;
  double mixing_ = 1.0, change_before_ = 2.0;
};

}  // namespace vex
