#include "engine/query/search/probed_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/numeric/directions.h"

namespace vex {
namespace {

using Ring = std::array<Vec3d, kCornersOfFace>;

// Of an eighth of the angle. A face has as large an extent then, or nearly; a surface that bends an eighth.
constexpr double kNarrower = 0.125;
// Extents of the whole angle and of an eighth of it are of one thing if the second is more than this of the first: of a
// length, and of an area.
constexpr double kStays = 0.5, kAreaStays = 0.3;
constexpr double kStraight = 0x1p-26, kLeast = 0x1p-20;
// An extent that falls by more than this is of what bends alone, which falls to an eighth; one that falls by less has a
// straight part, if a short one, as the side of a coin that stands on its edge. That is looked for at narrower angles,
// at which nothing else is as long, so many times.
constexpr double kOnlyBends = kNarrower * (1.0 + 0x1p-8);
constexpr int kMostNarrower = 3;

// Two unit vectors across a unit vector, which turn with the body: they change with the direction but a little, where
// it does, unless it crosses 45 degrees from the x axis.
struct PlaneAxes {
  Vec3d x, y;

  explicit PlaneAxes(const Vec3d& unit) {
    const Vec3d axis = std::fabs(unit.x) < 0.7071 ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
    const Vec3d beside = axis - dot(axis, unit) * unit;
    x = (1.0 / norm(beside)) * beside;
    y = cross(unit, x);
  }
};

// Support points of a core about a point of it, in units in which the body is about 1.
class Probe {
 public:
  Probe(const ConvexBody& body, const Vec3d& about)
      : body_(body), about_(about), unit_(std::ilogb(body.circumradius())) {}

  Vec3d operator()(const Vec3d& dir) const { return times_power_of_two(body_.core_support(dir) - about_, -unit_); }
  Vec3d point(const Vec3d& in_units) const { return about_ + times_power_of_two(in_units, unit_); }

  // Tilted by an angle of this tangent about a direction, each n-th of a turn.
  Ring ring(const Vec3d& unit_dir, double slope, std::size_t every = 1) const {
    static constexpr double kCos1 = 0.92387953251128674, kCos2 = 0.70710678118654752, kCos3 = 0.38268343236508977;
    static constexpr std::array<double, 16> kCosines = {1.0,  kCos1,  kCos2,  kCos3,  0.0, -kCos3, -kCos2, -kCos1,
                                                        -1.0, -kCos1, -kCos2, -kCos3, 0.0, kCos3,  kCos2,  kCos1};
    const PlaneAxes across(unit_dir);
    Ring points{};
    for (std::size_t k = 0; k < kCornersOfFace; k += every) {
      const Vec3d aside = kCosines[k] * across.x + kCosines[(k + 12) % 16] * across.y;
      points[k] = (*this)(unit_dir + slope * aside);
    }
    return points;
  }

