#include "meshes/exact_sign.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "engine/numeric/double_double.h"
#include "engine/numeric/rounding.h"

namespace vex {
namespace {

/// A sum of doubles, exactly: none overlaps the next, and the last has the sum's sign.
class ExactSum {
 public:
  void add(double value) {
    std::size_t n_kept = 0;
    for (const double part : parts_) {
      const DoubleDouble sum = two_sum(value, part);
      value = sum.high;
      if (sum.low != 0.0) {
        parts_[n_kept++] = sum.low;
      }
    }
    parts_.resize(n_kept);
    if (value != 0.0) {
      parts_.push_back(value);
    }
  }
  void add_product(double a, double b, double c) {
    const DoubleDouble ab = two_product(a, b);
    for (const double factor : {ab.high, ab.low}) {
      if (factor != 0.0) {
        const DoubleDouble abc = two_product(factor, c);
        add(abc.high);
        add(abc.low);
      }
    }
  }
  int sign() const { return parts_.empty() ? 0 : (parts_.back() > 0.0 ? 1 : -1); }

 private:
  std::vector<double> parts_;
};

/// A coordinate of a difference as up to three doubles whose sum it is.
using Parts = std::array<double, 3>;
using PartsVec3 = std::array<Parts, 3>;

Parts parts_of(double p, double base, double step) {
  const DoubleDouble difference = two_sum(p, -base);
  return {difference.high, difference.low, -step};
}

PartsVec3 parts_of(const Vec3d& p, const Vec3d& base, const Vec3d& step) {
  return {parts_of(p.x, base.x, step.x), parts_of(p.y, base.y, step.y), parts_of(p.z, base.z, step.z)};
}

void add_products(double sign, const Parts& a, const Parts& b, const Parts& c, ExactSum* sum) {
  for (const double i : a) {
    for (const double j : b) {
      for (const double k : c) {
        if (i != 0.0 && j != 0.0 && k != 0.0) {
          sum->add_product(sign * i, j, k);
        }
      }
    }
  }
}

int exact_determinant_sign(const PartsVec3& a, const PartsVec3& b, const PartsVec3& c) {
  ExactSum sum;
  for (std::size_t k = 0; k < 3; ++k) {
    add_products(1.0, a[k], b[(k + 1) % 3], c[(k + 2) % 3], &sum);
    add_products(-1.0, a[k], b[(k + 2) % 3], c[(k + 1) % 3], &sum);
  }
  return sum.sign();
}

/// det(a, b, c) where each coordinate may be off by up to 2 u of itself: with the determinant's own five roundings
/// that is at most gamma(11) times the permanent, whose own roundings are within gamma(16). Nothing is said, 0, where a
/// product may have come near to underflow.
int sure_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double det = a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  const double permanent = std::fabs(a.x) * (std::fabs(b.y * c.z) + std::fabs(b.z * c.y)) +
                           std::fabs(a.y) * (std::fabs(b.z * c.x) + std::fabs(b.x * c.z)) +
                           std::fabs(a.z) * (std::fabs(b.x * c.y) + std::fabs(b.y * c.x));
  if (permanent > 0x1p-960 && std::fabs(det) > gamma(24) * permanent + 0x1p-1020) {
    return det > 0.0 ? 1 : -1;
  }
  return 0;
}

/// The sign of a_1 b_2 - a_2 b_1, exactly.
int exact_minor_sign(const Parts& a_1, const Parts& b_2, const Parts& a_2, const Parts& b_1) {
  constexpr Parts kOne{1.0, 0.0, 0.0};
  ExactSum sum;
  add_products(1.0, a_1, b_2, kOne, &sum);
  add_products(-1.0, a_2, b_1, kOne, &sum);
  return sum.sign();
}

}  // namespace

int orientation_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const int sure = sure_sign(b - a, c - a, d - a);
  return sure != 0 ? sure : exact_determinant_sign(parts_of(b, a, {}), parts_of(c, a, {}), parts_of(d, a, {}));
}

int determinant_sign(const LocalPoint& o, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& a_local,
                     const Vec3d& b_local, const Vec3d& c_local) {
  const int sure = sure_sign(a_local, b_local, c_local);
  return sure != 0 ? sure
                   : exact_determinant_sign(parts_of(a, o.base, o.step), parts_of(b, o.base, o.step),
                                            parts_of(c, o.base, o.step));
}

bool collinear(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const PartsVec3 ab = parts_of(b, a, {});
  const PartsVec3 ac = parts_of(c, a, {});
  for (std::size_t k = 0; k < 3; ++k) {
    if (exact_minor_sign(ab[k], ac[(k + 1) % 3], ab[(k + 1) % 3], ac[k]) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace vex
