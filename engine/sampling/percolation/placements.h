// Bodies placed one after another in a periodic cube, uniformly and independently: the k-th body of a realisation is a
// function of the seed and of its numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/numeric/instruction_set.h"
#include "engine/numeric/pose.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/support/convex_body.h"

namespace vex {

/// How each body is turned, on its own.
struct BodyOrientations {
  OrientationLaw law;  // about the z axis of the cube; not `fixed`, `angle` and `each`, which are about two bodies
  /// Instead of the law: the angle between a body's z axis and the cube's is uniform, where it should be its cosine. I.
  /// Balberg, N. Binenbaum and N. Wagner (Phys. Rev. Lett. 52, 1465, 1984) drew sticks so; kept to tell what it does.
  bool uniform_polar_angle = false;
};

/// A kind of body, and its part of the number of all bodies.
struct BodyPart {
  ConvexBody body;
  double fraction = 1.0;
};

/// One realisation of one size of the cube.
struct RealisationId {
  std::uint32_t size = 0;         // the number of the size, below kMostSizes
  std::uint32_t realisation = 0;  // below kMostRealisations
};
inline constexpr std::uint32_t kMostSizes = 1u << 6, kMostRealisations = 1u << 26;

/// A value.
class Placements {
 public:
  /// Fractions above 0, which need not add up to 1. Throws UsageError.
  Placements(std::vector<BodyPart> parts, const BodyOrientations& orientations, std::uint64_t seed);

  struct Placed {
    std::uint32_t part = 0;
    Pose world_from_body;
  };
  /// The k-th body: its centre is uniform in a cube of this edge about the origin. Balls are not turned.
  Placed operator()(const RealisationId& realisation, std::uint32_t k, double edge) const;
  /// The bodies first, ..., first + n - 1, drawn by packets: the same bits. `kAtOnce` of them stay in a core's fastest
  /// cache.
  static constexpr std::uint32_t kAtOnce = 96;
  struct Many {
    std::vector<std::uint32_t> part;
    std::vector<Pose> world_from_body;
  };
  void many(const RealisationId& realisation, std::uint32_t first, std::uint32_t n, double edge, InstructionSet set,
            Many& out) const;

  const std::vector<BodyPart>& parts() const { return parts_; }
  const BodyOrientations& orientations() const { return orientations_; }
  std::uint64_t seed() const { return seed_; }

 private:
  static constexpr std::size_t kDimension = 7;  // coordinates of a body, at most
  using Point = std::array<double, kDimension>;
  std::uint32_t part_at(const Point& u) const;
  Transformd pose_at(const Point& u, std::uint32_t part, double edge) const;

  std::vector<BodyPart> parts_;
  std::vector<double> up_to_;         // sums of the fractions, of 1
  std::vector<bool> is_ball_;         // of each part: it need not be turned
  std::size_t n_drawn_ = kDimension;  // coordinates that are used
  BodyOrientations orientations_;
  std::uint64_t seed_;
};

}  // namespace vex
