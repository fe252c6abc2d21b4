// The command line of vex_percolate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/body_options.h"
#include "apps/common/checkpoint.h"
#include "apps/common/common_options.h"
#include "engine/query/overlap_backend.h"
#include "engine/sampling/percolation/placements.h"

namespace vex {

/// The words of the command line, as they stand.
struct PercolateCommandLine : CommonWords, BodyWords, CheckpointWords {
  std::vector<std::string> bodies;
  std::string sizes, realisations, first_realisation, std_error, seconds, orientations, axis, shell, backend, isa;
  std::string plot, csv, gltf, report;
};

/// Declares the options; parsing fills `words`, which must outlive `options`.
void declare_options(OptionParser& options, PercolateCommandLine& words);

/// A body of the command line and its part of the number of bodies.
struct BodyFraction {
  std::string text;
  double fraction = 1.0;
};

/// BODY or BODY:FRACTION: what stands behind the last colon is a fraction where it is a number and a body stands before
/// it.
struct BodyText {
  std::string text;
  std::optional<double> fraction;
};
BodyText body_and_fraction(const std::string& word);

/// What the words mean.
struct PercolateOptions : CommonOptions {
  std::vector<BodyFraction> bodies;
  BodyOptions body_options;
  std::vector<double> sizes;  // ascending, in units of the largest body's extent
  std::optional<std::uint64_t> realisations;
  std::uint32_t first_realisation = 0;
  bool is_part = false;  // whether the document has the realisations, for vex_merge
  std::optional<double> std_error, seconds;
  BodyOrientations orientations;
  std::vector<std::string> law_files;  // that the law is read from
  std::string law;
  double shell = 0.0;
  std::optional<BackendKind> backend;  // none: the engine, by packets
  std::string backend_name;
  InstructionSet instruction_set = best_instruction_set();
  bool dump_vertices = false;
  std::string plot, csv, gltf, report;
  CheckpointOptions checkpoint;
};

/// Throws UsageError where a word means nothing.
PercolateOptions interpret(const PercolateCommandLine& words);

}  // namespace vex
