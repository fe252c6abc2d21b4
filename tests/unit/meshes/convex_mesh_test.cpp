#include "meshes/convex_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "exact_polyhedron.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/exact_hull.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

TEST(ConvexMesh, ReportsWhatItFound) {
  const ConvexMesh mesh = convex_mesh_from(with_own_corners(box_soup({0, 0, 0}, {1, 2, 2})));
  EXPECT_EQ(mesh.report.n_vertices, 8U);
  EXPECT_EQ(mesh.report.n_faces, 6U);
  EXPECT_EQ(mesh.report.n_triangles, 12U);
  EXPECT_EQ(mesh.report.n_parts, 1U);
  EXPECT_EQ(mesh.report.n_welded_vertices, 16U);
  EXPECT_EQ(mesh.report.size, 3.0);
  EXPECT_EQ(mesh.report.reflex_depth, 0.0);
  EXPECT_FALSE(mesh.report.hull_used);
  EXPECT_EQ(mesh.report.hull_added_volume, 0.0);
  EXPECT_TRUE(mesh.report.notes.empty());
}

TEST(ConvexMesh, HasTheWeldedVerticesInOrder) {
  const ConvexMesh mesh = convex_mesh_from(shuffled(box_soup({0, 0, 0}, {1, 2, 3}), 3));
  ASSERT_EQ(mesh.polytope().n_vertices(), 8U);
  EXPECT_EQ(norm(mesh.polytope().vertex(0) - Vec3d{0, 0, 0}), 0.0);
  EXPECT_EQ(norm(mesh.polytope().vertex(1) - Vec3d{0, 0, 3}), 0.0);
  EXPECT_EQ(norm(mesh.polytope().vertex(7) - Vec3d{1, 2, 3}), 0.0);
}

TEST(ConvexMesh, TurnsABodyThatIsInsideOutIntoTheSameBody) {
  const ConvexMesh mesh = convex_mesh_from(icosahedron_soup());
  const ConvexMesh other = convex_mesh_from(turned(icosahedron_soup()));
  EXPECT_EQ(other.measures.volume, mesh.measures.volume);
  EXPECT_EQ(other.measures.surface_area, mesh.measures.surface_area);
  EXPECT_EQ(other.measures.integrated_mean_curvature, mesh.measures.integrated_mean_curvature);
  ASSERT_EQ(other.report.notes.size(), 1U);
  EXPECT_TRUE(contains(other.report.notes[0], "inside out"));
}

TEST(ConvexMesh, WithoutVolumeIsRefused) {
  PolygonSoup sheet;  // a triangle and its back
  sheet.points = {{0, 0, 0}, {1, 0, 0.3}, {0, 1, 0.7}};
  sheet.add_face({0, 1, 2});
  sheet.add_face({0, 2, 1});
  std::string message = refusal(sheet);
  EXPECT_TRUE(contains(message, "no volume"));
  EXPECT_TRUE(contains(message, "plate:"));
  EXPECT_TRUE(contains(message, "disc:"));
  message = refusal(box_soup({0, 0, 1}, {1, 1, 1}));  // two quads are left of it
  EXPECT_TRUE(contains(message, "no volume"));
}

TEST(ConvexMesh, ReadsAFaceWithACornerOnAStraightSide) {
  // Both faces at the edge know the vertex in its middle: nothing is without area if the cut goes the right way.
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points.push_back({0.5, 0, 0});
  soup = corner_added(soup, 2, 1, 8);  // 0 4 5 1 becomes 0 8 4 5 1
  soup = corner_added(soup, 4, 4, 8);  // 0 2 6 4 becomes 0 2 6 4 8
  const ConvexMesh mesh = convex_mesh_from(soup);
  EXPECT_EQ(mesh.measures.volume, 1.0);
  EXPECT_NEAR(mesh.measures.surface_area, 6.0, 1e-15 * 6);
  EXPECT_NEAR(mesh.measures.integrated_mean_curvature, 3.0 * 3.14159265358979323846, 1e-14);
  EXPECT_EQ(mesh.polytope().n_vertices(), 8U);
  EXPECT_EQ(mesh.report.n_dropped_vertices, 1U);
}

TEST(ConvexMesh, NamesTheFirstConditionThatFails) {
  // Two bodies, one open, one the wrong way round, neither convex: the count of bodies comes first.
  const PolygonSoup l = l_prism_soup();
  const PolygonSoup far_l = moved(l, [](const Vec3d& p) { return p + Vec3d{10, 0, 0}; });
  EXPECT_TRUE(contains(refusal(joined(face_removed(l, 2), far_l)), "not one body"));
  EXPECT_TRUE(contains(refusal(face_removed(face_turned(l, 3), 2)), "not closed"));
  EXPECT_TRUE(contains(refusal(face_turned(l, 3)), "not consistently oriented"));
  EXPECT_TRUE(contains(refusal(l), "not convex"));
}

