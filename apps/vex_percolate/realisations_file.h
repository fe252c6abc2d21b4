// All realisations of a run, as a file that --resume reads.
#pragma once

#include <string>

#include "apps/vex_percolate/percolate_run.h"

namespace vex {

/// What must be equal in two runs for one to go on from the other, lines of `# key: value`; then the numbers of each
/// realisation, as CSV: size,realisation,x,y,z; and a last line `# end, crc32 XXXXXXXX`, of all lines before it.
std::string realisations_text(const PercolateRun& run);

/// Adds what the file holds to the run. Throws InputError where it is of another system, or damaged.
void resume_from(const std::string& path, PercolateRun& run);

}  // namespace vex
