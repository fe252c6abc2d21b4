#include "engine/sampling/poses/orientation_law.h"

#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

// 1 - exp(-x) for x >= 0 by the series of expm1 and e -> e (2 + e) for a doubled argument: the same bits everywhere.
// Its error of some 10 u is an error of alpha, which nobody knows to 15 digits.
double complement_of_exp(double x) {
  if (x > 64.0) return 1.0;
  int n_doublings = 0;
  for (; x > 0.25; x *= 0.5) ++n_doublings;
  double e = 0.0;  // expm1(-x), Horner's scheme
  for (int k = 18; k >= 1; --k) e = -x / k * (1.0 + e);
  for (; n_doublings > 0; --n_doublings) e = e * (2.0 + e);
  return -e;
}

}  // namespace

OrientationLaw OrientationLaw::aligned() {
  OrientationLaw law;
  law.kind_ = Kind::aligned;
  return law;
}

OrientationLaw OrientationLaw::fixed(double w, double x, double y, double z) {
  OrientationLaw law;
  law.kind_ = Kind::fixed;
  law.quaternion_ = {w, x, y, z};
  law.fixed_ = rotation_from_quaternion(w, x, y, z);
  return law;
}

OrientationLaw OrientationLaw::cone(double degrees) {
  if (!(degrees >= 0.0 && degrees <= 90.0)) {
    throw UsageError("a cone's half angle is not from 0 to 90 degrees (" + shortest_number(degrees) +
                     ") - give one that is");
  }
  OrientationLaw law;
  law.kind_ = Kind::cone;
  law.parameter_ = degrees;
  const double half_sine = sincospi(degrees / 360.0).sin;
  law.height_ = 2.0 * (half_sine * half_sine);
  return law;
}

OrientationLaw OrientationLaw::angle(double degrees) {
  if (!(degrees >= 0.0 && degrees <= 180.0)) {
    throw UsageError("an angle between two axes is not from 0 to 180 degrees (" + shortest_number(degrees) +
                     ") - give one that is");
  }
  OrientationLaw law;
  law.kind_ = Kind::angle;
  law.parameter_ = degrees;
  const SinCos<double> between = sincospi(degrees / 180.0);
  law.between_ = {between.sin, between.cos};
  return law;
}

OrientationLaw OrientationLaw::onsager(double alpha) {
  if (!(alpha >= 0.0 && std::isfinite(alpha))) {
    throw UsageError("alpha is negative or not finite (" + shortest_number(alpha) + ") - give a number from 0 up");
  }
  OrientationLaw law;
  law.kind_ = Kind::onsager;
  law.parameter_ = alpha;
  law.height_ = complement_of_exp(2.0 * alpha);
  return law;
}

std::string OrientationLaw::name() const {
  switch (kind_) {
    case Kind::isotropic: return "isotropic";
    case Kind::aligned: return "aligned";
    case Kind::fixed: {
      std::string text = "fixed:";
      for (std::size_t k = 0; k < 4; ++k) text += (k == 0 ? "" : ",") + shortest_number(quaternion_[k]);
      return text;
    }
    case Kind::cone: return "cone:" + shortest_number(parameter_);
    case Kind::angle: return "angle:" + shortest_number(parameter_);
    case Kind::onsager: break;
  }
  return "onsager:" + shortest_number(parameter_);
}

std::optional<double> OrientationLaw::order_parameter() const {
  switch (kind_) {
    case Kind::isotropic: return 0.0;
    case Kind::aligned: return 1.0;
    case Kind::fixed:
    case Kind::angle: return std::nullopt;
    case Kind::cone: {
      // cos(theta) is uniform on [c, 1]: the mean of its square is (1 + c + c^2) / 3.
      const double c = sincospi(parameter_ / 180.0).cos;
      return 0.5 * c * (1.0 + c);
    }
    case Kind::onsager: break;
  }
  // 1 - 3 coth(alpha) / alpha + 3 / alpha^2 (L. Onsager, 1949). Below 1/8 its terms cancel: there it is the series
  // alpha^2 / 15 - 2 alpha^4 / 315 + alpha^6 / 1575 - 2 alpha^8 / 31185, good to 1e-11.
  const double alpha = parameter_, square = alpha * alpha;
  if (alpha < 0.125) {
    return square * (1.0 / 15.0 - square * (2.0 / 315.0 - square * (1.0 / 1575.0 - square * (2.0 / 31185.0))));
  }
  return 1.0 - 3.0 / (alpha * std::tanh(alpha)) + 3.0 / square;
}

int OrientationLaw::dimension() const {
  switch (kind_) {
    case Kind::isotropic: return 3;
    case Kind::aligned:
    case Kind::fixed: return 0;
    case Kind::angle: return 2;
    case Kind::cone:
    case Kind::onsager: break;
  }
  return kMaxDimension;
}

}  // namespace vex
