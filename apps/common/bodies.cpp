#include "apps/common/bodies.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "engine/numeric/errors.h"
#include "meshes/reader.h"
#include "shapes/rounded.h"

namespace vex {
namespace {

constexpr std::string_view kHull = "hull:", kPoints = "points:";

bool is_hull_text(std::string_view text) { return text.starts_with(kHull) || text.starts_with(kPoints); }

/// A text taken apart: BODY, hull:FILE or points:FILE, perhaps behind rounded:r,
struct TextParts {
  double radius = 0.0;
  std::string core;        // a named shape, or the path of a file
  bool hull = false;       // of the file's points
  bool as_points = false;  // as text, where the file's name tells no format
};

TextParts parts_of(const std::string& text) {
  const std::optional<RoundedText> round = parse_rounded(text);
  std::string_view core = round ? round->body : std::string_view(text);
  TextParts parts{round ? round->radius : 0.0, "", false, false};
  if (is_hull_text(core)) {
    parts.hull = true;
    parts.as_points = core.starts_with(kPoints);
    core.remove_prefix(parts.as_points ? kPoints.size() : kHull.size());
    if (core.empty() || names_a_shape(core)) {
      throw UsageError("no file to take the hull of (" + text + ") - write hull:FILE or points:FILE");
    }
  }
  parts.core = core;
  return parts;
}

// `spher:1` and `Sphere:1` are mistyped bodies rather than missing files, and so is `sphere`.
bool looks_like_a_named_shape(const std::string& text) {
  std::error_code error;
  if (std::filesystem::exists(text, error)) return false;
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return names_a_shape(text + ":");
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  };
  return colon > 1 && !is_hull_text(text) && std::ranges::all_of(text.substr(0, colon), is_letter);
}

// `sphere` alone: its sizes are missing.
[[noreturn]] void refuse_without_sizes(const std::string& name) {
  for (const NamedShape& shape : named_shapes()) {
    if (shape.name != name) continue;
    throw UsageError("a body without its sizes (" + name + ") - write " + name + ":" + std::string(shape.parameters) +
                     " (" + std::string(shape.meaning) + ")");
  }
  parse_shape(name + ":");
  throw UsageError("not a body (" + name + ") - name a mesh file or a body with its sizes");
}

// With two bodies on the command line it matters which one is refused. `path`: what the file is called there.
template <class Read>
auto naming_the_file(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    const std::string problem = error.what(), name = path == "-" ? "standard input" : path;
    if (problem.find(name) != std::string::npos) throw;
    throw InputError(name + ": " + problem);
  }
}

double scale_factor(const Measures& measures, const BodyOptions& options, const std::string& text) {
  if (!options.unit_volume) return options.scale;
  if (!std::isfinite(measures.volume)) {
    throw InputError("the volume overflows (" + text + ") - leave out --unit-volume");
  }
  if (measures.volume == 0.0) {
    throw InputError("a flat body has no volume to scale to 1 (" + text + ") - leave out --unit-volume");
  }
  return options.scale / std::cbrt(measures.volume);
}

// Of a text, `rounded:` taken off.
bool is_a_mesh(const std::string& core) { return !names_a_shape(core) && !looks_like_a_named_shape(core); }

// The format to read a file as, whatever its name; empty where its name tells.
std::string format_of(const TextParts& parts, const BodyOptions& options) {
  if (!options.format.empty() && (!options.reads_standard_input || parts.core == "-")) return options.format;
  return parts.as_points && !names_a_mesh_format(parts.core) ? ".txt" : "";
}

// Once for all bodies of a run: the machine is to blame, not a file.
void say_once_that_no_confinement_is_had(const std::string& reason) {
  static std::atomic<bool> is_said{false};
  if (reason.empty() || is_said.exchange(true)) return;
  std::fprintf(stderr,
               "note: the process that reads mesh files is not confined (%s) - its limits on time and memory hold; "
               "--require-confinement refuses such files instead\n",
               reason.c_str());
}

ReadOptions read_options(const TextParts& parts, const BodyOptions& options) {
  return {.format = format_of(parts, options),
          .confining = options.require_confinement ? Confining::required : Confining::as_far_as_possible};
}

// The mesh by these options; from a file, or from what was read of one before.
using MeshSource = std::function<ConvexMesh(const MeshOptions&)>;

