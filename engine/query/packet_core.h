// The support mappings of cores, over packets (packet.h): no more than kernels need, and nothing that is not theirs.
#pragma once

#include "engine/numeric/packet.h"
#include "engine/query/core_form.h"

namespace vex {
namespace VEX_ISA {

/// A vertex, exactly.
struct BoxCore {
  explicit BoxCore(const CoreForm& form) : lower(form.lower), upper(form.upper) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {select_by_sign(dir.x, L(lower.x), L(upper.x)), select_by_sign(dir.y, L(lower.y), L(upper.y)),
            select_by_sign(dir.z, L(lower.z), L(upper.z))};
  }

  /// From the nearest point of the core to p: a first guess at what separates it from a body about there. Zero where p
  /// is inside.
  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    const auto beyond = [](const L& x, double low, double high) {
      return larger(x - L(high), L(0.0)) - larger(L(low) - x, L(0.0));
    };
    return {beyond(p.x, lower.x, upper.x), beyond(p.y, lower.y, upper.y), beyond(p.z, lower.z, upper.z)};
  }
  /// Whether it is more than the direction from the centre.
  bool has_direction() const { return lower.x < upper.x || lower.y < upper.y || lower.z < upper.z; }

  Vec3d lower, upper;
};

/// D (D d / |D d|): each coordinate within 7 u of itself, as that of the body's own mapping (E2).
struct EllipsoidCore {
  explicit EllipsoidCore(const CoreForm& form) : semi_axes(form.semi_axes) {
    double shortest = semi_axes.x < semi_axes.y ? semi_axes.x : semi_axes.y;
    shortest = shortest < semi_axes.z ? shortest : semi_axes.z;
    const auto square = [](double x) { return x * x; };
    weights = {square(shortest / semi_axes.x), square(shortest / semi_axes.y), square(shortest / semi_axes.z)};
  }

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> image{L(semi_axes.x) * dir.x, L(semi_axes.y) * dir.y, L(semi_axes.z) * dir.z};
    const L scale = L(1.0) / norm(image);
    return {L(semi_axes.x) * (scale * image.x), L(semi_axes.y) * (scale * image.y), L(semi_axes.z) * (scale * image.z)};
  }

  /// Across the ellipsoid of this shape that goes through p.
  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    return {L(weights.x) * p.x, L(weights.y) * p.y, L(weights.z) * p.z};
  }
  bool has_direction() const { return weights.x < 1.0 || weights.y < 1.0 || weights.z < 1.0; }

  Vec3d semi_axes, weights;  // the latter D^-2, up to a factor
};

/// A vertex, and of those that tie the first.
struct VerticesCore {
  explicit VerticesCore(const CoreForm& form)
      : x(form.x.data()), y(form.y.data()), z(form.z.data()), n(form.x.size()) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    L best = dot(Vec3<L>{L(x[0]), L(y[0]), L(z[0])}, dir), index(0.0);
    for (std::size_t i = 1; i < n; ++i) {
      const L value = dot(Vec3<L>{L(x[i]), L(y[i]), L(z[i])}, dir);
      const MaskOf<L> better = value > best;
      best = select(better, value, best);
      index = select(better, L(static_cast<double>(i)), index);
    }
    return {gather(x, index), gather(y, index), gather(z, index)};
  }

  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    return p;
  }

  bool has_direction() const { return false; }

  const double *x, *y, *z;
  std::size_t n;
};

}  // namespace VEX_ISA
}  // namespace vex
