#include "meshes/difference_mesh.h"

#include <cmath>

#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

constexpr std::size_t kMostPairs = 4096;  // of vertices
constexpr std::size_t kMostFlatTriangles = 400;

Vec3d turned(const Transformd& rotation, const Vec3d& p) {
  return {dot(rotation.row_x, p), dot(rotation.row_y, p), dot(rotation.row_z, p)};
}

// Points of the boundary of A - R B, of B's centre seen from A's.
class SurfacePoints {
 public:
  SurfacePoints(const ConvexBody& a, const ConvexBody& b, const Transformd& rotation)
      : a_(a), b_(b), rotation_(rotation) {}

  void add_differences(const std::vector<Vec3d>& of_a, const std::vector<Vec3d>& of_b) {
    for (const Vec3d& p : of_a) {
      for (const Vec3d& q : of_b) points_.push_back(p - a_.centre() - turned(q - b_.centre()));
    }
  }

  /// Where both bodies' surfaces face along the direction, which is of A's frame.
  void add_support(const Vec3d& dir) { points_.push_back(of_a(dir) - of_b(dir)); }

  /// A flat face of one body faces along one direction: the other's point there goes around it.
  void add_flat_faces(const BodyMesh& mesh, bool is_of_a) {
    if (mesh.indices.size() > 3 * kMostFlatTriangles) return;  // small ones, which the directions tell well enough
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
      const std::uint32_t* const corners = &mesh.indices[k];
      const Vec3d &p = mesh.points[corners[0]], &q = mesh.points[corners[1]], &r = mesh.points[corners[2]];
      const Vec3d area = cross(q - p, r - p);
      const double size = norm(area);
      if (!(size > 0.0)) continue;
      const Vec3d normal = (1.0 / size) * area;
      bool is_flat = true;
      for (std::size_t c = 0; c < 3; ++c) is_flat = is_flat && dot(mesh.normals[corners[c]], normal) > kSameNormal;
      if (!is_flat) continue;
      for (const double side : {1.0, -1.0}) {
        if (side < 0.0 && !mesh.is_flat) continue;
        for (const Vec3d& corner : {p, q, r}) {
          points_.push_back(is_of_a ? corner - of_b(side * normal) : of_a(-side * turned(normal)) - turned(corner));
        }
      }
    }
  }

  /// On a grid that is finer than any picture, so that points which are one but for rounding become one.
  void round() {
    const double grain = 0x1p-22 * (a_.circumradius() + b_.circumradius());
    const auto rounded = [grain](double x) { return grain * std::round(x / grain); };
    for (Vec3d& p : points_) p = {rounded(p.x), rounded(p.y), rounded(p.z)};
  }

  const std::vector<Vec3d>& points() const { return points_; }

 private:
  static constexpr double kSameNormal = 1.0 - 1e-9;

  Vec3d turned(const Vec3d& p) const { return vex::turned(rotation_, p); }
  Vec3d of_a(const Vec3d& dir) const { return a_.support(dir) - a_.centre(); }
  Vec3d of_b(const Vec3d& dir) const { return turned(b_.support(rotation_.direction_to_b(-dir)) - b_.centre()); }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const Transformd& rotation_;
  std::vector<Vec3d> points_;
};

}  // namespace

DifferenceMesh difference_mesh(const ConvexBody& a, const BodyMesh& mesh_a, const ConvexBody& b, const BodyMesh& mesh_b,
                               const Transformd& rotation, int n_around) {
  const std::vector<Vec3d> of_a = vertices_of(a), of_b = vertices_of(b);
  const bool are_polytopes = !of_a.empty() && !of_b.empty();
  DifferenceMesh found;
  found.is_exact = are_polytopes && of_a.size() * of_b.size() <= kMostPairs;
  SurfacePoints surface(a, b, rotation);
  if (found.is_exact) {
    surface.add_differences(of_a, of_b);
  } else {
    for (const Vec3d& dir : directions_around(n_around)) {
      surface.add_support(dir);
      surface.add_support(turned(rotation, dir));
    }
    surface.add_flat_faces(mesh_a, true);
    surface.add_flat_faces(mesh_b, false);
    surface.round();
  }
  try {
    found.surface = mesh_of_points(surface.points(), are_polytopes ? kFlatRad : kCreaseRad);
  } catch (const InputError&) {
    found.surface = {};  // flat, as of two plates in parallel planes
  }
  return found;
}

}  // namespace vex