LoadedBody loaded_from(const std::string& text, const BodyOptions& options, const MeshSource& mesh_from) {
  const TextParts parts = parts_of(text);
  const std::string& core = parts.core;
  const double radius = parts.radius;
  // From the measures of the core as it stands.
  const auto factor = [&](const Measures& measures) {
    return scale_factor(radius > 0.0 ? parallel_body_measures(measures, radius) : measures, options, text);
  };

  const SizeRange& range = options.with_measures ? kMeasuredSizes : kQueriedSizes;
  if (!parts.hull && looks_like_a_named_shape(core) && core.find(':') == std::string::npos) refuse_without_sizes(core);
  if (!parts.hull && !is_a_mesh(core)) {
    const double scale = factor(parse_shape(core, 1.0, range).measures);
    return {text, parse_shape(text, scale, range), scale};
  }
  double scale = 1.0;
  MeshOptions mesh_options;
  mesh_options.convex_tolerance = options.convex_tolerance;
  mesh_options.weld = options.weld;
  mesh_options.unit = options.unit;
  mesh_options.format = format_of(parts, options);
  mesh_options.hull = options.hull || parts.hull;
  mesh_options.require_confinement = options.require_confinement;
  if (options.unit_volume || options.scale != 1.0) {
    mesh_options.scale = [&](const Measures& measures) { return scale = factor(measures); };
  }
  ConvexMesh mesh = naming_the_file(core, [&] { return mesh_from(mesh_options); });
  MeshReport report = std::move(mesh.report);
  say_once_that_no_confinement_is_had(report.reader_unconfined);
  LoadedBody loaded{text, std::move(mesh), scale, std::move(report)};
  require_size_in_range(loaded.shape.body, loaded.shape.measures, text, range);
  if (radius > 0.0) loaded.shape = rounded(loaded.shape, radius * scale, text, range);
  return loaded;
}

}  // namespace

LoadedBody load_body(const std::string& text, const BodyOptions& options) {
  return loaded_from(text, options,
                     [&](const MeshOptions& mesh_options) { return load(file_named_by(text), mesh_options); });
}

std::pair<LoadedBody, LoadedBody> load_two_bodies(const std::string& a, const std::string& b,
                                                  const BodyOptions& options) {
  const BodyOptions of_a = options.of_a(), of_b = options.of_b();
  if (a == b && of_a.scale != of_b.scale && names_a_mesh(a)) {
    const TextParts parts = parts_of(a);
    const PolygonSoup soup =
        naming_the_file(parts.core, [&] { return read_polygon_soup(parts.core, read_options(parts, options)); });
    const MeshSource mesh_from = [&](const MeshOptions& mesh_options) { return convex_mesh_from(soup, mesh_options); };
    return {loaded_from(a, of_a, mesh_from), loaded_from(b, of_b, mesh_from)};
  }
  LoadedBody loaded_a = load_body(a, of_a);
  if (a == b && of_a.scale == of_b.scale) return {loaded_a, loaded_a};
  LoadedBody loaded_b = load_body(b, of_b);
  require_one_unit(std::array{loaded_a, loaded_b}, options, ", or --scale-b 1 where their numbers meet as they stand");
  return {std::move(loaded_a), std::move(loaded_b)};
}

void require_one_unit(std::span<const LoadedBody> bodies, const BodyOptions& options, const std::string& or_else) {
  if (options.unit_volume || options.scale_a || options.scale_b) return;
  const LoadedBody* first = nullptr;
  for (const LoadedBody& body : bodies) {
    if (!body.mesh || body.mesh->unit.empty()) continue;
    if (first == nullptr) first = &body;
    if (body.mesh->unit == first->mesh->unit) continue;
    throw InputError("two files of different units (" + first->source + " in " + first->mesh->unit + ", " +
                     body.source + " in " + body.mesh->unit + ") - add --unit m (or cm, mm, um, nm, in)" + or_else);
  }
}

bool are_copies(const LoadedBody& a, const LoadedBody& b) { return a.source == b.source && a.scale == b.scale; }

bool names_a_mesh(const std::string& text) {
  const TextParts parts = parts_of(text);
  return parts.hull || is_a_mesh(parts.core);
}

std::string file_named_by(const std::string& text) { return parts_of(text).core; }

std::vector<std::string> files_of_bodies(std::span<const std::string> bodies, const BodyOptions& options) {
  std::vector<std::string> files;
  for (const std::string& body : bodies) {
    const TextParts parts = parts_of(body);
    files.push_back(parts.core);
    if (!parts.hull && !is_a_mesh(parts.core)) continue;
    for (const std::filesystem::path& file : files_read_with(parts.core, format_of(parts, options))) {
      files.push_back(file.string());
    }
  }
  return files;
}

}  // namespace vex
