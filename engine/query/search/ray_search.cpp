#include "engine/query/search/ray_search.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/directions.h"
#include "engine/query/search/difference.h"
#include "engine/query/search/nearest_simplex.h"
#include "engine/query/search/portal_refinement.h"

namespace vex {
namespace {

// Of one line. On polytopes a search ends by itself; curved ones need some 20 to 40 rounds to come to rounding.
constexpr int kMostTurns = 64, kMostPortalsOfRay = 192;

// Triangles are shrunk once a polytope of few faces would be done; by such ratios, each the square of the one before,
// unless that fails often.
constexpr int kRoundsOfPolytopes = 6, kMostFailures = 1;
constexpr double kFirstRatio = 0.125, kRatioOfGuess = 0x1p-6, kLeastRatio = 0x1p-12;
// Of a triangle, K being as large as 1: its square is next to rounding.
constexpr double kLeastSize = 0x1p-25;

// Off-centre rays about one that passes an edge of portals: how far, in errors of a shadow, to begin with; how much
// farther each time; and how often.
constexpr double kFirstOffset = 8.0, kOffsetGrowth = 8.0;
constexpr int kMostOffsets = 6;

// The first points are taken a little aside of where symmetry has them: through those the line would pass exactly.
constexpr double kTiltX = 0.1173, kTiltY = 0.0711;

Vec3d across(const Vec3d& unit) {
  const Vec3d side = cross(unit, least_axis(unit));
  return (1.0 / norm(side)) * side;
}

constexpr double kMostReach = 0x1p1000;

// A corner of a portal as it is seen from where the bodies meet.
struct SeenCorner {
  Vec3d w;
  const DifferencePoint* corner = nullptr;
};
constexpr std::size_t kMostCornerTurns = 16;

}  // namespace

bool are_within_range(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b) {
  return a.reach() < kMostReach && b.reach() < kMostReach && norm_1(a_from_b.translation) < kMostReach;
}

RaySearch::RaySearch(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& dir)
    : a_(a), b_(b), a_from_b_(a_from_b), dir_(dir), error_(query_error(a, b, a_from_b)) {
  exponent_ = error_.reach > 0.0 ? -std::ilogb(error_.reach) : 0;
  scale_ = std::ldexp(1.0, exponent_);
  error_ = {scale_ * error_.reach, scale_ * error_.support};
  // E22: the plane across the ray is one to a few u, and so are products with it.
  shadow_error_ = 1.5 * error_.support;
  along_ = (1.0 / norm(dir)) * dir;
  across_x_ = across(along_);
  across_y_ = cross(along_, across_x_);
  bounds_.latest = error_.reach / norm(dir) * (1.0 + gamma(8));
}

DifferencePoint RaySearch::support(const Vec3d& dir) {
  ++n_support_calls_;
  const Difference difference(a_, b_, a_from_b_, scale_);
  const Difference::CorePoints cores = difference.core_points(dir);
  return {difference.point(cores, dir), scale_ * cores.a, scale_ * cores.b, dir, cores.own_b};
}

// The support point of a normal, and what its plane tells of the ray: n . x <= h of all points of K, so t n . dir <= h.
DifferencePoint RaySearch::cut(const Vec3d& normal) {
  const DifferencePoint w = support(normal);
  const double length = norm_1(normal);
  const double height = dot(normal, w.at) + error_.support * length;
  const double along = dot(normal, dir_), rounding = 4.0 * kUnitRoundoff * length * norm_1(dir_);
  if (height < 0.0) {
    if (along - rounding >= 0.0) {
      bounds_.is_miss = true;
      normal_ = normal;
    } else {
      const double before = height / (along - rounding) * (1.0 - gamma(4));
      if (before > bounds_.lower || norm_1(normal_) == 0.0) normal_ = normal;
      bounds_.lower = std::fmax(bounds_.lower, before);
    }
  } else if (along - rounding > 0.0) {
    bounds_.latest = std::fmin(bounds_.latest, height / (along - rounding) * (1.0 + gamma(4)));
  }
  if (bounds_.lower > std::fmin(bounds_.latest, until_)) bounds_.is_miss = true;
  return w;
}

RaySearch::Shadow RaySearch::shadow(const DifferencePoint& point, const Line& line) const {
  return {dot(point.at, across_x_) - line.at.x, dot(point.at, across_y_) - line.at.y};
}

// Of points that are within shadow_error_ of these.
bool RaySearch::turns_beyond_doubt(const Shadow& p, const Shadow& q) const {
  const double lengths = std::fabs(p.x) + std::fabs(p.y) + std::fabs(q.x) + std::fabs(q.y);
  return turn(p, q) > 1.1 * shadow_error_ * (lengths + shadow_error_);
}

RaySearch::Line RaySearch::line_at(double x, double y) const { return {{x, y}, x * across_x_ + y * across_y_}; }

// The descent of Gilbert, Johnson and Keerthi in the shadow. None: the line misses K, or passes within rounding of the
// shadow's rim, or of a corner of it.
std::optional<RaySearch::Corners> RaySearch::corners_around(const Line& line) {
  DifferencePoint first = cut(kTiltX * across_x_ + kTiltY * across_y_ - along_);
  const auto in_shadow = [&](double x, double y) {
    return cut(scaled_to_unit_exponent(x * across_x_ + y * across_y_));
  };
  const double doubt = 2.0 * shadow_error_;
  Shadow p = shadow(first, line);
  if (p.x == 0.0 && p.y == 0.0) p.x = -shadow_error_;  // any direction is as good
  DifferencePoint second = in_shadow(-p.x - kTiltX * p.y, -p.y + kTiltX * p.x);
  for (int round = 0; round < kMostTurns && !bounds_.is_miss; ++round) {
    const Shadow from = shadow(first, line), to = shadow(second, line);
    Shadow edge{to.x - from.x, to.y - from.y};
    const double length = std::hypot(edge.x, edge.y);
    if (!(length > doubt)) return std::nullopt;
    // To the side of the edge on which the line is; where it is on neither, whichever has more of K.
    double side = turn(from, to) >= 0.0 ? 1.0 : -1.0;
    DifferencePoint third = in_shadow(-side * edge.y, side * edge.x);
    const auto beyond = [&](const Shadow& q) { return side * (turn(from, to) + turn(to, q) + turn(q, from)) / length; };
    if (!(beyond(shadow(third, line)) > doubt)) {
      if (std::fabs(turn(from, to)) > doubt * length || bounds_.is_miss) return std::nullopt;
      side = -side;
      third = in_shadow(-side * edge.y, side * edge.x);
      if (!(beyond(shadow(third, line)) > doubt)) return std::nullopt;
    }
    const Shadow q = shadow(third, line);
    // Inside, or beyond one of the two new edges.
    const bool beyond_second = side * turn(to, q) < 0.0, beyond_first = side * turn(q, from) < 0.0;
    if (!beyond_second && !beyond_first) {
      if (side > 0.0) return Corners{first, second, third};
      return Corners{second, first, third};
    }
    // Beyond both the line is past the third point: the edge that it is beyond by more.
    if (beyond_second && (!beyond_first || side * turn(to, q) * std::hypot(q.x - from.x, q.y - from.y) <
                                               side * turn(q, from) * std::hypot(q.x - to.x, q.y - to.y))) {
      first = third;
    } else {
      second = third;
    }
  }
  return std::nullopt;
}

// Where the line passes the portal beyond doubt, it is in K there: every point of the triangle of the true points has
// n . x from min n . v - E |n|_1 to max n . v + E |n|_1. False where nothing of it is known from above.
bool RaySearch::bound_crossing(Line& line, const Corners& corners, const Vec3d& normal) const {
  const Shadow p = shadow(corners[0], line), q = shadow(corners[1], line), r = shadow(corners[2], line);
  if (!turns_beyond_doubt(p, q) || !turns_beyond_doubt(q, r) || !turns_beyond_doubt(r, p)) return false;
  const double length = norm_1(normal), rounding = 4.0 * kUnitRoundoff * length * norm_1(dir_);
  const double along = dot(normal, dir_), offset = dot(normal, line.offset), error = error_.support * length;
  if (!(along + rounding < 0.0)) return false;
  const double v0 = dot(normal, corners[0].at), v1 = dot(normal, corners[1].at), v2 = dot(normal, corners[2].at);
  const double low = (std::fmin(v0, std::fmin(v1, v2)) - offset) - error;
  const double t = low / (low < 0.0 ? along + rounding : along - rounding);
  line.upper = std::fmin(line.upper, t + gamma(4) * std::fabs(t));
  const double high = (std::fmax(v0, std::fmax(v1, v2)) - offset) + error;
  const double from = high / (high < 0.0 ? along - rounding : along + rounding);
  line.least = std::fmax(line.least, from - gamma(4) * std::fabs(from));
  return true;
}

// The farthest point along the ray in place of a corner: of a K that is not flat such a triangle is passed later.
void RaySearch::look_behind(Line& line, const Corners& corners) {
  Corners behind = corners;
  if (!narrow(line, behind, cut(along_))) return;
  Vec3d normal = scaled_to_unit_exponent(detail::face_of(behind[0].at, behind[1].at, behind[2].at).normal);
  if (dot(normal, along_) > 0.0) normal = -normal;
  bound_crossing(line, behind, normal);
}

// The part of the portal, split by w in three, that the line passes.
bool RaySearch::narrow(const Line& line, Corners& corners, const DifferencePoint& w) const {
  const Shadow at_w = shadow(w, line);
  int best = -1;
  double best_inside = -HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) {
    const Shadow p = shadow(corners[k], line), q = shadow(corners[(k + 1) % 3], line);
    const double area = turn(p, q) + turn(q, at_w) + turn(at_w, p);
    if (!(area > 0.0)) continue;
    const double inside = std::fmin(turn(q, at_w), turn(at_w, p)) / area;
    if (inside > best_inside) {
      best_inside = inside;
      best = static_cast<int>(k);
    }
  }
  if (best < 0) return false;
  corners[(static_cast<std::size_t>(best) + 2) % 3] = w;
  return true;
}

