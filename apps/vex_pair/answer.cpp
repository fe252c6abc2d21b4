#include "apps/vex_pair/answer.h"

#include "engine/query/overlap.h"

namespace vex {

Answer answer(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, bool with_check) {
  Answer result;
  result.verdict = overlap(a, b, a_from_b, &result.certificate, kMaxSupportCalls,
                           with_check ? CertificateDetail::full : CertificateDetail::no_witnesses);
  if (with_check && result.verdict.outcome != Outcome::undecided) {
    result.check = check_certificate(a, b, a_from_b, result.verdict.outcome, result.certificate);
  }
  return result;
}

void Counts::add(const Answer& answer) {
  ++n_rows;
  switch (answer.verdict.outcome) {
    case Outcome::disjoint: ++n_disjoint; break;
    case Outcome::overlap: ++n_overlap; break;
    case Outcome::undecided: ++n_undecided; break;
  }
  if (answer.verdict.outcome != Outcome::undecided) ++decided_by[static_cast<std::size_t>(answer.verdict.by)];
  if (answer.check) ++(answer.check->is_proven ? n_reproven : n_not_reproven);
}

void Counts::add_refused() {
  ++n_rows;
  ++n_refused;
}

void Counts::add(const Counts& others) {
  n_rows += others.n_rows;
  n_refused += others.n_refused;
  n_disjoint += others.n_disjoint;
  n_overlap += others.n_overlap;
  n_undecided += others.n_undecided;
  for (std::size_t k = 0; k < decided_by.size(); ++k) decided_by[k] += others.decided_by[k];
  n_reproven += others.n_reproven;
  n_not_reproven += others.n_not_reproven;
}

}  // namespace vex
