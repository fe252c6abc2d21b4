// The integrand of B3 where <V_ex> is known: the volume of all triangles of overlapping bodies, by how far rays reach.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/radial/radial_packets.h"
#include "engine/sampling/virial/triangle_columns.h"
#include "engine/sampling/virial/triangle_map.h"
#include "engine/sampling/virial/virial_pairs.h"

namespace vex {

/// Its mean over the unit cube is B3 / B2^2. Values are continuous, and made for quasi-random points (triangle_map.h).
class TriangleIntegrand final : public Integrand {
 public:
  /// `law` is isotropic or aligned: of others a UsageError is thrown. `excluded_volume`, length^3, is known to within
  /// the relative error. One instance serves one thread. Fewer sides than three are for tests, which have to find out
  /// that the last one is forgotten.
  TriangleIntegrand(const ConvexBody& body, const OrientationLaw& law, double excluded_volume, double relative_error,
                    InstructionSet set = best_instruction_set(), int n_sides = 3);

  /// Whether it is the better way: where <V_ex> is known, and the body is not so long or flat that clusters that are
  /// hit or missed cost as little, and that values have a tail which a short run does not show.
  static bool is_for(const ConvexBody& body, const OrientationLaw& law, double excluded_volume, double relative_error);

  int dimension() const override { return map_.dimension(); }
  /// The pick.
  int n_independent_coordinates() const override { return 1; }
  bool may_be_negative() const override { return true; }
  double scale() const override { return 1.0; }
  /// Of r six times, with bounds as close as they come; and what turning the bodies rounds by is far less.
  double relative_rounding() const override { return 17.0 * kRadialRounding + 2.0 * relative_error_; }
  double cost() const override;

  Doubts evaluate(std::span<const double> points, std::span<double> values) override;
  void count(std::span<std::uint64_t> counted) override;

 private:
  // Of r^3 along a side. `lower` < `upper` where it is still to be decided on which side of a number it is.
  struct Bounds {
    double lower, upper;
    double off = 0.0;  // of what bounds that stayed apart leave open: half of it
  };
  Bounds by_itself(std::size_t row, double relative_gap = 0.0) const;
  Outcome outcome_at(std::size_t row, double cube) const;
  void ask(std::size_t n);
  bool reaches(std::size_t row, Bounds& bounds) const;
  void find_sides(std::size_t n);

  ConvexBody body_;
  TriangleMap map_;
  double excluded_volume_, relative_error_;
  std::size_t n_sides_;
  MakeTriangles make_triangles_;
  std::unique_ptr<PacketRays> packets_;
  TriangleColumns columns_;
  RadialAnswers answers_;
  VirialPairs counts_;
  // Of the triangles at hand: the bounds of their sides, and of the least of them.
  std::array<Bounds, PacketRays::kMostRays> bounds_;
  std::array<Bounds, TriangleColumns::kTriangles> least_;
};

}  // namespace vex
