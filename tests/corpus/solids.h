// Bodies whose V, S and M are known in closed form, and what is no body: what the corpus' files hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/numeric/vec3.h"
#include "shapes/measures.h"

namespace vex::tests {

using Face = std::vector<std::uint32_t>;

/// A surface of polygons. `measures` and `extreme` are those of the convex body it bounds; meaningless for what bounds
/// none.
struct Solid {
  std::vector<Vec3d> points;
  std::vector<Face> faces;
  Measures measures;
  std::vector<Vec3d> extreme;  // the body's vertices; empty: all of `points`

  const std::vector<Vec3d>& vertices() const { return extreme.empty() ? points : extreme; }
};

// None has a symmetry that would hide swapped axes or a lost vertex, and all coordinates are binary fractions of few
// digits: every format holds them exactly.
Solid box();              // 1 x 2 x 3, from (0.5, -1, 2)
Solid tetrahedron();      // corner(1, 2, 3), moved to (0.25, -0.5, 1)
Solid octahedron();       // regular, vertices 1.5 from (1, 2, -3)
Solid wedge();            // a right triangle of 3, 4, 5 times a height of 2
Solid five_prism();       // over a pentagon
Solid twelve_prism();     // over a polygon of twelve corners
Solid whole_wedge();      // the wedge, at whole numbers from 7 to 17; its first coordinate is 10, a line end as a byte
Solid one_digit_prism();  // whose numbers have one digit each: 9, 1, 0.1. Its last side is 1 wide, without it joining
                          // the points to either hand closes the rest
Solid corner(double a, double b, double c);  // a tetrahedron: three legs from the origin, along the axes
// Vertices rounded to double; edges of 2.
Solid icosahedron(const Vec3d& centre = {});
Solid dodecahedron(const Vec3d& centre = {});
/// The box with every face cut into `n` x `n`.
Solid cut_box(std::uint32_t n);

// The same body, written otherwise.
Solid triangulated(Solid solid);
Solid with_own_corners(const Solid& solid);  // every corner a point of its own
Solid inside_out(Solid solid);
Solid with_point(Solid solid, const Vec3d& unused);

// No bodies.
Solid with_hole(Solid solid);          // the last face is gone
Solid with_flipped_face(Solid solid);  // the last one
Solid two_boxes();
Solid torus();
Solid dented_box(double depth);  // a vertex in the middle of the face z = 5, so much below it
Solid flat_box();                // of no height

/// The box, and what its hull has with the point: a pyramid of height 3 upon it.
Vec3d far_point();
Solid box_with_roof();

}  // namespace vex::tests
