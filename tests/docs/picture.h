// An SVG picture of a convex body in its own frame, drawn from its support mapping: it is the body that the engine
// sees.
//
// Parallel projection, one view for all. All arithmetic is + - * / and square root in double, so the same body gives
// the same bytes on every machine and at every optimisation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/svg.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A length to show: a line between two points of the body's frame, with a label beside its middle.
struct Dimension {
  Vec3d from, to;
  std::string label;
  Pixel shift{};  // of the line
  Pixel label_shift{};
};

struct Subject {
  std::string title;
  ConvexBody body;
  std::vector<Dimension> dimensions{};
  std::optional<ConvexBody> core{};  // what was rounded: its edges are dashed
};

/// The directions of the picture in the body's frame: to the right, upwards, and towards the eye.
Vec3d picture_right();
Vec3d picture_up();
Vec3d picture_view();

/// The text of an SVG file.
std::string draw(const Subject& subject);

}  // namespace vex
