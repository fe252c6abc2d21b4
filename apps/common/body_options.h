// The options that every program with bodies on its command line has.
#pragma once

#include <string>

#include "apps/common/bodies.h"
#include "apps/common/option_parser.h"

namespace vex {

/// The words of the command line, as they stand.
struct BodyWords {
  std::string convex_tolerance, scale;
  bool hull = false, unit_volume = false, dump_vertices = false;
};

/// --unit-volume, --scale, --hull, --convex-tolerance and --dump-vertices.
void declare_body_options(OptionParser& options, BodyWords& words);

/// Throws UsageError where a word means nothing.
BodyOptions interpret_bodies(const BodyWords& words);

/// For --dump-vertices: throws UsageError where neither body has vertices.
void require_vertices_to_list(const LoadedBody& a, const LoadedBody& b);

/// The named bodies with their sizes, as --help lists them.
std::string named_bodies_help();

}  // namespace vex
