#include "shapes/faced_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "engine/numeric/double_double.h"
#include "engine/numeric/elementary.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/support/checked_input.h"

namespace vex {
namespace {

using Face = FacedPolytope::Face;

struct Facet {
  Vec3d unit_normal;
  double area = 0.0;
};

Vec3d of_length_one(const Vec3d& a) { return (1.0 / safe_norm(a)) * a; }

/// Triangles from the first corner, in units of the face's size so that no square of a product over- or underflows.
Facet facet_of(std::span<const Vec3d> vertices, const Face& face) {
  double size = 0.0;
  for (const std::uint32_t i : face) size = std::max(size, norm_1(vertices[i] - vertices[face[0]]));
  Vec3d twice_area;
  for (std::size_t k = 2; k < face.size(); ++k) {
    const Vec3d a = (1.0 / size) * (vertices[face[k - 1]] - vertices[face[0]]);
    const Vec3d b = (1.0 / size) * (vertices[face[k]] - vertices[face[0]]);
    twice_area = twice_area + cross(a, b);
  }
  return {of_length_one(twice_area), 0.5 * safe_norm(twice_area) * size * size};
}

struct SharedEdge {
  double length;
  std::size_t face_a, face_b;
};

std::vector<SharedEdge> edges_of(std::span<const Vec3d> vertices, const std::vector<Face>& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_of_edge;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      face_of_edge[{faces[f][k], faces[f][(k + 1) % faces[f].size()]}] = f;
    }
  }
  std::vector<SharedEdge> edges;
  for (const auto& [edge, face] : face_of_edge) {
    if (edge.first > edge.second) continue;
    const auto back = face_of_edge.find({edge.second, edge.first});
    VEX_EXPECT(back != face_of_edge.end());
    edges.push_back({safe_norm(vertices[edge.first] - vertices[edge.second]), face, back->second});
  }
  return edges;
}

double exterior_angle(const Vec3d& unit_a, const Vec3d& unit_b) {
  return std::atan2(norm(cross(unit_a, unit_b)), dot(unit_a, unit_b));
}

}  // namespace

FacedPolytope::FacedPolytope(std::span<const Vec3d> vertices, std::vector<Face> faces, const Vec3d& centre,
                             double inradius)
    : Polytope(vertices, centre, inradius), faces_(std::move(faces)) {}

Measures FacedPolytope::measures() const {
  const std::vector<Vec3d> points = vertices();
  DoubleDouble volume, area, curvature;
  std::vector<Vec3d> unit_normals;
  for (const Face& face : faces_) {
    const Facet facet = facet_of(points, face);
    unit_normals.push_back(facet.unit_normal);
    volume += facet.area * (dot(facet.unit_normal, points[face[0]] - centre()) / 3.0);
    area += facet.area;
  }
  for (const SharedEdge& edge : edges_of(points, faces_)) {
    curvature += 0.5 * edge.length * exterior_angle(unit_normals[edge.face_a], unit_normals[edge.face_b]);
  }
  return {volume.value(), area.value(), curvature.value()};
}

NormalMeasure FacedPolytope::area_measure() const {
  const std::vector<Vec3d> points = vertices();
  NormalMeasure area;
  for (const Face& face : faces_) {
    const Facet facet = facet_of(points, face);
    area.add(NormalAtom{facet.unit_normal, facet.area});
  }
  return area;
}

NormalMeasure FacedPolytope::mean_curvature_measure() const {
  const std::vector<Vec3d> points = vertices();
  NormalMeasure curvature;
  for (const SharedEdge& edge : edges_of(points, faces_)) {
    const Vec3d from = facet_of(points, faces_[edge.face_a]).unit_normal;
    const Vec3d to = facet_of(points, faces_[edge.face_b]).unit_normal;
    const double angle = exterior_angle(from, to);
    curvature.add(NormalArc{from, of_length_one(cross(cross(from, to), from)), angle, 0.5 * edge.length * angle});
  }
  return curvature;
}

std::vector<Face> faces_of_equal_edges(std::span<const Vec3d> vertices) {
  const std::size_t n = vertices.size();
  double edge = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < n; ++i) edge = std::min(edge, norm(vertices[i] - vertices[0]));
  // Of these solids the second least distance is far away, 1.4 edges: this is no matter of rounding, nor is below
  // whether a vertex is above a face.
  std::vector<Face> neighbours(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      if (i != j && norm(vertices[i] - vertices[j]) < 1.1 * edge) neighbours[i].push_back(j);
    }
  }
  // The corner after j on the face to the left of the edge from i to j.
  const auto next = [&](std::uint32_t i, std::uint32_t j) {
    for (const std::uint32_t k : neighbours[j]) {
      if (k == i) continue;
      const Vec3d dir = cross(vertices[j] - vertices[i], vertices[k] - vertices[j]);
      const double height = dot(dir, vertices[j]) + 1e-6 * norm(dir) * edge;
      if (std::ranges::all_of(vertices, [&](const Vec3d& v) { return dot(dir, v) < height; })) return k;
    }
    VEX_EXPECT(false);
    return i;
  };
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t j : neighbours[i]) {
      Face face{i, j};
      for (std::uint32_t k = next(i, j); k != i && face.size() <= n; k = next(face[face.size() - 2], face.back())) {
        face.push_back(k);
      }
      if (*std::ranges::min_element(face) == i) faces.push_back(std::move(face));  // from its first corner alone
    }
  }
  return faces;
}

double polygon_circumradius(int n_sides, double edge) { return 0.5 * edge / sincospi(1.0 / n_sides).sin; }

double polygon_inradius(int n_sides, double edge) {
  const SinCos<double> half_side = sincospi(1.0 / n_sides);
  return 0.5 * edge * (half_side.cos / half_side.sin);
}

std::vector<Vec3d> regular_polygon(int n_sides, double edge, double z, int half_sides) {
  const double radius = polygon_circumradius(n_sides, edge);
  std::vector<Vec3d> corners;
  for (int k = 0; k < n_sides; ++k) {
    const SinCos<double> at = sincospi(static_cast<double>((2 * k + 1 + half_sides) % (2 * n_sides)) / n_sides);
    corners.push_back({radius * at.cos, radius * at.sin, z});
  }
  return corners;
}

std::vector<Vec3d> two_polygons(int n_sides, double edge, double height, int half_sides, const std::string& what) {
  checked_n_sides(n_sides, what);
  checked_size(edge, ("the edge of " + what).c_str());
  checked_size(height, ("the height of " + what).c_str());
  std::vector<Vec3d> all = regular_polygon(n_sides, edge, -0.5 * height);
  const std::vector<Vec3d> upper = regular_polygon(n_sides, edge, 0.5 * height, half_sides);
  all.insert(all.end(), upper.begin(), upper.end());
  return all;
}

std::vector<Face> between_polygons(int n_sides, std::vector<Face> sides) {
  const auto n = static_cast<std::uint32_t>(n_sides);
  Face lower, upper;
  for (std::uint32_t k = 0; k < n; ++k) {
    lower.push_back(n - 1 - k);
    upper.push_back(n + k);
  }
  sides.push_back(std::move(lower));
  sides.push_back(std::move(upper));
  return sides;
}

int checked_n_sides(int n_sides, const std::string& what) {
  if (n_sides < 3 || n_sides > kMostSides) {
    throw InputError("the number of sides of " + what + " is not from 3 to " + std::to_string(kMostSides) + " (" +
                     std::to_string(n_sides) + ") - with more of them it is a cylinder or a cone to 1e-5");
  }
  return n_sides;
}

}  // namespace vex