// --- the hull that is asked for

ConvexMesh hull_of(const PolygonSoup& soup) { return convex_mesh_from(soup, {.hull = true}); }

void expect_same_body(const Polytope& a, const Polytope& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  for (std::size_t i = 0; i < a.n_vertices(); ++i) {
    EXPECT_EQ(norm(a.vertex(i) - b.vertex(i)), 0.0);
  }
  EXPECT_EQ(norm(a.centre() - b.centre()), 0.0);
  EXPECT_EQ(a.circumradius(), b.circumradius());
}

bool has_note(const MeshReport& report, const std::string& part) {
  return std::ranges::any_of(report.notes,
                             [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(ConvexMesh, HullOfAConvexMeshIsTheMesh) {
  for (const PolygonSoup& soup : {tetrahedron_soup(), icosahedron_soup(), box_soup({0, 0, 0}, {1, 2, 2}),
                                  turned(icosahedron_soup()), with_own_corners(icosahedron_soup())}) {
    const ConvexMesh mesh = convex_mesh_from(soup);
    const ConvexMesh hull = hull_of(soup);
    expect_same_body(hull.polytope(), mesh.polytope());
    EXPECT_NEAR(hull.measures.volume, mesh.measures.volume, 1e-15 * mesh.measures.volume);
    EXPECT_NEAR(hull.measures.surface_area, mesh.measures.surface_area, 1e-15 * mesh.measures.surface_area);
    EXPECT_EQ(hull.report.hull_added_volume, 0.0);
    EXPECT_EQ(hull.report.reflex_depth, 0.0);
    EXPECT_TRUE(hull.report.hull_used);
    EXPECT_EQ(hull.report.n_points, hull.report.n_vertices);
    EXPECT_EQ(hull.report.n_welded_vertices, mesh.report.n_welded_vertices);
  }
}

TEST(ConvexMesh, HullSaysHowMuchItAdded) {
  const ConvexMesh l = hull_of(l_prism_soup());
  EXPECT_EQ(l.measures.volume, 3.5);
  EXPECT_EQ(l.report.hull_added_volume, 0.5);
  EXPECT_EQ(l.report.n_vertices, 10U);
  EXPECT_EQ(l.report.n_points, 12U);
  EXPECT_FALSE(l.report.reflex_depth.has_value());
  const ConvexMesh inside_out = hull_of(turned(l_prism_soup()));
  EXPECT_EQ(inside_out.report.hull_added_volume, l.report.hull_added_volume);
}

TEST(ConvexMesh, HullOfSeveralPartsAddsTheirVolumesAsTheyStand) {
  const PolygonSoup box = box_soup({0, 0, 0}, {1, 1, 1});
  const auto shifted = [&](double x) { return moved(box, [=](const Vec3d& p) { return p + Vec3d{x, 0, 0}; }); };
  const ConvexMesh apart = hull_of(joined(box, shifted(2)));
  EXPECT_EQ(apart.measures.volume, 3.0);
  EXPECT_EQ(apart.report.hull_added_volume, 1.0);
  EXPECT_TRUE(has_note(apart.report, "2 surfaces"));
  EXPECT_EQ(apart.report.n_vertices, 8U);
  EXPECT_EQ(apart.report.n_points, 16U);
  const ConvexMesh overlapping = hull_of(joined(box, shifted(0.5)));
  EXPECT_EQ(overlapping.report.hull_added_volume, std::nullopt) << "two boxes that share half of their volume";
  EXPECT_TRUE(has_note(overlapping.report, "overlap"));
  const ConvexMesh opposite = hull_of(joined(box, turned(shifted(2))));
  EXPECT_EQ(opposite.report.hull_added_volume, std::nullopt) << "a part inside out is no cavity, and may not be one";
  EXPECT_TRUE(has_note(opposite.report, "some of them are inside out"));
}

TEST(ConvexMesh, HullOfASurfaceThatEnclosesNothingSaysWhyNothingWasCompared) {
  const PolygonSoup box = box_soup({0, 0, 0}, {1, 1, 1});
  const ConvexMesh whole = hull_of(box);
  PolygonSoup cloud;
  cloud.points = box.points;
  const std::vector<std::pair<PolygonSoup, const char*>> cases{
      {face_removed(box, 2), "is not defined: the surface is not closed: 4 of its 12 edges"},
      {joined(box, box), "is not defined: the surface is not closed: 12 of its 12 edges"},
      {face_turned(box, 1), "is not defined: the faces are not consistently oriented: 4 of 12 edges"},
      {cloud, "is not defined: there are no faces"}};
  for (const auto& [soup, reason] : cases) {
    const ConvexMesh mesh = hull_of(soup);
    expect_same_body(mesh.polytope(), whole.polytope());
    EXPECT_EQ(mesh.measures.volume, 1.0);
    EXPECT_EQ(mesh.report.hull_added_volume, std::nullopt);
    EXPECT_EQ(mesh.report.reflex_depth, std::nullopt);
    EXPECT_TRUE(has_note(mesh.report, reason)) << reason;
  }
}

TEST(ConvexMesh, HullHoldsPointsThatNoFaceUses) {
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points.push_back({0.5, 0.5, 4.0});
  soup.points.push_back({0.5, 0.5, 0.5});
  soup.add_face({8, 8, 8});
  const ConvexMesh mesh = hull_of(soup);
  EXPECT_EQ(mesh.measures.volume, 2.0);
  EXPECT_EQ(mesh.report.hull_added_volume, 1.0);
  EXPECT_EQ(mesh.report.n_vertices, 9U);
  EXPECT_EQ(mesh.report.n_points, 10U);
}

TEST(ConvexMesh, HullStillRefusesWhatHasNoBody) {
  const MeshOptions hull{.hull = true};
  EXPECT_TRUE(contains(refusal(box_soup({0, 0, 1}, {1, 1, 1}), hull), "needle:L"));
  EXPECT_TRUE(contains(refusal({}, hull), "no points"));
  PolygonSoup soup = icosahedron_soup();
  soup.points[5].x = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(contains(refusal(soup, hull), "not finite"));
}

// --- the scale

MeshOptions scaled_by(double s, bool hull = false) {
  return {.hull = hull, .scale = [s](const Measures&) { return s; }};
}

TEST(ConvexMesh, ScaledByAPowerOfTwoChangesNoBitButExponents) {
  const auto turn = [](const Vec3d& p) { return Vec3d{0.8 * p.x - 0.6 * p.z + 0.1, p.y, 0.6 * p.x + 0.8 * p.z - 0.3}; };
  for (const PolygonSoup& soup : {icosahedron_soup(), moved(capsule_soup(24, 10), turn), dodecahedron_soup()}) {
    for (const bool hull : {false, true}) {
      const ConvexMesh mesh = convex_mesh_from(soup, {.hull = hull});
      for (const double s : {1.0, 0x1p-40, 0x1p+60}) {
        const ConvexMesh scaled = convex_mesh_from(soup, scaled_by(s, hull));
        ASSERT_EQ(scaled.polytope().n_vertices(), mesh.polytope().n_vertices());
        for (std::size_t i = 0; i < mesh.polytope().n_vertices(); ++i) {
          EXPECT_EQ(norm(scaled.polytope().vertex(i) - s * mesh.polytope().vertex(i)), 0.0);
        }
        EXPECT_EQ(scaled.measures.volume, s * s * s * mesh.measures.volume);
        EXPECT_EQ(scaled.measures.surface_area, s * s * mesh.measures.surface_area);
        EXPECT_EQ(scaled.measures.integrated_mean_curvature, s * mesh.measures.integrated_mean_curvature);
        EXPECT_EQ(scaled.body.inradius(), s * mesh.body.inradius());
        EXPECT_EQ(scaled.body.circumradius(), s * mesh.body.circumradius());
        EXPECT_EQ(norm(scaled.body.centre() - s * mesh.body.centre()), 0.0);
        EXPECT_EQ(scaled.report.size, s * mesh.report.size);
        EXPECT_EQ(scaled.report.reflex_depth, mesh.report.reflex_depth);
        EXPECT_EQ(*scaled.report.hull_added_volume, s * s * s * *mesh.report.hull_added_volume);
      }
    }
  }
}

TEST(ConvexMesh, ScaledVerticesAreTheBodyAndAreMeasuredAnew) {
  const auto turn = [](const Vec3d& p) { return Vec3d{0.8 * p.x - 0.6 * p.z + 0.1, p.y, 0.6 * p.x + 0.8 * p.z - 0.3}; };
  for (const PolygonSoup& soup :
       {box_soup({1, 2, 3}, {2, 4, 6}), icosahedron_soup(), moved(capsule_soup(16, 10), turn)}) {
    for (const double s : {1.0 / 3.0, 0.1, 1e30 / 7.0, 1e-30 / 7.0}) {
      const ConvexMesh mesh = convex_mesh_from(soup);
      const ConvexMesh scaled = convex_mesh_from(soup, scaled_by(s));
      ASSERT_EQ(scaled.polytope().n_vertices(), mesh.polytope().n_vertices());
      for (std::size_t i = 0; i < mesh.polytope().n_vertices(); ++i) {
        EXPECT_EQ(norm(scaled.polytope().vertex(i) - s * mesh.polytope().vertex(i)), 0.0);
      }
      // The exact measures of the hull of just these doubles.
      const std::vector<Vec3d> vertices = scaled.polytope().vertices();
      const Measures exact = exact_measures(*exact_hull(vertices));
      EXPECT_NEAR(scaled.measures.volume, exact.volume, 1e-13 * exact.volume);
      EXPECT_NEAR(scaled.measures.surface_area, exact.surface_area, 1e-13 * exact.surface_area);
      EXPECT_NEAR(scaled.measures.integrated_mean_curvature, exact.integrated_mean_curvature,
                  1e-13 * exact.integrated_mean_curvature);
      EXPECT_NEAR(scaled.measures.volume, s * s * s * mesh.measures.volume, 1e-13 * scaled.measures.volume);
      EXPECT_NEAR(scaled.body.inradius(), s * mesh.body.inradius(), 1e-5 * scaled.body.inradius());
    }
  }
}

TEST(ConvexMesh, AsksForTheScaleOnceAndWithTheMeasuresOfTheFile) {
  int n_calls = 0;
  double volume = 0.0;
  const ConvexMesh mesh = convex_mesh_from(box_soup({0, 0, 0}, {1, 2, 4}), {.scale = [&](const Measures& m) {
                                             ++n_calls;
                                             volume = m.volume;
                                             return 1.0 / std::cbrt(m.volume);
                                           }});
  EXPECT_EQ(n_calls, 1);
  EXPECT_EQ(volume, 8.0);
  EXPECT_EQ(mesh.measures.volume, 1.0);
  EXPECT_EQ(mesh.report.size, std::sqrt(21.0) / 2.0);
  const PolygonSoup open = face_removed(box_soup({0, 0, 0}, {1, 2, 4}), 0);
  EXPECT_TRUE(contains(refusal(open, {.scale = [&](const Measures&) { return static_cast<double>(++n_calls); }}),
                       "not closed"));
  EXPECT_EQ(n_calls, 1);  // after all checks
}

TEST(ConvexMesh, ScalesTheVolumeThatTheHullAdded) {
  const PolygonSoup box = box_soup({0, 0, 0}, {1, 1, 1});
  const PolygonSoup two = joined(box, moved(box, [](const Vec3d& p) { return p + Vec3d{2, 0, 0}; }));
  const ConvexMesh mesh = convex_mesh_from(two, scaled_by(3.0, true));
  EXPECT_EQ(mesh.measures.volume, 81.0);
  EXPECT_EQ(mesh.report.hull_added_volume, 27.0);
}

TEST(ConvexMesh, RefusesAScaleThatLeavesNoBody) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double s : {1e300, 1e100, infinity}) {
    EXPECT_TRUE(contains(refusal(icosahedron_soup(), scaled_by(s)), "too large")) << s;
  }
  for (const double s : {1e-300, 1e-103, 0.0}) {
    EXPECT_TRUE(contains(refusal(icosahedron_soup(), scaled_by(s)), "too small")) << s;
  }
  for (const double s : {-1.0, std::nan("")}) {
    EXPECT_TRUE(contains(refusal(icosahedron_soup(), scaled_by(s)), "not positive")) << s;
  }
  EXPECT_TRUE(contains(refusal(icosahedron_soup(), scaled_by(0.0)), "choose another scale"));
}

// Twelve digits at 10^12 told the volume of an icosahedron of edge 2 as 26 times what it was.
TEST(ConvexMesh, RefusesCoordinatesTooCoarseForTheBody) {
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 2, 3});
  soup.digits = {CoordinateDigits::Kind::decimals, 12, 1.0};
  EXPECT_TRUE(contains(refusal(soup), "too coarse for the body"));
  soup.digits = {CoordinateDigits::Kind::decimals, 1, 1.0};  // nobody knows that these were rounded
  EXPECT_GT(convex_mesh_from(soup).report.volume_rounding, 0.5);
}

}  // namespace
}  // namespace vex::tests
