#include "engine/numeric/quaternion.h"

#include <algorithm>
#include <span>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// The sign of a sum of doubles, exactly: sweeps of two_sum carry the sum into parts that do not overlap (Shewchuk's
// grow expansion, one part after the other); the largest part that is not zero has the sign of the whole.
int sign_of_sum(std::span<const double> terms) {
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

constexpr double kLost = 0x1p-480, kTrifle = 0x1p-960;

/// The root of a sum of squares, rounded to nearest or to its neighbour `other`: to which is certain where `margin`,
/// how far half the gap is from what the rounding left, is above 2^-90 of it.
struct NearRoot {
  double value, other, half_gap, margin;
  bool is_certain() const { return margin > 0x1p-90 * value; }
};

// Nothing cancels in the sum, so what rounding takes from the low parts, each u of it or less, is some u^2 of it.
[[gnu::always_inline]] inline NearRoot near_root(const DoubleDouble& w, const DoubleDouble& x, const DoubleDouble& y,
                                                 const DoubleDouble& z) {
  const DoubleDouble wx = two_sum(w.high, x.high), yz = two_sum(y.high, z.high), all = two_sum(wx.high, yz.high);
  const DoubleDouble sum = fast_two_sum(all.high, all.low + ((wx.low + yz.low) + ((w.low + x.low) + (y.low + z.low))));
  const double root = std::sqrt(sum.high);
  const DoubleDouble square = two_product(root, root);
  const double correction = (((sum.high - square.high) - square.low) + sum.low) / (2.0 * root);
  const DoubleDouble norm = fast_two_sum(root, correction);
  const double other = from_bits(bits_of(norm.high) + (norm.low > 0.0 ? 1u : ~std::uint64_t{0}));
  const double half_gap = 0.5 * (other - norm.high);  // exact; signed as norm.low
  return {norm.high, other, half_gap, std::fabs(norm.low - half_gap)};
}

/// 2^-e for a positive normal number m 2^e with m in [1/2, 1).
[[gnu::always_inline]] inline double scale_below_one(double largest) {
  return from_bits((std::uint64_t{2045} - (bits_of(largest) >> 52)) << 52);
}

template <class Store>
[[gnu::always_inline]] inline void store_rotation(double w, double x, double y, double z, const Store& store) {
  store(0, 1.0 - 2.0 * (y * y + z * z));
  store(1, 2.0 * (x * y - w * z));
  store(2, 2.0 * (x * z + w * y));
  store(3, 2.0 * (x * y + w * z));
  store(4, 1.0 - 2.0 * (x * x + z * z));
  store(5, 2.0 * (y * z - w * x));
  store(6, 2.0 * (x * z - w * y));
  store(7, 2.0 * (y * z + w * x));
  store(8, 1.0 - 2.0 * (x * x + y * y));
}

}  // namespace

double correctly_rounded_norm(const std::array<double, 4>& components) {
  const auto square_of = [](double c) {
    return std::fabs(c) >= kLost ? two_product(c, c) : DoubleDouble(c == 0.0 ? 0.0 : kTrifle);
  };
  const NearRoot norm =
      near_root(square_of(components[0]), square_of(components[1]), square_of(components[2]), square_of(components[3]));
  if (norm.is_certain()) return norm.value;
  // sign of sum - (norm.value + half_gap)^2, the squares written out in exact products
  std::array<double, 13> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    const DoubleDouble square = square_of(components[k]);
    terms[2 * k] = square.low;
    terms[2 * k + 1] = square.high;
  }
  const DoubleDouble a = two_product(norm.value, norm.value), b = two_product(2.0 * norm.value, norm.half_gap);
  const std::array<double, 5> minus_middle_sq = {-a.low, -a.high, -b.low, -b.high, -norm.half_gap * norm.half_gap};
  std::ranges::copy(minus_middle_sq, terms.begin() + 8);
  const int sign = sign_of_sum(terms);
  if (sign == 0) {
    const auto is_even = [](double value) { return (bits_of(value) & 1u) == 0; };
    return is_even(norm.value) ? norm.value : norm.other;
  }
  return sign > 0 ? std::max(norm.value, norm.other) : std::min(norm.value, norm.other);
}

Transformd rotation_from_quaternion(double w, double x, double y, double z) {
  const double largest = std::max({std::fabs(w), std::fabs(x), std::fabs(y), std::fabs(z)});
  if (!(std::isfinite(w) && std::isfinite(x) && std::isfinite(y) && std::isfinite(z))) {
    throw InputError("a quaternion is not finite - give finite numbers");
  }
  if (largest == 0.0) throw InputError("a quaternion of length 0 (all four numbers are 0) - any other length will do");
  if (largest > 0x1p-1000 && largest < 0x1p1000) {  // what ldexp does, in one multiplication
    const double factor = scale_below_one(largest);
    for (double* const c : {&w, &x, &y, &z}) *c *= factor;
  } else {
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (double* const c : {&w, &x, &y, &z}) *c = std::ldexp(*c, -exponent);
  }
  const double norm = correctly_rounded_norm({w, x, y, z});
  for (double* const c : {&w, &x, &y, &z}) *c = *c / norm;
  std::array<double, 9> r;
  store_rotation(w, x, y, z, [&r](std::size_t k, double value) { r[k] = value; });
  return {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}, {}};
}

void rotations_from_quaternions(const std::array<const double*, 4>& components, std::size_t n, double* rotations,
                                std::size_t stride) {
  constexpr std::size_t kAtOnce = 16;
  const auto [w, x, y, z] = components;
  for (std::size_t first = 0; first < n; first += kAtOnce) {
    const std::size_t n_here = std::min(kAtOnce, n - first);
    std::array<std::uint64_t, kAtOnce> is_plain;
    // Without a branch, so that compilers take two or more at once. What is not finite makes a NaN, which is not
    // certain.
    for (std::size_t i = 0; i < n_here; ++i) {
      const std::size_t k = first + i;
      const double a = std::fabs(w[k]), b = std::fabs(x[k]), c = std::fabs(y[k]), d = std::fabs(z[k]);
      const double ab = a > b ? a : b, cd = c > d ? c : d, largest = ab > cd ? ab : cd;
      const double ab_less = a > b ? b : a, cd_less = c > d ? d : c, least = ab_less > cd_less ? cd_less : ab_less;
      const double scale = scale_below_one(largest);
      const double ws = w[k] * scale, xs = x[k] * scale, ys = y[k] * scale, zs = z[k] * scale;
      const NearRoot norm =
          near_root(two_product(ws, ws), two_product(xs, xs), two_product(ys, ys), two_product(zs, zs));
      const bool is_in_range = largest < 0x1p1000 && least * scale >= kLost && largest > 0x1p-1000;
      is_plain[i] = static_cast<std::uint64_t>(is_in_range && norm.is_certain());
      store_rotation(ws / norm.value, xs / norm.value, ys / norm.value, zs / norm.value,
                     [&](std::size_t column, double value) { rotations[column * stride + k] = value; });
    }
    for (std::size_t i = 0; i < n_here; ++i) {
      if (is_plain[i] != 0) continue;
      const std::size_t k = first + i;
      const Transformd r = rotation_from_quaternion(w[k], x[k], y[k], z[k]);
      double* at = rotations + k;
      for (const Vec3d* const row : {&r.row_x, &r.row_y, &r.row_z}) {
        for (const double value : {row->x, row->y, row->z}) {
          *at = value;
          at += stride;
        }
      }
    }
  }
}

}  // namespace vex
