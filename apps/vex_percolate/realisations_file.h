// All realisations of a run, as a file that --resume reads, and as a part of a document that vex_merge reads.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/vex_percolate/percolate_run.h"

namespace vex {

/// What must be equal in two runs for one to go on from the other, or to be put together with it: lines of
/// `# key: value`.
std::vector<std::string> system_lines(const PercolateRun& run);

/// These, and of a part of a run its first realisation; then the numbers of each realisation, as CSV:
/// size,realisation,x,y,z; and a last line `# end, crc32 XXXXXXXX`, of all lines before it.
std::string realisations_text(const PercolateRun& run);
std::string realisations_text(const PercolateRun& run, std::span<const std::string> of);

/// Adds what the file holds to the run. Throws InputError where it is of another system, or damaged.
void resume_from(const std::string& path, PercolateRun& run);
/// The same of a text in lines that a document holds; `name` is said in messages, `of` what system_lines should be.
void read_realisations(const std::string& name, std::span<const std::string> lines, std::span<const std::string> of,
                       PercolateRun& run);

}  // namespace vex
