#include "meshes/scaled_body.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/hull_of_points.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

// What exact_sign.h asks of coordinates. Those of files are far inside.
constexpr double kLargestCoordinate = 0x1p300;
constexpr double kSmallestCoordinate = 0x1p-300;

[[noreturn]] void refuse_scaled(const std::string& what, double scale) {
  throw InputError("the scaled body is " + what + " (its scale is " + number_text(scale) + ") - choose another scale");
}

void check_scaled(const std::vector<Vec3d>& vertices, double scale) {
  for (const Vec3d& v : vertices) {
    for (const double x : {v.x, v.y, v.z}) {
      if (!(std::fabs(x) <= kLargestCoordinate)) {
        refuse_scaled("too large", scale);
      }
      if (x != 0.0 && std::fabs(x) < kSmallestCoordinate) {
        refuse_scaled("too small", scale);
      }
    }
  }
}

HullOfPoints hull_of_scaled(const std::vector<Vec3d>& vertices, double scale) {
  try {
    return hull_of_points(vertices);
  } catch (const InputError&) {
    refuse_scaled("too thin for its coordinates", scale);
  }
}

}  // namespace

void check_scaled_measures(const Measures& measures, double scale) {
  for (const double value : {measures.volume, measures.surface_area, measures.integrated_mean_curvature}) {
    if (!std::isfinite(value)) {
      refuse_scaled("too large", scale);
    }
    if (!(value >= std::numeric_limits<double>::min())) {
      refuse_scaled("too small", scale);
    }
  }
}

MeshBody scaled_body(MeshBody body, double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    refuse_scaled(scale > 0.0 ? "too large" : (scale == 0.0 ? "too small" : "none, for the scale is not positive"),
                  scale);
  }
  for (Vec3d& v : body.vertices) {
    v = scale * v;
  }
  check_scaled(body.vertices, scale);
  body.solid = volume_and_centroid(body.triangles);
  const ConvexityCensus census = convexity_census(body.triangles, body.solid.centroid);
  if (census.locally_convex() && census.winding_number == 1) {
    return body;
  }
  HullOfPoints hull = hull_of_scaled(body.vertices, scale);
  body.vertices = std::move(hull.vertices);
  body.triangles = std::move(hull.triangles);
  body.solid = volume_and_centroid(body.triangles);
  return body;
}

}  // namespace vex
