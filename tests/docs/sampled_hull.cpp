#include "tests/docs/sampled_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "engine/numeric/elementary.h"
#include "meshes/exact_hull.h"
#include "shapes/any_shape.h"
#include "tests/docs/outline.h"

namespace vex {
namespace {

constexpr int kAzimuths = 96, kLatitudes = 32;

// Support points around the z axis, which is the axis of every body that has one. A point that is there already, up to
// rounding, is left out: it would make slivers of triangles that point anywhere.
std::vector<Vec3d> surface_points(const ConvexBody& body) {
  std::vector<Vec3d> points;
  const double near = 1e-6 * body.circumradius();
  const auto add = [&](const Vec3d& dir) {
    const Vec3d p = body.support(dir);
    if (std::ranges::none_of(points, [&](const Vec3d& q) { return norm(p - q) < near; })) points.push_back(p);
  };
  for (int i = 1; i < kLatitudes; ++i) {
    const SinCos<double> polar = sincospi(static_cast<double>(i) / kLatitudes);
    for (int j = 0; j < kAzimuths; ++j) {
      // Between two of them lie x, y and the diagonals, at which boxes jump from corner to corner.
      const SinCos<double> azimuth = sincospi((2.0 * j + 1.0) / kAzimuths);
      add({polar.sin * azimuth.cos, polar.sin * azimuth.sin, polar.cos});
    }
  }
  add({0.0, 0.0, 1.0});
  add({0.0, 0.0, -1.0});
  return points;
}

// For each triangle the first one of those in its plane that can be reached through such.
std::vector<std::size_t> faces_of(const Triangles& triangles, const std::vector<Vec3d>& unit_normals) {
  std::vector<std::size_t> face(triangles.size(), triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (face[t] != triangles.size()) continue;
    std::vector<std::size_t> to_visit = {t};
    face[t] = t;
    while (!to_visit.empty()) {
      const std::size_t here = to_visit.back();
      to_visit.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = triangles.mates[3 * here + k] / 3;
        if (face[next] != triangles.size() || norm(unit_normals[next] - unit_normals[t]) > 1e-6) continue;
        face[next] = t;
        to_visit.push_back(next);
      }
    }
  }
  return face;
}

// The boundary of a face, from one of its half-edges on.
std::vector<Vec3d> corners_from(const Triangles& triangles, const std::vector<std::size_t>& face,
                                std::uint32_t half_edge) {
  std::vector<Vec3d> corners;
  std::uint32_t h = half_edge;
  do {
    corners.push_back(triangles.point(triangles.tail(h)));
    h = next_in_triangle(h);
    while (face[triangles.mates[h] / 3] == face[h / 3]) h = next_in_triangle(triangles.mates[h]);
  } while (h != half_edge);
  return corners;
}

}  // namespace

SampledHull sampled_hull(const ConvexBody& body) {
  std::vector<Vec3d> points = vertices_of(body);
  if (points.empty()) points = surface_points(body);
  const std::optional<Triangles> triangles = exact_hull(points);
  SampledHull hull;
  if (!triangles) return hull;

  std::vector<Vec3d> unit_normals;
  for (std::size_t t = 0; t < triangles->size(); ++t) {
    const Vec3d a = triangles->corner(t, 0);
    unit_normals.push_back(normalised(cross(triangles->corner(t, 1) - a, triangles->corner(t, 2) - a)));
  }
  const std::vector<std::size_t> face = faces_of(*triangles, unit_normals);
  std::vector<bool> is_done(triangles->size(), false);
  for (std::uint32_t h = 0; h < triangles->mates.size(); ++h) {
    const std::uint32_t mate = triangles->mates[h];
    if (face[h / 3] == face[mate / 3]) continue;
    if (!is_done[face[h / 3]]) {
      is_done[face[h / 3]] = true;
      hull.faces.push_back({corners_from(*triangles, face, h), unit_normals[face[h / 3]]});
    }
    if (h < mate) {
      hull.edges.push_back({triangles->point(triangles->tail(h)), triangles->point(triangles->head(h)),
                            unit_normals[face[h / 3]], unit_normals[face[mate / 3]]});
    }
  }
  return hull;
}

bool is_covered(const SampledHull& hull, const Vec3d& point, const Vec3d& unit_view, double size) {
  if (hull.faces.empty()) return false;
  // The part of the line of sight point + t view, t > 0, that is inside.
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (const HullFace& face : hull.faces) {
    const double above = dot(point - face.corners[0], face.unit_normal), slope = dot(unit_view, face.unit_normal);
    if (slope > 0.0) leave = std::min(leave, -above / slope);
    if (slope < 0.0) enter = std::max(enter, -above / slope);
    if (slope == 0.0 && above > 0.0) return false;
  }
  return leave - enter > 1e-3 * size;
}

}  // namespace vex
