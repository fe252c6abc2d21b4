#include "soups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "meshes/nearest_float.h"

namespace vex::tests {
namespace {

constexpr double kGoldenRatio = std::numbers::phi;

Vec3d rounded(const Vec3d& p) { return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)}; }

template <class Visit>  // visit(the face's corners)
void for_each_face(const PolygonSoup& soup, const Visit& visit) {
  std::size_t begin = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    visit(Face(soup.corners.begin() + static_cast<std::ptrdiff_t>(begin),
               soup.corners.begin() + static_cast<std::ptrdiff_t>(begin + size)));
    begin += size;
  }
}

void add(const Face& face, PolygonSoup* soup) {
  soup->corners.insert(soup->corners.end(), face.begin(), face.end());
  soup->face_sizes.push_back(static_cast<std::uint32_t>(face.size()));
}

std::vector<Vec3d> icosahedron_points() {
  std::vector<Vec3d> points;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-kGoldenRatio, kGoldenRatio}) {
      points.push_back({0.0, s, t});
      points.push_back({s, t, 0.0});
      points.push_back({t, 0.0, s});
    }
  }
  return points;
}

bool close(double a, double b) { return std::fabs(a - b) < 1e-3; }

/// Faces of a polyhedron with the given edge length whose vertices are all alike: all cycles of `n_corners` vertices at
/// that distance in the plane that three of them span, one per plane, turned outward.
std::vector<Face> faces_by_edge(const std::vector<Vec3d>& p, double edge, std::size_t n_corners) {
  std::vector<Face> faces;
  std::map<std::vector<std::uint32_t>, bool> seen;
  const auto n = static_cast<std::uint32_t>(p.size());
  const auto adjacent = [&](std::uint32_t a, std::uint32_t b) { return close(norm(p[a] - p[b]), edge); };
  for (std::uint32_t a = 0; a < n; ++a) {
    for (std::uint32_t b = 0; b < n; ++b) {
      for (std::uint32_t c = 0; c < n; ++c) {
        if (a == c || !adjacent(a, b) || !adjacent(b, c)) {
          continue;
        }
        const Vec3d normal = cross(p[b] - p[a], p[c] - p[b]);
        if (dot(normal, p[a]) <= 1e-9) {
          continue;
        }
        Face face{a, b, c};
        while (face.size() < n_corners) {
          bool found = false;
          for (std::uint32_t d = 0; d < n && !found; ++d) {
            if (std::find(face.begin(), face.end(), d) == face.end() && adjacent(face.back(), d) &&
                close(dot(normal, p[d] - p[a]), 0.0)) {
              face.push_back(d);
              found = true;
            }
          }
          if (!found) {
            break;
          }
        }
        std::vector<std::uint32_t> key = face;
        std::sort(key.begin(), key.end());
        if (face.size() == n_corners && adjacent(face.back(), a) && !seen[key]) {
          seen[key] = true;
          faces.push_back(face);
        }
      }
    }
  }
  return faces;
}

}  // namespace

PolygonSoup soup_of(const std::vector<Vec3d>& points, const std::vector<Face>& faces) {
  PolygonSoup soup;
  for (const Vec3d& p : points) {
    soup.points.push_back(rounded(p));
  }
  for (const Face& face : faces) {
    add(face, &soup);
  }
  soup.n_parts = 1;
  return soup;
}

