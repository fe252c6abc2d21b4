// The search for what may prove how near the cores of two bodies are, over any lane.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/search/expanding_polytope.h"
#include "engine/query/search/nearest_descent.h"

namespace vex {

/// What may prove how near the cores are.
struct CoreProof {
  ExactVector dir;
  WitnessHull hull, surface;             // the nearest points; and, of cores in each other, a surface around the origin
  std::vector<bool> is_late;             // of each witness of the hull
  std::vector<bool> is_late_of_surface;  // of each of the surface
  bool is_capped = false;                // another one, for a smaller gap, would be no better
};

namespace detail {

template <class Core>
void add_witness(const Core& core, const typename Core::Point& point, WitnessHull& hull, std::vector<bool>& is_late) {
  hull.witnesses.push_back(core.record(point).witness);
  is_late.push_back(core.record(point).is_late);
}

// All living faces, and the points that are corners of one.
template <class L, class Core>
void take_surface(const Core& core, const PolytopeStore<L, typename Core::Point>& store, CoreProof& proof) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> index(store.points.size(), kNone);
  for (const auto& face : store.faces) {
    if (!face.is_alive) continue;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& i = index[face.corners[k]];
      if (i == kNone) {
        i = static_cast<std::uint32_t>(proof.surface.witnesses.size());
        add_witness(core, store.points[face.corners[k]], proof.surface, proof.is_late_of_surface);
      }
      corners[k] = i;
    }
    proof.surface.faces.push_back(corners);
  }
}

}  // namespace detail

/// `Core::support` gives points of the difference and keeps a record of each; `gap`: of the core's unit, how near to
/// each other the bounds of the signed distance shall be.
template <class L, class Core>
CoreProof prove_nearness_in(const Core& core, const Vec3<L>& first_dir, double gap, int max_support_calls) {
  using Point = typename Core::Point;
  using Descent = NearestDescent<L, Point>;
  const auto wanted = [gap](const L&) { return L(gap); };
  const QueryError<L> error = Core::error();
  const Descent descent =
      descend_to_origin<L, Point>(core, first_dir, {}, error, wanted, L(0.0), DescentGoal::nearest, max_support_calls);
  CoreProof proof;
  proof.is_capped = descent.end == Descent::End::capped;
  for (int k = 0; k < descent.simplex.size(); ++k) {
    detail::add_witness(core, descent.simplex.point(k), proof.hull, proof.is_late);
  }
  if (!(descent.lower > L(0.0))) {
    using Polytope = ExpandingPolytope<L, Point, Core>;
    PolytopeStore<L, Point> store;
    Polytope polytope(core, error, max_support_calls, store);
    proof.is_capped = polytope.run(descent.simplex, wanted) == Polytope::End::capped || proof.is_capped;
    detail::take_surface<L>(core, store, proof);
  }
  proof.dir = core.best_dir();
  return proof;
}

}  // namespace vex
