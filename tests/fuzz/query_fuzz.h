// Queries of bodies that lie: support mappings that break their contract, in every way that bytes can choose. Answers
// may be wrong then (support_mapping.h), but there is one, soon, and nothing else happens.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "reader_fuzz.h"

namespace vex::tests {

/// No query asks bodies for more points than this, whatever they say; nor does a search for a certificate, which is
/// slow, for more than ten times as many.
inline constexpr std::uint64_t kMostPointsOfAQuery = 1'000'000;

/// The most points that a query has asked for so far, and which query.
struct MostAsked {
  std::uint64_t n_points = 0;
  const char* query = "none";
};
MostAsked most_asked();

/// Two bodies, a pose and a query, all of these bytes. Throws std::logic_error where a promise is broken.
void query_liars(std::string_view bytes);

/// "query".
std::vector<FuzzFormat> query_formats();

}  // namespace vex::tests
