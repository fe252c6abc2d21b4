#include "engine/query/overlap.h"

#include <gtest/gtest.h>

#include "apps/referees/exact_overlap.h"
#include "shapes/capsule.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "tests/referees/contact.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

Transformd shifted(double x, double y, double z) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, z}}; }

// The verdict, held against exact arithmetic: the verdict itself, which is never open, and what it carries as its
// proof.
void expect_exact(const TestPolytope& a, const TestPolytope& b, const Transformd& pose, Outcome& outcome) {
  OverlapCertificate proof;
  const Verdict verdict = overlap(a.body, b.body, pose, &proof);
  outcome = verdict.outcome;
  const std::vector<Vec3d> placed_b = exact::placed(b.vertices, pose);
  ASSERT_EQ(outcome, exact::overlap(a.vertices, placed_b) ? Outcome::overlap : Outcome::disjoint);
  if (outcome == Outcome::disjoint && verdict.by == DecidedBy::gjk) {
    ASSERT_TRUE(exact::separates(proof.separating_dir, a.vertices, placed_b));
  }
  const CertificateCheck check = check_certificate(a.body, b.body, pose, outcome, proof);
  ASSERT_TRUE(check.is_proven) << check.fault;
}

struct Counts {
  int overlap = 0, disjoint = 0, undecided = 0;
  void add(Outcome outcome) {
    (outcome == Outcome::overlap ? overlap : outcome == Outcome::disjoint ? disjoint : undecided) += 1;
  }
};

TEST(Overlap, OfRandomPolytopesIsWhatExactArithmeticSays) {
  std::mt19937_64 random(11);
  const std::vector<TestPolytope> bodies = {test_box(1, 1, 1), test_box(4, 1, 0.25), test_tetrahedron(0.7),
                                            test_point_hull(20, {1, 1, 1}, 3), test_point_hull(30, {3, 1, 0.2}, 4)};
  Counts counts;
  for (const TestPolytope& a : bodies) {
    for (const TestPolytope& b : bodies) {
      const Domain domain = ball_domain(a.body, b.body);
      for (int k = 0; k < 60; ++k) {
        Outcome outcome{};
        ASSERT_NO_FATAL_FAILURE(expect_exact(a, b, random_pose(random, domain, b.body), outcome));
        counts.add(outcome);
      }
    }
  }
  EXPECT_EQ(counts.undecided, 0);
  const int n = counts.overlap + counts.disjoint;
  EXPECT_GT(counts.overlap, n / 10) << "the sample must hold both";
  EXPECT_GT(counts.disjoint, n / 10);
}

TEST(Overlap, NearContactIsRight) {
  // Boxes moved along the line of their centres until they all but touch, then apart and together by a relative d.
  std::mt19937_64 random(12);
  const TestPolytope a = test_box(1, 2, 3), b = test_box(2, 1, 1);
  for (const double d : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15, 1e-16}) {
    Counts counts;
    for (int k = 0; k < 12; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double apart = exact::contact_along(a, b, pose, dir).apart;
      for (const double factor : {1.0 + d, 1.0 - d}) {
        pose.translation = (apart * factor) * dir;
        Outcome outcome{};
        ASSERT_NO_FATAL_FAILURE(expect_exact(a, b, pose, outcome));
        counts.add(outcome);
      }
    }
    if (d >= 1e-15) {
      EXPECT_EQ(counts.overlap, 12) << "at a distance of " << d;
      EXPECT_EQ(counts.disjoint, 12);
    }
  }
}

