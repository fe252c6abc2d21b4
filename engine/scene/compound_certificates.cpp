#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound_certificate.h"
#include "engine/scene/moving_parts.h"

namespace vex {
namespace {

CertificateCheck proven_unless(std::string fault) {
  const bool is_proven = fault.empty();
  return {is_proven, std::move(fault)};
}

std::size_t n_parts(const ConvexBody& /*b*/) { return 1; }
std::size_t n_parts(const Compound& b) { return b.size(); }
const ConvexBody& part_of(const ConvexBody& b, std::size_t /*part*/) { return b; }
const ConvexBody& part_of(const Compound& b, std::size_t part) { return b.body(part); }
Pose frame_of(const ConvexBody& /*b*/, std::size_t /*part*/, const Pose& a_from_b) { return a_from_b; }
Pose frame_of(const Compound& b, std::size_t part, const Pose& a_from_b) { return b.frame_from_part(part, a_from_b); }

template <class B>
Pose pose_of_pair(const Compound& a, const B& b, const Pose& a_from_b, const PartPair& parts) {
  return a.part_from_b(parts.a, frame_of(b, parts.b, a_from_b));
}

// The pairs of a certificate, each once: all of them, or the one that is told alone.
template <class Certificate>
bool are_the_pairs(const Certificate& certificate, std::size_t n_a, std::size_t n_b, const PartPair* told) {
  std::vector<PartPair> pairs;
  for (const auto& of_pair : certificate.pairs) pairs.push_back(of_pair.parts);
  std::ranges::sort(pairs);
  const bool are_parts = std::ranges::all_of(pairs, [&](const PartPair& x) { return x.a < n_a && x.b < n_b; });
  if (!are_parts || std::ranges::adjacent_find(pairs) != pairs.end()) return false;
  if (told != nullptr && std::ranges::binary_search(pairs, *told)) return true;
  return pairs.size() == n_a * n_b;
}

template <class Certificate>
const typename decltype(Certificate::pairs)::value_type* of_parts(const Certificate& certificate,
                                                                  const PartPair& parts) {
  const auto found = std::ranges::find_if(certificate.pairs, [&](const auto& x) { return x.parts == parts; });
  return found == certificate.pairs.end() ? nullptr : &*found;
}

// Points and normals are those of a pair's answer to this much.
template <class Answer>
bool is_as_told(const Answer& claimed, const Answer& of_pair, double near) {
  const double rounding = 32.0 * kUnitRoundoff * (norm_1(of_pair.point_a) + norm_1(of_pair.point_b));
  return norm_1(claimed.point_a - of_pair.point_a) <= near + rounding &&
         norm_1(claimed.point_b - of_pair.point_b) <= near + rounding &&
         norm_1(claimed.normal - of_pair.normal) <= 1e-6 &&
         norm_1(claimed.point_b_in_b - of_pair.point_b_in_b) <=
             near + 32.0 * kUnitRoundoff * norm_1(of_pair.point_b_in_b);
}

// --- distances

template <class B>
CompoundCertificate certificate_of(const Compound& a, const B& b, const Pose& a_from_b,
                                   const CompoundSeparation& found) {
  CompoundCertificate certificate;
  const bool meets = found.separation.verdict.outcome == Outcome::overlap;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    for (std::uint32_t j = 0; j < n_parts(b); ++j) {
      if (meets && !(i == found.part_a && j == found.part_b)) continue;
      const Pose pose = pose_of_pair(a, b, a_from_b, {i, j});
      const Separation one = distance(a.body(i), part_of(b, j), pose);
      certificate.pairs.push_back({{i, j}, one, certify(a.body(i), part_of(b, j), pose, one)});
    }
  }
  return certificate;
}

template <class B>
std::string fault_of(const Compound& a, const B& b, const Pose& a_from_b, const CompoundSeparation& claimed,
                     const CompoundCertificate& certificate) {
  const Separation& of_union = claimed.separation;
  const Outcome outcome = of_union.verdict.outcome;
  const PartPair told{claimed.part_a, claimed.part_b};
  const bool meets = outcome == Outcome::overlap;
  if (!are_the_pairs(certificate, a.size(), n_parts(b), meets ? &told : nullptr)) return "not every pair has a proof";
  for (const auto& [parts, found, proof] : certificate.pairs) {
    const CertificateCheck check =
        check_certificate(a.body(parts.a), part_of(b, parts.b), pose_of_pair(a, b, a_from_b, parts), found, proof);
    if (!check.is_proven) return check.fault;
    if (outcome == Outcome::disjoint && found.verdict.outcome != Outcome::disjoint) return "a pair may overlap";
    if (!meets && !(found.lower >= of_union.lower)) return "a pair may be nearer than the lower bound";
  }
  const auto* const of_told = of_parts(certificate, told);
  if (meets) return of_told->found.verdict.outcome == Outcome::overlap ? "" : "that the parts overlap is not proven";
  if (!(of_union.lower <= of_union.signed_distance && of_union.signed_distance <= of_union.upper)) {
    return "the value is not between its bounds";
  }
  if (of_union.upper == HUGE_VAL) return {};
  if (of_told == nullptr) return "the nearest parts have no proof";
  const Separation seen =
      a.is_in_place(told.a) ? of_told->found : in_world(of_told->found, a.compound_from_part(told.a));
  const double near = promised_accuracy(a.body(told.a), part_of(b, told.b), of_told->found) +
                      promised_accuracy(a.body(told.a), part_of(b, told.b), of_union);
  if (!(seen.upper <= of_union.upper)) return "the upper bound is not proven";
  if (of_union.has_witnesses && !is_as_told(of_union, seen, near)) return "the points are not those of the parts";
  return {};
}

// --- motions

// The last time at which a pair other than the one that is told has to be apart.
double horizon(const CompoundContact& found, double until) {
  return found.contact.verdict.outcome == Outcome::disjoint ? until : found.contact.lower;
}

template <class B>
CompoundContactCertificate certificate_of(const Compound& a, const B& b, const Pose& a_from_b,
                                          const RigidMotion& motion_a, const RigidMotion& motion_b,
                                          const CompoundContact& found, double until) {
  CompoundContactCertificate certificate;
  const bool meets = found.contact.verdict.outcome == Outcome::overlap;
  const double end = horizon(found, until);
  for (const MovingPart& part : moving_parts(b, a_from_b, turns(motion_b))) {
    for (std::uint32_t i = 0; i < a.size(); ++i) {
      const bool is_told = meets && i == found.part_a && part.number == found.part_b;
      if (!is_told && end == 0.0 && found.contact.verdict.outcome != Outcome::disjoint) continue;
      const MovingPair pair = moving_pair(a, i, part, motion_a, motion_b);
      double last = is_told ? until : end;
      FirstContact one = time_of_impact(pair.a, pair.b, pair.pose, pair.of_a, pair.of_b, last);
      if (is_told && one.lower < end) {  // how long the steps are hangs on the end that they are given
        last = found.contact.upper;
        one = time_of_impact(pair.a, pair.b, pair.pose, pair.of_a, pair.of_b, last);
      }
      certificate.pairs.push_back(
          {{i, part.number}, last, one, certify(pair.a, pair.b, pair.pose, pair.of_a, pair.of_b, one, last)});
    }
  }
  return certificate;
}

template <class B>
std::string fault_of(const Compound& a, const B& b, const Pose& a_from_b, const RigidMotion& motion_a,
                     const RigidMotion& motion_b, const CompoundContact& claimed,
                     const CompoundContactCertificate& certificate, double until) {
  const FirstContact& of_union = claimed.contact;
  const Outcome outcome = of_union.verdict.outcome;
  const PartPair told{claimed.part_a, claimed.part_b};
  const double end = horizon(claimed, until);
  const bool meets = outcome == Outcome::overlap;
  // Of a claim that begins with the start nothing is said of others.
  const bool is_told_enough = meets && end == 0.0;
  if (!(outcome == Outcome::undecided && end == 0.0) &&
      !are_the_pairs(certificate, a.size(), n_parts(b), is_told_enough ? &told : nullptr)) {
    return "not every pair has a proof";
  }
  const std::vector<MovingPart> parts_b = moving_parts(b, a_from_b, turns(motion_b));
  const auto pair_of = [&](const PartPair& parts) {
    return moving_pair(a, parts.a, parts_b[parts.b], motion_a, motion_b);
  };
  for (const auto& [parts, last, found, proof] : certificate.pairs) {
    const MovingPair pair = pair_of(parts);
    const CertificateCheck check =
        check_certificate(pair.a, pair.b, pair.pose, pair.of_a, pair.of_b, found, proof, last);
    if (!check.is_proven) return check.fault;
    const bool is_free = found.verdict.outcome == Outcome::disjoint ? last >= end : found.lower >= end;
    if (!is_free || (outcome == Outcome::disjoint && found.verdict.outcome != Outcome::disjoint)) {
      return "a pair may meet before";
    }
  }
  if (!meets) return {};
  const auto* const of_told = of_parts(certificate, told);
  if (of_told == nullptr || of_told->found.verdict.outcome != Outcome::overlap ||
      !(of_told->found.upper <= of_union.upper && of_union.upper <= until)) {
    return "the contact is not proven";
  }
  if (!(of_union.lower <= of_union.time && of_union.time <= of_union.upper)) {
    return "the time is not between its bounds";
  }
  const MovingPair pair = pair_of(told);
  const double size = pair.a.circumradius() + pair.b.circumradius();
  const double moving = safe_norm(pair.of_a.velocity) + safe_norm(pair.of_b.velocity) +
                        safe_norm(pair.of_a.angular_velocity) * pair.a.reach() +
                        safe_norm(pair.of_b.angular_velocity) * pair.b.reach();
  const double near = 1e-8 * size + 2.0 * moving * (of_union.upper - of_union.lower);
  return is_as_told(of_union, seen_by_compounds(of_told->found, pair), near) ? ""
                                                                             : "the points are not those of the parts";
}

}  // namespace

