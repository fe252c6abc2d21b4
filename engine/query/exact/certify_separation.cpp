// Finds the certificates of distances and depths. Nothing here is believed: the checker judges what is found.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/exact/recorded_core.h"
#include "engine/query/separation_certificate.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;

constexpr int kMostCalls = 1 << 11;
constexpr double kPointGap = 0x1p-52;

// The points of a body that carry what is nearest to the other one, a point.
std::vector<Witness> nearest_witnesses(const std::optional<PlacedForms>& placed) {
  if (!placed) return {};
  const LocalForms forms(*placed);
  const RecordedCore core(forms);
  return prove_nearness(core, {}, kPointGap, kMostCalls).hull.witnesses;
}

/// A point as a body.
struct PointBody {
  Vec3d at;

  template <class L>
  Vec3<L> support(const Vec3<L>& /*dir*/) const {
    return broadcast<L>(at);
  }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return at; }
  double circumradius() const { return 0.0; }
  double inradius() const { return 0.0; }
  std::optional<ExactForm> exact_form() const { return ExactForm{{at}, {}, 0.0}; }
};

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
  offer_dir({{{found.normal, 0}}});
  const double width = std::isfinite(found.upper - found.lower) ? (found.upper - found.lower) * unit : 0.0;
  const double first = placed.are_rounded_polytopes() ? 0x1p-62 : std::clamp(0.5 * width, 0x1p-62, 0x1p-10);
  for (double gap = first; !(has_dir && has_hull); gap = gap > 0x1p-61 ? gap * 0x1p-9 : 0.0) {
    const RecordedCore core(forms);
    CoreProof proof = prove_nearness(core, found.normal, gap, kMostCalls);
    offer_dir(std::move(proof.dir));
    offer_hull(std::move(proof.hull));
    if (!proof.surface.faces.empty()) offer_hull(std::move(proof.surface));
    if (!(gap > 0.0) || proof.is_capped) break;
  }
}

}  // namespace

SeparationCertificate certify(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const Separation& found) {
  SeparationCertificate certificate;
  const Outcome outcome = found.verdict.outcome;
  Separation open = found;  // what bounds have to be proven by themselves
  const bool is_shown = (outcome == Outcome::disjoint && found.lower > 0.0) ||
                        (outcome == Outcome::overlap && found.upper < 0.0) || outcome == Outcome::undecided;
  if (!is_shown) {
    overlap(a, b, pose, &certificate.sign);
    if (outcome == Outcome::disjoint) open.lower = -HUGE_VAL;
    if (outcome == Outcome::overlap) open.upper = HUGE_VAL;
  }
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  const std::optional<PlacedForms> placed = placed_forms(a, b, pose.a_from_b());
  if (!pair || !placed) return certificate;
  if (open.lower > -HUGE_VAL || open.upper < HUGE_VAL) find_bounds(*pair, *placed, open, certificate);
  if (found.has_witnesses) {
    Transformd at_a;
    at_a.translation = found.point_a;
    certificate.near_a = nearest_witnesses(placed_forms(a, ConvexBody(PointBody{{}}), at_a));
    certificate.near_b = nearest_witnesses(placed_forms(ConvexBody(PointBody{found.point_b}), b, pose.a_from_b()));
  }
  return certificate;
}

}  // namespace vex
