// Finds the certificates of what half-spaces answer. Nothing here is believed: the checker judges what is found.
#include <optional>
#include <string>
#include <vector>

#include "engine/query/checker/plane_heights.h"
#include "engine/query/exact/nearest_witnesses.h"
#include "engine/query/half_space_certificate.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/plane_sweep.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

using checker::Clear;
using checker::ExactPair;

constexpr int kMostHalvings = 4;

// A step of the search is as long as its own bound of what bends allows. Where that of the checker is a little looser
// the interval is proven in pieces, of which each bends by a quarter of what two of them do.
void add_clear(const checker::TurningHeights& turning, const Clear& interval, int most_halvings,
               std::vector<Clear>& clear) {
  const double middle = 0.5 * interval.from + 0.5 * interval.to;
  const bool has_middle = interval.from < middle && middle < interval.to;
  if (most_halvings == 0 || !has_middle || turning.stays_clear(interval)) {
    clear.push_back(interval);
    return;
  }
  add_clear(turning, {interval.from, middle}, most_halvings - 1, clear);
  add_clear(turning, {middle, interval.to}, most_halvings - 1, clear);
}

}  // namespace

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Separation& found) {
  HalfSpaceCertificate certificate;
  if (!found.has_witnesses) return certificate;
  certificate.near_b.push_back(
      nearest_of_b(b, {}, found.point_b_in_b, pose.a_from_b().direction_to_b(a.unit_normal())));
  return certificate;
}

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const Vec3d& motion,
                             const FirstContact& found, double until) {
  return certify(a, b, pose, RigidMotion{motion, {}}, found, until);
}

HalfSpaceCertificate certify(const HalfSpace& a, const ConvexBody& b, const Pose& pose, const RigidMotion& motion,
                             const FirstContact& found, double until) {
  HalfSpaceCertificate certificate;
  const bool meets = found.verdict.outcome == Outcome::overlap;
  if (meets) {
    const Transformd then = pose_at(pose.a_from_b(), motion, found.time);
    certificate.near_b.push_back(nearest_of_b(b, {}, found.point_b_in_b, then.direction_to_b(a.unit_normal())));
  }
  if (!(norm_1(motion.angular_velocity) > 0.0) || (meets && found.upper == 0.0)) return certificate;
  std::vector<ApartDuring> record;
  time_of_impact(a, b, pose, motion, until, record);
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(ConvexBody(PointBody{}), b, pose.a_from_b(), fault);
  if (!pair) return certificate;
  const checker::Heights heights(a, *pair, pose.a_from_b());
  const checker::TurningHeights turning(heights, *pair, pose.a_from_b(), motion, b.centre());
  for (const ApartDuring& step : record) add_clear(turning, {step.from, step.to}, kMostHalvings, certificate.clear);
  if (!meets) return certificate;
  const Vec3d down = pose_at(pose.a_from_b(), motion, found.upper).direction_to_b(-a.dir_normal());
  Witness lowest{};
  lowest.dir_b = down;
  lowest.point_b = b.core_support(down);
  certificate.lowest.push_back(lowest);
  return certificate;
}

HalfSpaceCertificate certify(const HalfSpace& /*a*/, const ConvexBody& b, const Pose& pose,
                             std::span<const PlaneContact> found) {
  HalfSpaceCertificate certificate;
  for (const PlaneContact& contact : found) {
    const Vec3d own = pose.a_from_b().direction_to_b(contact.point_b - pose.a_from_b().translation);
    certificate.near_b.push_back(nearest_of_b(b, {}, own, {}));
  }
  return certificate;
}

}  // namespace vex