CompoundCertificate certify(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                            const CompoundSeparation& found) {
  return certificate_of(a, b, a_from_b, found);
}
CompoundCertificate certify(const Compound& a, const Compound& b, const Pose& a_from_b,
                            const CompoundSeparation& found) {
  return certificate_of(a, b, a_from_b, found);
}
CompoundContactCertificate certify(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& found, double until) {
  return certificate_of(a, b, a_from_b, motion_a, motion_b, found, until);
}
CompoundContactCertificate certify(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& found, double until) {
  return certificate_of(a, b, a_from_b, motion_a, motion_b, found, until);
}
CompoundOnPlaneCertificate certify(const HalfSpace& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& /*found*/) {
  CompoundOnPlaneCertificate certificate;
  for (std::size_t part = 0; part < b.size(); ++part) {
    const Pose pose = b.frame_from_part(part, a_from_b);
    certificate.found.push_back(signed_distance(a, b.body(part), pose));
    certificate.proofs.push_back(certify(a, b.body(part), pose, certificate.found.back()));
  }
  return certificate;
}

CertificateCheck check_certificate(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundCertificate& certificate) {
  return proven_unless(fault_of(a, b, a_from_b, claimed, certificate));
}
CertificateCheck check_certificate(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundCertificate& certificate) {
  return proven_unless(fault_of(a, b, a_from_b, claimed, certificate));
}
CertificateCheck check_certificate(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& claimed, const CompoundContactCertificate& certificate,
                                   double until) {
  return proven_unless(fault_of(a, b, a_from_b, motion_a, motion_b, claimed, certificate, until));
}
CertificateCheck check_certificate(const Compound& a, const Compound& b, const Pose& a_from_b,
                                   const RigidMotion& motion_a, const RigidMotion& motion_b,
                                   const CompoundContact& claimed, const CompoundContactCertificate& certificate,
                                   double until) {
  return proven_unless(fault_of(a, b, a_from_b, motion_a, motion_b, claimed, certificate, until));
}

