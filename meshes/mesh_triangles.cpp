#include "meshes/mesh_triangles.h"

#include <string>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// How far a corner may be turned inwards, as `--convex-tolerance` has it: the rounding of such files.
constexpr double kReflexTolerance_rad = 1e-6;

// Whether a turns into b to the left, seen against the normal, or to the right by no more than that.
bool turns_left(const Vec3d& a, const Vec3d& b, const Vec3d& unit_normal) {
  return dot(cross(a, b), unit_normal) >= -kReflexTolerance_rad * (norm(a) * norm(b));
}

bool is_convex(const std::vector<Vec3d>& polygon) {
  Vec3d dir_normal;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    dir_normal = dir_normal + cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  const double length = norm(dir_normal);
  if (!(length > 0.0)) return false;
  const Vec3d unit_normal = (1.0 / length) * dir_normal;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3d here = polygon[(k + 1) % n] - polygon[k], next = polygon[(k + 2) % n] - polygon[(k + 1) % n];
    if (!turns_left(here, next, unit_normal)) return false;
    // Sides that go around twice turn left everywhere; their fan does not, or opens by more than half a turn.
    if (k < 2) continue;
    const Vec3d first = polygon[1] - polygon[0], last = polygon[k] - polygon[0];
    if (!turns_left(polygon[k - 1] - polygon[0], last, unit_normal) || !turns_left(first, last, unit_normal)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::array<Vec3d, 3>> triangles_of(const PolygonSoup& soup) {
  for (const Vec3d& point : soup.points) {
    if (!is_finite(point)) throw InputError("a mesh has a coordinate that is not finite - give finite ones");
  }
  std::vector<std::array<Vec3d, 3>> triangles;
  std::vector<Vec3d> polygon;
  std::size_t first = 0;
  for (std::size_t face = 0; face < soup.face_sizes.size(); ++face) {
    polygon.clear();
    for (std::size_t k = 0; k < soup.face_sizes[face]; ++k) polygon.push_back(soup.points[soup.corners[first + k]]);
    first += soup.face_sizes[face];
    if (polygon.size() > 3 && !is_convex(polygon)) {
      throw InputError("face " + std::to_string(face) + " of a mesh, of " + std::to_string(polygon.size()) +
                       " corners, is no convex polygon - cut it into triangles");
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  }
  if (triangles.empty()) throw InputError("a mesh has no face - give one that has, or the hull of its points");
  return triangles;
}

std::vector<std::array<Vec3d, 3>> read_triangles(const std::filesystem::path& path, const ReadOptions& options) {
  return triangles_of(read_polygon_soup(path, options));
}

}  // namespace vex