 private:
  const ConvexBody& body_;
  Vec3d about_;
  int unit_;
};

// Twice the area of the polygon, along its normal (M. Newell).
Vec3d area_of(const Ring& points, std::size_t every = 1) {
  Vec3d area;
  for (std::size_t k = every; k + every < kCornersOfFace; k += every) {
    area = area + cross(points[k] - points[0], points[k + every] - points[0]);
  }
  return area;
}

// Two of them that are about as far from each other as any.
std::array<Vec3d, 2> far_ends(const Ring& points, std::size_t every) {
  Vec3d from = points[0], to = points[0];
  for (int round = 0; round < 2; ++round) {
    for (std::size_t k = 0; k < kCornersOfFace; k += every) {
      const Vec3d& p = points[k];
      if (dot(p - from, p - from) > dot(to - from, to - from)) to = p;
    }
    std::swap(from, to);
  }
  return {from, to};
}

enum class ProbedKind : std::uint8_t { face, no_face, point };

// What the points at eight of the sixteen directions are of, and if they are a face's, its normal.
ProbedKind kind_of(const Probe& probe, const Vec3d& unit_dir, const Ring& ring, double length, double slope,
                   Vec3d& normal, bool& only_bends) {
  const Vec3d area = area_of(ring, 2);
  const double size = norm(area);
  if (!(size > kLeast * length * length)) return ProbedKind::no_face;
  normal = (1.0 / size) * area;
  if (!(norm(cross(normal, unit_dir)) <= slope + kLeast && dot(normal, unit_dir) > 0.0)) return ProbedKind::no_face;
  // What bends away in all directions is known by four of them, and most bodies do.
  const auto [from, to] = far_ends(probe.ring(normal, kNarrower * slope, 4), 4);
  only_bends = !(norm(to - from) > kOnlyBends * length);
  if (!(norm(to - from) >= kStays * length)) return ProbedKind::point;
  return norm(area_of(probe.ring(normal, kNarrower * slope, 2), 2)) >= kAreaStays * size ? ProbedKind::face
                                                                                         : ProbedKind::no_face;
}

struct Edge {
  Vec3d from, to, unit_across;
};

// The edge along about this direction: tilted towards its ends, the mapping tells them.
Edge edge_along(const Probe& probe, const Vec3d& unit_dir, const Vec3d& unit_along, double slope) {
  const Vec3d across = unit_dir - dot(unit_dir, unit_along) * unit_along;
  const Vec3d unit_across = (1.0 / norm(across)) * across;
  const Vec3d aside = (kNarrower * slope) * unit_along;
  return {probe(unit_across - aside), probe(unit_across + aside), unit_across};
}

// The two ends of the edge that is within this slope across the direction, along about the line through two of the
// ring's points; false where there is none.
bool find_edge(const Probe& probe, const Vec3d& unit_dir, const Vec3d& first, const Vec3d& second, double slope,
               std::vector<NumberedPoint>& corners) {
  const double length = norm(second - first);
  // Twice: the ends that the ring has found may be beside the edge.
  Vec3d along = (1.0 / length) * (second - first);
  if (dot(along, Vec3d{0.36, 0.48, 0.8}) < 0.0) along = -along;  // the same end is the first one the next time
  Edge edge = edge_along(probe, unit_dir, along, slope);
  const double found = norm(edge.to - edge.from);
  if (!(found >= kStays * length)) return false;
  edge = edge_along(probe, unit_dir, (1.0 / found) * (edge.to - edge.from), slope);
  const double extent = norm(edge.to - edge.from);
  if (!(extent >= kStays * length)) return false;
  // What is within the feature angle, and straight.
  const double lean = std::fabs(dot(unit_dir, edge.to - edge.from));
  const double middle = dot(edge.unit_across, probe(edge.unit_across));
  const double bulge = middle - std::fmin(dot(edge.unit_across, edge.from), dot(edge.unit_across, edge.to));
  if (!(lean <= (slope + kLeast) * extent && bulge <= kStraight)) return false;
  corners.push_back({probe.point(edge.from), kEdgeFrom});
  corners.push_back({probe.point(edge.to), kEdgeTo});
  return true;
}

}  // namespace

void probe_face(const ConvexBody& body, const Vec3d& unit_dir, const Vec3d& nearest, double feature_angle,
                std::vector<NumberedPoint>& corners) {
  corners.clear();
  if (!(body.circumradius() > 0.0)) return;
  // Below 2^-20 a direction is not known better; and a wider angle than a radian would be no face's.
  double slope = std::tan(std::clamp(feature_angle, kLeast, 1.0));
  const Probe probe(body, nearest);
  for (int k = 0; k <= kMostNarrower && slope >= kLeast; ++k, slope *= kNarrower) {
    const Ring ring = probe.ring(unit_dir, slope, 2);
    const auto [first, second] = far_ends(ring, 2);
    const double length = norm(second - first);
    if (!(length > kLeast)) return;
    Vec3d normal;
    bool only_bends = false;
    const ProbedKind kind = kind_of(probe, unit_dir, ring, length, slope, normal, only_bends);
    if (kind == ProbedKind::face) {
      const Ring rim = probe.ring(normal, slope);
      for (std::uint32_t corner = 0; corner < kCornersOfFace; ++corner) {
        const bool is_known = std::any_of(rim.begin(), rim.begin() + corner,
                                          [&](const Vec3d& p) { return norm_1(p - rim[corner]) <= kStraight; });
        if (!is_known) corners.push_back({probe.point(rim[corner]), corner});
      }
      return;
    }
    if (kind == ProbedKind::no_face && find_edge(probe, unit_dir, first, second, slope, corners)) return;
    if (only_bends) return;
  }
}

}  // namespace vex
