// What the rounding of a file's coordinates leaves open: how far points may be from where they were meant, and what
// that is for a volume.
#pragma once

#include <cstddef>
#include <string>

#include "engine/numeric/vec3.h"
#include "meshes/polygon_soup.h"
#include "meshes/triangles.h"

namespace vex {

/// Lengths are in the unit of the points.
struct CoordinateRounding {
  CoordinateDigits digits;  // with a last place: that of a double where the points are not from a file
  Vec3d last_places;        // on each axis, of the coordinate of largest magnitude there

  /// Points that were meant to be one may be this far apart, and points that were meant to be inside a convex body may
  /// be this far outside the others' hull, or as deep below it if they were meant to be its corners. Each coordinate is
  /// off by half a last place at most, so each point by sqrt(3)/2 of one, and with it a support function of the others:
  /// sqrt(3) last places together. But eight last places of doubles at least, for the arithmetic that made the
  /// coordinates had no more digits than these.
  double reach = 0.0;
};

/// A fraction of the size: coordinates that are rounded more coarsely explain no dents.
inline constexpr double kMostExplained = 1e-3;
/// The same for points that are joined because nothing else closes the surface.
inline constexpr double kMostJoined = 1e-4;

/// Of the soup as the file has it. 64-bit coordinates all of which are 32-bit floats count as floats. The reach of
/// floats all of which nine decimal digits print exactly (0.5, 12) is that of doubles, for text holds the same numbers
/// without a sign of rounding: the reach must not depend on the format.
CoordinateRounding coordinate_rounding(const PolygonSoup& soup);

/// By how much the volume of what was meant may differ, relative to `volume`, that of the surface `triangles`. Where
/// each coordinate is off by half a last place at most, no point of the surface moves farther than that along any axis,
/// so to first order V changes by at most the integral of (l_x |n_x| + l_y |n_y| + l_z |n_z|) / 2 over the surface, n
/// being the unit normal: at most sqrt(3)/2 S times the largest last place.
double volume_rounding(const Triangles& triangles, double volume, const Vec3d& last_places);

/// "4 decimals", "7 digits", "32-bit floats", "64-bit numbers".
std::string digits_text(const CoordinateDigits& digits);

/// "its coordinates are printed to 4 decimals (5 digits)" or "its coordinates are 32-bit floats, one unit in the last
/// place of the largest is 6.1e-05".
std::string coordinates_text(const CoordinateDigits& digits);

/// A number of two digits, for what is known no better.
std::string rough_text(double value);

}  // namespace vex