CertificateCheck check_certificate(const HalfSpace& a, const Compound& b, const Pose& a_from_b,
                                   const CompoundSeparation& claimed, const CompoundOnPlaneCertificate& certificate) {
  if (certificate.found.size() != b.size() || certificate.proofs.size() != b.size()) {
    return proven_unless("not every part has a proof");
  }
  const Separation& of_union = claimed.separation;
  const Outcome outcome = of_union.verdict.outcome;
  bool meets = false;
  for (std::size_t part = 0; part < b.size(); ++part) {
    const Separation& found = certificate.found[part];
    CertificateCheck check =
        check_certificate(a, b.body(part), b.frame_from_part(part, a_from_b), found, certificate.proofs[part]);
    if (!check.is_proven) return check;
    meets = meets || found.verdict.outcome == Outcome::overlap;
    if (outcome == Outcome::disjoint && found.verdict.outcome != Outcome::disjoint) {
      return proven_unless("a part may overlap");
    }
    if (!(found.lower >= of_union.lower)) return proven_unless("a part may be lower than the lower bound");
  }
  if (outcome == Outcome::overlap && !meets) return proven_unless("that a part overlaps is not proven");
  if (!(of_union.lower <= of_union.signed_distance && of_union.signed_distance <= of_union.upper)) {
    return proven_unless("the value is not between its bounds");
  }
  if (claimed.part_b >= b.size() || !(certificate.found[claimed.part_b].upper <= of_union.upper)) {
    return proven_unless("the upper bound is not proven");
  }
  const double near = 1e-9 * b.body(claimed.part_b).circumradius();
  const bool is_told = !of_union.has_witnesses || is_as_told(of_union, certificate.found[claimed.part_b], near);
  return proven_unless(is_told ? "" : "the points are not those of the part");
}

}  // namespace vex
