#include "apps/vex_stress/features.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

constexpr std::size_t kMostVertices = 20;
constexpr double kOnPlane = 1e-9;

}  // namespace

Features features_of(const ExactForm& form) {
  Features result;
  if (!form.is_polytope() || form.points.size() > kMostVertices) return result;
  const std::vector<Vec3d>& p = form.points;
  double size = 0.0;
  for (const Vec3d& v : p) size = std::max(size, norm_1(v));
  if (!(size > 1e-100 && size < 1e100)) return result;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < p.size(); ++j) {
      for (std::size_t k = std::max(i, j) + 1; k < p.size(); ++k) {
        const Vec3d normal = cross(p[j] - p[i], p[k] - p[i]);
        const double length = norm(normal);
        if (i == j || !(length > kOnPlane * size * size)) continue;
        const Vec3d unit = (1.0 / length) * normal;
        Features::Face face{unit, {}};
        bool is_outside = true;
        for (const Vec3d& v : p) {
          const double height = dot(unit, v - p[i]);
          is_outside = is_outside && height < kOnPlane * size;
          if (std::fabs(height) < kOnPlane * size) face.vertices.push_back(v);
        }
        const bool is_new = std::ranges::none_of(
            result.faces, [&unit](const Features::Face& f) { return dot(f.unit_normal, unit) > 1.0 - kOnPlane; });
        if (is_outside && is_new) result.faces.push_back(face);
      }
    }
  }
  if (result.faces.size() < 4) return {};
  result.vertices = p;
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    for (std::size_t g = f + 1; g < result.faces.size(); ++g) {
      std::vector<Vec3d> common;
      for (const Vec3d& v : result.faces[f].vertices) {
        for (const Vec3d& w : result.faces[g].vertices) {
          if (v.x == w.x && v.y == w.y && v.z == w.z) common.push_back(v);
        }
      }
      if (common.size() != 2) continue;
      result.edges.push_back({common[0], common[1], {result.faces[f].unit_normal, result.faces[g].unit_normal}});
    }
  }
  return result;
}

}  // namespace vex
