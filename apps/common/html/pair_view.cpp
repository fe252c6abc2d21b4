#include "apps/common/html/pair_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/pose_algebra.h"
#include "engine/numeric/quaternion.h"
#include "engine/sampling/points/sobol.h"
#include "meshes/difference_mesh.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/exact_average.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostOrientations = 32, kFewestOrientations = 8;
constexpr std::size_t kMostTriangles = 24'000;    // of all surfaces of a page
constexpr std::size_t kMostDrawnVertices = 1500;  // of a polytope that is drawn as it is
constexpr std::size_t kMostFaces = 20'000;        // of a body whose faces are summed over at each orientation
constexpr double kOneSurface = 1.0 - 1e-5;        // cosine between the normals of one point on both sides of a line
constexpr int kAround = 32;                       // directions of a curved body's ring
constexpr int kSurfaceAround = 24;

// A polytope of very many vertices is drawn by some of them.
BodyMesh drawn_mesh(const ConvexBody& body) {
  try {
    if (vertices_of(body).size() <= kMostDrawnVertices) return mesh_of(body, kAround);
    std::vector<Vec3d> points;
    for (const Vec3d& dir : directions_around(2 * kAround)) points.push_back(body.support(dir) - body.centre());
    BodyMesh mesh = mesh_of_points(points, kFlatRad);
    mesh.origin = body.centre();
    return mesh;
  } catch (const InputError&) {
    return {};  // too thin for a picture's grid, and in no plane of the frame
  }
}

bool is_summable(const Body& body) {
  return body.normals.area && body.normals.mean_curvature && body.measures.are_known() && body.n_faces <= kMostFaces;
}

// As good as what a picture says.
void find_value(const Body& a, const Body& b, OrientationView* view) {
  if (!is_summable(a) || !is_summable(b)) return;
  const auto& [w, x, y, z] = view->quaternion;
  ExactAverageSettings settings;
  settings.n_randomisations = 8;
  settings.largest_cost = 5e6;
  const ExactAverage found = exact_average(a, b, OrientationLaw::fixed(w, x, y, z), settings);
  if (!std::isfinite(found.excluded_volume) || !std::isfinite(found.error)) return;
  view->excluded_volume = found.excluded_volume;
  view->error = found.error;
}

double reach(const BodyMesh& mesh) {
  double farthest = 0.0;
  for (const Vec3d& p : mesh.points) farthest = std::max(farthest, norm(p));
  return farthest;
}

// Indices as what is left to the largest one so far, plus one: 0 is the next point, and gzip finds many alike.
Json indices_json(const std::vector<std::uint32_t>& indices) {
  Json list = Json::array();
  std::uint32_t next = 0;
  for (const std::uint32_t index : indices) {
    list.push_back(static_cast<std::int64_t>(next) - static_cast<std::int64_t>(index));
    next = std::max(next, index + 1);
  }
  return list;
}

// Whole numbers of steps, each less that of the vector before it.
Json vectors_json(const std::vector<Vec3d>& vectors, double steps) {
  Json list = Json::array();
  std::array<std::int64_t, 3> previous{};
  for (const Vec3d& v : vectors) {
    const std::array<std::int64_t, 3> here = {std::llround(steps * v.x), std::llround(steps * v.y),
                                              std::llround(steps * v.z)};
    for (std::size_t k = 0; k < 3; ++k) list.push_back(here[k] - previous[k]);
    previous = here;
  }
  return list;
}

bool has_flat_faces(const BodyMesh& mesh) {
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Vec3d& n = mesh.normals[mesh.indices[t]];
    for (std::size_t c = 1; c < 3; ++c) {
      if (!(dot(mesh.normals[mesh.indices[t + c]], n) > kOneSurface)) return false;
    }
  }
  return true;
}

// In units of the whole view, whatever the unit of length; points to 1/4095 of the mesh's size, which is less than a
// pixel. Of flat faces the script finds the normals itself, and a point is told once.
Json mesh_json(const BodyMesh& mesh, double whole) {
  constexpr double kSteps = 4095.0, kNormalSteps = 127.0;
  const double size = reach(mesh);
  std::vector<std::uint32_t> triangles, ends, number_of(mesh.points.size());
  (mesh.is_line ? ends : triangles) = mesh.indices;
  if (!mesh.is_line) {
    for (const SharpEdge& edge : sharp_edges(mesh)) ends.insert(ends.end(), edge.ends.begin(), edge.ends.end());
  }
  const bool is_flat = !mesh.is_line && has_flat_faces(mesh);
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  std::vector<Vec3d> points;
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    const Vec3d& p = mesh.points[k];
    number_of[k] = static_cast<std::uint32_t>(points.size());
    if (is_flat) number_of[k] = known.emplace(std::tuple(p.x, p.y, p.z), number_of[k]).first->second;
    if (number_of[k] == points.size()) points.push_back(p);
  }
  for (std::vector<std::uint32_t>* const list : {&triangles, &ends}) {
    for (std::uint32_t& index : *list) index = number_of[index];
  }
  return {{"unit", size / whole / kSteps},
          {"points", vectors_json(points, size > 0.0 ? kSteps / size : 0.0)},
          {"normals", is_flat ? Json::array() : vectors_json(mesh.normals, kNormalSteps)},
          {"triangles", indices_json(triangles)},
          {"edges", indices_json(ends)}};
}

}  // namespace

