#include "meshes/coordinate_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "meshes/formats/coordinate_text.h"
#include "meshes/nearest_float.h"

namespace vex {
namespace {

using Kind = CoordinateDigits::Kind;

/// The magnitudes' largest on each axis. What is not finite is refused elsewhere.
Vec3d largest_coordinates(const PolygonSoup& soup) {
  Vec3d largest;
  const auto note = [](double x, double* most) {
    if (std::isfinite(x)) {
      *most = std::max(*most, std::fabs(x));
    }
  };
  for (const Vec3d& p : soup.points) {
    note(p.x, &largest.x);
    note(p.y, &largest.y);
    note(p.z, &largest.z);
  }
  return largest;
}

double largest_of(const Vec3d& p) { return std::max({p.x, p.y, p.z}); }

template <class Condition>
bool all_coordinates(const PolygonSoup& soup, const Condition& condition) {
  return std::ranges::all_of(soup.points,
                             [&](const Vec3d& p) { return condition(p.x) && condition(p.y) && condition(p.z); });
}

bool is_float(double x) { return std::fabs(x) <= double{std::numeric_limits<float>::max()} && nearest_float(x) == x; }

/// Whether nine decimal digits print a number exactly. m 2^-k has the digits of m 5^k.
bool has_few_digits(double x) {
  constexpr double kMost = 1e9;
  if (x == 0.0) {
    return true;
  }
  int exponent = 0;
  double digits = std::fabs(std::frexp(x, &exponent)) * 0x1p53;
  exponent -= 53;
  while (exponent < 0 && std::fmod(digits, 2.0) == 0.0) {
    digits /= 2.0;
    ++exponent;
  }
  for (; exponent < 0 && digits < kMost; ++exponent) {
    digits *= 5.0;
  }
  if (exponent > 0) {  // beyond 2^53: more digits than a float has, unless they are zeros
    digits = std::ldexp(digits, exponent);
  }
  while (digits >= kMost && std::fmod(digits, 10.0) == 0.0) {
    digits /= 10.0;
  }
  return digits < kMost;
}

CoordinateDigits known_digits(const PolygonSoup& soup, double largest) {
  if (!(soup.digits.last_place > 0.0)) {
    return double_digits(largest);
  }
  if (soup.digits.kind == Kind::doubles && all_coordinates(soup, is_float) && !all_coordinates(soup, has_few_digits)) {
    return float_digits(largest);
  }
  return soup.digits;
}

/// How many decimals a last place is; negative where it is no power of ten, or above 1.
int n_decimals(double last_place) {
  const double exponent = -std::log10(last_place);
  const double nearest = std::nearbyint(exponent);
  return std::fabs(exponent - nearest) < 1e-6 && nearest >= 0.0 && nearest < 400.0 ? static_cast<int>(nearest) : -1;
}

std::string counted(int n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

}  // namespace

CoordinateRounding coordinate_rounding(const PolygonSoup& soup) {
  const Vec3d largest = largest_coordinates(soup);
  CoordinateRounding result;
  result.digits = known_digits(soup, largest_of(largest));
  const double last_place = result.digits.last_place;
  const auto place_of = [&](double magnitude) {
    switch (result.digits.kind) {
      case Kind::doubles: return std::min(last_place, double_digits(magnitude).last_place);
      case Kind::floats: return std::min(last_place, float_digits(magnitude).last_place);
      case Kind::decimals: break;
    }
    return last_place;
  };
  result.last_places = {place_of(largest.x), place_of(largest.y), place_of(largest.z)};
  const bool as_doubles = result.digits.kind == Kind::doubles ||
                          (result.digits.kind == Kind::floats && all_coordinates(soup, has_few_digits));
  result.reach =
      std::max(8.0 * double_digits(largest_of(largest)).last_place, as_doubles ? 0.0 : std::sqrt(3.0) * last_place);
  return result;
}

double volume_rounding(const Triangles& triangles, double volume, const Vec3d& last_places) {
  Vec3d twice_area;  // seen along each axis, from both sides
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3d a = triangles.corner(t, 0);
    const Vec3d normal = cross(triangles.corner(t, 1) - a, triangles.corner(t, 2) - a);
    twice_area = twice_area + Vec3d{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  }
  return 0.25 * dot(last_places, twice_area) / volume;
}

std::string digits_text(const CoordinateDigits& digits) {
  switch (digits.kind) {
    case Kind::doubles: return "64-bit numbers";
    case Kind::floats: return "32-bit floats";
    case Kind::decimals: break;
  }
  const int decimals = n_decimals(digits.last_place);
  return decimals >= 0 ? counted(decimals, "decimal") : counted(digits.n_digits, "digit");
}

std::string coordinates_text(const CoordinateDigits& digits) {
  if (digits.kind != Kind::decimals) {
    return "its coordinates are " + digits_text(digits) + ", one unit in the last place of the largest is " +
           rough_text(digits.last_place);
  }
  const std::string printed = "its coordinates are printed to " + digits_text(digits);
  return n_decimals(digits.last_place) >= 0 ? printed + " (" + counted(digits.n_digits, "digit") + ")" : printed;
}

std::string rough_text(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

}  // namespace vex
