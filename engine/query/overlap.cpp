#include "engine/query/overlap.h"

#include <optional>

#include "engine/query/exact/exact_overlap.h"
#include "engine/query/exact/exact_witness.h"
#include "engine/query/exact/extended_overlap.h"
#include "engine/query/exact/placed_forms.h"
#include "engine/query/search/overlap_filter.h"
#include "engine/query/search/separation_search.h"
#include "engine/query/separation_with_verdict.h"

namespace vex {
namespace {

// Of bodies without exact forms, at poses like those whose directions are vertices' and edges', the search for a point
// in both may end by rounding, or never, however deep they are in each other: then the distance's bounds tell.
void decide_by_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, int max_support_calls,
                        OverlapAnswer& answer) {
  Separation found;
  search_in_double({a, b, a_from_b, SeparationGoal::signed_distance, {.max_support_calls = max_support_calls}}, nullptr,
                   found);
  answer.n_support_calls += found.n_support_calls;
  // No direction is told: the one that has shown the lower bound need not be the normal.
  if (found.lower > 0.0) answer.verdict = Verdict::disjoint(DecidedBy::gjk);
  if (found.upper < 0.0) answer.verdict = Verdict::overlap(DecidedBy::gjk);
}

// What the filter leaves open goes to the exact forms. `witnesses`: null, or what receives those of an overlap, of one
// that the filter has proven too. `placed`: the forms where they are there already, or null.
OverlapAnswer decide(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, int max_support_calls,
                     const FilterResult& filtered, OverlapCertificate* witnesses, const PlacedForms* placed = nullptr) {
  OverlapAnswer answer{filtered.verdict, filtered.n_support_calls, filtered.separating_dir};
  const bool is_open = answer.verdict.outcome == Outcome::undecided;
  if (!is_open && !(answer.verdict.outcome == Outcome::overlap && witnesses != nullptr)) return answer;
  const std::optional<PlacedForms> made = placed == nullptr ? placed_forms(a, b, a_from_b) : std::nullopt;
  const PlacedForms* const forms = made ? &*made : placed;
  if (forms == nullptr) {
    if (is_open) decide_by_distance(a, b, a_from_b, max_support_calls, answer);
    return answer;
  }
  if (forms->are_rounded_polytopes()) {
    const ExactOverlap exact = exact_overlap(*forms);
    if (is_open) {
      answer.n_support_calls += exact.n_support_calls;
      answer.verdict = exact.overlap ? Verdict::overlap(DecidedBy::exact) : Verdict::disjoint(DecidedBy::exact);
    }
    if (witnesses == nullptr) return answer;
    witnesses->n_witnesses = exact.n_carriers;
    for (int k = 0; k < exact.n_carriers; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      witnesses->witnesses[i] = vertex_witness(*forms, exact.carriers_a[i], exact.carriers_b[i]);
    }
    return answer;
  }
  if (is_open) {
    answer = extended_overlap(*forms, max_support_calls);
    answer.n_support_calls += filtered.n_support_calls;
  }
  if (witnesses != nullptr && answer.verdict.outcome == Outcome::overlap) {
    find_witnesses(*forms, *witnesses,
                   [&] { return check_certificate(a, b, a_from_b, Outcome::overlap, *witnesses).is_proven; });
  }
  return answer;
}

}  // namespace

Verdict overlap(const ConvexBody& a, const ConvexBody& b, const Pose& pose, OverlapCertificate* certificate,
                int max_support_calls) {
  const FilterResult filtered = filter_overlap(a, b, pose.a_from_b(), max_support_calls);
  if (certificate == nullptr) {
    // Nearly all pairs end here, and nothing is made for them but the verdict.
    if (filtered.verdict.outcome != Outcome::undecided) return filtered.verdict;
    return decide(a, b, pose.a_from_b(), max_support_calls, filtered, nullptr).verdict;
  }
  *certificate = {};
  const OverlapAnswer answer = decide(a, b, pose.a_from_b(), max_support_calls, filtered, certificate);
  certificate->separating_dir = answer.separating_dir;
  certificate->separating_dir_low = answer.separating_dir_low;
  certificate->gap_lower = answer.gap_lower;
  certificate->gap_upper = answer.gap_upper;
  certificate->n_support_calls = answer.n_support_calls;
  return answer.verdict;
}

OverlapAnswer overlap_answer(const ConvexBody& a, const ConvexBody& b, const Pose& pose, int max_support_calls) {
  const FilterResult filtered = filter_overlap(a, b, pose.a_from_b(), max_support_calls);
  return decide(a, b, pose.a_from_b(), max_support_calls, filtered, nullptr);
}

OverlapAnswer overlap_answer(const ConvexBody& a, const ConvexBody& b, const PlacedForms& placed) {
  const FilterResult filtered = filter_overlap(a, b, placed.a_from_b, kMaxSupportCalls);
  return decide(a, b, placed.a_from_b, kMaxSupportCalls, filtered, nullptr, &placed);
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
