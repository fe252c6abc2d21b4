#include "apps/common/scene_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "apps/common/glb_file.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/numeric/pose_algebra.h"
#include "meshes/body_mesh.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;
using Quaternion = std::array<double, 4>;  // x, y, z, w

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr int kLines = 1;

// glTF's order.
Quaternion xyzw_of(const Transformd& pose) {
  const auto [w, x, y, z] = quaternion_of(pose);
  return {x, y, z, w};
}

// glTF has linear light.
Json colour_json(const std::array<double, 3>& srgb) {
  Json colour = Json::array();
  for (const double c : srgb) colour.push_back(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  colour.push_back(1.0);
  return colour;
}

// Fewer triangles a body where there are many bodies.
int n_around_of(std::size_t n_bodies) {
  return n_bodies <= 200 ? 48 : n_bodies <= 5000 ? 32 : n_bodies <= 50000 ? 20 : 12;
}

class SceneGltf {
 public:
  SceneGltf(const Scene& scene, std::span<const std::string> names, const std::vector<std::uint8_t>& colours)
      : scene_(scene), names_(names), colours_(colours) {}

  std::string text() {
    for (BodyId body = 0; body < scene_.end(); ++body) bodies_[{scene_.shape_of(body), colours_[body]}].push_back(body);
    const bool has_instances = scene_.end() > kMostNodes;
    for (const auto& [kind, bodies] : bodies_) {
      const std::size_t mesh = add_mesh(kind.first, kind.second);
      has_instances ? add_instances(kind.first, mesh, bodies) : add_nodes(kind.first, mesh, bodies);
    }
    if (scene_.box()) add_box(*scene_.box());
    if (has_instances) {
      file_.document()["extensionsRequired"].push_back(kInstancing);
      file_.document()["extensionsUsed"].push_back(kInstancing);
    }
    if (is_unlit_) file_.document()["extensionsUsed"].push_back(kUnlit);
    add_root();
    return file_.text();
  }

 private:
  // What copies of one shape share, whatever their colours.
  struct Geometry {
    Json attributes;
    std::size_t indices = 0;
    Vec3d origin;
    bool is_flat = false, is_line = false;
  };

  const Geometry& geometry_of(ShapeId shape) {
    if (const auto found = geometries_.find(shape); found != geometries_.end()) return found->second;
    const ConvexBody& body = scene_.shape(shape);
    require_fit(body.circumradius(), "a circumradius", 1e-30);
    const BodyMesh mesh = mesh_of(body, n_around_of(scene_.end()));
    Geometry geometry;
    geometry.attributes["POSITION"] = file_.add_vectors(mesh.points, true);
    if (!mesh.is_line) geometry.attributes["NORMAL"] = file_.add_vectors(mesh.normals, true);
    geometry.indices = file_.add_indices(mesh.indices, mesh.points.size());
    geometry.origin = mesh.origin;
    geometry.is_flat = mesh.is_flat;
    geometry.is_line = mesh.is_line;
    return geometries_.emplace(shape, std::move(geometry)).first->second;
  }

  std::size_t material_of(std::uint8_t colour, const Geometry& geometry) {
    const auto key = std::tuple(colour, geometry.is_flat, geometry.is_line);
    if (const auto found = materials_.find(key); found != materials_.end()) return found->second;
    Json material = {{"name", kBodyColours[colour].name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", colour_json(kBodyColours[colour].srgb)},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 0.6}}}};
    if (geometry.is_flat) material["doubleSided"] = true;
    if (geometry.is_line) set_unlit(material);
    return materials_[key] = file_.add("materials", std::move(material));
  }

  // Lines have no normals, and so no light falls on them.
  void set_unlit(Json& material) {
    material["extensions"][kUnlit] = Json::object();
    is_unlit_ = true;
  }

  std::size_t add_mesh(ShapeId shape, std::uint8_t colour) {
    const Geometry& geometry = geometry_of(shape);
    Json primitive = {{"attributes", geometry.attributes},
                      {"indices", geometry.indices},
                      {"material", material_of(colour, geometry)}};
    if (geometry.is_line) primitive["mode"] = kLines;
    return file_.add("meshes", {{"name", names_[shape]}, {"primitives", Json::array({primitive})}});
  }

  // Where the centre is, in the box.
  Vec3d place_of(BodyId body, const Vec3d& origin) const {
    const Transformd pose = scene_.pose(body);
    Vec3d place = pose(origin);
    ImageOffset ignored{};
    if (scene_.box()) place = scene_.box()->wrapped(place, &ignored);
    require_fit(norm_1(place), "a place");
    return place;
  }

  // What is nearer to 0 than a body may be small is 0 to a viewer.
  static void require_fit(double length, const char* what, double least = 0.0) {
    constexpr double kMost = 1e30;
    if (length >= least && length <= kMost) return;
    throw InputError(std::string(what) + " out of the range of glTF's 32-bit numbers (" + shortest_number(length) +
                     ") - choose another unit of length, or leave out --gltf");
  }

  void add_nodes(ShapeId shape, std::size_t mesh, const std::vector<BodyId>& bodies) {
    const Vec3d origin = geometry_of(shape).origin;
    for (const BodyId body : bodies) {
      const Vec3d place = place_of(body, origin);
      children_.push_back(file_.add("nodes", {{"name", "body " + std::to_string(body)},
                                              {"mesh", mesh},
                                              {"translation", {place.x, place.y, place.z}},
                                              {"rotation", xyzw_of(scene_.pose(body))}}));
    }
  }

  void add_instances(ShapeId shape, std::size_t mesh, const std::vector<BodyId>& bodies) {
    const Vec3d origin = geometry_of(shape).origin;
    std::vector<Vec3d> places;
    std::vector<Quaternion> rotations;
    for (const BodyId body : bodies) {
      places.push_back(place_of(body, origin));
      rotations.push_back(xyzw_of(scene_.pose(body)));
    }
    Json node = {{"name", std::to_string(bodies.size()) + " bodies"}, {"mesh", mesh}};
    node["extensions"][kInstancing]["attributes"] = {{"TRANSLATION", file_.add_vectors(places, false)},
                                                     {"ROTATION", file_.add_quaternions(rotations)}};
    children_.push_back(file_.add("nodes", std::move(node)));
  }

  void add_box(const PeriodicBox& box) {
    std::vector<Vec3d> corners;
    for (int k = 0; k < 8; ++k) {
      const Vec3d whole = box.shift({k & 1, k >> 1 & 1, k >> 2 & 1});
      corners.push_back(whole - 0.5 * box.shift({1, 1, 1}));
      require_fit(norm_1(corners.back()), "a place");
    }
    const std::vector<std::uint32_t> edges = {0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7};
    Json material = {{"name", "box"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.1, 0.1, 1.0}}}}};
    set_unlit(material);
    const Json primitive = {{"attributes", {{"POSITION", file_.add_vectors(corners, true)}}},
                            {"indices", file_.add_indices(edges, corners.size())},
                            {"material", file_.add("materials", std::move(material))},
                            {"mode", kLines}};
    const std::size_t mesh = file_.add("meshes", {{"name", "box"}, {"primitives", Json::array({primitive})}});
    children_.push_back(file_.add("nodes", {{"name", "box"}, {"mesh", mesh}}));
  }

  // Viewers have y up.
  void add_root() {
    const double half = std::sqrt(0.5);
    Json root = {{"name", "scene, z up"}, {"rotation", {-half, 0.0, 0.0, half}}};
    if (!children_.empty()) root["children"] = children_;
    const std::size_t node = file_.add("nodes", std::move(root));
    file_.add("scenes", {{"nodes", Json::array({node})}});
    file_.document()["scene"] = 0;
  }

  const Scene& scene_;
  std::span<const std::string> names_;
  const std::vector<std::uint8_t>& colours_;
  GlbFile file_;
  std::map<std::pair<ShapeId, std::uint8_t>, std::vector<BodyId>> bodies_;
  std::map<ShapeId, Geometry> geometries_;
  std::map<std::tuple<std::uint8_t, bool, bool>, std::size_t> materials_;
  std::vector<std::size_t> children_;
  bool is_unlit_ = false;
};

}  // namespace

void require_glb_name(const std::string& path, const std::string& option) {
  std::string end = path.size() < 4 ? "" : path.substr(path.size() - 4);
  std::ranges::transform(end, end.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (path.empty() || end == ".glb") return;
  throw UsageError("not the name of a binary glTF file (" + path + " for " + option + ") - let it end in .glb");
}

std::string scene_gltf(const Scene& scene, std::span<const std::string> names,
                       const std::vector<std::uint8_t>& colours) {
  return SceneGltf(scene, names, colours).text();
}

}  // namespace vex
