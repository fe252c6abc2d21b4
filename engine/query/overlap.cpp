#include "engine/query/overlap.h"

#include <functional>

#include "engine/query/exact/exact_overlap.h"
#include "engine/query/exact/extended_overlap.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/search/overlap_filter.h"

namespace vex {
namespace {

Witness witness_of(const PlacedForms& forms, const ExactOverlap& exact, int k) {
  const auto index = static_cast<std::size_t>(k);
  return {{}, {}, {}, {}, forms.a.points[exact.carriers_a[index]], forms.b.points[exact.carriers_b[index]]};
}

// What the filter left open, and the witnesses of what it did not.
Verdict decide_by_forms(const PlacedForms& forms, const Verdict& filtered, OverlapCertificate* certificate,
                        bool wants_witnesses, int& n_support_calls, int max_support_calls,
                        const std::function<bool()>& is_proof) {
  const bool is_open = filtered.outcome == Outcome::undecided;
  if (forms.are_rounded_polytopes()) {
    const ExactOverlap exact = exact_overlap(forms);
    if (is_open) n_support_calls += exact.n_support_calls;
    if (wants_witnesses) {
      certificate->n_witnesses = exact.n_carriers;
      for (int k = 0; k < exact.n_carriers; ++k) {
        certificate->witnesses[static_cast<std::size_t>(k)] = witness_of(forms, exact, k);
      }
    }
    if (!is_open) return filtered;
    return exact.overlap ? Verdict::overlap(DecidedBy::exact) : Verdict::disjoint(DecidedBy::exact);
  }
  Verdict verdict = filtered;
  if (is_open) {
    const ExtendedOverlap found = extended_overlap(forms, certificate, max_support_calls);
    n_support_calls += found.n_support_calls;
    verdict = found.verdict;
  }
  if (wants_witnesses && verdict.outcome == Outcome::overlap) {
    find_witnesses(forms, *certificate, is_proof);
  }
  return verdict;
}

}  // namespace

Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Pose& pose, OverlapCertificate* certificate,
                int max_support_calls, CertificateDetail detail) {
  const Transformd& a_from_b = pose.a_from_b();
  FilterResult found = filter_overlap(a, b, a_from_b, max_support_calls);
  Verdict verdict = found.verdict;
  if (certificate != nullptr) {
    *certificate = {};
    certificate->separating_dir = found.separating_dir;
  }
  const bool wants_witnesses = certificate != nullptr && detail == CertificateDetail::full;
  if (verdict.outcome == Outcome::undecided || (verdict.outcome == Outcome::overlap && wants_witnesses)) {
    if (const std::optional<PlacedForms> forms = placed_forms(a, b, a_from_b)) {
      verdict =
          decide_by_forms(*forms, verdict, certificate, wants_witnesses, found.n_support_calls, max_support_calls,
                          [&] { return check_certificate(a, b, a_from_b, Outcome::overlap, *certificate).is_proven; });
    }
  }
  if (certificate != nullptr) certificate->n_support_calls = found.n_support_calls;
  return verdict;
}

CertificateCheck prove_again(const ConvexBody& a, const ConvexBody& b, const Pose& pose, Outcome claimed) {
  const Transformd& a_from_b = pose.a_from_b();
  OverlapCertificate certificate;
  const Verdict verdict = overlap(a, b, pose, &certificate);
  if (verdict.outcome != claimed) {
    return {false,
            "the engine says " + std::string(name_of(verdict.outcome)) + ", not " + std::string(name_of(claimed))};
  }
  return check_certificate(a, b, a_from_b, claimed, certificate);
}

}  // namespace vex
