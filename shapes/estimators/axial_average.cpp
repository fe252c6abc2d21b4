#include "shapes/estimators/axial_average.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

#include "engine/numeric/elementary.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using std::numbers::pi;

constexpr double kInnerTolerance = 1e-13, kOuterTolerance = 1e-11;  // relative, of one body's integral
constexpr int kMostHalvings = 22;  // of an interval: where |x| has its corner the error falls fourfold each time
constexpr int kMostOuterHalvings = 12;
// Of measures and sums, relative to the value; and of heights, relative to the reach of the body they are of.
constexpr double kAxialRounding = 1e-12, kHeightRounding = 0x1p-46;

struct Integral {
  double value = 0.0, error = 0.0;
};

/// To this error, absolute, or as near as so many halvings of the interval bring it. (The adaptive integral of
/// Boost 1.74 tells errors of narrow intervals as if they were wide.)
template <class F>
Integral integral_to(const F& f, double from, double to, int most_halvings, double tolerance) {
  Integral result;
  result.value = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 0, 0.0, &result.error);
  result.error *= 0.5 * (to - from);
  if (result.error <= tolerance || most_halvings == 0) return result;
  const double middle = 0.5 * (from + to);
  const Integral left = integral_to(f, from, middle, most_halvings - 1, 0.5 * tolerance),
                 right = integral_to(f, middle, to, most_halvings - 1, 0.5 * tolerance);
  return {left.value + right.value, left.error + right.error};
}

template <class F>
Integral integral_of(const F& f, double from, double to, int most_halvings, double tolerance) {
  double error = 0.0;
  const double rough = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 0, 0.0, &error);
  return integral_to(f, from, to, most_halvings, tolerance * std::fabs(rough));
}

bool is_across_or_along(const Vec3d& normal) { return normal.x == 0.0 && normal.y == 0.0; }

/// Whether the measure is alike about z.
bool is_axial(const NormalMeasure& measure) {
  return std::ranges::all_of(measure.components(), [](const NormalMeasure::Component& component) {
    if (const auto* const atom = std::get_if<NormalAtom>(&component)) return is_across_or_along(atom->unit_normal);
    if (std::holds_alternative<NormalArc>(component)) return mass_of(component) == 0.0;
    if (std::holds_alternative<SuperellipsoidNormals>(component)) return is_alike_about_z(component);
    if (const auto* const area = std::get_if<EllipsoidNormals>(&component)) {
      return area->semi_axes.x == area->semi_axes.y;
    }
    if (const auto* const curvature = std::get_if<EllipsoidCurvature>(&component)) {
      return curvature->semi_axes.x == curvature->semi_axes.y;
    }
    return true;
  });
}

/// Both measures are: of a flat body the area alone does not tell a disc from a plate.
bool is_of_revolution(const NormalMeasure& area, const Body& body) {
  return is_axial(area) && is_axial(body.normals.mean_curvature());
}

/// The mean of the other body's height over the azimuth of a normal, the axes at an angle in the plane of x and z.
class MeanHeight {
 public:
  MeanHeight(const Body& other, const SinCos<double>& between) : other_(other), between_(between) {}

  /// `normal`: in the plane of x and z, x >= 0.
  Integral operator()(const Vec3d& normal) const {
    if (is_across_or_along(normal)) return {height(normal.x, normal.z, 1.0, 0.0), 0.0};
    const double sine = std::hypot(normal.x, normal.y);
    Integral mean =
        integral_of([&](double azimuth) { return height(sine, normal.z, std::cos(azimuth), std::sin(azimuth)); }, 0.0,
                    pi, kMostHalvings, kInnerTolerance);
    return {mean.value / pi, mean.error / pi};
  }

 private:
  /// h of the other body against the normal, which is turned into its frame.
  double height(double sine, double cosine, double cos_azimuth, double sin_azimuth) const {
    const double x = sine * cos_azimuth;
    const Vec3d against{-(between_.cos * x - between_.sin * cosine), -sine * sin_azimuth,
                        -(between_.sin * x + between_.cos * cosine)};
    return dot(against, other_.body.support(against));
  }

  const Body& other_;
  SinCos<double> between_;
};

