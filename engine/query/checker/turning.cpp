#include "engine/query/checker/turning.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace vex::checker {
namespace {

using whole::Dyadic;
using whole::DyadicVector;
using whole::Integer;

// Of fixed-point numbers; of the series; and the largest number of halvings of the angle.
constexpr int kFraction = 192, kTerms = 20, kMostHalvings = 57;

// Whole numbers times 2^-kFraction.
using Matrix = std::array<std::array<Integer, 3>, 3>;

Integer shifted_down(const Integer& x, int bits) {
  const Integer magnitude = abs(x) >> static_cast<unsigned>(bits);
  return x.sign() < 0 ? Integer(-magnitude) : magnitude;
}

// Each coefficient off by less than 2^-kFraction.
Matrix product(const Matrix& p, const Matrix& q) {
  Matrix result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = shifted_down(Integer(p[i][0] * q[0][j] + p[i][1] * q[1][j] + p[i][2] * q[2][j]), kFraction);
    }
  }
  return result;
}

Integer fixed(const Dyadic& x, int halvings) {
  const int shift = x.exponent + kFraction - halvings;
  if (shift >= 0) return x.mantissa << static_cast<unsigned>(shift);
  return shifted_down(x.mantissa, -shift);
}

// exp([angle]), by its series for an angle that is halved until it is below 2^-8, and squared as often. As an operator
// X of the series is off by 3 * 2^-kFraction, and each of its 20 terms by less than 2^5 of that; the rest of the series
// is below 2^-168 / 21! < 2^-230. All that is below 2^(10 - kFraction). A square of a matrix that is off by e, of a
// length of 1 + e, is off by 2.1 e and 9 * 2^-kFraction for its own rounding.
Matrix exponential(const DyadicVector& angle, int halvings) {
  const Integer x = fixed(angle.x, halvings), y = fixed(angle.y, halvings), z = fixed(angle.z, halvings);
  const Matrix generator = {{{0, Integer(-z), y}, {z, 0, Integer(-x)}, {Integer(-y), x, 0}}};
  Matrix sum;
  for (std::size_t i = 0; i < 3; ++i) sum[i][i] = Integer(1) << static_cast<unsigned>(kFraction);
  Matrix term = sum;
  for (int k = 1; k <= kTerms; ++k) {
    term = product(term, generator);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        term[i][j] /= k;
        sum[i][j] += term[i][j];
      }
    }
  }
  for (int k = 0; k < halvings; ++k) sum = product(sum, sum);
  return sum;
}

}  // namespace

DyadicVector cross(const DyadicVector& p, const DyadicVector& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

std::optional<ExactPose> pose_at(const Transformd& a_from_b, const RigidMotion& motion, const Dyadic& time) {
  const DyadicVector w = whole::exactly(motion.angular_velocity), v = whole::exactly(motion.velocity);
  const DyadicVector angle{time * w.x, time * w.y, time * w.z};
  const ExactPose start = exactly(a_from_b);
  if (whole::sign(dot(angle, angle)) == 0) {
    ExactPose pose = start;
    pose.translation = pose.translation + DyadicVector{time * v.x, time * v.y, time * v.z};
    return pose;
  }
  const int exponent =
      std::max({whole::exponent_of(angle.x), whole::exponent_of(angle.y), whole::exponent_of(angle.z)});
  const int halvings = std::max(0, exponent + 9);  // each coordinate below 2^-9
  if (halvings > kMostHalvings) return std::nullopt;
  const Matrix turn = exponential(angle, halvings);
  const auto row = [&](std::size_t i) {
    const auto coefficient = [&](std::size_t j) { return Dyadic(turn[i][j], -kFraction); };
    const auto times = [](const Dyadic& s, const DyadicVector& r) { return DyadicVector{s * r.x, s * r.y, s * r.z}; };
    return times(coefficient(0), start.row_x) + times(coefficient(1), start.row_y) + times(coefficient(2), start.row_z);
  };
  ExactPose pose{row(0), row(1), row(2), start.translation + DyadicVector{time * v.x, time * v.y, time * v.z}, {}};
  // 2.1^halvings (2^10 + 9 halvings), and a rotation that is one to 1e-6.
  pose.error = Dyadic(1, 12 + halvings + halvings / 10 - kFraction);
  return pose;
}

}  // namespace vex::checker
