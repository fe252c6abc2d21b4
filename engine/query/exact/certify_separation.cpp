// Finds the certificates of distances, depths and manifolds. Nothing here is believed: the checker judges what is
// found.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/inner_balls.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/exact/exact_overlap.h"
#include "engine/query/exact/exact_witness.h"
#include "engine/query/exact/fine_core.h"
#include "engine/query/exact/nearest_witnesses.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/exact/recorded_core.h"
#include "engine/query/manifold_certificate.h"
#include "engine/query/separation_certificate.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;

constexpr int kMostCallsOfBounds = 1 << 11, kMostCallsOfTies = 1 << 16, kMostFineCalls = 1 << 9;
// In the unit of the forms: below the error that is counted for a point in twice the precision.
constexpr double kFineGap = 0.25 * kExtendedError;

void find_bounds(const ExactPair& pair, const PlacedForms& placed, const Separation& found,
                 SeparationCertificate& certificate) {
  const LocalForms forms(placed);
  const double unit = std::ldexp(1.0, -forms.exponent());
  bool has_dir = !(found.lower > -HUGE_VAL), has_hull = !(found.upper < HUGE_VAL);
  const auto offer_dir = [&](ExactVector dir) {
    if (has_dir || !is_apart_by(pair, dir, Dyadic(found.lower))) return;
    certificate.dir = std::move(dir);
    has_dir = true;
  };
  const auto offer_hull = [&](WitnessHull hull) {
    if (has_hull || !comes_as_near_as(pair, hull, Dyadic(found.upper))) return;
    certificate.hull = std::move(hull);
    has_hull = true;
  };
  if (placed.are_rounded_polytopes()) {
    whole::Vector dir;
    const ExactOverlap nearest = exact_nearest(placed, dir);
    WitnessHull hull;
    for (std::size_t k = 0; k < static_cast<std::size_t>(nearest.n_carriers); ++k) {
      hull.witnesses.push_back(vertex_witness(placed, nearest.carriers_a[k], nearest.carriers_b[k]));
    }
    if (!nearest.overlap) offer_dir(exact_vector(dir));
    offer_hull(std::move(hull));
  }
  offer_dir({{{found.normal, 0}}});
  const double width = std::isfinite(found.upper - found.lower) ? (found.upper - found.lower) * unit : 0.0;
  const double first = placed.are_rounded_polytopes() ? 0x1p-62 : std::clamp(0.5 * width, 0x1p-92, 0x1p-10);
  for (double gap = first; !(has_dir && has_hull); gap *= 0x1p-9) {
    bool is_capped = false;
    // Where rounding stalls one descent it may not stall another.
    for (const Vec3d& first_dir : {found.normal, Vec3d{}}) {
      const RecordedCore core(forms);
      CoreProof proof = prove_nearness(core, first_dir, gap, kMostCallsOfBounds);
      is_capped = is_capped || proof.is_capped;
      offer_dir(std::move(proof.dir));
      offer_hull(std::move(proof.hull));
      if (!proof.surface.faces.empty()) offer_hull(std::move(proof.surface));
      if (has_dir && has_hull) return;
    }
    if (gap < 0x1p-90 || is_capped) break;
  }
  if (has_dir && has_hull) return;
  // Where rounding stalls all of them, as of flat bodies that are next to nothing apart, in more digits. Nearer to the
  // truth than a search in twice the precision says it has come.
  for (const Vec3d& first_dir : {found.normal, Vec3d{}}) {
    const FineCore core(pair, forms);
    CoreProof proof = prove_nearness(core, first_dir, kFineGap, kMostFineCalls);
    offer_dir(std::move(proof.dir));
    offer_hull(std::move(proof.hull));
    if (!proof.surface.faces.empty()) offer_hull(std::move(proof.surface));
    if (has_dir && has_hull) return;
  }
  // In ever so many directions, as of bodies of which ever so many are the shortest way out.
  const RecordedCore core(forms);
  CoreProof proof = prove_nearness(core, found.normal, first, kMostCallsOfTies);
  offer_dir(std::move(proof.dir));
  offer_hull(std::move(proof.surface.faces.empty() ? proof.hull : proof.surface));
}

}  // namespace

SeparationCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Separation& found) {
  SeparationCertificate certificate;
  const Outcome outcome = found.verdict.outcome;
  Separation open = found;  // what bounds have to be proven by themselves
  const bool is_shown = (outcome == Outcome::disjoint && found.lower > 0.0) ||
                        (outcome == Outcome::overlap && found.upper < 0.0) || outcome == Outcome::undecided;
  if (!is_shown) {
    const bool is_sign = overlap(a, b, pose, &certificate.sign).outcome == outcome;
    if (outcome == Outcome::disjoint) open.lower = is_sign ? -HUGE_VAL : kLeastGap;
    if (outcome == Outcome::overlap) open.upper = is_sign ? HUGE_VAL : -kLeastGap;
  }
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  const std::optional<PlacedForms> placed = placed_forms(a, b, pose.a_from_b());
  if (!pair || !placed) return certificate;
  // What the checker needs no witness for is not looked for.
  if (open.upper < HUGE_VAL &&
      checker::balls_come_as_near_as(pair->a(), pair->b(), pose.a_from_b(), whole::Dyadic(open.upper))) {
    open.upper = HUGE_VAL;
  }
  if (open.lower > -HUGE_VAL || open.upper < HUGE_VAL) find_bounds(*pair, *placed, open, certificate);
  if (found.has_witnesses) {
    certificate.near_a = nearest_of_a(a, found.point_a, found.normal);
    certificate.near_b = nearest_of_b(b, {}, found.point_b_in_b, pose.a_from_b().direction_to_b(found.normal));
  }
  return certificate;
}

ManifoldCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                            const ContactManifold& manifold) {
  ManifoldCertificate certificate{certify(a, b, pose, manifold.separation), {}};
  for (const ContactManifold::Contact& contact : manifold.contacts) {
    certificate.contacts.push_back(
        {nearest_of_a(a, contact.point_a, {}), nearest_of_b(b, pose.a_from_b(), contact.point_b, {})});
  }
  return certificate;
}

}  // namespace vex
