// The command line of vex_pair.
#pragma once

#include <optional>
#include <string>

#include "apps/common/body_options.h"
#include "apps/common/common_options.h"
#include "apps/vex_pair/query_options.h"
#include "apps/vex_pair/row_text.h"

namespace vex {

/// The words of the command line, as they stand.
struct PairCommandLine : CommonWords, BodyWords, QueryWords {
  std::string a, b;
  std::string matrix, rotation, translation, poses;
  bool keep_going = false, jsonl = false, csv = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, PairCommandLine& words);

/// What the words mean.
struct PairOptions : CommonOptions {
  std::string a, b;
  BodyOptions bodies;
  bool dump_vertices = false;
  std::optional<Transformd> pose;  // one; or else:
  std::string poses;               // a file of them, or "-"
  QuerySettings query;
  RowLayout layout;
  bool keep_going = false;
};

/// Throws UsageError where a word means nothing; InputError where the one pose is none, or a number is out of range.
PairOptions interpret(const PairCommandLine& words);

}  // namespace vex
