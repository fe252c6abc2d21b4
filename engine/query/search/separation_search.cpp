#include "engine/query/search/separation_search.h"

#include <array>
#include <cmath>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/numeric/interval.h"
#include "engine/query/search/core_difference.h"
#include "engine/query/search/warm_memory.h"
#include "engine/query/search/way_out.h"
#include "engine/query/search/zonotope.h"

namespace vex {
namespace {

// As SeparationQuery::searched_gap, in twice the precision.
constexpr double kExtendedPolytopeGap = 0x1p-60;
// Where rounding makes faces of its own, a hull of more points than these is no better.
constexpr int kCoarseHullPoints = 32;

void set_points(Separation& result, const Transformd& a_from_b, const Difference::CorePoints& cores, double radius_a,
                double radius_b) {
  result.point_a = cores.a + radius_a * result.normal;
  result.point_b = cores.b - radius_b * result.normal;
  result.point_b_in_b = cores.own_b;
  if (radius_b > 0.0) result.point_b_in_b = cores.own_b - radius_b * unit_seen_from_b(a_from_b, result.normal);
}

class DoubleSearch {
 public:
  explicit DoubleSearch(const SeparationQuery& query)
      : query_(query),
        difference_(query.a, query.b, query.a_from_b),
        error_(difference_.error()),
        is_coarse_(4.0 * error_.support > query.settled_gap() * query.circumradii()),
        settings_{query.goal,
                  difference_.radius_a() + difference_.radius_b(),
                  query.circumradii(),
                  query.searched_gap(),
                  query.settings.max_support_calls,
                  is_coarse_ ? std::min(kCoarseHullPoints, query.settings.max_support_calls) : query.max_hull_points(),
                  query.settings.max_distance,
                  0.9375 * query.settled_gap()} {}

  SearchedSeparation run(WarmStart* warm_start, Separation& result) const {
    SearchedSeparation searched;
    searched.is_out_of_range = !is_usual(error_);
    if (searched.is_out_of_range) return searched;
    searched.is_coarse = is_coarse_;
    if (!answer_without_search(searched, result)) search_with(warm_start, searched, result);
    searched.signed_distance = result.signed_distance;
    return searched;
  }

 private:
  // The bodies' answer from that of their cores.
  void take(const Vec3d& normal, double distance, const Interval<double>& bounds, Separation& result) const {
    const double rounding = 4.0 * kUnitRoundoff * settings_.radii;
    result.lower = bounds.lower - settings_.radii - rounding;
    result.upper = bounds.upper - settings_.radii + rounding;
    result.signed_distance = distance - settings_.radii;
    result.has_witnesses = true;
    result.normal = normal;
  }
  void take_points(const Difference::CorePoints& cores, Separation& result) const {
    set_points(result, query_.a_from_b, cores, difference_.radius_a(), difference_.radius_b());
  }
  // Its bounds are what the normal and the points show.
  void take(const ZonotopeSeparation& found, SearchedSeparation& searched, Separation& result) const {
    searched.missing = found.distance - found.bounds.lower;
    searched.tells_missing = true;
    take(found.normal, found.distance, found.bounds, result);
    take_points({found.point_a, found.point_b, found.own_point_b}, result);
  }

  bool are_zonotopes() const { return query_.a.generators() && query_.b.generators(); }
  // Of zonotopes. It is made where it is asked, for most distances of boxes never ask.
  DifferenceZonotope zonotope() const { return {*query_.a.generators(), *query_.b.generators(), query_.a_from_b}; }

  bool answer_without_search(SearchedSeparation& searched, Separation& result) const {
    if (!are_zonotopes()) return false;
    const Generators &of_a = *query_.a.generators(), &of_b = *query_.b.generators();
    if (is_known_without_search(query_.a, query_.b)) {
      const std::optional<ZonotopeSeparation> nearest = nearest_of_segments(of_a, of_b, query_.a_from_b, error_);
      const double rounding = 4.0 * error_.support;
      if (!nearest || nearest->bounds.width() > rounding + settings_.wanted(nearest->distance)) return false;
      take(*nearest, searched, result);
      return true;
    }
    if (settings_.goal != SeparationGoal::depth) return false;
    const std::optional<ZonotopeSeparation> deepest = deepest_of_faces(zonotope(), error_);
    if (!deepest || !(deepest->bounds.lower > settings_.radii || deepest->bounds.upper < 0.0)) return false;
    take(*deepest, searched, result);
    return true;
  }

