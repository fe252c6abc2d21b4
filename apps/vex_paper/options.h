// The command line of vex_paper.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/common/common_options.h"

namespace vex {

/// The words of the command line, as they stand.
struct PaperCommandLine : CommonWords {
  std::vector<std::string> tables;
  std::string trials;
  bool text = false, erratum = false, curve = false, referees = false;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, PaperCommandLine& words);

/// What the words mean.
struct PaperOptions : CommonOptions {
  bool table_1 = false, table_2 = false, text = false, erratum = false, curve = false, referees = false;
  std::uint64_t trials = 0;  // a row
};

/// Throws UsageError where a word means nothing. Without a part named: everything but the curve and the referees.
PaperOptions interpret(const PaperCommandLine& words);

}  // namespace vex
