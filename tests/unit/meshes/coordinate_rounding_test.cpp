#include "meshes/coordinate_rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "meshes/formats/coordinate_text.h"
#include "meshes/nearest_float.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

using Kind = CoordinateDigits::Kind;

constexpr double kGolden = std::numbers::phi;

/// Doubles: the bodies of soups.h at a place, with faces as they are there.
PolygonSoup placed(PolygonSoup soup, const Vec3d& offset) {
  for (Vec3d& p : soup.points) {
    const auto exact = [](double x) {  // of the coordinates of dodecahedra and icosahedra
      for (const double value : {0.0, 1.0, kGolden, 1.0 / kGolden}) {
        if (std::fabs(std::fabs(x) - value) < 1e-6) {
          return std::copysign(value, x);
        }
      }
      ADD_FAILURE() << x;
      return x;
    };
    p = offset + Vec3d{exact(p.x), exact(p.y), exact(p.z)};
  }
  return soup;
}

/// As a file holds it that prints with so many decimals.
PolygonSoup printed(PolygonSoup soup, int n_decimals) {
  WrittenDigits digits;
  const auto as_read = [&](double x) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", n_decimals, x);
    const double value = *parse_decimal(text);
    digits.note(text, value);
    return value;
  };
  for (Vec3d& p : soup.points) {
    p = {as_read(p.x), as_read(p.y), as_read(p.z)};
  }
  soup.digits = digits.digits();
  return soup;
}