TEST(Overlap, OfSymmetricPlacementsIsDecided) {
  // Edges, faces and axes in line: the portal's edges pass through the ray. Every gap here is far above rounding.
  const TestPolytope cube = test_box(1, 1, 1);
  for (const double x : {0.0, 0.25, 0.5, 0.75, 0.999, 1.001, 1.5, 2.0}) {
    for (const Vec3d& dir :
         {Vec3d{1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1}, Vec3d{1, 1, 0}, Vec3d{1, 0, -1}, Vec3d{1, 1, 1}}) {
      const Transformd pose = shifted(x * dir.x, x * dir.y, x * dir.z);
      const Verdict verdict = overlap(cube.body, cube.body, pose);
      EXPECT_EQ(verdict.outcome, x < 1.0 ? Outcome::overlap : Outcome::disjoint)
          << x << " along " << dir.x << dir.y << dir.z;
    }
  }
  // A quarter and an eighth of a turn about z.
  const double h = std::sqrt(0.5);
  for (const Transformd& turn :
       {Transformd{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {}}, Transformd{{h, -h, 0}, {h, h, 0}, {0, 0, 1}, {}}}) {
    for (const double x : {0.0, 0.5, 0.9}) {
      Transformd pose = turn;
      pose.translation = {x, 0, 0};
      EXPECT_EQ(overlap(cube.body, cube.body, pose).outcome, Outcome::overlap) << x;
    }
    Transformd apart = turn;
    apart.translation = {1.3, 0, 0};
    EXPECT_EQ(overlap(cube.body, cube.body, apart).outcome, Outcome::disjoint);
  }
}

TEST(Overlap, OfBallsIsTheirCentreDistance) {
  std::mt19937_64 random(13);
  const ConvexBody a = Sphere(1.0), b = Sphere(2.5);
  for (const double d : {1e-2, 1e-6, 1e-10, 1e-13}) {
    for (int k = 0; k < 200; ++k) {
      const Vec3d dir = random_direction(random);
      for (const double distance : {3.5 * (1 + d), 3.5 * (1 - d)}) {
        Transformd pose = random_rotation(random);
        pose.translation = (distance / norm(dir)) * dir;
        const Outcome outcome = overlap(a, b, pose).outcome;
        EXPECT_EQ(outcome, distance < 3.5 ? Outcome::overlap : Outcome::disjoint) << d;
      }
    }
  }
}

TEST(Overlap, OfCapsulesIsTheDistanceOfTheirAxes) {
  // Distance of two segments by brute force over one parameter and projection on the other: convex, so a fine ternary
  // search.
  std::mt19937_64 random(14);
  const double length = 2.0, radius = 0.5;
  const ConvexBody capsule = Capsule(length, radius);
  const Domain domain = ball_domain(capsule, capsule);
  Counts counts;
  for (int k = 0; k < 2000; ++k) {
    const Transformd pose = random_pose(random, domain, capsule);
    const Vec3d axis = pose(Vec3d{0, 0, 1}) - pose.translation;
    const auto distance_at = [&](double s) {
      const Vec3d p = pose.translation + s * axis;
      const double z = std::clamp(p.z, -length / 2, length / 2);
      return norm(p - Vec3d{0, 0, z});
    };
    double low = -length / 2, high = length / 2;
    for (int step = 0; step < 200; ++step) {
      const double third = (high - low) / 3;
      (distance_at(low + third) < distance_at(high - third) ? high : low) =
          distance_at(low + third) < distance_at(high - third) ? high - third : low + third;
    }
    const double distance = distance_at(0.5 * (low + high));
    if (std::fabs(distance - 2 * radius) < 1e-7) continue;  // beyond what the search resolves
    const Outcome outcome = overlap(capsule, capsule, pose).outcome;
    counts.add(outcome);
    ASSERT_EQ(outcome, distance < 2 * radius ? Outcome::overlap : Outcome::disjoint) << k;
  }
  EXPECT_EQ(counts.undecided, 0);
  EXPECT_GT(counts.overlap, 300);
  EXPECT_GT(counts.disjoint, 300);
}

TEST(Overlap, OfTouchingBodiesIsOverlap) {
  // Face on face, vertex on vertex, ball on ball, all exactly: the closed bodies share points.
  const TestPolytope cube = test_box(1, 1, 1);
  for (const Transformd& pose : {shifted(1.0, 0.25, 0.125), shifted(1, 1, 0), shifted(1, 1, 1)}) {
    EXPECT_EQ(overlap(cube.body, cube.body, pose), Verdict::overlap(DecidedBy::exact));
    Transformd apart = pose;
    apart.translation.x = std::nextafter(apart.translation.x, 2.0);
    EXPECT_EQ(overlap(cube.body, cube.body, apart), Verdict::disjoint(DecidedBy::exact));
  }
  EXPECT_EQ(overlap(Sphere(1.0), Sphere(1.0), shifted(2.0, 0.0, 0.0)), Verdict::overlap(DecidedBy::exact));
  EXPECT_EQ(overlap(Sphere(1.0), Sphere(1.0), shifted(std::nextafter(2.0, 3.0), 0.0, 0.0)).outcome, Outcome::disjoint);
}

