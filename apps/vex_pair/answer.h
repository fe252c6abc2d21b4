// One pose's answer to any query, and how many there were of each kind.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "apps/vex_pair/query.h"
#include "apps/vex_pair/query_certificate.h"
#include "engine/query/certificate.h"
#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/margin.h"
#include "engine/query/verdict.h"

namespace vex {

struct Answer {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  Verdict verdict;
  int n_support_calls = 0;
  /// Distance, depth, or the time of a contact; the true one is between `lower` and `upper`. What is not finite is
  /// not there. Of an undecided overlap the bounds are those of the gap of the bodies, without the margin.
  double value = kNone, lower = kNone, upper = kNone;
  std::optional<double> signed_distance{};  // where the query is of either sign
  bool is_rough = false;                    // the bounds are farther apart than is usual: Separation::is_rough
  std::optional<Vec3d> normal{}, point_a{}, point_b{};
  /// Which body is hit first; `either` where rounding leaves that open, and then value, normal and points are those of
  /// the one that seems to be first.
  enum class RayHit : std::uint8_t { nothing, a, b, either };
  RayHit ray_hit = RayHit::nothing;
  std::vector<ContactManifold::Contact> contacts{};
  OverlapCertificate certificate{};         // of an overlap query
  QueryCertificate query_certificate{};     // of any other one
  std::optional<CertificateCheck> check{};  // of what is claimed, where it was asked for

  bool is_undecided() const { return verdict.outcome == Outcome::undecided; }
  /// Of a motion: there is contact before anything has moved.
  bool is_at_start() const { return verdict.outcome == Outcome::overlap && upper == 0.0; }
};

/// What `value` is called: distance, depth, parameter or time; nothing of an overlap query.
std::string_view name_of_value(Query query, const Answer& answer);
constexpr std::string_view name_of(Answer::RayHit hit) {
  switch (hit) {
    case Answer::RayHit::a: return "a";
    case Answer::RayHit::b: return "b";
    case Answer::RayHit::either: return "either";
    case Answer::RayHit::nothing: break;
  }
  return "";
}

/// A query of a pair of bodies, ready to be asked of many poses. What does not depend on the pose is done once.
class Question {
 public:
  Question(const ConvexBody& a, const ConvexBody& b, const QuerySettings& settings);

  /// Asks the engine. May be called by many threads; the answer depends on the pose alone. Throws InputError where a
  /// number of the pose, or one of the answer, is beyond what can be told. No 0 of an answer has a sign.
  Answer answer(const Transformd& a_from_b) const;

 private:
  Answer answer_of_query(const Transformd& a_from_b) const;
  Answer overlap_answer(const Transformd& a_from_b) const;
  Answer overlap_of(const WidenedPair& pair, const Transformd& a_from_b) const;
  Answer separation_answer(const Separation& found) const;
  Answer ray_answer(const Transformd& a_from_b) const;
  Answer impact_answer(const Transformd& a_from_b) const;
  template <class Motion>
  Answer contact_answer_of(const FirstContact& found, const Transformd& a_from_b, const Motion& motion) const;

  QuerySettings settings_;
  ConvexBody a_, b_;
  MarginPairs with_margin_;                    // where the query is an overlap
  std::optional<ConvexBody> ray_origin_body_;  // a point
  FirstContact ray_on_a_;
};

/// Of a stream of answers.
struct Counts {
  std::uint64_t n_rows = 0;     // answered or refused
  std::uint64_t n_refused = 0;  // bad rows
  std::uint64_t n_disjoint = 0, n_overlap = 0, n_undecided = 0;
  std::array<std::uint64_t, kNDecidedBy> decided_by{};
  std::uint64_t n_reproven = 0, n_not_reproven = 0;
  /// Of all values, with their sign where the query is of either.
  double smallest = std::numeric_limits<double>::infinity(), largest = -std::numeric_limits<double>::infinity();

  void add(const Answer& answer);
  void add_refused();
  void add(const Counts& others);
};

}  // namespace vex
