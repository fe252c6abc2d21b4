#include "tests/referees/difference_hull.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

namespace vex::exact {
namespace {

constexpr int kMostFaces = 1000;
// Coordinates are a few units; of a face no smaller than what `kNearEnough` takes, heights are right to less.
constexpr double kSeen = 0x1p-80;
// Points whose hull is thinner than this have no volume.
constexpr double kThin = 0x1p-90;

class DifferenceHull {
 public:
  explicit DifferenceHull(const DifferenceBody& difference) : difference_(difference) {}

  Bounds depth() {
    if (!make_tetrahedron()) return bounds_;
    for (int step = 0; step < kMostFaces; ++step) {
      while (!faces_[nearest_.top().second].is_there) nearest_.pop();
      const std::size_t index = nearest_.top().second;
      const Face face = faces_[index];
      bounds_.lower = face.distance;
      const Vec3dd p = support(face.normal);
      const DoubleDouble beyond = dot(p, face.normal) - face.distance;
      if (beyond.value() <= kSeen || (bounds_.upper - bounds_.lower).value() <= kNearEnough) return bounds_;
      if (!add(p, index)) return bounds_;  // the bound of the last whole polytope stands
    }
    return bounds_;
  }

 private:
  using Corners = std::array<std::size_t, 3>;
  struct Face {
    Corners corners, across;  // counter-clockwise from outside; the neighbour beyond corner k and the next
    Vec3dd normal;
    DoubleDouble distance;
    bool is_there = true;
  };

  // Every direction that is looked at gives a bound from above.
  Vec3dd support(const Vec3dd& unit_dir) {
    const Vec3dd p = difference_.support_of_cores(unit_dir).approximately;
    const DoubleDouble height = dot(p, unit_dir);
    if (height < bounds_.upper) {
      bounds_.upper = height;
      bounds_.direction = unit_dir;
    }
    return p;
  }

  static std::optional<Vec3dd> unit(const Vec3dd& v) {
    const DoubleDouble length = norm(v);
    if (!(length.high > 0.0)) return std::nullopt;
    return Vec3dd{v.x / length, v.y / length, v.z / length};
  }

  // The farther of the two supports across a plane through `from`; nothing where there is no way off it.
  std::optional<Vec3dd> off_plane(const Vec3dd& from, const Vec3dd& normal) {
    const std::optional<Vec3dd> n = unit(normal);
    if (!n) return std::nullopt;
    const Vec3dd up = support(*n), down = support(-*n);
    const double above = dot(up - from, *n).value(), below = dot(from - down, *n).value();
    if (std::max(above, below) > kThin) return above > below ? up : down;
    bounds_ = {0.0, 0.0, *n};
    return std::nullopt;
  }

  bool make_tetrahedron() {
    std::vector<Vec3dd> p = {support({1.0, 0.0, 0.0})};
    const auto spread = [&p](const Vec3dd& q) { return norm(q - p[0]).value() > kThin; };
    for (const Vec3dd& dir : {Vec3dd{-1.0, 0.0, 0.0}, Vec3dd{0.0, 1.0, 0.0}, Vec3dd{0.0, -1.0, 0.0},
                              Vec3dd{0.0, 0.0, 1.0}, Vec3dd{0.0, 0.0, -1.0}}) {
      const Vec3dd q = support(dir);
      if (p.size() == 1 && spread(q)) p.push_back(q);
    }
    if (p.size() == 1) {
      bounds_ = {0.0, 0.0, {1.0, 0.0, 0.0}};
      return false;
    }
    const Vec3dd along = p[1] - p[0];
    const double x = std::fabs(along.x.high), y = std::fabs(along.y.high), z = std::fabs(along.z.high);
    const Vec3dd axis = x <= y && x <= z ? Vec3dd{1.0, 0.0, 0.0}
                        : y <= z         ? Vec3dd{0.0, 1.0, 0.0}
                                         : Vec3dd{0.0, 0.0, 1.0};
    const Vec3dd aside = cross(along, axis);
    std::optional<Vec3dd> third = off_plane(p[0], aside);
    if (!third) third = off_plane(p[0], cross(along, aside));
    if (!third) return false;
    const std::optional<Vec3dd> fourth = off_plane(p[0], cross(along, *third - p[0]));
    if (!fourth) return false;
    p.push_back(*third);
    p.push_back(*fourth);
    bounds_.lower = -HUGE_VAL;
    if (determinant(p[1] - p[0], p[2] - p[0], p[3] - p[0]) > 0.0) std::swap(p[1], p[2]);
    points_ = std::move(p);
    // Face k is without point k.
    constexpr Corners kCorners[] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
    for (const Corners& corners : kCorners) {
      Corners across{};
      for (std::size_t k = 0; k < 3; ++k) across[k] = corners[(k + 2) % 3];
      if (!add_face(corners, across)) return false;
    }
    return true;
  }