TEST(Overlap, OfTouchingCurvedBodiesIsNeverGuessed) {
  // Two ellipsoids at the sum of their semi-axes: the gap is 0 exactly, and no more than that is said.
  OverlapCertificate proof;
  const Verdict verdict = overlap(Ellipsoid(1, 2, 3), Ellipsoid(1, 3, 2), shifted(2.0, 0.0, 0.0), &proof);
  EXPECT_EQ(verdict, Verdict::undecided(DecidedBy::double_double, UndecidedReason::rounding));
  EXPECT_LE(proof.gap_lower, 0.0);
  EXPECT_GE(proof.gap_upper, 0.0);
  EXPECT_LT(proof.gap_upper - proof.gap_lower, 1e-24);
}

// A vertex of B above or in the top face of a box A: which of the two, the placed vertices themselves say, exactly. The
// plane of the face is z = h, so B is apart if every placed z is above h, and meets A if its lowest vertex is in A.
enum class OnFace { apart, meets, unknown };

Vec3d lowest_of(const std::vector<Vec3d>& points) {
  Vec3d lowest{0, 0, 1e300};
  for (const Vec3d& p : points) {
    if (p.z < lowest.z) lowest = p;
  }
  return lowest;
}

OnFace vertex_on_face(const std::vector<Vec3d>& placed_b, const Vec3d& half) {
  const Vec3d lowest = lowest_of(placed_b);
  if (lowest.z > half.z) return OnFace::apart;
  const bool in_box = std::fabs(lowest.x) <= half.x && std::fabs(lowest.y) <= half.y && lowest.z >= -half.z;
  return in_box ? OnFace::meets : OnFace::unknown;
}

TEST(Overlap, WithinRoundingOfContactIsNeverWrong) {
  // 10^5 placements a few roundoffs from contact, at ratios where the bounds matter: a filter whose bounds are a
  // hundred times too small, or that trusts its signs, answers wrong here (tried: hundreds of times).
  std::mt19937_64 random(18);
  struct Ratio {
    Vec3d edges_a, edges_b;
  };
  const std::vector<Ratio> ratios = {{{1, 1, 1}, {1, 1, 1}},          {{1, 1, 1}, {1e9, 1, 1}},
                                     {{1e9, 1e9, 1}, {1, 1, 1}},      {{1e6, 1e6, 1e6}, {1, 1, 1}},
                                     {{1, 1, 1}, {1, 1e6, 1e6}},      {{1, 1, 1e-9}, {1, 1, 1}},
                                     {{100, 100, 1}, {1e-3, 1, 1e3}}, {{1, 1, 1}, {1e-9, 1e-9, 1}}};
  int n_by_filter = 0, n_by_exact = 0, n_apart = 0;
  for (const Ratio& ratio : ratios) {
    const TestPolytope a = test_box(ratio.edges_a.x, ratio.edges_a.y, ratio.edges_a.z);
    const TestPolytope b = test_box(ratio.edges_b.x, ratio.edges_b.y, ratio.edges_b.z);
    const Vec3d half = 0.5 * ratio.edges_a;
    const double reach = a.body.reach() + b.body.reach();
    for (int k = 0; k < 12500; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d lowest = lowest_of(exact::placed(b.vertices, pose));
      // The lowest vertex over the face; its height a random multiple of 2^-56 ... 2^-36 of the reach.
      const double gap =
          std::ldexp(reach * (2.0 * random_in_unit_interval(random) - 1.0), -36 - static_cast<int>(random() % 21));
      pose.translation = {half.x * (1.8 * random_in_unit_interval(random) - 0.9) - lowest.x,
                          half.y * (1.8 * random_in_unit_interval(random) - 0.9) - lowest.y, half.z + gap - lowest.z};
      const OnFace truth = vertex_on_face(exact::placed(b.vertices, pose), half);
      if (truth == OnFace::unknown) continue;
      const Verdict verdict = overlap(a.body, b.body, pose);
      (verdict.by == DecidedBy::exact ? n_by_exact : n_by_filter) += 1;
      n_apart += truth == OnFace::apart ? 1 : 0;
      ASSERT_EQ(verdict.outcome, truth == OnFace::apart ? Outcome::disjoint : Outcome::overlap)
          << "boxes " << ratio.edges_a.x << " " << ratio.edges_a.y << " and " << ratio.edges_b.x << ", placement " << k;
    }
  }
  EXPECT_GT(n_by_filter, 20000) << "the sample must hold what the filter can decide";
  EXPECT_GT(n_by_exact, 5000) << "and what it cannot";
  EXPECT_GT(n_apart, 20000);
}

