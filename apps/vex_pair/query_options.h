// The options that say what vex_pair asks.
#pragma once

#include <string>

#include "apps/common/option_parser.h"
#include "apps/vex_pair/query.h"

namespace vex {

/// The words of the command line, as they stand.
struct QueryWords {
  std::string query, ray, cast, toi, toi_a, margin, until, max_distance;
  bool certificate = false, four_at_most = false;
};

/// Declares the options below the heading; parsing fills `words`.
void declare_query_options(OptionParser& options, QueryWords& words, const std::string& heading);

/// Throws UsageError where a word means nothing, is missing, or belongs to another query; InputError where a number is
/// not finite, or a direction has no length.
QuerySettings interpret_query(const QueryWords& words);

}  // namespace vex
