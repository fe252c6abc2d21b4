// A pair of bodies as an SVG picture: A, the surface that B's centre may not enter, and B where it touches A.
#pragma once

#include <string>

#include "apps/common/html/pair_view.h"
#include "apps/common/svg.h"

namespace vex {

/// Paths of the picture, no wider and higher than this, about the origin. The view is from above, a little from the
/// side; depth is shown by shade alone. + - * / and square root only, in double.
void draw_pair(Svg& svg, const PairView& view, const OrientationView& orientation, double width, double height);

}  // namespace vex