/// The integral of the mean height over an axial measure. `ball_height`: the mean over all normals, which is that over
/// whole spheres.
Integral integral_over(const NormalMeasure& measure, const MeanHeight& mean_height, double ball_height) {
  Integral sum;
  // Zones that are as dense make a whole sphere: those of a capsule.
  double lowest = 1.0, highest = -1.0, density = -1.0, zones_mass = 0.0;
  bool are_alike = true;
  for (const NormalMeasure::Component& component : measure.components()) {
    const auto* const zone = std::get_if<NormalZone>(&component);
    if (zone == nullptr || !(zone->mass > 0.0)) continue;
    const double here = zone->mass / (zone->cos_to - zone->cos_from);
    are_alike = are_alike && (density < 0.0 || std::fabs(here - density) <= 4e-16 * here) &&
                (zone->cos_from == highest || zone->cos_to == lowest || density < 0.0);
    density = here;
    lowest = std::min(lowest, zone->cos_from);
    highest = std::max(highest, zone->cos_to);
    zones_mass += zone->mass;
  }
  const bool is_sphere = are_alike && density > 0.0 && lowest == -1.0 && highest == 1.0;
  if (is_sphere) sum.value += zones_mass * ball_height;

  for (const NormalMeasure::Component& component : measure.components()) {
    const double mass = mass_of(component);
    if (!(mass > 0.0) || (is_sphere && std::holds_alternative<NormalZone>(component))) continue;
    const auto at = [&](double v) -> WeightedNormal {
      const auto* const spheroid = std::get_if<EllipsoidCurvature>(&component);
      if (spheroid == nullptr) return normal_at(component, v, 0.0);
      // Its own normals go around another axis than z where it is long.
      const Vec3d normal{2.0 * std::sqrt(v * (1.0 - v)), 0.0, 2.0 * v - 1.0};
      return {normal, 2.0 * pi * spheroid->factor * sum_of_radii_of_curvature(spheroid->semi_axes, normal)};
    };
    if (!coordinates_used(component).v) {
      const Integral one = mean_height(at(0.5).unit_normal);
      sum.value += mass * one.value;
      sum.error += mass * one.error;
      continue;
    }
    // With v = sin^2 t roots of the sine of the polar angle, which zones have at the poles, are smooth in t; so are
    // those at the ends of the quarters that a superellipsoid has.
    double largest_inner = 0.0;
    const int n_pieces = std::holds_alternative<SuperellipsoidNormals>(component) ? 4 : 1;
    const double piece = 1.0 / n_pieces;
    Integral outer;
    for (int k = 0; k < n_pieces; ++k) {
      const Integral of_piece = integral_of(
          [&](double t) {
            const WeightedNormal node = at(piece * (k + std::pow(std::sin(t), 2)));
            const Integral inner = mean_height(node.unit_normal);
            largest_inner = std::max(largest_inner, node.weight * inner.error);
            return piece * node.weight * inner.value * std::sin(2.0 * t);
          },
          0.0, 0.5 * pi, kMostOuterHalvings, kOuterTolerance);
      outer.value += of_piece.value;
      outer.error += of_piece.error;
    }
    sum.value += outer.value;
    sum.error += outer.error + largest_inner;
  }
  return sum;
}

}  // namespace

std::optional<SeriesAverage> axial_average(const Body& a, const Body& b, const OrientationLaw& law) {
  if (law.kind() != OrientationLaw::Kind::angle || law.has_axes()) return std::nullopt;
  for (const Body* const body : {&a, &b}) {
    if (!body->normals.area || !body->normals.mean_curvature) {
      throw UsageError("a body without its measures on normals (" + body->kind + ") - the quadrature needs them");
    }
    // A polytope has faces across no axis; the measures of a large one are not even asked for.
    if (!vertices_of(body->body).empty() && body->n_faces > 0) return std::nullopt;
  }
  const NormalMeasure area_a = a.normals.area(), area_b = b.normals.area();
  if (!is_of_revolution(area_a, a) || !is_of_revolution(area_b, b)) return std::nullopt;
  const SinCos<double> between = sincospi(law.parameter() / 180.0);
  // From either body the other's axis is at the same angle.
  const Integral of_a = integral_over(area_a, MeanHeight(b, between), b.measures.mean_radius());
  const Integral of_b = integral_over(area_b, MeanHeight(a, between), a.measures.mean_radius());
  const double value = (a.measures.volume + b.measures.volume) + (of_a.value + of_b.value);
  const double heights =
      a.measures.surface_area * b.body.circumradius() + b.measures.surface_area * a.body.circumradius();
  return SeriesAverage{value, of_a.error + of_b.error + kAxialRounding * value + kHeightRounding * heights};
}

}  // namespace vex
