#include "meshes/exact_sign.h"

#include <array>
#include <cstddef>
#include <initializer_list>

#include "engine/numeric/double_double.h"
#include "engine/numeric/expect.h"

namespace vex {
namespace {

/// A sum of doubles, exactly: none overlaps the next, and the last has the sum's sign.
class ExactSum {
 public:
  /// A part that is zero is written all the same and then written over: whether it is cannot be predicted.
  void add(double value) {
    VEX_EXPECT(n_ < kMost);
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      const DoubleDouble sum = two_sum(value, parts_[k]);
      value = sum.high;
      parts_[n_kept] = sum.low;
      n_kept += sum.low != 0.0 ? 1 : 0;
    }
    parts_[n_kept] = value;
    n_ = n_kept + (value != 0.0 ? 1 : 0);
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
  int sign() const { return n_ == 0 ? 0 : (parts_[n_ - 1] > 0.0 ? 1 : -1); }

 private:
  static constexpr std::size_t kMost = 6 * 27 * 4;  // parts of a determinant: six products of three times three

  std::array<double, kMost> parts_;
  std::size_t n_ = 0;
};

/// A coordinate of a difference: up to three doubles whose sum it is, none of them zero. Mostly it is one.
class Parts {
 public:
  Parts(double p, double base, double step) {
    const DoubleDouble difference = two_sum(p, -base);
    for (const double part : {difference.high, difference.low, -step}) {
      if (part != 0.0) {
        parts_[n_++] = part;
      }
    }
  }

  const double* begin() const { return parts_.data(); }
  const double* end() const { return parts_.data() + n_; }

 private:
  std::array<double, 3> parts_{};
  std::size_t n_ = 0;
};
using PartsVec3 = std::array<Parts, 3>;

PartsVec3 parts_of(const Vec3d& p, const Vec3d& base, const Vec3d& step) {
  return {Parts(p.x, base.x, step.x), Parts(p.y, base.y, step.y), Parts(p.z, base.z, step.z)};
}

void add_products(double sign, const Parts& a, const Parts& b, const Parts& c, ExactSum* sum) {
  for (const double i : a) {
    for (const double j : b) {
      for (const double k : c) {
        sum->add_product(sign * i, j, k);
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

/// The sign of a_1 b_2 - a_2 b_1, exactly.
int exact_minor_sign(const Parts& a_1, const Parts& b_2, const Parts& a_2, const Parts& b_1) {
  static const Parts kOne(1.0, 0.0, 0.0);
  ExactSum sum;
  add_products(1.0, a_1, b_2, kOne, &sum);
  add_products(-1.0, a_2, b_1, kOne, &sum);
  return sum.sign();
}

}  // namespace

int orientation_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const int sure = sure_determinant_sign(b - a, c - a, d - a);
  return sure != 0 ? sure : exact_determinant_sign(parts_of(b, a, {}), parts_of(c, a, {}), parts_of(d, a, {}));
}

int determinant_sign(const LocalPoint& o, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& a_local,
                     const Vec3d& b_local, const Vec3d& c_local) {
  const int sure = sure_determinant_sign(a_local, b_local, c_local);
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
