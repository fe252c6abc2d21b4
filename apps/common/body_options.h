// The options that every program with bodies on its command line has.
#pragma once

#include <span>
#include <string>

#include "apps/common/bodies.h"
#include "apps/common/option_parser.h"

namespace vex {

/// The words of the command line, as they stand.
struct BodyWords {
  std::string convex_tolerance, weld, unit, format, scale, scale_a, scale_b;
  bool hull = false, unit_volume = false, dump_vertices = false, require_confinement = false;
};

/// What --help calls the argument that is a body.
inline constexpr const char* kBodyHelp =
    "A mesh file (.obj .stl .ply .off .gltf .glb .dae .3mf ...), - for standard input, or a named body such as "
    "box:1,2,3";

/// --unit-volume, --scale, --unit, --hull, --convex-tolerance, --weld, --format, --require-confinement and
/// --dump-vertices.
void declare_body_options(OptionParser& options, BodyWords& words);

/// The same, and --scale-a and --scale-b, for programs with a body A and a body B.
void declare_options_of_two_bodies(OptionParser& options, BodyWords& words);

/// `bodies`: the texts of all bodies of the command line, each as often as it is written there. `poses`: the value of
/// --poses, where there is that option. Throws UsageError where a word means nothing, where standard input is wanted
/// twice or has no --format, and where --unit or --format are given although no body is a mesh. (--hull,
/// --convex-tolerance, --weld and --require-confinement ask for something that a named body fulfils as it is.)
BodyOptions interpret_bodies(const BodyWords& words, std::span<const std::string> bodies,
                             const std::string& poses = "");

/// For --dump-vertices: throws UsageError where no body has vertices.
void require_vertices_to_list(const LoadedBody& a, const LoadedBody& b);
void require_vertices_to_list(std::span<const LoadedBody> bodies);

/// The named bodies with their sizes, as --help lists them.
std::string named_bodies_help();

}  // namespace vex
