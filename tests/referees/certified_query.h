// One query of a scene, and whether the exact checker accepts the certificate of what it answered.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "tests/referees/query_strata.h"

namespace vex {

enum class CertifiedQuery { overlap, signed_distance, distance, depth, ray, cast, impact, manifold };
inline constexpr std::array kCertifiedQueries = {CertifiedQuery::overlap,  CertifiedQuery::signed_distance,
                                                 CertifiedQuery::distance, CertifiedQuery::depth,
                                                 CertifiedQuery::ray,      CertifiedQuery::cast,
                                                 CertifiedQuery::impact,   CertifiedQuery::manifold};
std::string_view name_of(CertifiedQuery query);

struct CertifiedAnswer {
  Outcome outcome = Outcome::undecided;
  double seconds = 0.0;  // the query alone
  int n_support_calls = 0;
  double width = 0.0;  // of the bounds, of R_A + R_B, or of the time in which the bodies move by that
  std::string fault;   // what is not proven; empty where all is, as of an undecided answer that claims nothing
};

CertifiedAnswer ask(const QueryScene& scene, CertifiedQuery query);

}  // namespace vex
