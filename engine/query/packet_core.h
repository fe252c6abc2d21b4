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
    const L zero(0.0);
    return {select(dir.x < zero, L(lower.x), L(upper.x)), select(dir.y < zero, L(lower.y), L(upper.y)),
            select(dir.z < zero, L(lower.z), L(upper.z))};
  }

  Vec3d lower, upper;
};

/// D (D d / |D d|): each coordinate within 7 u of itself, as that of the body's own mapping (E2).
struct EllipsoidCore {
  explicit EllipsoidCore(const CoreForm& form) : semi_axes(form.semi_axes) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> image{L(semi_axes.x) * dir.x, L(semi_axes.y) * dir.y, L(semi_axes.z) * dir.z};
    const L scale = L(1.0) / norm(image);
    return {L(semi_axes.x) * (scale * image.x), L(semi_axes.y) * (scale * image.y), L(semi_axes.z) * (scale * image.z)};
  }

  Vec3d semi_axes;
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

  const double *x, *y, *z;
  std::size_t n;
};

}  // namespace VEX_ISA
}  // namespace vex
