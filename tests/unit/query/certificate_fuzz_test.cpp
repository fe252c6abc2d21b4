// No certificate whatever may prove what is false: random ones and distorted true ones, against the referees.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/overlap.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/plate.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

double wild(std::mt19937_64& random) {
  switch (random() % 12) {
    case 0: return 0.0;
    case 1: return 1e300 * (random_in_unit_interval(random) - 0.5);
    case 2: return std::ldexp(static_cast<double>(random() % 64), -1074);
    case 3: return HUGE_VAL;
    case 4: return std::nan("");
    default: break;
  }
  return std::ldexp(2.0 * random_in_unit_interval(random) - 1.0, static_cast<int>(random() % 5) - 2);
}
Vec3d wild_vector(std::mt19937_64& random) {
  if (random() % 8 == 0) return {wild(random), wild(random), wild(random)};
  return random_direction(random);
}
// Next to the given one, or far from it.
Vec3d distorted(const Vec3d& v, std::mt19937_64& random) {
  switch (random() % 4) {
    case 0: return wild_vector(random);
    case 1: return v + std::ldexp(1.0, -static_cast<int>(random() % 60)) * random_direction(random);
    case 2: return -v;
    default: return v;
  }
}

OverlapCertificate distorted(const OverlapCertificate& certificate, std::mt19937_64& random) {
  OverlapCertificate c = certificate;
  const bool is_bare = random() % 2 == 0;  // an overlap is claimed without a direction
  c.separating_dir = is_bare ? Vec3d{} : distorted(certificate.separating_dir, random);
  c.separating_dir_low = is_bare ? Vec3d{} : distorted(certificate.separating_dir_low, random);
  if (random() % 3 == 0) c.n_witnesses = static_cast<int>(random() % 6);
  if (c.n_witnesses == 0) c.n_witnesses = 4;
  for (Witness& witness : c.witnesses) {
    witness = certificate.witnesses[random() % 4];
    witness = {distorted(witness.dir, random),     distorted(witness.dir_low, random),
               distorted(witness.dir_b, random),   distorted(witness.dir_b_low, random),
               distorted(witness.point_a, random), distorted(witness.point_b, random)};
  }
  return c;
}

TEST(CertificateFuzz, NothingProvesWhatIsFalse) {
  std::mt19937_64 random(1);
  const ConvexBody box = test_box(1, 1, 1).body, thin = test_box(2, 1, 1e-6).body, plate = Plate(1, 1);
  const ConvexBody round = Ellipsoid(0.5, 0.7, 0.9), flat = Ellipsoid(1, 1, 0.01), capsule = Capsule(1, 0.25);
  const std::vector<std::pair<ConvexBody, ConvexBody>> pairs = {
      {box, box},       {box, thin},        {plate, box},       {plate, plate},
      {round, round},   {round, flat},      {Sphere(1), round}, {round, Sphere(1)},
      {Sphere(1), box}, {capsule, capsule}, {capsule, box},     {Inflated<Plate>(Plate(1, 1), 0.25), thin}};
  int n_certificates = 0, n_proven_truths = 0;
  for (const auto& [a, b] : pairs) {
    for (int k = 0; k < 21; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double contact = contact_along(a, b, pose, dir);
      // A certificate of either outcome, from a step to both sides of contact.
      OverlapCertificate inner, outer;
      pose.translation = (contact * (1.0 - 1e-6)) * dir;
      overlap(a, b, pose, &inner);
      pose.translation = (contact * (1.0 + 1e-6)) * dir;
      overlap(a, b, pose, &outer);
      constexpr double kFactors[] = {0.8, 1.2, 1 - 1e-3, 1 + 1e-3, 1 - 1e-9, 1 + 1e-9, 1 - 1e-15, 1 + 1e-15};
      pose.translation = (contact * kFactors[k % 8]) * dir;
      const Outcome truth = true_outcome(a, b, pose).value();
      const Outcome lie = truth == Outcome::overlap ? Outcome::disjoint : Outcome::overlap;
      for (int j = 0; j < 400; ++j) {
        const OverlapCertificate c = distorted(lie == Outcome::overlap ? inner : outer, random);
        ++n_certificates;
        ASSERT_FALSE(check_certificate(a, b, pose, lie, c).is_proven) << "at " << kFactors[k % 8] << " of contact";
        if (j % 20 == 0) {
          const OverlapCertificate of_truth = distorted(truth == Outcome::overlap ? inner : outer, random);
          n_proven_truths += check_certificate(a, b, pose, truth, of_truth).is_proven ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GE(n_certificates, 100000);
  EXPECT_GT(n_proven_truths, 100) << "distorted so little that some still prove what is true";
}

}  // namespace
}  // namespace vex