// Behind (-1), in (0) or in front of (+1) the plane of a, b, c, seen from where they turn counter-clockwise: exact.
int side_of(const std::array<Vec3d, 3>& face, const Vec3d& p) {
  const exact::Point a = exact::exactly(face[0]);
  const exact::Point ab = exact::minus(exact::exactly(face[1]), a), ac = exact::minus(exact::exactly(face[2]), a);
  const exact::Point ap = exact::minus(exact::exactly(p), a);
  const exact::Rational det = ap[0] * (ab[1] * ac[2] - ab[2] * ac[1]) + ap[1] * (ab[2] * ac[0] - ab[0] * ac[2]) +
                              ap[2] * (ab[0] * ac[1] - ab[1] * ac[0]);
  return det > 0 ? 1 : (det < 0 ? -1 : 0);
}

TEST(Overlap, OfAVertexWithinRoundingOfATurnedFaceIsNeverWrong) {
  // The other way round: the face is B's, so its plane and every support value along its normal are rounded. B is a
  // tetrahedron, whose placed face is a plane exactly; on which side of it A's vertices lie is decided in rationals.
  std::mt19937_64 random(19);
  int n_by_filter = 0, n_by_exact = 0, n_meets = 0, n_apart = 0;
  for (const double stretch : {1.0, 1e3, 1e6, 1e9}) {
    const TestPolytope a = test_box(1, 2, 3);
    const std::vector<Vec3d> corners = {{stretch, 0, 0}, {-stretch, stretch, 0}, {-stretch, -stretch, 0}, {0, 0, -1}};
    const TestPolytope b = test_hull(corners, {-0.25 * stretch, 0, -0.25}, 0.0);
    const double reach = a.body.reach() + b.body.reach();
    for (int k = 0; k < 2000; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d normal{pose.row_x.z, pose.row_y.z, pose.row_z.z};  // of the face z = 0 of B, outwards
      const Vec3d vertex = a.body.support(-normal);
      const double u = 0.2 + 0.2 * random_in_unit_interval(random), v = 0.2 + 0.2 * random_in_unit_interval(random);
      const Vec3d inside = pose(u * corners[0] + v * corners[1] + (1.0 - u - v) * corners[2]);
      const double gap =
          std::ldexp(reach * (2.0 * random_in_unit_interval(random) - 1.0), -42 - static_cast<int>(random() % 14));
      pose.translation = vertex + gap * normal - inside;
      const std::vector<Vec3d> placed = exact::placed(corners, pose);
      const std::array<Vec3d, 3> face = {placed[0], placed[1], placed[2]};
      bool apart = true;
      for (const Vec3d& p : a.vertices) apart = apart && side_of(face, p) > 0;
      const bool meets = side_of(face, vertex) <= 0;  // then the vertex is in B: it is far from B's other faces
      if (!apart && !meets) continue;
      (apart ? n_apart : n_meets) += 1;
      const Verdict verdict = overlap(a.body, b.body, pose);
      (verdict.by == DecidedBy::exact ? n_by_exact : n_by_filter) += 1;
      ASSERT_EQ(verdict.outcome, apart ? Outcome::disjoint : Outcome::overlap)
          << "stretch " << stretch << ", placement " << k;
    }
  }
  EXPECT_GT(n_meets, 1500);
  EXPECT_GT(n_apart, 1500);
  EXPECT_GT(n_by_filter, 800);
  EXPECT_GT(n_by_exact, 800);
}

