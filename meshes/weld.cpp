#include "meshes/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/hash_key.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

Vec3d without_minus_zero(const Vec3d& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0 + 0 = +0

[[noreturn]] void refuse_point(const PolygonSoup& soup, std::size_t i, const std::string& what,
                               const std::string& advice) {
  throw InputError("a coordinate is " + what + " (vertex " + std::to_string(i) + " of " +
                   std::to_string(soup.points.size()) + ", counted from 0: " + point_text(soup.points[i]) + ") - " +
                   advice);
}

void check_points(const PolygonSoup& soup) {
  const auto too_small = [](double x) { return x != 0.0 && std::fabs(x) < kLeastFileCoordinate; };
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Vec3d& p = soup.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      refuse_point(soup, i, "not finite", "mend the file");
    }
    if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) >= kLargestFileCoordinate) {
      refuse_point(soup, i, "too large", "scale the mesh down below 3.4e38");
    }
    if (too_small(p.x) || too_small(p.y) || too_small(p.z)) {
      refuse_point(soup, i, "too small", "write 0 for what is below 1.4e-45, or scale the mesh up");
    }
  }
}

void check_soup(const PolygonSoup& soup) {
  constexpr std::size_t kMost = std::size_t{1} << 30U;  // the half-edges of fans, three for a corner, have 32-bit names
  if (soup.points.size() > kMost || soup.corners.size() > kMost) {
    throw InputError("the mesh is too large (more than 2^30 vertices or corners of faces) - simplify it");
  }
  check_points(soup);
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

std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ bits >> 32U) * 0xd6e8feb86659fd93U;
  return bits ^ bits >> 32U;
}

std::uint64_t hash_of(const Vec3d& p, std::uint64_t key) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  return mixed(bits(p.x) + key * mixed(bits(p.y) + key * mixed(bits(p.z) + key)));
}

/// For each point its vertex, and the vertices in lexicographic order.
struct Vertices {
  std::vector<Vec3d> vertices;
  std::vector<std::uint32_t> of_point;  // kUnused where no face uses the point
  std::size_t n_used_points = 0;
};

/// Puts the vertices, which are all different, in order.
void sort_vertices(Vertices* found) {
  struct Placed {
    Vec3d at;
    std::uint32_t old = 0;
  };
  std::vector<Placed> placed;
  placed.reserve(found->vertices.size());
  for (const Vec3d& v : found->vertices) {
    placed.push_back({v, static_cast<std::uint32_t>(placed.size())});
  }
  std::size_t n_compared = 0;
  std::sort(placed.begin(), placed.end(), [&n_compared](const Placed& a, const Placed& b) {
    if (++n_compared % (1 << 16) == 0) end_if_interrupted();
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y != b.at.y ? a.at.y < b.at.y : a.at.z < b.at.z;
  });
  std::vector<std::uint32_t> renumbered(placed.size());
  for (std::uint32_t v = 0; v < placed.size(); ++v) {
    found->vertices[v] = placed[v].at;
    renumbered[placed[v].old] = v;
  }
  for (std::uint32_t& vertex : found->of_point) {
    vertex = vertex == kUnused ? kUnused : renumbered[vertex];
  }
}

/// Equal points are found by a hash table: an STL file names each place six times, and sorting all of them would take
/// longer than everything else here.
Vertices welded_vertices(const PolygonSoup& soup, UnusedPoints unused) {
  Vertices result;
  result.of_point.assign(soup.points.size(), unused == UnusedPoints::kept ? 0 : kUnused);
  for (const std::uint32_t corner : soup.corners) {
    result.of_point[corner] = 0;
  }
  result.n_used_points = soup.points.size() -
                         static_cast<std::size_t>(std::count(result.of_point.begin(), result.of_point.end(), kUnused));
  const std::size_t mask = std::bit_ceil(2 * result.n_used_points + 1) - 1;
  std::vector<std::uint32_t> table(mask + 1, kUnused);
  const std::uint64_t key = hash_key();
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (i % 4096 == 0) end_if_interrupted();
    if (result.of_point[i] == kUnused) {
      continue;
    }
    const Vec3d p = without_minus_zero(soup.points[i]);
    std::size_t slot = static_cast<std::size_t>(hash_of(p, key)) & mask;
    const auto is_other = [&](std::uint32_t vertex) {
      const Vec3d& v = result.vertices[vertex];
      return v.x != p.x || v.y != p.y || v.z != p.z;
    };
    while (table[slot] != kUnused && is_other(table[slot])) {
      slot = (slot + 1) & mask;
    }
    if (table[slot] == kUnused) {
      table[slot] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back(p);
    }
    result.of_point[i] = table[slot];
  }
  table = {};
  sort_vertices(&result);
  return result;
}

