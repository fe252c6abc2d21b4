// The radial function of A - B for many orientations of B and a ray for each, a register full of rays at a time: what
// the radial estimator averages.
#pragma once

#include <cstddef>
#include <memory>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Rays in columns of `stride` values each: R by rows, without translation; the ray's direction d; a number of the unit
/// interval; three directions, the normals of the first portal, best so chosen that the points where these are normal
/// surround the ray. After the n of them there is room for a packet.
struct RayTable {
  static constexpr std::size_t kDirection = 9, kPick = 12, kNormals = 13, kColumns = 22;

  const double* columns;
  std::size_t stride, n;

  Vec3d at(std::size_t column, std::size_t k) const {
    const double* const x = columns + column * stride + k;
    return {x[0], x[stride], x[2 * stride]};
  }
  Transformd rotation(std::size_t k) const { return {at(0, k), at(3, k), at(6, k), {}}; }
  Vec3d dir(std::size_t k) const { return at(kDirection, k); }
};

/// Of up to kMostRays rays (PacketRays::find).
struct RadialAnswers {
  static constexpr std::size_t kMostRays = 256;

  double cube[kMostRays], inner[kMostRays], outer[kMostRays];
  double asked[kMostRays];  // of PacketRays::decide alone

  /// The first n are open, without bounds.
  void open_all(std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      cube[k] = __builtin_nan("");
      inner[k] = outer[k] = 0.0;
    }
  }

  /// Of an open one, r^3 being found otherwise.
  double cube_of(std::size_t k, double pick, double r_cubed) const {
    if (outer[k] == 0.0) return r_cubed;
    return inner[k] + pick * (outer[k] - inner[k]) <= r_cubed ? outer[k] : inner[k];
  }
};

/// One instance serves one thread.
class PacketRays {
 public:
  static constexpr std::size_t kMostRays = RadialAnswers::kMostRays;
  static constexpr std::size_t kStride = kMostRays + 16;

  virtual ~PacketRays();  // not inline: kernels would each have it

  /// answers.cube[k], for up to kMostRays rays: a number whose mean over a uniform pick is r(d)^3, r being the radial
  /// function (radial_function.h); or a NaN where the search ended without one.
  ///
  /// Once r lies between two bounds within kRadialGap of each other, r^3 is not searched for any longer: of a number
  /// drawn between the bounds' cubes it is decided whether it is below r^3, and the upper cube is the answer if so,
  /// otherwise the lower. So there is no bias beyond kRadialRounding, and where the bounds meet before, as they do for
  /// polytopes, nothing is drawn. Whether a search ends without an answer may depend on the pick then: of such a ray
  /// inner[k] and outer[k] are the two cubes, by which the question is to be decided all the same
  /// (RadialAnswers::cube_of). Of any other they are both 0.
  virtual void find(const RayTable& rays, RadialAnswers& answers) = 0;

  /// The same in two halves, for a mean that hangs on several rays together. The first one answers where bounds meet;
  /// of rays whose bounds are near enough it tells the cubes of these, inner[k] and outer[k], and the number that is to
  /// be drawn is the caller's. All others are open.
  virtual void close_in(const RayTable& rays, RadialAnswers& answers) = 0;
  /// Right after it, of the same answers: whether r(d)^3 is asked[k] or more, for all rays with an inner[k] and
  /// outer[k]. cube[k] is at least asked[k] where it is, and otherwise less; or a NaN where the search ended without an
  /// answer.
  virtual void decide(RadialAnswers& answers) = 0;
};

inline constexpr double kRadialGap = 0x1p-10;

using RayKernel = PacketRays* (*)(const PacketPairForms& forms, const BodyPoints& points);

/// Of `scalar` the one that is compiled for the baseline of the machine's kind: averages, and not only hits, are then
/// the same bits for every set, and on machines that have none of the others.
RayKernel ray_kernel(InstructionSet set);

/// None for a pair that kernels do not take, as make_packet_overlap.
std::unique_ptr<PacketRays> make_packet_rays(RayKernel kernel, const ConvexBody& a, const ConvexBody& b,
                                             const BodyPoints& points);

// Each is compiled for its own set (radial_kernel.cpp).
namespace baseline {
PacketRays* new_packet_rays(const PacketPairForms& forms, const BodyPoints& points);
}
namespace sse2 {
PacketRays* new_packet_rays(const PacketPairForms& forms, const BodyPoints& points);
}
namespace avx2 {
PacketRays* new_packet_rays(const PacketPairForms& forms, const BodyPoints& points);
}
namespace avx512 {
PacketRays* new_packet_rays(const PacketPairForms& forms, const BodyPoints& points);
}

}  // namespace vex
