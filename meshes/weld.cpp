#include "meshes/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

Vec3d promoted(const SoupPoint& p) { return {double{p.x} + 0.0, double{p.y} + 0.0, double{p.z} + 0.0}; }  // -0 + 0 = +0

void check_soup(const PolygonSoup& soup) {
  constexpr std::size_t kMost = std::size_t{1} << 30U;  // the half-edges of fans, three for a corner, have 32-bit names
  if (soup.points.size() > kMost || soup.corners.size() > kMost) {
    throw InputError("the mesh is too large (more than 2^30 vertices or corners of faces) - simplify it");
  }
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const SoupPoint& p = soup.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError("a coordinate is not finite as a 32-bit float (vertex " + std::to_string(i) + " of " +
                       std::to_string(soup.points.size()) + ", counted from 0: " + point_text(promoted(p)) +
                       ") - mend the file or scale the mesh down");
    }
  }
  std::size_t n_corners = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    n_corners += size;
  }
  if (n_corners != soup.corners.size()) {
    throw InputError("the faces have " + std::to_string(n_corners) + " corners and " +
                     std::to_string(soup.corners.size()) + " are given - the mesh is damaged");
  }
  for (const std::uint32_t corner : soup.corners) {
    if (corner >= soup.points.size()) {
      throw InputError("a face names a vertex that is not there (vertex " + std::to_string(corner) + " of " +
                       std::to_string(soup.points.size()) + ") - the mesh is damaged");
    }
  }
}

/// A point as two integers that sort as its coordinates do, x first.
struct SortKey {
  std::uint64_t xy = 0;
  std::uint32_t z = 0;
  std::uint32_t point = 0;

  bool same_place(const SortKey& other) const { return xy == other.xy && z == other.z; }
  friend bool operator<(const SortKey& a, const SortKey& b) { return a.xy != b.xy ? a.xy < b.xy : a.z < b.z; }
};

/// Monotone from finite floats, with -0 and +0 alike, to integers: negative ones in reverse, below the positive ones.
std::uint32_t ordered_bits(float value) {
  constexpr std::uint32_t kSign = 0x80000000U;
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);
  return (bits & kSign) != 0U ? ~bits : bits | kSign;
}

/// For each point its vertex, and the vertices in lexicographic order.
struct Vertices {
  std::vector<Vec3d> vertices;
  std::vector<std::uint32_t> of_point;  // kUnused where no face uses the point
  std::size_t n_used_points = 0;
};

Vertices welded_vertices(const PolygonSoup& soup, UnusedPoints unused) {
  Vertices result;
  result.of_point.assign(soup.points.size(), unused == UnusedPoints::kept ? 0 : kUnused);
  for (const std::uint32_t corner : soup.corners) {
    result.of_point[corner] = 0;
  }
  std::vector<SortKey> keys;
  keys.reserve(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const SoupPoint& p = soup.points[i];
    if (result.of_point[i] != kUnused) {
      keys.push_back({std::uint64_t{ordered_bits(p.x)} << 32U | ordered_bits(p.y), ordered_bits(p.z),
                      static_cast<std::uint32_t>(i)});
    }
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || !keys[i].same_place(keys[i - 1])) {
      result.vertices.push_back(promoted(soup.points[keys[i].point]));
    }
    result.of_point[keys[i].point] = static_cast<std::uint32_t>(result.vertices.size() - 1);
  }
  result.n_used_points = keys.size();
  return result;
}

/// Drops the vertices that no corner names and renumbers the rest; their order stays.
void drop_unused(PolygonSurface* surface) {
  std::vector<std::uint32_t> renumbered(surface->vertices.size(), kUnused);
  for (const std::uint32_t corner : surface->corners) {
    renumbered[corner] = 0;
  }
  std::uint32_t n_used = 0;
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] != kUnused) {
      surface->vertices[n_used] = surface->vertices[i];
      renumbered[i] = n_used++;
    }
  }
  surface->vertices.resize(n_used);
  for (std::uint32_t& corner : surface->corners) {
    corner = renumbered[corner];
  }
}

}  // namespace

WeldedSurface weld(const PolygonSoup& soup, UnusedPoints unused) {
  check_soup(soup);
  WeldedSurface result;
  Vertices vertices = welded_vertices(soup, unused);
  PolygonSurface& surface = result.surface;
  surface.vertices = std::move(vertices.vertices);
  surface.corners.reserve(soup.corners.size());
  surface.face_begin.reserve(soup.face_sizes.size() + 1);
  std::size_t next = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    const std::size_t begin = surface.corners.size();
    for (const std::size_t end = next + size; next < end; ++next) {
      const std::uint32_t vertex = vertices.of_point[soup.corners[next]];
      if (surface.corners.size() == begin || surface.corners.back() != vertex) {
        surface.corners.push_back(vertex);
      }
    }
    while (surface.corners.size() > begin + 1 && surface.corners.back() == surface.corners[begin]) {
      surface.corners.pop_back();
    }
    if (surface.corners.size() < begin + 3) {
      surface.corners.resize(begin);
      ++result.n_collapsed_faces;
    } else {
      surface.face_begin.push_back(static_cast<std::uint32_t>(surface.corners.size()));
    }
  }
  result.n_welded_vertices = vertices.n_used_points - surface.vertices.size();
  if (result.n_collapsed_faces > 0 && unused == UnusedPoints::dropped) {
    drop_unused(&surface);
  }
  surface.put_in_order();
  return result;
}

}  // namespace vex
