#include "apps/common/body_options.h"

#include <algorithm>
#include <cmath>

#include "apps/common/choices.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

const char* const kGroup = "Bodies";

// A fraction of the size of a mesh. More than a tenth of it is no rounding of coordinates.
double fraction_of_size(const std::string& word, const char* option) {
  const double value = parse_number(word, option);
  if (value < 0.0 || value > 0.1) {
    throw UsageError("out of range (\"" + word + "\" for " + option + ") - from 0 to 0.1");
  }
  return value;
}

// Of one body of two, that of both included.
std::optional<double> scale_of_one(double of_both, const std::string& word, const char* option) {
  if (word.empty()) return std::nullopt;
  const double scale = of_both * parse_positive_number(word, option);
  if (!std::isfinite(scale) || scale == 0.0) {
    throw UsageError("out of range (--scale times \"" + word + "\" for " + option + ") - give one factor");
  }
  return scale;
}

// Only one can be read from there.
void require_one_standard_input(std::size_t n_bodies, const std::string& poses) {
  if (n_bodies > 1) {
    throw UsageError("standard input is wanted for " + std::to_string(n_bodies) +
                     " bodies (-) - leave out B where it is the same body, or give files");
  }
  if (n_bodies == 1 && poses == "-") {
    throw UsageError("standard input is wanted for a body and for --poses (-) - give one of them as a file");
  }
}

}  // namespace

void declare_body_options(OptionParser& options, BodyWords& words) {
  options.add_flag("--unit-volume", words.unit_volume, "Scale every body to V = 1 about the origin").group(kGroup);
  options.add_option("--scale", words.scale, "Scale every body about the origin (after --unit-volume)")
      .type_name("X")
      .group(kGroup);
  options
      .add_option("--unit", words.unit,
                  "Convert every mesh file to this unit of length: m, cm, mm, um, nm or in; refused for a file that "
                  "does not state its own")
      .type_name("UNIT")
      .group(kGroup);
  options
      .add_flag("--hull", words.hull,
                "Take the convex hull of whatever a mesh file holds: not convex, several parts, or points alone")
      .group(kGroup);
  options
      .add_option("--convex-tolerance", words.convex_tolerance,
                  "How far from convex a mesh may be, relative to its size (default 1e-6, or the rounding of its "
                  "coordinates where that is coarser)")
      .type_name("X")
      .group(kGroup);
  options
      .add_option(
          "--weld", words.weld,
          "Take vertices of a mesh for one where they are no farther apart than this, relative to its size (default: "
          "equal ones, and if that leaves the surface open, those that the rounding of the coordinates explains)")
      .type_name("X")
      .group(kGroup);
  options
      .add_option("--format", words.format,
                  "The format, as an extension like stl, of standard input; where no body is -, of every mesh file, "
                  "whatever its name")
      .type_name("EXT")
      .group(kGroup);
  options
      .add_flag("--require-confinement", words.require_confinement,
                "Refuse a mesh file whose reader (of .gltf .glb .dae .3mf ...) cannot be confined on this system, "
                "instead of saying so")
      .group(kGroup);
  options
      .add_flag("--dump-vertices", words.dump_vertices,
                "List a polytope's vertices in hexadecimal: they are the body, exactly")
      .group(kGroup);
}

void declare_options_of_two_bodies(OptionParser& options, BodyWords& words) {
  declare_body_options(options, words);
  options.add_option("--scale-a", words.scale_a, "Scale A about the origin, besides --scale")
      .type_name("X")
      .group(kGroup);
  options
      .add_option("--scale-b", words.scale_b,
                  "Scale B about the origin, besides --scale; where B is A again, that copy alone")
      .type_name("X")
      .group(kGroup);
}

BodyOptions interpret_bodies(const BodyWords& words, std::span<const std::string> bodies, const std::string& poses) {
  BodyOptions options;
  if (!words.convex_tolerance.empty()) {
    options.convex_tolerance = fraction_of_size(words.convex_tolerance, "--convex-tolerance");
  }
  if (!words.weld.empty()) options.weld = fraction_of_size(words.weld, "--weld");
  if (!words.unit.empty()) require_one_of(words.unit, "--unit", {"m", "cm", "mm", "um", "nm", "in"});
  options.unit = words.unit;
  options.format = words.format;
  options.hull = words.hull;
  options.require_confinement = words.require_confinement;
  options.unit_volume = words.unit_volume;
  if (!words.scale.empty()) options.scale = parse_positive_number(words.scale, "--scale");
  options.scale_a = scale_of_one(options.scale, words.scale_a, "--scale-a");
  options.scale_b = scale_of_one(options.scale, words.scale_b, "--scale-b");

  std::size_t n_meshes = 0, n_on_standard_input = 0;
  for (const std::string& body : bodies) {
    if (!names_a_mesh(body)) continue;
    ++n_meshes;
    if (file_named_by(body) == "-") ++n_on_standard_input;
  }
  require_one_standard_input(n_on_standard_input, poses);
  options.reads_standard_input = n_on_standard_input > 0;
  if (options.reads_standard_input && options.format.empty()) {
    throw UsageError(
        "standard input has no extension that tells its format (-) - add --format EXT, such as --format stl");
  }
  if (n_meshes == 0) {
    const std::string named = bodies.empty() ? "" : " with " + bodies.front();
    if (!words.unit.empty()) {
      throw UsageError("no body is a mesh file, whose unit could be converted (--unit " + words.unit + named +
                       ") - leave it out, and give sizes in that unit");
    }
    if (!words.format.empty()) {
      throw UsageError("no body is a mesh file (--format " + words.format + named + ") - leave it out");
    }
  }
  return options;
}

void require_vertices_to_list(const LoadedBody& a, const LoadedBody& b) {
  if (a.is_polytope() || b.is_polytope()) return;
  throw UsageError("not a polytope, so it has no vertices to list (" + a.source + ") - leave out --dump-vertices");
}

void require_vertices_to_list(std::span<const LoadedBody> bodies) {
  if (bodies.empty() || std::ranges::any_of(bodies, &LoadedBody::is_polytope)) return;
  require_vertices_to_list(bodies.front(), bodies.front());
}

std::string named_bodies_help() {
  std::string text = "Named bodies:";
  for (const NamedShape& shape : named_shapes()) {
    text += "\n  " + std::string(shape.name) + ":" + std::string(shape.parameters) + "  " + std::string(shape.meaning);
  }
  text +=
      "\n  hull:FILE  the convex hull of all points of a mesh file: --hull for this body alone"
      "\n  points:FILE  the same; a file whose name tells no format is read as text, three numbers a line";
  return text;
}

}  // namespace vex
