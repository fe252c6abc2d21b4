// One pose's answer, and how many there were of each kind.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/query/certificate.h"
#include "engine/query/verdict.h"

namespace vex {

struct Answer {
  Verdict verdict;
  OverlapCertificate certificate;
  std::optional<CertificateCheck> check{};  // of a verdict that was proven, where it was asked for
};

/// Asks the engine; `with_check` proves its answer again from the certificate.
Answer answer(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, bool with_check);

/// Of a stream of answers.
struct Counts {
  std::uint64_t n_rows = 0;     // answered or refused
  std::uint64_t n_refused = 0;  // bad rows
  std::uint64_t n_disjoint = 0, n_overlap = 0, n_undecided = 0;
  std::array<std::uint64_t, kNDecidedBy> decided_by{};
  std::uint64_t n_reproven = 0, n_not_reproven = 0;

  void add(const Answer& answer);
  void add_refused();
  void add(const Counts& others);
};

}  // namespace vex