// Of a smooth K the normal, scaled to one height along the ray, is nearly linear in the shadow: so support points can
// be had near three places around the line, in a triangle `ratio` as large.
std::optional<RaySearch::Corners> RaySearch::shrunk(const Line& line, const Corners& corners, double ratio) {
  std::array<Shadow, 3> at;
  std::array<Vec3d, 3> slope;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = shadow(corners[k], line);
    const double along = -dot(corners[k].dir, along_);
    if (!(along > 0x1p-10 * norm_1(corners[k].dir))) return std::nullopt;
    slope[k] = (1.0 / along) * corners[k].dir;
  }
  const Shadow side{at[1].x - at[0].x, at[1].y - at[0].y}, other{at[2].x - at[0].x, at[2].y - at[0].y};
  const double area = turn(side, other);
  double size = 0.0;
  for (const Shadow& corner : at) size = std::fmax(size, std::hypot(corner.x, corner.y));
  ratio = std::fmax(ratio, kLeastSize / size);
  if (ratio > kFirstRatio) return std::nullopt;
  Corners next;
  for (std::size_t k = 0; k < 3; ++k) {
    // A smaller copy, the line in its middle.
    const std::size_t from = (k + 1) % 3, to = (k + 2) % 3;
    const Shadow wanted{ratio * (2.0 * at[k].x - at[from].x - at[to].x),
                        ratio * (2.0 * at[k].y - at[from].y - at[to].y)};
    const Shadow offset{wanted.x - at[0].x, wanted.y - at[0].y};
    const double of_1 = turn(offset, other) / area, of_2 = turn(side, offset) / area;
    const Vec3d normal = ((1.0 - of_1 - of_2) * slope[0] + of_1 * slope[1]) + of_2 * slope[2];
    next[k] = cut(scaled_to_unit_exponent(normal));
    if (bounds_.is_miss) return std::nullopt;
  }
  const Shadow p = shadow(next[0], line), q = shadow(next[1], line), r = shadow(next[2], line);
  if (!turns_beyond_doubt(p, q) || !turns_beyond_doubt(q, r) || !turns_beyond_doubt(r, p)) return std::nullopt;
  return next;
}

