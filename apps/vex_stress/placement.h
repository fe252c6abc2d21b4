// Pairs of bodies and how they are put into contact, or just beside it.
//
// Nothing here uses the engine's queries: contact comes from support points of the bodies' exact forms, and what is
// true of a pose is asked of a referee afterwards, never inferred from how the pose was made.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/vex_stress/features.h"
#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Random numbers of one pose: a function of (seed, stratum, index), so that threads do not matter.
class Draw {
 public:
  Draw(std::uint64_t seed, std::string_view stratum, std::uint64_t index);

  /// Uniform in (0, 1).
  double operator()();
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  /// 0 ... n - 1.
  std::size_t below(std::size_t n);
  double sign() { return (*this)() < 0.5 ? -1.0 : 1.0; }
  Vec3d unit_direction();
  /// R, without translation.
  Transformd rotation();

 private:
  static constexpr std::size_t kMany = 64;
  std::uint64_t seed_, index_;
  std::array<double, kMany> numbers_;
  std::size_t next_ = 0;
  std::uint64_t n_refilled_ = 0;
};

struct StressPair {
  StressPair(std::string pair_name, ConvexBody body_a, ConvexBody body_b);

  std::string name;
  ConvexBody a, b;
  ExactForm form_a, form_b;
  Features features_a, features_b;  // of polytopes of few vertices

  /// R_A + R_B, what distances are relative to; 1 for two points.
  double size() const {
    const double sum = a.circumradius() + b.circumradius();
    return sum > 0.0 ? sum : 1.0;
  }
  bool is_rational() const { return form_a.is_rounded_polytope() && form_b.is_rounded_polytope(); }
};

/// The body of this text with itself, or two texts with a blank between.
StressPair named_pair(const std::string& text);

struct StressPose {
  Transformd a_from_b;
  Vec3d normal;  // from A to B, across the contact; zero where there is none
};

/// B, turned, touches A where A is farthest along the unit vector `normal`, and is then moved by `distance` along it.
StressPose beside_contact(const StressPair& pair, const Transformd& turn, const Vec3d& normal, double distance);

/// The point of A nearest to B is `p_a`, that of B `p_b` (in B's frame), but for `distance` along `normal`.
StressPose with_points_at(const Vec3d& p_a, const Vec3d& p_b, const Transformd& turn, const Vec3d& normal,
                          double distance);

/// 10^-3 ... 10^-16 times the pair's size, of either sign.
double random_distance(const StressPair& pair, Draw& draw);

/// B, turned anyhow, at such a distance along any direction.
StressPose place_near(const StressPair& pair, Draw& draw);

}  // namespace vex
