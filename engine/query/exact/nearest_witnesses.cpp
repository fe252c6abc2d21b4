#include "engine/query/exact/nearest_witnesses.h"

#include <optional>

#include "engine/query/exact/placed_forms.h"
#include "engine/query/exact/recorded_core.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

constexpr int kMostCallsOfPoints = 1 << 11;
constexpr double kPointGap = 0x1p-52;

// Of what is nearest to a point; `normal` is from A towards B, of which one is the point.
std::vector<Witness> nearest_witnesses(const std::optional<PlacedForms>& placed, const Vec3d& normal) {
  if (!placed) return {};
  const LocalForms forms(*placed);
  const RecordedCore core(forms);
  return prove_nearness(core, normal, kPointGap, kMostCallsOfPoints).hull.witnesses;
}

}  // namespace

std::vector<Witness> nearest_of_a(const ConvexBody& a, const Vec3d& point, const Vec3d& normal) {
  Transformd at_a;
  at_a.translation = point;
  return nearest_witnesses(placed_forms(a, ConvexBody(PointBody{{}}), at_a), normal);
}
std::vector<Witness> nearest_of_b(const ConvexBody& b, const Transformd& a_from_b, const Vec3d& point,
                                  const Vec3d& normal) {
  return nearest_witnesses(placed_forms(ConvexBody(PointBody{point}), b, a_from_b), normal);
}

}  // namespace vex