/// Leaves out of each face what repeats the corner before it, and faces of fewer than three corners then; returns the
/// number of these.
std::size_t drop_repeated_corners(PolygonSurface* surface) {
  std::vector<std::uint32_t>& corners = surface->corners;
  std::uint32_t n_corners = 0;
  std::size_t n_faces = 0;
  std::uint32_t next = 0;
  for (std::size_t f = 0; f < surface->n_faces(); ++f) {
    const std::uint32_t begin = n_corners;
    const std::uint32_t end = surface->face_begin[f + 1];  // not written yet: faces move down only
    for (; next < end; ++next) {
      if (n_corners == begin || corners[n_corners - 1] != corners[next]) {
        corners[n_corners++] = corners[next];
      }
    }
    while (n_corners > begin + 1 && corners[n_corners - 1] == corners[begin]) {
      --n_corners;
    }
    if (n_corners < begin + 3) {
      n_corners = begin;
    } else {
      surface->face_begin[++n_faces] = n_corners;
    }
  }
  const std::size_t n_collapsed = surface->n_faces() - n_faces;
  corners.resize(n_corners);
  surface->face_begin.resize(n_faces + 1);
  return n_collapsed;
}

/// Drops the vertices that are not to be kept and renumbers the rest; their order stays.
void keep_vertices(const std::vector<bool>& is_kept, PolygonSurface* surface) {
  std::vector<std::uint32_t> renumbered(surface->vertices.size(), kUnused);
  std::uint32_t n_kept = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (is_kept[v]) {
      surface->vertices[n_kept] = surface->vertices[v];
      renumbered[v] = n_kept++;
    }
  }
  surface->vertices.resize(n_kept);
  for (std::uint32_t& corner : surface->corners) {
    corner = renumbered[corner];
  }
}

std::vector<bool> used_vertices(const PolygonSurface& surface) {
  std::vector<bool> is_used(surface.vertices.size(), false);
  for (const std::uint32_t corner : surface.corners) {
    is_used[corner] = true;
  }
  return is_used;
}

}  // namespace

WeldedSurface weld(const PolygonSoup& soup, UnusedPoints unused) {
  check_soup(soup);
  WeldedSurface result;
  PolygonSurface& surface = result.surface;
  Vertices vertices = welded_vertices(soup, unused);
  surface.vertices = std::move(vertices.vertices);
  surface.corners.reserve(soup.corners.size());
  for (const std::uint32_t corner : soup.corners) {
    surface.corners.push_back(vertices.of_point[corner]);
  }
  vertices.of_point = {};
  surface.face_begin.resize(soup.face_sizes.size() + 1);
  std::partial_sum(soup.face_sizes.begin(), soup.face_sizes.end(), surface.face_begin.begin() + 1);
  result.n_welded_vertices = vertices.n_used_points - surface.vertices.size();
  result.n_collapsed_faces = drop_repeated_corners(&surface);
  if (result.n_collapsed_faces > 0 && unused == UnusedPoints::dropped) {
    keep_vertices(used_vertices(surface), &surface);
  }
  surface.put_in_order();
  return result;
}

std::size_t join_vertices(std::span<const std::uint32_t> joined_to, UnusedPoints unused, PolygonSurface* surface) {
  for (std::uint32_t& corner : surface->corners) {
    corner = joined_to[corner];
  }
  const std::size_t n_collapsed = drop_repeated_corners(surface);
  std::vector<bool> is_kept(joined_to.size(), true);
  if (unused == UnusedPoints::dropped) {
    is_kept = used_vertices(*surface);
  } else {
    for (std::uint32_t v = 0; v < joined_to.size(); ++v) {
      is_kept[v] = joined_to[v] == v;
    }
  }
  keep_vertices(is_kept, surface);
  surface->put_in_order();
  return n_collapsed;
}

}  // namespace vex
