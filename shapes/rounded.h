// A body with a ball of radius r about each of its points: its parallel body.
#pragma once

#include <numbers>
#include <utility>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"

namespace vex {

/// V, S and M of K + ball of radius r, from those of K (J. Steiner, 1840; also where K is flat):
/// V + S r + M r^2 + 4/3 pi r^3, S + 2 M r + 4 pi r^2, M + 4 pi r.
inline Measures parallel_body_measures(const Measures& body, double radius) {
  constexpr double pi = std::numbers::pi;
  const double s = body.surface_area, m = body.integrated_mean_curvature, r = radius;
  return {body.volume + r * (s + r * (m + 4.0 / 3.0 * pi * r)), s + r * (2.0 * m + 4.0 * pi * r), m + 4.0 * pi * r};
}

/// The surface area measure of K + ball of radius r, from S_K and H_K: S_K + 2 r H_K + r^2 S_B, the same formula normal
/// by normal (Schneider, section 4.2).
inline NormalMeasure parallel_body_area_measure(NormalMeasure area, const NormalMeasure& mean_curvature,
                                                double radius) {
  area.add(mean_curvature, 2.0 * radius);
  area.add(uniform_normals(4.0 * std::numbers::pi), radius * radius);
  return area;
}

/// The mean-curvature measure of K + ball of radius r: H_K + r H_B.
inline NormalMeasure parallel_body_mean_curvature_measure(NormalMeasure mean_curvature, double radius) {
  mean_curvature.add(uniform_normals(4.0 * std::numbers::pi), radius);
  return mean_curvature;
}

/// Both, for measures that are made when asked for.
inline NormalMeasures parallel_body_normal_measures(const NormalMeasures& body, double radius) {
  return {[body, radius] { return parallel_body_area_measure(body.area(), body.mean_curvature(), radius); },
          [body, radius] { return parallel_body_mean_curvature_measure(body.mean_curvature(), radius); }};
}

/// `rounded:r,BODY`.
template <SupportMapping Body>
class Rounded : public Inflated<Body> {
 public:
  Rounded(Body body, const Measures& body_measures, double radius)
      : Inflated<Body>(std::move(body), checked_size(radius, "the radius of a rounded body")),
        measures_(parallel_body_measures(body_measures, radius)) {}

  Measures measures() const { return measures_; }
  NormalMeasure area_measure() const requires HasNormalMeasures<Body> {
    const Body& body = this->body();
    return parallel_body_area_measure(body.area_measure(), body.mean_curvature_measure(), this->radius());
  }
  NormalMeasure mean_curvature_measure() const requires HasNormalMeasures<Body> {
    return parallel_body_mean_curvature_measure(this->body().mean_curvature_measure(), this->radius());
  }

 private:
  Measures measures_;
};

}  // namespace vex