  static double determinant(const Vec3dd& a, const Vec3dd& b, const Vec3dd& c) { return dot(a, cross(b, c)).value(); }

  bool add_face(const Corners& corners, const Corners& across) {
    const Vec3dd &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
    const std::optional<Vec3dd> normal = unit(cross(b - a, c - a));
    if (!normal) return false;
    faces_.push_back({corners, across, *normal, dot(a, *normal)});
    nearest_.emplace(-faces_.back().distance, faces_.size() - 1);
    return true;
  }

  struct HorizonEdge {
    std::size_t from, to, beyond;
  };

  // Puts the point in the place of the faces that see it, or have it in their planes.
  bool add(const Vec3dd& p, std::size_t seeing) {
    std::vector<HorizonEdge> horizon;
    std::vector<std::size_t> open = {seeing};
    faces_[seeing].is_there = false;
    std::vector<std::size_t> seen;
    while (!open.empty()) {
      const std::size_t index = open.back();
      open.pop_back();
      seen.push_back(index);
      for (const std::size_t next : faces_[index].across) {
        Face& face = faces_[next];
        if (!face.is_there || (dot(p, face.normal) - face.distance).value() < -kSeen) continue;
        face.is_there = false;
        open.push_back(next);
      }
    }
    for (const std::size_t index : seen) {
      const Face& face = faces_[index];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!faces_[face.across[k]].is_there) continue;
        horizon.push_back({face.corners[k], face.corners[(k + 1) % 3], face.across[k]});
      }
    }
    points_.push_back(p);
    const std::size_t apex = points_.size() - 1, first = faces_.size();
    std::map<std::size_t, std::size_t> starting, ending;  // new faces by the corners of their horizon edges
    for (std::size_t k = 0; k < horizon.size(); ++k) {
      if (!starting.emplace(horizon[k].from, first + k).second) return false;
      if (!ending.emplace(horizon[k].to, first + k).second) return false;
    }
    for (const HorizonEdge& edge : horizon) {
      const auto after = starting.find(edge.to), before = ending.find(edge.from);
      if (after == starting.end() || before == ending.end()) return false;
      const std::size_t index = faces_.size();
      if (!add_face({edge.from, edge.to, apex}, {edge.beyond, after->second, before->second})) return false;
      Face& beyond = faces_[edge.beyond];
      for (std::size_t k = 0; k < 3; ++k) {
        if (beyond.corners[k] == edge.to && beyond.corners[(k + 1) % 3] == edge.from) beyond.across[k] = index;
      }
    }
    return true;
  }

  const DifferenceBody& difference_;
  Bounds bounds_;
  std::vector<Vec3dd> points_;
  std::vector<Face> faces_;
  std::priority_queue<std::pair<DoubleDouble, std::size_t>> nearest_;  // minus the distance, and the face
};

}  // namespace

Bounds depth_of_cores(const DifferenceBody& difference) { return DifferenceHull(difference).depth(); }

}  // namespace vex::exact