std::optional<RaySearch::Corners> RaySearch::close_in(Line& line) {
  std::optional<Corners> corners = corners_around(line);
  if (corners) close_in(line, *corners, 0, kFirstRatio);
  return corners;
}

// From the given round on.
void RaySearch::close_in(Line& line, Corners& corners, int round, double ratio) {
  int n_failures = 0;
  for (; round < kMostPortalsOfRay && !bounds_.is_miss; ++round) {
    const Corners& c = corners;
    // Against the ray: the corners turn counter-clockwise seen along it.
    const Vec3d normal = scaled_to_unit_exponent(-detail::face_of(c[0].at, c[1].at, c[2].at).normal);
    if (!(dot(normal, along_) < 0.0)) break;
    const DifferencePoint w = cut(normal);
    line.is_settled = bound_crossing(line, c, normal);
    if (is_known_well(line.upper)) break;
    const double least = std::fmin(dot(normal, c[0].at), std::fmin(dot(normal, c[1].at), dot(normal, c[2].at)));
    if (!(dot(normal, w.at) - least > error_.support * norm_1(normal))) break;
    if (!narrow(line, corners, w)) break;
    if (round < kRoundsOfPolytopes || n_failures > kMostFailures) continue;
    if (const std::optional<Corners> smaller = shrunk(line, corners, ratio)) {
      corners = *smaller;
      ratio = std::fmax(ratio * ratio, kLeastRatio);
    } else {
      ratio = std::fmin(std::sqrt(ratio), kFirstRatio);
      ++n_failures;
    }
  }
}

