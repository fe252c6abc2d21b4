#include "apps/common/body_options.h"

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"

namespace vex {

void declare_body_options(OptionParser& options, BodyWords& words) {
  const std::string bodies = "Bodies";
  options.add_flag("--unit-volume", words.unit_volume, "Scale every body to V = 1 about the origin").group(bodies);
  options.add_option("--scale", words.scale, "Scale every body about the origin (after --unit-volume)")
      .type_name("X")
      .group(bodies);
  options
      .add_flag("--hull", words.hull,
                "Take the convex hull of whatever a mesh file holds: not convex, several parts, or points alone")
      .group(bodies);
  options
      .add_option("--convex-tolerance", words.convex_tolerance,
                  "How far from convex a mesh may be, relative to its size (default 1e-6)")
      .type_name("X")
      .group(bodies);
  options
      .add_flag("--dump-vertices", words.dump_vertices,
                "List a polytope's vertices in hexadecimal: they are the body, exactly")
      .group(bodies);
}

BodyOptions interpret_bodies(const BodyWords& words) {
  BodyOptions options;
  if (!words.convex_tolerance.empty()) {
    options.convex_tolerance = parse_number(words.convex_tolerance, "--convex-tolerance");
    if (options.convex_tolerance < 0.0 || options.convex_tolerance > 0.1) {
      throw UsageError("out of range (\"" + words.convex_tolerance + "\" for --convex-tolerance) - from 0 to 0.1");
    }
  }
  options.hull = words.hull;
  options.unit_volume = words.unit_volume;
  if (!words.scale.empty()) options.scale = parse_positive_number(words.scale, "--scale");
  return options;
}

void require_vertices_to_list(const LoadedBody& a, const LoadedBody& b) {
  if (a.is_polytope() || b.is_polytope()) return;
  throw UsageError("not a polytope, so it has no vertices to list (" + a.source + ") - leave out --dump-vertices");
}

std::string named_bodies_help() {
  std::string text = "Named bodies:";
  for (const NamedShape& shape : named_shapes()) {
    text += "\n  " + std::string(shape.name) + ":" + std::string(shape.parameters) + "  " + std::string(shape.meaning);
  }
  return text;
}

}  // namespace vex