PolygonSoup box_soup(const Vec3d& low, const Vec3d& high) {
  std::vector<Vec3d> points;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) {
      for (const double z : {low.z, high.z}) {
        points.push_back({x, y, z});
      }
    }
  }
  return soup_of(points, {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

PolygonSoup tetrahedron_soup() {
  return soup_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

PolygonSoup octahedron_soup() {
  const std::vector<Vec3d> p{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  return soup_of(p, faces_by_edge(p, std::sqrt(2.0), 3));
}

PolygonSoup dodecahedron_soup() {
  std::vector<Vec3d> p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      p.push_back({s, t, -1.0});
      p.push_back({s, t, 1.0});
      p.push_back({0.0, s / kGoldenRatio, t * kGoldenRatio});
      p.push_back({s / kGoldenRatio, t * kGoldenRatio, 0.0});
      p.push_back({s * kGoldenRatio, 0.0, t / kGoldenRatio});
    }
  }
  return soup_of(p, faces_by_edge(p, 2.0 / kGoldenRatio, 5));
}

PolygonSoup icosahedron_soup() {
  const std::vector<Vec3d> p = icosahedron_points();
  return soup_of(p, faces_by_edge(p, 2.0, 3));
}

PolygonSoup great_dodecahedron_soup() {
  const std::vector<Vec3d> p = icosahedron_points();
  return soup_of(p, faces_by_edge(p, 2.0, 5));
}

PolygonSoup great_icosahedron_soup() {
  const std::vector<Vec3d> p = icosahedron_points();
  return soup_of(p, faces_by_edge(p, 2.0 * kGoldenRatio, 3));
}

PolygonSoup sphere_soup(int n, const std::function<Vec3d(const Vec3d&)>& place) {
  const std::vector<Vec3d> p = icosahedron_points();
  PolygonSoup soup;
  soup.n_parts = 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> on_edge;
  std::vector<std::uint32_t> on_corner;
  const auto add_point = [&](const Vec3d& v) {
    soup.points.push_back(rounded(place((1.0 / norm(v)) * v)));
    return static_cast<std::uint32_t>(soup.points.size() - 1);
  };
  for (const Vec3d& v : p) {
    on_corner.push_back(add_point(v));
  }
  const auto count = static_cast<std::uint32_t>(n);
  const double step = 1.0 / n;
  // The k-th of n steps from a to b, shared by the two faces at the edge.
  const auto edge_point = [&](std::uint32_t a, std::uint32_t b, std::uint32_t k) {
    if (a > b) {
      std::swap(a, b);
      k = count - k;
    }
    if (k == 0 || k == count) {
      return on_corner[k == 0 ? a : b];
    }
    std::vector<std::uint32_t>& points = on_edge[{a, b}];
    if (points.empty()) {
      for (std::uint32_t i = 1; i < count; ++i) {
        points.push_back(add_point((1.0 - i * step) * p[a] + (i * step) * p[b]));
      }
    }
    return points[k - 1];
  };
  for (const Face& face : faces_by_edge(p, 2.0, 3)) {
    std::vector<std::vector<std::uint32_t>> rows;  // row i: i steps from corner 0 towards the far side, i + 1 points
    for (std::uint32_t i = 0; i <= count; ++i) {
      std::vector<std::uint32_t> row;
      for (std::uint32_t j = 0; j <= i; ++j) {
        if (j == 0) {
          row.push_back(edge_point(face[0], face[1], i));
        } else if (j == i) {
          row.push_back(edge_point(face[0], face[2], i));
        } else if (i == count) {
          row.push_back(edge_point(face[1], face[2], j));
        } else {
          row.push_back(
              add_point((1.0 - i * step) * p[face[0]] + (((i - j) * step) * p[face[1]] + (j * step) * p[face[2]])));
        }
      }
      rows.push_back(row);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t j = 0; j <= i; ++j) {
        soup.add_face({rows[i][j], rows[i + 1][j], rows[i + 1][j + 1]});
        if (j < i) {
          soup.add_face({rows[i][j], rows[i + 1][j + 1], rows[i][j + 1]});
        }
      }
    }
  }
  return soup;
}

PolygonSoup revolution_soup(int n, const std::vector<std::array<double, 2>>& rings, double z_low, double z_high) {
  PolygonSoup soup;
  soup.n_parts = 1;
  const auto count = static_cast<std::uint32_t>(n);
  for (const auto& [radius, z] : rings) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      soup.points.push_back(rounded({radius * std::cos(angle), radius * std::sin(angle), z}));
    }
  }
  const auto low = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back(rounded({0.0, 0.0, z_low}));
  soup.points.push_back(rounded({0.0, 0.0, z_high}));
  const auto n_rings = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = (i + 1) % count;
    soup.add_face({low, j, i});
    soup.add_face({low + 1, (n_rings - 1) * count + i, (n_rings - 1) * count + j});
    for (std::uint32_t r = 0; r + 1 < n_rings; ++r) {
      soup.add_face({r * count + i, r * count + j, (r + 1) * count + j});
      soup.add_face({r * count + i, (r + 1) * count + j, (r + 1) * count + i});
    }
  }
  return soup;
}