// How far the bounds are apart where neither can be better.
double RaySearch::width_of_rounding() const {
  return 8.0 * error_.support * norm_1(normal_) / std::fmax(std::fabs(dot(normal_, dir_)), 0x1p-60);
}

RayBounds RaySearch::run(const Vec3d& separating_dir, bool is_apart_at_start) {
  cut(along_);
  if (!bounds_.is_miss && norm_1(separating_dir) > 0.0) cut(scaled_to_unit_exponent(separating_dir));
  if (bounds_.is_miss) return bounds_;
  Line ray = line_at(0.0, 0.0);
  const std::optional<Corners> corners = close_in(ray);
  bounds_.upper = ray.upper;
  if (corners) keep(*corners);
  if (corners && !(bounds_.lower > 0.0) && !(ray.least >= 0.0)) look_behind(ray, *corners);
  // Through an edge or a corner: points of K on three lines around the ray have one on the ray between them.
  double offset = kFirstOffset * shadow_error_;
  for (int attempt = 0; attempt < kMostOffsets && !bounds_.is_miss; ++attempt, offset *= kOffsetGrowth) {
    if (bounds_.upper - bounds_.lower <= width_of_rounding() || is_known_well(bounds_.upper)) break;
    // Turned by angles that no symmetry knows.
    const double angle = 0.7548776662 + 2.399963 * attempt;
    double latest = -HUGE_VAL, least = HUGE_VAL;
    bool are_settled = true;
    std::array<std::optional<Corners>, 3> portals;
    std::size_t n_lines = 0;
    while (n_lines < 3 && latest < bounds_.upper && !bounds_.is_miss) {
      const double turned = angle + 2.0943951023931953 * static_cast<double>(n_lines);
      Line beside = line_at(offset * std::cos(turned), offset * std::sin(turned));
      const std::optional<Corners>& found = portals[n_lines++] = close_in(beside);
      if (found && n_portals_ == 0) keep(*found);
      latest = std::fmax(latest, beside.upper + 8.0 * kUnitRoundoff * offset);
      if (found && !(bounds_.lower > 0.0) && !(beside.least > 0.0)) look_behind(beside, *found);
      least = std::fmin(least, beside.least - 8.0 * kUnitRoundoff * offset);
      are_settled = are_settled && beside.is_settled;
    }
    if (n_lines == 3 && latest < bounds_.upper) {
      // Between what they meet is a point on the ray.
      n_portals_ = 0;
      for (const std::optional<Corners>& portal : portals) keep(*portal);
    }
    bounds_.upper = std::fmin(bounds_.upper, latest);
    if (n_lines == 3) ray.least = std::fmax(ray.least, least);
    if (are_settled) break;
  }
  // The bodies are apart at the start, and the line is in K before it: then never again.
  if (bounds_.upper < 0.0 && is_apart_at_start) bounds_.is_miss = true;
  // A point of K that is on the line before `upper` is on the ray if all of K on the line is after the start. Or else
  // another one is on the ray: with that one K has all between them, and the first of those on the ray is at 0, where
  // the bodies may touch, or no later than the first one.
  bounds_.is_hit = !bounds_.is_miss && bounds_.upper < HUGE_VAL && (bounds_.lower > 0.0 || ray.least >= 0.0);
  if (bounds_.is_hit) bounds_.upper = std::fmax(bounds_.upper, 0.0);
  return bounds_;
}