  void search_with(WarmStart* warm_start, SearchedSeparation& searched, Separation& result) const {
    // Depths of zonotopes are looked for on all faces at once: nothing that is remembered helps there.
    if (warm_start == nullptr || (settings_.goal == SeparationGoal::depth && are_zonotopes())) {
      return search(nullptr, searched, result);
    }
    WarmMemory memory(*warm_start, difference_, error_);
    search(&memory, searched, result);
  }

  void search(WarmMemory* memory, SearchedSeparation& searched, Separation& result) const {
    const bool is_smooth = !query_.are_rounded_polytopes();
    NearestSimplex<double, CoreDifference::Point> simplex;
    int n_calls_before = 0;
    if (query_.guess != nullptr) {
      simplex = guessed_simplex(*query_.guess);
      n_calls_before = query_.guess->are_points ? 0 : static_cast<int>(query_.guess->n);
    }
    if (memory) {
      if (memory->holds_hull() && settings_.goal != SeparationGoal::distance) {
        CoreSeparation<double, CoreDifference::Point> core;
        if (memory->find_depth(settings_, is_smooth, core)) {
          take(core, searched, result);
          result.n_support_calls = memory->n_support_calls();
          return;
        }
      } else {
        simplex = memory->simplex(settings_, is_smooth);
      }
      n_calls_before = memory->n_support_calls();
    }
    const Vec3d first_dir = simplex.size() == 0 ? first_direction(memory) : Vec3d{};
    CoreSearch<double, CoreDifference::Point, CoreDifference> search(difference_, error_, settings_, first_dir,
                                                                     simplex);
    if (search.wants_depth()) {
      if (are_zonotopes()) {
        const std::optional<ZonotopeSeparation> deepest = deepest_of_faces(zonotope(), error_);
        if (deepest && deepest->bounds.upper < 0.0) {
          if (memory) memory->forget();
          take(*deepest, searched, result);
          result.n_support_calls = n_calls_before + search.n_support_calls();
          return;
        }
      }
      if (memory) memory->forget();
      search.find_depth([&](const WarmMemory::Polytope& polytope) {
        if (memory) memory->remember_hull(polytope, is_smooth, settings_.size, search.n_support_calls());
      });
    }
    const CoreSeparation<double, CoreDifference::Point>& core = search.found();
    if (memory && core.distance > 0.0 && core.has_normal) {
      memory->remember_nearest(core, settings_, is_smooth, search.n_support_calls());
    } else if (memory && !search.wants_depth()) {
      memory->forget();  // of bodies that overlap, where their distance is all that is asked
    }
    take(core, searched, result);
    result.n_support_calls = (memory ? memory->n_support_calls() : n_calls_before) + search.n_support_calls();
    if (core.is_capped && search.wants_depth() && core.bounds.lower > -HUGE_VAL) look_for_shorter_way(core, result);
  }

  Vec3d first_direction(const WarmMemory* memory) const {
    const Vec3d parting_dir = memory ? memory->parting_dir() : Vec3d{};
    const Vec3d dir = norm_1(parting_dir) > 0.0 ? parting_dir : difference_.between_centres();
    return norm_1(dir) > 0.0 ? unit_along(dir) : kAnyUnitVector;
  }

