#include "engine/query/exact/whole_points.h"

#include <cmath>

namespace vex {
namespace {

// Fewer are told apart as fast by whole numbers.
constexpr std::size_t kFew = 4;
// Of the largest difference of two of the vertices: more than rounding takes from the difference of two heights (E15).
constexpr double kHeightError = 0x1p-96;
// Beyond these, products over- or underflow.
constexpr double kLeastExtent = 0x1p-400, kLargestExtent = 0x1p400;

}  // namespace

void WholePoints::narrow(const std::vector<Vec3d>& vertices, const whole::DyadicVector& exact_dir,
                         std::vector<std::size_t>& open) {
  if (open.size() <= kFew) return;
  const int exponent =
      std::max({whole::exponent_of(exact_dir.x), whole::exponent_of(exact_dir.y), whole::exponent_of(exact_dir.z)});
  const Vec3<DoubleDouble> dir{whole::rounded(exact_dir.x, exponent), whole::rounded(exact_dir.y, exponent),
                               whole::rounded(exact_dir.z, exponent)};
  const Vec3d& first = vertices[open.front()];
  std::vector<DoubleDouble> heights;
  heights.reserve(open.size());
  DoubleDouble largest = 0.0;  // of the first
  double extent = 0.0;
  for (const std::size_t i : open) {
    const Vec3d& p = vertices[i];
    // Nothing is lost: a difference of two doubles has two parts.
    const Vec3<DoubleDouble> off{two_sum(p.x, -first.x), two_sum(p.y, -first.y), two_sum(p.z, -first.z)};
    heights.push_back(dot(off, dir));
    largest = larger(heights.back(), largest);
    extent = larger(norm_1(Vec3d{off.x.high, off.y.high, off.z.high}), extent);
  }
  if (extent != 0.0 && !(extent > kLeastExtent && extent < kLargestExtent)) return;
  const DoubleDouble least = largest - DoubleDouble(kHeightError * extent);
  const auto is_as_far = [&](const Vec3d& p, const Vec3d& q) {
    return (p.x == q.x || whole::sign(exact_dir.x) == 0) && (p.y == q.y || whole::sign(exact_dir.y) == 0) &&
           (p.z == q.z || whole::sign(exact_dir.z) == 0);
  };
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (heights[k] < least) continue;
    if (!kept.empty() && is_as_far(vertices[kept.front()], vertices[open[k]])) continue;
    kept.push_back(open[k]);
  }
  open = std::move(kept);
}

}  // namespace vex
