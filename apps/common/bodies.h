// The bodies that a command line names: mesh files and named shapes, rounded and scaled as asked for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"

namespace vex {

/// What the command line wants of every body.
struct BodyOptions {
  std::optional<double> convex_tolerance{};  // of meshes, as in MeshOptions, and so the next three
  std::optional<double> weld{};
  std::string unit{};
  std::string format{};  // of standard input, where that is one of the bodies; otherwise of every mesh file
  bool reads_standard_input = false;           // one of the bodies is "-"
  bool hull = false;                           // of meshes: the convex hull of whatever the file holds
  bool require_confinement = false;            // of meshes: as in MeshOptions
  bool unit_volume = false;                    // scale to V = 1 about the origin ...
  double scale = 1.0;                          // ... and then by this
  std::optional<double> scale_a{}, scale_b{};  // of two bodies: where given, instead of `scale`
  bool with_measures = true;  // V, S and M must be finite: sizes of named bodies are kMeasuredSizes, or kQueriedSizes

  /// For one of two bodies.
  BodyOptions of_a() const { return with_scale(scale_a.value_or(scale)); }
  BodyOptions of_b() const { return with_scale(scale_b.value_or(scale)); }

 private:
  BodyOptions with_scale(double factor) const {
    BodyOptions options = *this;
    options.scale = factor;
    return options;
  }
};

struct LoadedBody {
  std::string source;                // as the user wrote it
  Body shape;                        // rounded and scaled
  double scale = 1.0;                // what every length was multiplied by
  std::optional<MeshReport> mesh{};  // of a mesh file; what was rounded is its core

  /// Whether it is the convex hull of the vertices that `vertices_of` gives.
  bool is_polytope() const { return !vertices_of(shape.body).empty(); }
};

/// `text`: a named shape (`box:1,2,3`), the path of a mesh, "-" for a mesh on standard input, `hull:` or `points:` and
/// the path of a file whose points' convex hull is meant, or `rounded:r,` and one of these. Throws UsageError or InputError.
LoadedBody load_body(const std::string& text, const BodyOptions& options);

/// A with `options.of_a()` and B with `options.of_b()`. A mesh that is both is read once. Throws besides InputError
/// where the files of both state their units, unlike ones, and nothing says how they are to meet: neither --unit nor
/// --unit-volume, --scale-a or --scale-b.
std::pair<LoadedBody, LoadedBody> load_two_bodies(const std::string& a, const std::string& b,
                                                  const BodyOptions& options);

/// Numbers of millimetres and of metres side by side would give a result that is neither's. Throws InputError where the
/// files of two meshes state unlike units and no option says how they are to meet; `or_else` is advice besides --unit.
void require_one_unit(std::span<const LoadedBody> bodies, const BodyOptions& options, const std::string& or_else = "");

/// Whether they are copies of one body: of the same text, in the same size.
bool are_copies(const LoadedBody& a, const LoadedBody& b);

/// Whether the text names a mesh, on standard input too, and not a shape; a shape that is mistyped (`spher:1`) is none.
/// Throws UsageError where `rounded:r,` is malformed.
bool names_a_mesh(const std::string& text);

/// The file that the text names, without `rounded:r,`, `hull:` and `points:` before it; "-" for standard input; the text itself where it names
/// none.
std::string file_named_by(const std::string& text);

/// All files that loading these bodies reads: the meshes, what a reader opens beside them (the buffers of a .gltf),
/// and "-" where standard input is one of them.
std::vector<std::string> files_of_bodies(std::span<const std::string> bodies, const BodyOptions& options);

}  // namespace vex
