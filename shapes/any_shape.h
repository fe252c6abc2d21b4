// A body named by a text: `box:1,2,3`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/support/convex_body.h"
#include "shapes/measures.h"

namespace vex {

/// A body as the sampler sees it, and beside it, never mixed with it, its measures as the formula sees them.
struct MeasuredBody {
  std::string kind;  // sphere, box, ...; polyhedron for a mesh
  ConvexBody body;
  Measures measures;
};

/// One line of the list of named bodies.
struct NamedShape {
  std::string_view name;
  std::string_view parameters;  // as the user writes them: "A,B,C"
  std::string_view meaning;
};

/// Every body that `parse_shape` can make, in the order of the documentation.
std::vector<NamedShape> named_shapes();

/// Whether the text is meant as a named body: what stands before the first colon is the name of one, built or planned.
bool names_a_shape(std::string_view text);

/// The body that the text names. Throws UsageError where the text is malformed or the body is not built yet, InputError
/// where a size is zero, negative, not finite, or beyond what the engine's rounding bounds cover.
MeasuredBody parse_shape(std::string_view text);

/// The smallest and largest size that the engine takes: a product of six lengths must neither over- nor underflow.
inline constexpr double kSmallestSize = 1e-45;
inline constexpr double kLargestSize = 1e45;

/// Throws InputError where the body, or a coordinate of it, is out of that range; `source` names it in the message.
void require_size_in_range(const ConvexBody& body, const Measures& measures, std::string_view source);

}  // namespace vex
