#include "shapes/nematic/fixed_point.h"

#include <Eigen/QR>
#include <algorithm>

namespace vex {
namespace {

constexpr std::size_t kMostDifferences = 6;
// Rounds that are off by more than this are far from linear. They are substituted as they are, so that a fluid that
// begins ordered ends ordered if it can.
constexpr double kLinear = 0.02;
constexpr double kLeastMixing = 1.0 / 64.0, kRounding = 1e-12;

}  // namespace

double FixedPoint::step(std::vector<double>& x, const std::vector<double>& of_x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::Map<Eigen::VectorXd> at(x.data(), n);
  const Eigen::VectorXd residual = Eigen::Map<const Eigen::VectorXd>(of_x.data(), n) - at;
  const double change = residual.cwiseAbs().maxCoeff();
  // A step that overshoots makes the next one shorter, and what was learnt before it is forgotten. Rounding alone, at
  // the end, is no overshooting.
  if (change > change_before_ && change > kRounding) {
    mixing_ = std::max(0.5 * mixing_, kLeastMixing);
    differences_.clear();
  } else if (last_.x.size() == n && change < kLinear) {
    differences_.push_back({at - last_.x, residual - last_.residual});
    if (differences_.size() > kMostDifferences) differences_.pop_front();
  }
  change_before_ = change;
  last_ = {at, residual};
  if (differences_.empty()) {
    at += mixing_ * residual;
    return change;
  }
  Eigen::MatrixXd of_x_differences(n, static_cast<Eigen::Index>(differences_.size())), residuals = of_x_differences;
  for (std::size_t k = 0; k < differences_.size(); ++k) {
    of_x_differences.col(static_cast<Eigen::Index>(k)) = differences_[k].x;
    residuals.col(static_cast<Eigen::Index>(k)) = differences_[k].residual;
  }
  const Eigen::VectorXd parts = residuals.colPivHouseholderQr().solve(residual);
  at += mixing_ * residual - (of_x_differences + mixing_ * residuals) * parts;
  return change;
}

}  // namespace vex