bool notes_tell(const MeshReport& report, const std::string& part) {
  return std::ranges::any_of(report.notes,
                             [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

double icosahedron_volume() { return 8.0 * 5.0 / 12.0 * (3.0 + std::sqrt(5.0)); }  // edge 2

TEST(CoordinateRounding, ADodecahedronPrintedWithFourDecimalsIsConvexToWithinThem) {
  for (const Vec3d& at : {Vec3d{}, Vec3d{100, 200, -100}}) {
    const ConvexMesh mesh = convex_mesh_from(printed(placed(dodecahedron_soup(), at), 4));
    EXPECT_TRUE(mesh.report.hull_used);
    EXPECT_GT(*mesh.report.reflex_depth, 1e-6);
    EXPECT_TRUE(notes_tell(mesh.report, "the mesh is convex to within its 4 decimals"));
    EXPECT_TRUE(notes_tell(mesh.report, "its coordinates are printed to 4 decimals"));
    EXPECT_EQ(mesh.report.digits.kind, Kind::decimals);
    EXPECT_NEAR(mesh.report.digits.last_place, 1e-4, 1e-12);
    EXPECT_NEAR(mesh.report.coordinate_rounding, 1e-4 / mesh.report.size, 1e-12);
    EXPECT_NEAR(mesh.measures.volume, 7.66311896 * 8.0 / (kGolden * kGolden * kGolden),
                mesh.report.volume_rounding * mesh.measures.volume);
  }
}

TEST(CoordinateRounding, ADentBeyondTheDecimalsIsRefusedAndSaysWhatTheyExplain) {
  PolygonSoup soup = printed(placed(dodecahedron_soup(), {}), 4);
  Vec3d& p = soup.points[3];
  p = (1.0 - 0.0006 / norm(p)) * p;  // 0.0003 below the planes of its three faces
  const std::string message = refusal(printed(soup, 4));
  EXPECT_TRUE(contains(message, "edges are reflex"));
  EXPECT_TRUE(contains(message, "what rounding to 4 decimals explains"));
  EXPECT_TRUE(contains(message, "raise --convex-tolerance"));
  EXPECT_TRUE(
      contains(refusal(printed(placed(dodecahedron_soup(), {}), 4), {.convex_tolerance = 1e-6}), "tolerance 1e-06)"))
      << "what the user says holds";
}

TEST(CoordinateRounding, DecimalsTooCoarseExplainNothing) {
  const std::string message = refusal(printed(placed(dodecahedron_soup(), {}), 1));
  EXPECT_TRUE(contains(message, "tolerance 0.001, for rounding to 1 decimal is too coarse to explain anything"));
}

TEST(CoordinateRounding, AFlatDodecahedronOfTwelveDigitsIsAcceptedAwayFromTheOrigin) {
  const ConvexMesh mesh = convex_mesh_from(printed(placed(dodecahedron_soup(), {100, 200, -100}), 9));
  EXPECT_LT(*mesh.report.reflex_depth, 1e-8);
  EXPECT_FALSE(notes_tell(mesh.report, "may differ"));
  EXPECT_EQ(mesh.report.digits.n_digits, 12);
}

TEST(CoordinateRounding, AnIcosahedronFarAwayHasItsVolumeInDoubles) {
  for (const auto& [offset, error] : {std::pair{1e3, 1e-12}, {1e4, 1e-11}, {1e7, 1e-8}}) {
    PolygonSoup soup = placed(icosahedron_soup(), {offset, offset, offset});
    soup.digits = double_digits(offset + 2.0);
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_NEAR(mesh.measures.volume, icosahedron_volume(), error * icosahedron_volume());
    EXPECT_LT(std::fabs(mesh.measures.volume / icosahedron_volume() - 1.0), mesh.report.volume_rounding);
    EXPECT_LT(mesh.report.volume_rounding, 4.0 * error);
    EXPECT_TRUE(mesh.report.notes.empty());
    EXPECT_EQ(mesh.polytope().n_vertices(), 12U);
  }
}

TEST(CoordinateRounding, OfFloatsFarAwayIsWarnedOf) {
  for (const auto& [offset, error] : {std::pair{1e3, 1e-4}, {1e4, 1e-3}}) {
    PolygonSoup soup = placed(icosahedron_soup(), {offset, offset, offset});
    for (Vec3d& p : soup.points) {
      p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
    }
    soup.digits = float_digits(offset + kGolden);
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_TRUE(
        notes_tell(mesh.report, "its coordinates are 32-bit floats, one unit in the last place of the largest is"));
    EXPECT_TRUE(notes_tell(mesh.report, "the volume of what was meant may differ by"));
    EXPECT_LT(std::fabs(mesh.measures.volume / icosahedron_volume() - 1.0), mesh.report.volume_rounding);
    EXPECT_LT(mesh.report.volume_rounding, 3.0 * error);
    EXPECT_GT(mesh.report.volume_rounding, 1e-6);
  }
}

TEST(CoordinateRounding, BoundsTheVolumeByEachAxis) {
  // A plate whose short edge has a finer last place than its long ones.
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 0x1p-10});
  soup.digits = float_digits(1.0);
  soup.points[0].z = nearest_float(1e-9);  // so that nine digits do not print all
  const ConvexMesh mesh = convex_mesh_from(soup, {.convex_tolerance = 1e-3});
  const double expected = 0.5 * (2 * 0x1p-10 * 0x1p-23 * 2 + 2 * 0x1p-33) / 0x1p-10;
  EXPECT_NEAR(mesh.report.volume_rounding, expected, 1e-2 * expected);
}

TEST(CoordinateRounding, OfTheSameNumbersIsTheSameFromTextAndBinary) {
  const PolygonSoup round = icosahedron_soup();
  for (PolygonSoup soup : {round, box_soup({-1, -0.5, 2}, {12, 0.375, 3}), moved(round, [](const Vec3d& p) {
                             return p + Vec3d{1000, 0, 0};
                           })}) {
    PolygonSoup binary = soup, text = soup, wide = soup;
    double largest = 0.0;
    for (const Vec3d& p : soup.points) {
      largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    binary.digits = float_digits(largest);
    wide.digits = double_digits(largest);
    WrittenDigits digits;
    const auto as_read = [&](double x) {
      char token[64];
      std::snprintf(token, sizeof token, "%.17g", x);
      const double value = *parse_decimal(token);
      digits.note(token, value);
      return value;
    };
    for (Vec3d& p : text.points) {
      p = {as_read(p.x), as_read(p.y), as_read(p.z)};
    }
    text.digits = digits.digits();
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
      EXPECT_EQ(norm(text.points[i] - soup.points[i]), 0.0);
    }
    EXPECT_EQ(coordinate_rounding(text).reach, coordinate_rounding(binary).reach);
    EXPECT_EQ(coordinate_rounding(wide).reach, coordinate_rounding(binary).reach);
  }
}

TEST(CoordinateRounding, IsSaidInWords) {
  EXPECT_EQ(digits_text({Kind::decimals, 5, 1e-4}), "4 decimals");
  EXPECT_EQ(digits_text({Kind::decimals, 5, 0.1}), "1 decimal");
  EXPECT_EQ(digits_text({Kind::decimals, 6, 1e3}), "6 digits");
  EXPECT_EQ(coordinates_text({Kind::decimals, 5, 1e-4}), "its coordinates are printed to 4 decimals (5 digits)");
  EXPECT_EQ(coordinates_text({Kind::floats, 0, 0x1p-14}),
            "its coordinates are 32-bit floats, one unit in the last place of the largest is 6.1e-05");
}

TEST(CoordinateRounding, TakesNoiseForZeroAndSaysSo) {
  PolygonSoup soup = icosahedron_soup();
  soup.points[0].x = 1e-320;
  const ConvexMesh mesh = convex_mesh_from(soup);
  EXPECT_TRUE(notes_tell(mesh.report, "coordinates below 1.4e-45 were taken for 0 (1 of them)"));
  for (Vec3d& p : soup.points) {
    p = 1e-60 * p;
  }
  EXPECT_TRUE(contains(refusal(soup), "too small"));
  soup.points[0].x = 1e60;
  EXPECT_TRUE(contains(refusal(soup), "too large"));
}

TEST(CoordinateRounding, IsConvertedWithTheUnit) {
  PolygonSoup soup = printed(placed(dodecahedron_soup(), {}), 4);
  soup.unit = "mm";
  soup.unit_metres = 1e-3;
  const ConvexMesh in_mm = convex_mesh_from(soup);
  EXPECT_EQ(in_mm.report.unit, "mm");
  const ConvexMesh in_m = convex_mesh_from(soup, {.unit = "m"});
  EXPECT_EQ(in_m.report.unit, "m");
  EXPECT_NEAR(in_m.measures.volume, 1e-9 * in_mm.measures.volume, 1e-22);
  EXPECT_NEAR(in_m.report.coordinate_rounding, in_mm.report.coordinate_rounding, 1e-15);
  EXPECT_NEAR(in_m.report.volume_rounding, in_mm.report.volume_rounding, 1e-12);
  EXPECT_TRUE(notes_tell(in_m.report, "convex to within its 4 decimals"));
  EXPECT_THROW(convex_mesh_from(soup, {.unit = "furlong"}), UsageError);
  soup.unit = "";
  soup.unit_metres = 0.0;
  EXPECT_THROW(convex_mesh_from(soup, {.unit = "m"}), InputError);
}

}  // namespace
}  // namespace vex::tests