TEST(Overlap, GivenUpIsSaidSo) {
  // A cap too low for anything: no verdict, and the reason is the cap.
  const ConvexBody body = Ellipsoid(1, 2, 3);  // 1e-6 deep in each other, across no axis
  OverlapCertificate proof;
  const Verdict verdict = overlap(body, body, shifted(1.154699, 2.309399, 3.464099), &proof, 2);
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_EQ(verdict.reason, UndecidedReason::iteration_cap);
  EXPECT_GE(proof.n_support_calls, 14 + 10)
      << "two from each of three starts and four to find each of the later two; then "
         "in double-double six to find two, and two from each";
}

TEST(Overlap, DoesNotDependOnTheUnitOfLength) {
  std::mt19937_64 random(15);
  for (const double scale : {0x1p-147, 0x1p-30, 0x1p30, 0x1p147}) {
    const TestPolytope one = test_box(1, 2, 0.5), scaled = test_box(scale, 2 * scale, 0.5 * scale);
    const Domain domain = ball_domain(one.body, one.body);
    const ConvexBody curved = Ellipsoid(1, 2, 0.5), curved_scaled = Ellipsoid(scale, 2 * scale, 0.5 * scale);
    for (int k = 0; k < 300; ++k) {
      Transformd pose = random_pose(random, domain, one.body);
      const Verdict verdict = overlap(one.body, one.body, pose);
      const Verdict verdict_of_curved = overlap(curved, curved, pose);
      pose.translation = scale * pose.translation;
      ASSERT_EQ(overlap(scaled.body, scaled.body, pose), verdict);
      ASSERT_EQ(overlap(curved_scaled, curved_scaled, pose), verdict_of_curved);
    }
  }
}

TEST(Overlap, TakesSizeRatiosOfAMillion) {
  const ConvexBody large = Box(1e6, 1e6, 1e6), small = Sphere(1.0);
  EXPECT_EQ(overlap(large, small, shifted(5e5 + 0.99, 17, 3)).outcome, Outcome::overlap);
  EXPECT_EQ(overlap(large, small, shifted(5e5 + 1.01, 17, 3)).outcome, Outcome::disjoint);
  EXPECT_EQ(overlap(small, large, shifted(-5e5 - 0.99, 17, 3)).outcome, Outcome::overlap);
  EXPECT_EQ(overlap(small, large, shifted(-5e5 - 1.01, 17, 3)).outcome, Outcome::disjoint);
}

TEST(Overlap, CertificateOfOverlapIsASimplexAroundTheOrigin) {
  std::mt19937_64 random(16);
  const TestPolytope a = test_box(1, 1, 1), b = test_point_hull(20, {1, 2, 1}, 9);
  const Domain domain = ball_domain(a.body, b.body);
  int n = 0;
  for (int k = 0; k < 200; ++k) {
    OverlapCertificate proof;
    const Transformd pose = random_pose(random, domain, b.body);
    if (overlap(a.body, b.body, pose, &proof).outcome != Outcome::overlap) continue;
    ++n;
    std::vector<exact::Point> simplex;
    for (int i = 0; i < proof.n_witnesses; ++i) {
      const Witness& witness = proof.witnesses[static_cast<std::size_t>(i)];
      simplex.push_back(exact::minus(exact::exactly(witness.point_a), exact::exactly(pose(witness.point_b))));
    }
    ASSERT_FALSE(simplex.empty());
    EXPECT_EQ(exact::inner(exact::nearest_point(simplex), exact::nearest_point(simplex)), 0);
  }
  EXPECT_GT(n, 20);
}

}  // namespace
}  // namespace vex