PolygonSoup capsule_soup(int n, int n_rings) {
  std::vector<std::array<double, 2>> rings;
  const int n_cap = std::max(1, n / 4);
  for (int i = 1; i < n_cap; ++i) {
    const double angle = std::numbers::pi / 2 * i / n_cap;
    rings.push_back({std::sin(angle), -1.0 - std::cos(angle)});
  }
  for (int i = 0; i < n_rings; ++i) {
    rings.push_back({1.0, -1.0 + 2.0 * i / (n_rings - 1)});
  }
  for (int i = n_cap - 1; i > 0; --i) {
    const double angle = std::numbers::pi / 2 * i / n_cap;
    rings.push_back({std::sin(angle), 1.0 + std::cos(angle)});
  }
  return revolution_soup(n, rings, -2.0, 2.0);
}

PolygonSoup torus_soup(int n) {
  std::vector<Vec3d> points;
  std::vector<Face> faces;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>((i % n) * n + j % n); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2.0 * std::numbers::pi * i / n;
      const double v = 2.0 * std::numbers::pi * j / n;
      points.push_back({(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return soup_of(points, faces);
}

PolygonSoup l_prism_soup() {
  const std::vector<std::array<double, 2>> l{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  std::vector<Vec3d> points;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : l) {
      points.push_back({x, y, z});
    }
  }
  std::vector<Face> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    faces.push_back({i, j, 6 + j, 6 + i});
  }
  return soup_of(points, faces);
}

PolygonSoup moved(PolygonSoup soup, const std::function<Vec3d(const Vec3d&)>& place) {
  for (Vec3d& p : soup.points) {
    p = rounded(place(p));
  }
  return soup;
}

PolygonSoup joined(PolygonSoup a, const PolygonSoup& b) {
  const auto shift = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const std::uint32_t corner : b.corners) {
    a.corners.push_back(corner + shift);
  }
  a.face_sizes.insert(a.face_sizes.end(), b.face_sizes.begin(), b.face_sizes.end());
  a.n_parts += b.n_parts;
  return a;
}

PolygonSoup face_turned(PolygonSoup soup, std::size_t f) {
  const auto begin = soup.corners.begin() + std::accumulate(soup.face_sizes.begin(),
                                                            soup.face_sizes.begin() + static_cast<std::ptrdiff_t>(f),
                                                            std::ptrdiff_t{0});
  std::reverse(begin, begin + soup.face_sizes[f]);
  return soup;
}

PolygonSoup corner_added(PolygonSoup soup, std::size_t f, std::size_t k, std::uint32_t vertex) {
  std::size_t at = k;
  for (std::size_t g = 0; g < f; ++g) {
    at += soup.face_sizes[g];
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i <= soup.corners.size(); ++i) {
    if (i == at) {
      corners.push_back(vertex);
    }
    if (i < soup.corners.size()) {
      corners.push_back(soup.corners[i]);
    }
  }
  soup.corners = corners;
  ++soup.face_sizes[f];
  return soup;
}

PolygonSoup turned(PolygonSoup soup) {
  std::reverse(soup.corners.begin(), soup.corners.end());
  std::reverse(soup.face_sizes.begin(), soup.face_sizes.end());
  return soup;
}

PolygonSoup face_removed(PolygonSoup soup, std::size_t f) {
  std::vector<Face> faces;
  for_each_face(soup, [&](const Face& face) { faces.push_back(face); });
  faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
  soup.corners.clear();
  soup.face_sizes.clear();
  for (const Face& face : faces) {
    add(face, &soup);
  }
  return soup;
}

PolygonSoup shuffled(const PolygonSoup& soup, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto shuffle = [&random](auto* items) {
    for (std::size_t i = items->size(); i > 1; --i) {
      std::swap((*items)[i - 1], (*items)[random() % i]);
    }
  };
  std::vector<std::uint32_t> new_of_old(soup.points.size());
  std::iota(new_of_old.begin(), new_of_old.end(), 0U);
  shuffle(&new_of_old);
  PolygonSoup result;
  result.n_parts = soup.n_parts;
  result.points.resize(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    result.points[new_of_old[i]] = soup.points[i];
  }
  std::vector<Face> faces;
  for_each_face(soup, [&](Face face) {
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % face.size()), face.end());
    for (std::uint32_t& corner : face) {
      corner = new_of_old[corner];
    }
    faces.push_back(face);
  });
  shuffle(&faces);
  for (const Face& face : faces) {
    add(face, &result);
  }
  return result;
}

}  // namespace vex::tests
