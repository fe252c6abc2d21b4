#include "engine/numeric/quaternion.h"

#include <algorithm>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// The sign of a sum of doubles, exactly: sweeps of two_sum carry the sum into parts that do not overlap (Shewchuk's
// grow expansion, one part after the other); the largest part that is not zero has the sign of the whole.
int sign_of_sum(const std::vector<double>& terms) {
  std::vector<double> parts;
  for (double carry : terms) {
    for (double& part : parts) {
      const DoubleDouble sum = two_sum(carry, part);
      carry = sum.high;
      part = sum.low;
    }
    parts.push_back(carry);
  }
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (*part != 0.0) return *part > 0.0 ? 1 : -1;
  }
  return 0;
}

}  // namespace

double correctly_rounded_norm(const std::array<double, 4>& components) {
  constexpr double kLost = 0x1p-480, kTrifle = 0x1p-960;
  std::vector<double> terms;
  DoubleDouble sum;
  for (const double c : components) {
    const DoubleDouble square = std::fabs(c) >= kLost ? two_product(c, c) : DoubleDouble(c == 0.0 ? 0.0 : kTrifle);
    sum += square;
    terms.insert(terms.end(), {square.low, square.high});
  }
  const double root = std::sqrt(sum.high);
  const double correction = (sum - two_product(root, root)).value() / (2.0 * root);
  const DoubleDouble norm = fast_two_sum(root, correction);
  const double other = std::nextafter(norm.high, norm.low > 0.0 ? 2.0 * norm.high : 0.0);
  const double half_gap = 0.5 * (other - norm.high);  // exact; signed as norm.low
  if (std::fabs(norm.low - half_gap) > 0x1p-90 * norm.high) return norm.high;
  // sign of sum - (norm.high + half_gap)^2, the square written out in exact products
  const DoubleDouble a = two_product(norm.high, norm.high), b = two_product(2.0 * norm.high, half_gap);
  terms.insert(terms.end(), {-a.low, -a.high, -b.low, -b.high, -half_gap * half_gap});
  const int sign = sign_of_sum(terms);
  if (sign == 0) {
    const auto is_even = [](double value) { return (bits_of(value) & 1u) == 0; };
    return is_even(norm.high) ? norm.high : other;
  }
  return sign > 0 ? std::max(norm.high, other) : std::min(norm.high, other);
}

Transformd rotation_from_quaternion(double w, double x, double y, double z) {
  const double largest = std::max({std::fabs(w), std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!(std::isfinite(w) && std::isfinite(x) && std::isfinite(y) && std::isfinite(z))) {
    throw InputError("a quaternion is not finite - give finite numbers");
  }
  if (largest == 0.0) throw InputError("a quaternion of length 0 (all four numbers are 0) - any other length will do");
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (double* const c : {&w, &x, &y, &z}) *c = std::ldexp(*c, -exponent);
  const double norm = correctly_rounded_norm({w, x, y, z});
  for (double* const c : {&w, &x, &y, &z}) *c = *c / norm;
  Transformd rotation;
  rotation.row_x = {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)};
  rotation.row_y = {2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)};
  rotation.row_z = {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)};
  return rotation;
}

}  // namespace vex
