#include "apps/common/html/pair_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "apps/common/body_colours.h"

namespace vex {
namespace {

using Colour = std::array<double, 3>;

constexpr std::size_t kManyTriangles = 400;  // of a body with flat faces: then its edges are thin

const Vec3d kView{0.844, 0.390, 0.368};  // towards the eye; made a unit below

Vec3d unit(const Vec3d& v) { return (1.0 / norm(v)) * v; }

std::string hex(const Colour& colour) {
  std::string text = "#";
  for (const double c : colour) {
    const auto value = static_cast<unsigned>(std::floor(255.0 * std::clamp(c, 0.0, 1.0) + 0.5));
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

class PairPicture {
 public:
  PairPicture(Svg& svg, const PairView& view, const OrientationView& orientation)
      : svg_(svg), view_(view), orientation_(orientation) {}

  void draw(double width, double height) {
    const Vec3d contact = centre_in_contact();
    std::vector<Vec3d> points_b;
    for (const Vec3d& p : view_.b.points) points_b.push_back(contact + turned(p));
    fit({&view_.a.points, &orientation_.surface.points, &points_b}, width, height);
    const Colour& surface = kBodyColours[kFirstOfClusters + 2].srgb;
    faces(orientation_.surface, orientation_.surface.points, surface, -1.0, "opacity=\".22\"");
    edges(orientation_.surface, orientation_.surface.points, surface, -1.0, 0.35);
    body(view_.a, view_.a.points, kBodyColours[kFirstOfClusters].srgb, false);
    faces(orientation_.surface, orientation_.surface.points, surface, 1.0, "opacity=\".3\"");
    edges(orientation_.surface, orientation_.surface.points, surface, 1.0, 0.9);
    body(view_.b, points_b, kBodyColours[kStandsOut].srgb, true);
    svg_.dot(pixel(contact), 3.2, "fill=\"#fff\" stroke=\"#5a2500\" stroke-width=\"1.6\"");
    svg_.dot(pixel({}), 3.2, "fill=\"#fff\" stroke=\"#00324e\" stroke-width=\"1.6\"");
  }

 private:
  Vec3d turned(const Vec3d& p) const {
    const Transformd& r = orientation_.rotation;
    return {dot(r.row_x, p), dot(r.row_y, p), dot(r.row_z, p)};
  }

  // The point of the surface that is farthest to the right and a little up: there B covers little of the rest.
  Vec3d centre_in_contact() const {
    const Vec3d dir = right_ + 0.35 * up_;
    Vec3d farthest = (view_.size / norm(dir)) * dir;
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3d& p : orientation_.surface.points) {
      if (dot(p, dir) > most) most = dot(p, dir), farthest = p;
    }
    return farthest;
  }

  void fit(const std::array<const std::vector<Vec3d>*, 3>& sets, double width, double height) {
    constexpr double kHuge = 1e300;
    Pixel least{kHuge, kHuge}, most{-kHuge, -kHuge};
    for (const std::vector<Vec3d>* const points : sets) {
      for (const Vec3d& p : *points) {
        const double x = dot(p, right_), y = -dot(p, up_);
        least = {std::min(least.x, x), std::min(least.y, y)};
        most = {std::max(most.x, x), std::max(most.y, y)};
      }
    }
    scale_ = std::min(width / std::max(most.x - least.x, 1e-300), height / std::max(most.y - least.y, 1e-300));
    middle_ = {0.5 * (least.x + most.x), 0.5 * (least.y + most.y)};
  }

  Pixel pixel(const Vec3d& p) const {
    return {scale_ * (dot(p, right_) - middle_.x), scale_ * (-dot(p, up_) - middle_.y)};
  }

  void body(const BodyMesh& mesh, const std::vector<Vec3d>& points, const Colour& colour, bool is_b) {
    if (mesh.is_line) {
      svg_.line(pixel(points[0]), pixel(points[1]),
                "stroke=\"" + hex(colour) + "\" stroke-width=\"4\" stroke-linecap=\"round\"");
      return;
    }
    faces(mesh, points, colour, 1.0, is_b ? "opacity=\".93\"" : "");
    const Colour dark = {0.45 * colour[0], 0.45 * colour[1], 0.45 * colour[2]};
    edges(mesh, points, dark, 1.0, mesh.indices.size() > 3 * kManyTriangles ? 0.25 : 0.8);
  }

  static double facing(const std::vector<Vec3d>& points, const std::uint32_t* c) {
    return dot(cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]), kUnitView);
  }

  // Those that face the eye (side 1) or away (-1): of one shade one path, from the dark to the light, so that no seams
  // are seen.
  void faces(const BodyMesh& mesh, const std::vector<Vec3d>& points, const Colour& colour, double side,
             const std::string& attributes) {
    constexpr double kTones = 48.0;
    if (mesh.is_line || mesh.indices.empty()) return;
    std::map<double, std::string> paths;  // by light
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const std::uint32_t* const c = &mesh.indices[t];
      const Vec3d area = cross(points[c[1]] - points[c[0]], points[c[2]] - points[c[0]]);
      const double seen = side * dot(area, kUnitView);
      if (!(seen > 0.0) && !(mesh.is_flat && seen < 0.0)) continue;
      const Vec3d normal = (dot(area, kUnitView) < 0.0 ? -1.0 : 1.0) / norm(area) * area;
      const double light = std::floor(kTones * std::max(0.0, dot(normal, light_)) + 0.5) / kTones;
      paths[light] += svg_fine_path({pixel(points[c[0]]), pixel(points[c[1]]), pixel(points[c[2]])});
    }
    // In steps of the fine grid.
    svg_.begin_group({}, attributes + " stroke-width=\"12\" stroke-linejoin=\"round\"");
    svg_.begin_fine_grid();
    for (const auto& [light, path] : paths) {
      const double part = 0.42 + 0.58 * light, gloss = 0.22 * part * part * part * part;
      const std::string shade = hex({part * colour[0] + gloss, part * colour[1] + gloss, part * colour[2] + gloss});
      svg_.path(path, "fill=\"" + shade + "\" stroke=\"" + shade + "\"");
    }
    svg_.end_group();
    svg_.end_group();
  }

  void edges(const BodyMesh& mesh, const std::vector<Vec3d>& points, const Colour& colour, double side,
             double opacity) {
    const auto is_seen = [&](std::uint32_t triangle) {
      return mesh.is_flat || side * facing(points, &mesh.indices[3 * triangle]) > 0.0;
    };
    std::string path;
    for (const SharpEdge& edge : sharp_edges(mesh)) {
      if (is_seen(edge.triangles[0]) || is_seen(edge.triangles[1]))
        path += svg_path({pixel(points[edge.ends[0]]), pixel(points[edge.ends[1]])}, false);
    }
    svg_.path(path, "fill=\"none\" stroke=\"" + hex(colour) +
                        "\" stroke-width=\"1\" stroke-linecap=\"round\" opacity=\"" + svg_number(opacity) + "\"");
  }

  static inline const Vec3d kUnitView = unit(kView);
  const Vec3d right_ = unit(cross({0.0, 0.0, 1.0}, kUnitView)), up_ = cross(kUnitView, right_);
  const Vec3d light_ = unit(kUnitView + 0.8 * up_ - 0.5 * right_);

  Svg& svg_;
  const PairView& view_;
  const OrientationView& orientation_;
  double scale_ = 1.0;  // pixels for each unit of length
  Pixel middle_;
};

}  // namespace

void draw_pair(Svg& svg, const PairView& view, const OrientationView& orientation, double width, double height) {
  PairPicture(svg, view, orientation).draw(width, height);
}

}  // namespace vex
