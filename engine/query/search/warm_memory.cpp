#include "engine/query/search/warm_memory.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/numeric/directions.h"
#include "engine/query/search/direction_code.h"

namespace vex {
namespace {

// How much nearer bounds are brought from nothing than a known hull has to bring them, as far as that is allowed: its
// triangles are a little larger or smaller than they were.
constexpr double kAllowance = 1.75;
// How often in turn a memory may fail before it is made only now and then; and where that is begun anew.
constexpr int kMostFailed = 2, kFirstPlace = 4, kFirstHull = 16, kLongFailed = 64;
// A hull that has to grow by more points than these takes as long as one from nothing, for it is larger.
constexpr int kMostGrownOfCorners = 7, kMostGrown = 10;
// What a memory costs besides its support calls, in quarters of one: corners are looked up, of a place axes are made,
// and either is made anew where the nearest points are others. A search from nothing that takes fewer calls than
// `kShort...` is as fast as what would be remembered of it.
constexpr int kCornersCost = 8, kNewCornersCost = 6, kPlaceCost = 8, kNewPlaceCost = 16;
constexpr int kShortOfCorners = 4, kShortOfPlace = 12;
// After so many uses a search begins from nothing once, to see what that takes by now.
constexpr int kMostUsed = 64;
// After a place that is known well a descent has no more to ask than these.
constexpr int kFewCalls = 4;

// A unit vector of what may be none; else zero.
Vec3d unit_or_zero(const Vec3d& v) {
  const double size = norm_1(v);
  return size > 0.5 && size < 2.0 ? unit_along(v) : Vec3d{};
}

std::optional<WarmMemory::CornersOfBoth> corners_of(const CoreDifference& difference) {
  if (difference.has_rolling() || !difference.a().is_rounded_polytope() || !difference.b().is_rounded_polytope()) {
    return std::nullopt;
  }
  const CornerTable &a = difference.a().corners(), &b = difference.b().corners();
  if (a.size() == 0 || b.size() == 0) return std::nullopt;
  return WarmMemory::CornersOfBoth{a, b};
}

}  // namespace

WarmMemory::WarmMemory(WarmStart& state, const CoreDifference& difference, const QueryError<double>& error)
    : state_(state),
      difference_(difference),
      error_(error),
      normal_(unit_or_zero(state.normal_)),
      corners_(corners_of(difference)),
      holds_hull_(state.are_corners_ == (corners_ ? 1 : 0) && norm_1(normal_) > 0.0 && state.n_points_ >= 4 &&
                  state.n_points_ <= WarmStart::kMostPoints && state.n_faces_ >= 4 &&
                  state.n_faces_ <= WarmStart::kMostFaces) {}

std::optional<WarmMemory::Point> WarmMemory::point_of(std::uint32_t code, const DirectionCode& frame) {
  if (!corners_) {
    ++n_support_calls_;
    return difference_.support(frame.unit_dir(code));
  }
  return are_corners(code) ? std::optional(corner_of(code)) : std::nullopt;
}
bool WarmMemory::are_corners(std::uint32_t code) const {
  return (code >> 16) < corners_->a.size() && (code & 0xffffu) < corners_->b.size();
}
WarmMemory::Point WarmMemory::corner_of(std::uint32_t code) const {
  return difference_.at(corners_->a[code >> 16], corners_->b[code & 0xffffu]);
}
std::optional<std::uint32_t> WarmMemory::code_of(const Point& point, const DirectionCode& frame) const {
  if (!corners_) return frame.code(point.dir);
  const std::optional<std::uint16_t> of_a = corners_->a.number_of(point.a), of_b = corners_->b.number_of(point.own_b);
  if (!of_a || !of_b) return std::nullopt;
  return std::uint32_t{*of_a} << 16 | *of_b;
}

NearestSimplex<double, WarmMemory::Point> WarmMemory::simplex(const CoreSearchSettings<double>& settings,
                                                              bool is_smooth) {
  NearestSimplex<double, Point> simplex;
  const bool is_known = norm_1(normal_) > 0.0 && state_.n_faces_ == 0 && state_.n_points_ <= 4;
  // A direction that parts the bodies is all that a depth has to know of bodies that are apart.
  if (!is_known || settings.goal == SeparationGoal::depth || state_.are_corners_ != (corners_ ? 1 : 0)) return simplex;
  has_begun_apart_ = true;
  if (is_smooth) {
    LowPlaceSearch search(difference_, settings.size);
    nearest_ = find_lowest(search);
    n_support_calls_ += search.n_support_calls();
    place_cost_ = search.quarters();
    if (!(CoreDifference::height_of(nearest_->point) < 0.0)) {
      nearest_.reset();
      return simplex;
    }
    search.visit_last([&simplex](const Point& point) {
      if (!simplex.is_around_origin()) simplex.add(point, false);
    });
    return simplex;
  }
  const DirectionCode frame = frame_of(normal_, state_.x_, state_.y_);
  std::array<Point, 4> points;
  std::size_t n = 0;
  for (std::size_t k = 0; k < state_.n_points_; ++k) {
    const std::optional<Point> point = point_of(state_.dirs_[k], frame);
    if (point) points[n++] = *point;
  }
  if (n > 0) simplex.begin_with(std::span(points).first(n));
  return simplex;
}

LowPlace WarmMemory::find_lowest(LowPlaceSearch& search) const {
  // A face of A turns with A, and one of B with B.
  LowPlace start{search.ask(normal_), state_.x_, state_.y_, static_cast<double>(state_.turn_x_),
                 static_cast<double>(state_.turn_y_)};
  const Vec3d with_b = unit_or_zero(difference_.turned_with_b(state_.normal_in_b_));
  if (norm_1(with_b) > 0.0) {
    const Point other = search.ask(with_b);
    if (CoreDifference::height_of(other) < CoreDifference::height_of(start.point)) start.point = other;
  }
  return search.lower(start);
}

bool WarmMemory::find_depth(const CoreSearchSettings<double>& settings, bool is_smooth, Found& found) {
  if (state_.n_points_ + 1 >= settings.max_hull_points) return false;
  thread_local PolytopeStore<double, Point> store;
  Polytope polytope(difference_, error_, settings.max_hull_points, store);
  LowPlace lowest{{}, state_.x_, state_.y_, 0.0, 0.0};
  lowest.point.dir = normal_;
  if (is_smooth) {
    LowPlaceSearch search(difference_, settings.size);
    lowest = find_lowest(search);
    n_support_calls_ += search.n_support_calls();
    if (CoreDifference::height_of(lowest.point) < 0.0) {
      normal_ = lowest.point.dir;
      is_parted_ = true;
      return false;
    }
  }
  const DirectionCode frame = frame_of(lowest.point.dir, lowest.x, lowest.y);
  for (std::size_t k = 0; k < state_.n_points_; ++k) {
    const std::uint32_t code = state_.dirs_[k];
    if (!corners_) {
      ++n_support_calls_;
      polytope.add_farthest(difference_.support(frame.unit_dir(code)));
      continue;
    }
    if (!are_corners(code)) return false;
    polytope.add_known([&] { return corner_of(code); });
  }
  // Last, so that it changes no number of another.
  if (is_smooth) polytope.add_farthest(lowest.point);
  CoreSearchSettings<double> allowing = settings;
  allowing.relative_gap =
      std::min(kAllowance * settings.relative_gap, std::max(settings.relative_gap, settings.allowed_gap));
  const auto wanted = [&](double depth) { return allowing.wanted(-depth); };
  const auto corners = [this](std::uint32_t k) {
    const std::array<std::uint8_t, 3>& face = state_.faces_[k];
    return Polytope::Corners{face[0], face[1], face[2]};
  };
  const Polytope::End end = polytope.run_on(state_.n_faces_, corners, wanted);
  n_support_calls_ += polytope.n_support_calls();
  if (end == Polytope::End::separated) {
    normal_ = polytope.normal();
    is_parted_ = true;
  }
  const double depth_lower = end == Polytope::End::converged ? polytope.depth_lower() : 0.0;
  if (!(depth_lower > 0.0)) {
    if (end != Polytope::End::separated) ++state_.n_failed_;
    return false;
  }
  const bool is_given_up = fails(polytope.n_support_calls() <= (corners_ ? kMostGrownOfCorners : kMostGrown));
  found.normal = polytope.normal();
  found.has_normal = true;
  found.distance = -polytope.height();
  found.tells_missing = true;  // nothing
  found.bounds = {-polytope.depth_upper(), -depth_lower};
  const auto add = [&](double weight, const Point& point) { found.points.add(weight, point); };
  if (polytope.is_as_known()) {
    if (!visit_foot(polytope, found.normal, add)) return false;
    if (is_smooth) keep_place(lowest);
    if (corners_) keep_normal(found.normal);
    return true;
  }
  polytope.visit_foot(add);
  if (is_smooth) keep_place(lowest);
  is_given_up ? forget() : keep_grown_hull(polytope);
  if (corners_ && state_.n_faces_ > 0) keep_normal(found.normal);
  return true;
}

// In the triangle of the surface, as it is known, that the ray along the normal passes.
template <class Visit>
bool WarmMemory::visit_foot(const Polytope& polytope, const Vec3d& normal, const Visit& visit) const {
  for (std::size_t f = 0; f < state_.n_faces_; ++f) {
    const std::array<std::uint8_t, 3>& face = state_.faces_[f];
    const Point &a = polytope.points()[face[0]], &b = polytope.points()[face[1]], &c = polytope.points()[face[2]];
    const double of_a = dot(cross(b.w, c.w), normal), of_b = dot(cross(c.w, a.w), normal);
    const double of_c = dot(cross(a.w, b.w), normal), sum = of_a + of_b + of_c;
    if (!(of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 && sum > 0.0)) continue;
    visit(of_a / sum, a);
    visit(of_b / sum, b);
    visit(of_c / sum, c);
    return true;
  }
  return false;
}

DirectionCode WarmMemory::frame_of(const Vec3d& middle, const Vec3d& x, const Vec3d& y) const {
  return corners_ ? DirectionCode() : DirectionCode(middle, x, y);
}

bool WarmMemory::keep_place(const LowPlace& place) {
  const DirectionCode frame = frame_of(place.point.dir, place.x, place.y);
  normal_ = unit_or_zero(place.point.dir);
  state_.normal_ = normal_;
  state_.normal_in_b_ = difference_.seen_from_b(normal_);
  state_.x_ = frame.x();
  state_.y_ = frame.y();
  state_.turn_x_ = static_cast<float>(place.turn_x);
  state_.turn_y_ = static_cast<float>(place.turn_y);
  return norm_1(normal_) > 0.0;
}
void WarmMemory::keep_normal(const Vec3d& unit_normal) { state_.normal_ = unit_normal; }

void WarmMemory::forget() {
  if (state_.n_faces_ > 0) state_.faces_[0] = {};  // no account
  state_.n_points_ = state_.n_faces_ = 0;
  state_.normal_ = {};
}

bool WarmMemory::rests(int first) {
  if (state_.n_failed_ < kMostFailed) return false;
  if (++state_.n_failed_ == 0xff) state_.n_failed_ = kLongFailed;
  return state_.n_failed_ < first || !std::has_single_bit(state_.n_failed_);
}
bool WarmMemory::fails(bool is_of_use) {
  state_.n_failed_ = static_cast<std::uint8_t>(is_of_use ? 0 : state_.n_failed_ + 1);
  return state_.n_failed_ >= kMostFailed;
}

void WarmMemory::remember_nearest(const Found& found, const CoreSearchSettings<double>& settings, bool is_smooth,
                                  int n_calls) {
  std::uint8_t& usual = quarters_from_nothing();
  if (!has_begun_apart_) {
    const int quarters = std::min(4 * n_calls, 0xff);
    usual = static_cast<std::uint8_t>(usual == 0 ? quarters : usual + (quarters - usual) / 4);
    const bool is_short = usual < 4 * (is_smooth ? kShortOfPlace : kShortOfCorners);
    if (is_short || rests(kFirstPlace)) return forget();
    keep_nearest(found, settings, is_smooth);
    n_used() = 0;
    return;
  }
  const bool is_lost = n_calls > (is_smooth ? kFewCalls : 1);
  const int quarters = 4 * n_calls + (is_smooth ? place_cost_ + kPlaceCost + (is_lost ? kNewPlaceCost : 0)
                                                : kCornersCost + (is_lost ? kNewCornersCost : 0));
  if (fails(quarters <= usual) || ++n_used() >= kMostUsed) return forget();
  if (is_smooth && is_lost) nearest_.reset();
  if (corners_ && !is_lost) return keep_normal(found.normal);  // the points are those that are known
  keep_nearest(found, settings, is_smooth);
}

void WarmMemory::keep_nearest(const Found& found, const CoreSearchSettings<double>& settings, bool is_smooth) {
  forget();
  if (is_smooth && settings.goal != SeparationGoal::depth) {
    if (!nearest_) {
      LowPlaceSearch search(difference_, settings.size);
      nearest_ = search.around(found.normal);
      n_support_calls_ += search.n_support_calls();
    }
    nearest_->point.dir = found.normal;
    keep_place(*nearest_);
    state_.are_corners_ = 0;
    return;
  }
  keep_normal(found.normal);
  if (!corners_) {
    LowPlace place;
    place.point.dir = found.normal;
    keep_place(place);
  }
  const DirectionCode frame = frame_of(state_.normal_, state_.x_, state_.y_);
  for (std::size_t k = 0; k < found.points.size(); ++k) {
    const std::optional<std::uint32_t> code = code_of(found.points.point(k), frame);
    if (!code) return;
    state_.dirs_[k] = *code;
  }
  state_.n_points_ = static_cast<std::uint8_t>(found.points.size());
  state_.are_corners_ = corners_ ? 1 : 0;
}

void WarmMemory::remember_hull(const Polytope& polytope, bool is_smooth, double size, int n_calls) {
  forget();
  // Of pairs whose hulls are of no use a step later one is tried now and then.
  if ((is_smooth && n_calls < kShortOfPlace) || rests(kFirstHull)) return;
  if (is_smooth) {
    LowPlaceSearch search(difference_, size);
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = polytope.points()[polytope.nearest_corners()[k]];
    const LowPlace place =
        search.of_triangle(polytope.point_along_normal(), corners, polytope.height() - polytope.depth_lower());
    n_support_calls_ += search.n_support_calls();
    if (!keep_place(place)) return;
  } else {
    LowPlace place;
    place.point.dir = polytope.normal();
    keep_place(place);
  }
  keep_hull(polytope, false);
  state_.n_points_at_first_ = state_.n_points_;
}

void WarmMemory::keep_grown_hull(const Polytope& polytope) {
  keep_hull(polytope, true);
  // A hull that has grown along with a motion is larger than need be.
  if (state_.n_points_ > state_.n_points_at_first_ + state_.n_points_at_first_ / 2 + 4) forget();
}

void WarmMemory::keep_hull(const Polytope& polytope, bool has_kept) {
  constexpr std::uint8_t kNone = 0xff;
  thread_local std::vector<std::uint8_t> number;
  number.assign(polytope.points().size(), kNone);
  const DirectionCode frame = frame_of(normal_, state_.x_, state_.y_);
  const std::uint32_t n_kept = has_kept ? state_.n_points_ : 0;
  std::array<std::uint32_t, WarmStart::kMostPoints> dirs;
  std::size_t n_points = 0, n_faces = 0;
  bool is_lost = false;
  polytope.visit_faces([&](const Polytope::Corners& corners) {
    if (is_lost || n_faces == WarmStart::kMostFaces) {
      is_lost = true;
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k];
      if (number[i] == kNone) {
        if (n_points == WarmStart::kMostPoints) {
          is_lost = true;
          return;
        }
        const std::optional<std::uint32_t> code = i < n_kept ? state_.dirs_[i] : code_of(polytope.points()[i], frame);
        if (!code) {
          is_lost = true;
          return;
        }
        dirs[n_points] = *code;
        number[i] = static_cast<std::uint8_t>(n_points++);
      }
      state_.faces_[n_faces][k] = number[i];
    }
    ++n_faces;
  });
  if (is_lost) {
    forget();
    return;
  }
  std::copy_n(dirs.begin(), n_points, state_.dirs_.begin());
  state_.n_points_ = static_cast<std::uint8_t>(n_points);
  state_.n_faces_ = static_cast<std::uint8_t>(n_faces);
  state_.are_corners_ = corners_ ? 1 : 0;
}

}  // namespace vex
