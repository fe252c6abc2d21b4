// A body named by a text: `box:1,2,3`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shapes/body.h"

namespace vex {

/// The vertices of a polytope, exactly: it is their convex hull. None for a body with curved parts.
std::vector<Vec3d> vertices_of(const ConvexBody& body);

/// One line of the list of named bodies.
struct NamedShape {
  std::string_view name;
  std::string_view parameters;  // as the user writes them: "A,B,C"
  std::string_view meaning;
};

/// Every body that `parse_shape` can make, in the order of the documentation.
std::vector<NamedShape> named_shapes();

/// Whether the text is meant as a named body: what stands before the first colon is the name of one.
bool names_a_shape(std::string_view text);

/// Sizes that are taken. Where volumes are wanted, a product of six lengths must neither over- nor underflow; for
/// queries alone a length may be what it likes, and V, S and M what comes out, infinite or 0 too.
struct SizeRange {
  double smallest, largest;
  bool needs_measures;
};
inline constexpr SizeRange kMeasuredSizes{1e-45, 1e45, true};
inline constexpr SizeRange kQueriedSizes{1e-150, 1e150, false};

/// The body that the text names, every size of it multiplied by `scale` and rounded. Throws UsageError where the text
/// is malformed, InputError where a size is zero, negative, not finite, or out of the range.
Body parse_shape(std::string_view text, double scale = 1.0, const SizeRange& range = kMeasuredSizes);

/// `rounded:r,BODY`, taken apart. BODY is the text of any body, also of one that only the caller can make (a mesh
/// file); where it is rounded itself the radii add up, as the parallel bodies do.
struct RoundedText {
  double radius = 0.0;
  std::string_view body;
};

/// Nothing where the text does not begin with `rounded:`. Throws as `parse_shape` does.
std::optional<RoundedText> parse_rounded(std::string_view text);

/// The body with a ball of this radius about each of its points. `source` names it in messages.
Body rounded(const Body& body, double radius, std::string_view source, const SizeRange& range = kMeasuredSizes);

/// Throws InputError where the body, or a coordinate of it, is out of the range; `source` names it in the message.
void require_size_in_range(const ConvexBody& body, const Measures& measures, std::string_view source,
                           const SizeRange& range = kMeasuredSizes);

}  // namespace vex