PairView pair_view(const Body& a, const std::string& name_a, const Body& b, const std::string& name_b,
                   const OrientationLaw& law, std::uint64_t seed) {
  PairView view{name_a, name_b, drawn_mesh(a.body), drawn_mesh(b.body), 0.0, {}};
  const int dimension = law.dimension();
  std::size_t n = dimension == 0 ? 1 : kMostOrientations;
  const SobolPoints points(std::max(1, dimension));
  const SobolPoints::Scrambling keys = points.scrambling(seed, 0);
  std::vector<double> point(static_cast<std::size_t>(points.dimension()));
  for (std::size_t k = 0; k < n; ++k) {
    points.scrambled(keys, k, point);
    OrientationView one;
    one.quaternion = quaternion_of(law.rotation(std::span<const double>(point)));
    const auto& [w, x, y, z] = one.quaternion;
    one.rotation = rotation_from_quaternion(w, x, y, z);
    DifferenceMesh difference = difference_mesh(a.body, view.a, b.body, view.b, one.rotation, kSurfaceAround);
    one.surface = std::move(difference.surface);
    one.is_exact = difference.is_exact;
    find_value(a, b, &one);
    if (k == 0 && n > 1) {
      n = std::clamp(3 * kMostTriangles / std::max<std::size_t>(1, one.surface.indices.size()), kFewestOrientations,
                     kMostOrientations);
    }
    view.size = std::max(view.size, reach(one.surface));
    view.orientations.push_back(std::move(one));
  }
  std::ranges::stable_sort(view.orientations, {},
                           [](const OrientationView& one) { return one.excluded_volume.value_or(0.0); });
  view.size = std::max(view.size, reach(view.a)) + reach(view.b);
  return view;
}

std::vector<SharpEdge> sharp_edges(const BodyMesh& mesh) {
  using Place = std::tuple<double, double, double>;
  const auto place_of = [&mesh](std::uint32_t k) {
    return Place{mesh.points[k].x, mesh.points[k].y, mesh.points[k].z};
  };
  const double least_height = 1e-5 * reach(mesh);
  // A line between the same places is met twice, from its two triangles.
  std::map<std::pair<Place, Place>, SharpEdge> open;
  std::vector<SharpEdge> edges;
  for (std::uint32_t t = 0; 3 * t + 2 < mesh.indices.size(); ++t) {
    const std::uint32_t* const c = &mesh.indices[3 * t];
    const Vec3d &p = mesh.points[c[0]], &q = mesh.points[c[1]], &r = mesh.points[c[2]];
    const double longest = std::max({norm(q - p), norm(r - q), norm(p - r)});
    const bool is_sliver = !(norm(cross(q - p, r - p)) > least_height * longest);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = c[k], to = c[(k + 1) % 3];
      const auto found = open.find({place_of(to), place_of(from)});
      if (found == open.end()) {
        if (!is_sliver) open[{place_of(from), place_of(to)}] = {{from, to}, {t, t}};
        continue;
      }
      const SharpEdge other = found->second;
      open.erase(found);
      const bool is_smooth = dot(mesh.normals[from], mesh.normals[other.ends[1]]) > kOneSurface &&
                             dot(mesh.normals[to], mesh.normals[other.ends[0]]) > kOneSurface;
      if (!is_smooth && !is_sliver) edges.push_back({{from, to}, {t, other.triangles[0]}});
    }
  }
  // The rim of what is flat.
  if (mesh.is_flat) {
    for (const auto& [places, edge] : open) edges.push_back(edge);
  }
  return edges;
}

std::string viewer_document(const PairView& view) {
  Json list = Json::array();
  for (const OrientationView& one : view.orientations) {
    const Transformd& r = one.rotation;
    Json json = {{"quaternion", one.quaternion},
                 {"rotation",
                  {r.row_x.x, r.row_x.y, r.row_x.z, r.row_y.x, r.row_y.y, r.row_y.z, r.row_z.x, r.row_z.y, r.row_z.z}},
                 {"surface", one.surface.points.empty() ? Json(nullptr) : mesh_json(one.surface, view.size)},
                 {"value", nullptr}};
    if (one.excluded_volume) {
      json["value"] = one.error > 1e-11 * *one.excluded_volume ? with_error(*one.excluded_volume, one.error)
                                                               : short_number(*one.excluded_volume, 10);
    }
    list.push_back(std::move(json));
  }
  return Json{{"a", mesh_json(view.a, view.size)}, {"b", mesh_json(view.b, view.size)}, {"orientations", list}}.dump();
}

}  // namespace vex