RayBounds RaySearch::run_from(const CastGuess& guess) {
  Corners corners;
  for (std::size_t k = 0; k < guess.n && !bounds_.is_miss; ++k) corners[k] = cut(guess.dirs[k]);
  if (guess.n < CastGuess::kMost || bounds_.is_miss) return bounds_;
  Line ray = line_at(0.0, 0.0);
  close_in(ray, corners, kRoundsOfPolytopes, kRatioOfGuess);
  bounds_.upper = ray.upper;
  keep(corners);
  bounds_.is_hit = !bounds_.is_miss && bounds_.lower > 0.0 && bounds_.upper - bounds_.lower <= width_of_rounding();
  return bounds_;
}

// Of a portal's corners, where they make the ray's point to rounding. None of a portal that is narrower than that, or
// lies along the ray.
std::optional<std::array<double, 3>> RaySearch::weights_by_shadow(double time) const {
  if (n_portals_ != 1) return std::nullopt;
  const Corners& corners = *contact_[0];
  const Line ray = line_at(0.0, 0.0);
  std::array<Shadow, 3> at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = shadow(corners[k], ray);
  std::array<double, 3> weights{turn(at[1], at[2]), turn(at[2], at[0]), turn(at[0], at[1])};
  const double sum = weights[0] + weights[1] + weights[2];
  Vec3d off = -time * dir_;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] /= sum;
    off = off + weights[k] * corners[k].at;
  }
  const bool is_between = weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
  if (!(is_between && norm_1(off) <= 2.0 * error_.support)) return std::nullopt;
  return weights;
}

RaySearch::Touch RaySearch::touch() const {
  Touch touch;
  if (norm_1(normal_) > 0.0) touch.normal = unit_along(normal_);
  if (n_portals_ == 0) return touch;
  const double time = bounds_.upper < HUGE_VAL ? bounds_.lower + 0.5 * (bounds_.upper - bounds_.lower) : bounds_.lower;
  const bool has_balls = a_.ball_radius() + b_.ball_radius() > 0.0;
  Vec3d core_a, core_b, own_b, outwards, from_b;
  const auto take = [&](const DifferencePoint& corner, double weight) {
    core_a = core_a + weight * corner.core_a;
    core_b = core_b + weight * corner.core_b;
    own_b = own_b + weight * corner.own_b;
    if (!has_balls) return;
    // With the balls along the corners' own directions what is between the corners is where the bodies meet.
    const Vec3d unit = unit_along(corner.dir);
    outwards = outwards + weight * unit;
    from_b = from_b + weight * unit_seen_from_b(a_from_b_, unit);
  };
  if (const std::optional<std::array<double, 3>> weights = weights_by_shadow(time)) {
    for (std::size_t k = 0; k < 3; ++k) take((*contact_[0])[k], (*weights)[k]);
  } else {
    // Whatever corner brings the corners' nearest point nearer is taken in, until none does.
    NearestSimplex<double, SeenCorner> met;
    const std::size_t n_corners = 3 * n_portals_;
    std::size_t n_without_gain = 0;
    for (std::size_t k = 0; k < kMostCornerTurns * n_corners && n_without_gain < n_corners; ++k) {
      const DifferencePoint& corner = (*contact_[k % n_corners / 3])[k % 3];
      n_without_gain = met.add({corner.at - time * dir_, &corner}, false) ? 0 : n_without_gain + 1;
    }
    for (int k = 0; k < met.size(); ++k) take(*met.point(k).corner, met.weight(k));
  }
  touch.point_a = times_power_of_two(core_a, -exponent_) + a_.ball_radius() * outwards;
  touch.point_b = times_power_of_two(core_b, -exponent_) - b_.ball_radius() * outwards;
  touch.point_b_in_b = own_b - b_.ball_radius() * from_b;
  return touch;
}

}  // namespace vex