  NearestSimplex<double, CoreDifference::Point> guessed_simplex(const NearestGuess& guess) const {
    std::array<CoreDifference::Point, NearestGuess::kMost> points;
    std::size_t n = 0;
    for (std::size_t k = 0; k < guess.n; ++k) {
      const auto& [of_a, of_b] = guess.corners[k];
      if (guess.are_points) {
        points[n++] = difference_.at(of_a, of_b);
      } else if (std::fabs(dot(of_a, of_a) - 1.0) < 0x1p-48) {
        points[n++] = difference_.support(of_a);
      }
    }
    NearestSimplex<double, CoreDifference::Point> simplex;
    if (n > 0) simplex.begin_with(std::span(points).first(n));
    return simplex;
  }

  void take(const CoreSeparation<double, CoreDifference::Point>& core, SearchedSeparation& searched,
            Separation& result) const {
    searched.is_capped = core.is_capped;
    searched.missing = core.missing;
    searched.tells_missing = core.tells_missing;
    take(core.normal, core.distance, core.bounds, result);
    result.has_witnesses = core.has_normal;
    if (core.has_normal) take_points(difference_.cores_of(core.points), result);
  }

  void look_for_shorter_way(const CoreSeparation<double, CoreDifference::Point>& core, Separation& result) const {
    const WayOut way = shorter_way_out(query_.a, query_.b, query_.a_from_b, difference_, core.normal, -core.distance,
                                       settings_.wanted(core.distance));
    result.n_support_calls += way.n_support_calls;
    if (!way.is_found) return;
    const double lower = std::fmax(core.bounds.lower, -way.height - 2.0 * error_.support);
    take(way.normal, -way.height, {lower, core.bounds.upper}, result);
    result.point_a = way.point_a;
    result.point_b = way.point_b;
    result.point_b_in_b = way.point_b_in_b;
  }

  const SeparationQuery& query_;
  CoreDifference difference_;
  QueryError<double> error_;
  bool is_coarse_;
  CoreSearchSettings<double> settings_;
};

}  // namespace

bool is_known_without_search(const ConvexBody& a, const ConvexBody& b) {
  return a.generators() && b.generators() && a.generators()->n_vectors + b.generators()->n_vectors <= 2;
}

SearchedSeparation search_in_double(const SeparationQuery& query, WarmStart* warm_start, Separation& found) {
  return DoubleSearch(query).run(warm_start, found);
}

Separation search_in_extended(const SeparationQuery& query, const PlacedForms& placed, const Vec3d& first_dir) {
  const LocalForms forms(placed);
  const ExtendedCore difference(forms);
  const CoreSearchSettings<Extended> settings{
      query.goal,
      forms.ball_radius(),
      Extended(std::ldexp(query.circumradii(), -forms.exponent())),
      Extended(query.relative_gap(kExtendedPolytopeGap, SeparationQuery::kCurvedGap)),
      query.settings.max_support_calls,
      query.max_hull_points(),
      Extended(std::ldexp(query.settings.max_distance, -forms.exponent()))};
  const QueryError<Extended> error{Extended(8.0), Extended(kExtendedError)};
  CoreSearch<Extended, ExtendedCore::Point, ExtendedCore> search(difference, error, settings,
                                                                 broadcast<Extended>(first_dir), {});
  if (search.wants_depth()) search.find_depth();
  const CoreSeparation<Extended, ExtendedCore::Point>& core = search.found();
  const auto of_bodies = [&forms](const Extended& of_cores) {
    return std::ldexp((of_cores - forms.ball_radius()).high, forms.exponent());
  };
  Separation result;
  result.n_support_calls = search.n_support_calls();
  result.lower = next_below(of_bodies(core.bounds.lower));
  result.upper = next_above(of_bodies(core.bounds.upper));
  result.signed_distance = of_bodies(core.distance);
  result.has_witnesses = core.has_normal;
  result.normal = high_part(core.normal);
  if (!core.has_normal) return result;
  const Vec3d own_b = weighted_sum(core.points, &ExtendedCore::Point::b);
  set_points(result, placed.a_from_b,
             {weighted_sum(core.points, &ExtendedCore::Point::a), placed.a_from_b(own_b), own_b}, query.a.ball_radius(),
             query.b.ball_radius());
  return result;
}

}  // namespace vex
