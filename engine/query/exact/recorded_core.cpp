#include "engine/query/exact/recorded_core.h"

#include <cmath>
#include <cstdint>

#include "engine/query/search/expanding_polytope.h"
#include "engine/query/search/nearest_descent.h"

namespace vex {
namespace {

using Point = RecordedCore::Point;

void add(const RecordedCore& core, const Point& point, WitnessHull& hull, std::vector<bool>& is_late) {
  hull.witnesses.push_back(core.record(point).witness);
  is_late.push_back(core.record(point).is_late);
}

// All living faces, and the points that are corners of one.
void take_surface(const RecordedCore& core, const PolytopeStore<Extended, Point>& store, CoreProof& proof) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> index(store.points.size(), kNone);
  for (const auto& face : store.faces) {
    if (!face.is_alive) continue;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& i = index[face.corners[k]];
      if (i == kNone) {
        i = static_cast<std::uint32_t>(proof.surface.witnesses.size());
        add(core, store.points[face.corners[k]], proof.surface, proof.is_late_of_surface);
      }
      corners[k] = i;
    }
    proof.surface.faces.push_back(corners);
  }
}

}  // namespace

RecordedCore::Point RecordedCore::support(const Vec3e& normal) const {
  const Vec3e dir_b = forms_.a_from_b().direction_to_b(-normal);
  const LocalForms::Farthest a = forms_.farthest_of_a(normal), b = forms_.farthest_of_b(-normal, dir_b);
  const bool is_late = dot(normal, to_ - from_) < Extended(0.0);
  const Vec3e w = ((a.point - b.point) - forms_.a_from_b().translation) - (is_late ? to_ : from_);
  records_.push_back({{high_part(normal), low_part(normal), high_part(dir_b), low_part(dir_b), a.own, b.own}, is_late});
  const Extended gap = -(dot(normal, w) / norm(normal));
  if (gap > best_gap_) {
    best_gap_ = gap;
    best_dir_ = normal;
  }
  return {w, records_.size() - 1};
}

ExactVector RecordedCore::best_dir() const { return {{{high_part(best_dir_), 0}, {low_part(best_dir_), 0}}}; }

CoreProof prove_nearness(const RecordedCore& core, const Vec3d& first_dir, double gap, int max_support_calls) {
  const bool has_dir = is_finite(first_dir) && norm_1(first_dir) > 0.0;
  const Vec3e first = broadcast<Extended>(has_dir ? scaled_to_unit_exponent(first_dir) : Vec3d{0.6, 0.0, 0.8});
  const auto wanted = [gap](const Extended&) { return Extended(gap); };
  const QueryError<Extended> error = RecordedCore::error();
  using Descent = NearestDescent<Extended, Point>;
  const Descent descent = descend_to_origin<Extended, Point>(core, first, {}, error, wanted, Extended(0.0),
                                                             DescentGoal::nearest, max_support_calls);
  CoreProof proof;
  proof.is_capped = descent.end == Descent::End::capped;
  for (int k = 0; k < descent.simplex.size(); ++k) add(core, descent.simplex.point(k), proof.hull, proof.is_late);
  if (!(descent.lower > Extended(0.0))) {
    using Polytope = ExpandingPolytope<Extended, Point, RecordedCore>;
    PolytopeStore<Extended, Point> store;
    Polytope polytope(core, error, max_support_calls, store);
    proof.is_capped = polytope.run(descent.simplex, wanted) == Polytope::End::capped || proof.is_capped;
    take_surface(core, store, proof);
  }
  proof.dir = core.best_dir();
  return proof;
}

}  // namespace vex
