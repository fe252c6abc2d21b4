// Whatever a query answers has a certificate that the exact checker accepts, in every stratum; and no certificate
// proves what is false. vex_certified_queries asks millions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/query/contact_certificate.h"
#include "engine/query/manifold_certificate.h"
#include "engine/query/separation_certificate.h"
#include "tests/referees/certified_query.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

class Certificates : public testing::TestWithParam<QueryStratum> {
 protected:
  QueryScene scene(int k) { return GetParam().scene(random_, k); }
  double size_of(const QueryScene& scene) const { return scene.a.circumradius() + scene.b.circumradius(); }
  // What any promise allows of points far from the origins of frames, and more.
  double rounding_of(const QueryScene& scene) const {
    return 0x1p-42 * (scene.a.reach() + 2.0 * scene.b.reach() + norm_1(scene.pose.translation));
  }

  std::mt19937_64 random_{7};
};

TEST_P(Certificates, EveryAnswerHasOne) {
  int n_decided = 0;
  for (int k = 0; k < 12; ++k) {
    const QueryScene at = scene(k);
    for (const CertifiedQuery query : kCertifiedQueries) {
      const CertifiedAnswer answer = ask(at, query);
      EXPECT_EQ(answer.fault, "") << name_of(query) << " " << at.text();
      n_decided += answer.outcome != Outcome::undecided ? 1 : 0;
    }
  }
  EXPECT_GT(n_decided, 70);
}

// --- false claims, and the best certificate that is found for them

TEST_P(Certificates, NoneProvesAWrongDistance) {
  int n_claims = 0;
  for (int k = 0; k < 10; ++k) {
    const QueryScene at = scene(k);
    const Separation truth = signed_distance(at.a, at.b, at.pose);
    const double wrong = std::fmax(1e-6 * (size_of(at) + std::fabs(truth.signed_distance)), rounding_of(at));
    if (!truth.has_witnesses || !(truth.upper - truth.lower < 1e-3 * wrong)) continue;
    const auto refuses = [&](Separation claim, const char* what) {
      claim.signed_distance = std::fmin(std::fmax(claim.signed_distance, claim.lower), claim.upper);
      const auto proven = [&](const SeparationCertificate& c) {
        return check_certificate(at.a, at.b, at.pose, claim, c).is_proven;
      };
      EXPECT_FALSE(proven(certify(at.a, at.b, at.pose, claim))) << what << " " << at.text();
      EXPECT_FALSE(proven(certify(at.a, at.b, at.pose, truth))) << what << " " << at.text();
      ++n_claims;
    };
    Separation claim = truth;
    claim.lower = truth.upper + wrong;
    claim.upper = claim.lower + wrong;
    refuses(claim, "farther");
    claim = truth;
    claim.upper = truth.lower - wrong;
    claim.lower = claim.upper - wrong;
    refuses(claim, "nearer");
    if (std::fabs(truth.signed_distance) > wrong) {
      claim = truth;
      claim.verdict = truth.verdict.outcome == Outcome::disjoint ? Verdict::overlap(DecidedBy::exact)
                                                                 : Verdict::disjoint(DecidedBy::exact);
      refuses(claim, "the other verdict");
    }
    claim = truth;
    claim.point_a = truth.point_a + wrong * truth.normal;
    claim.point_b = truth.point_b + wrong * truth.normal;
    refuses(claim, "points aside");
    claim = truth;
    claim.normal = -truth.normal;
    if (std::fabs(truth.signed_distance) > wrong) refuses(claim, "the other normal");
  }
  EXPECT_GT(n_claims, 8);
}

template <class Motion>
void expect_no_wrong_contact(const QueryScene& at, const Motion& motion, const FirstContact& truth, int& n_claims) {
  const auto refuses = [&](const FirstContact& claim, const char* what) {
    const auto proven = [&](const ContactCertificate& c) {
      return check_certificate(at.a, at.b, at.pose, motion, claim, c).is_proven;
    };
    EXPECT_FALSE(proven(certify(at.a, at.b, at.pose, motion, claim))) << what << " " << at.text();
    EXPECT_FALSE(proven(certify(at.a, at.b, at.pose, motion, truth))) << what << " " << at.text();
    ++n_claims;
  };
  FirstContact claim = truth;
  if (truth.verdict.outcome == Outcome::disjoint) {
    claim.verdict = Verdict::overlap(DecidedBy::gjk);
    claim.lower = claim.time = 0.0;
    claim.upper = 1.0;
    refuses(claim, "a hit");
    claim.upper = 0.0;
    refuses(claim, "a hit at the start");
    return;
  }
  if (truth.verdict.outcome != Outcome::overlap) return;
  claim.verdict = Verdict::disjoint(DecidedBy::gjk);
  claim.lower = claim.time = claim.upper = HUGE_VAL;
  refuses(claim, "a miss");
  const bool is_narrow = truth.lower > 0.0 && truth.upper - truth.lower <= 1e-8 * truth.lower;
  if (!is_narrow) return;
  claim = truth;
  claim.lower = claim.time = truth.upper * (1.0 + 1e-6);
  claim.upper = claim.lower * (1.0 + 1e-6);
  refuses(claim, "later");
  claim = truth;
  claim.lower = claim.time = 0.25 * truth.lower;
  claim.upper = truth.lower * (1.0 - 1e-6);
  refuses(claim, "earlier");
}

TEST_P(Certificates, NoneProvesAWrongContact) {
  int n_claims = 0;
  for (int k = 0; k < 12; ++k) {
    const QueryScene at = scene(k);
    if (!(norm_1(at.motion.velocity) > 0.0)) continue;
    expect_no_wrong_contact(at, at.motion.velocity, linear_cast(at.a, at.b, at.pose, at.motion.velocity), n_claims);
    if (k % 3 != 0) continue;
    expect_no_wrong_contact(at, at.motion, time_of_impact(at.a, at.b, at.pose, at.motion), n_claims);
  }
  EXPECT_GT(n_claims, 8);
}

TEST_P(Certificates, NoneProvesAWrongManifold) {
  int n_claims = 0;
  for (int k = 0; k < 20; ++k) {
    const QueryScene at = scene(k);
    const double margin = 1e-3 * size_of(at), wrong = std::fmax(1e-5 * size_of(at), rounding_of(at));
    const ContactManifold truth = contact_manifold(at.a, at.b, at.pose, margin);
    if (truth.contacts.empty() || !(promised_accuracy(at.a, at.b, truth.separation) < 1e-2 * wrong)) continue;
    const auto refuses = [&](const ContactManifold& claim, const char* what) {
      EXPECT_FALSE(check_certificate(at.a, at.b, at.pose, claim, certify(at.a, at.b, at.pose, claim), margin).is_proven)
          << what << " " << at.text();
      ++n_claims;
    };
    ContactManifold claim = truth;
    claim.contacts[0].point_a = claim.contacts[0].point_a + wrong * truth.separation.normal;
    claim.contacts[0].signed_distance -= wrong;
    refuses(claim, "a point above A");
    claim = truth;
    claim.contacts[0].signed_distance += wrong;
    refuses(claim, "another distance");
    claim = truth;
    claim.contacts.clear();
    if (truth.separation.upper < margin) refuses(claim, "no contact");
    if (truth.contacts.size() < 3) continue;
    claim = truth;
    std::reverse(claim.contacts.begin(), claim.contacts.end());
    refuses(claim, "clockwise");
  }
  EXPECT_GE(n_claims, GetParam().name == "grazing" || GetParam().name == "far" ? 0 : 8);
}

INSTANTIATE_TEST_SUITE_P(Strata, Certificates, testing::ValuesIn(query_strata()),
                         [](const auto& one) { return one.param.name; });

// --- distorted certificates of what is false by a little

Vec3d distorted(const Vec3d& v, std::mt19937_64& random) {
  switch (random() % 5) {
    case 0: return v + std::ldexp(1.0, -static_cast<int>(random() % 60)) * random_direction(random);
    case 1: return -v;
    case 2: return random_direction(random);
    case 3: return {};
    default: return v;
  }
}

void distort(ExactVector& dir, std::mt19937_64& random) {
  for (ExactVector::Part& part : dir.parts) {
    part.value = distorted(part.value, random);
    if (random() % 8 == 0) part.exponent += static_cast<int>(random() % 100) - 50;
  }
}

void distort(WitnessHull& hull, std::mt19937_64& random) {
  for (Witness& witness : hull.witnesses) {
    for (Vec3d* const v : {&witness.dir, &witness.dir_b, &witness.point_a, &witness.point_b})
      *v = distorted(*v, random);
  }
  for (auto& face : hull.faces) {
    if (random() % 4 == 0) std::swap(face[0], face[1]);
    if (random() % 8 == 0) face[2] = static_cast<std::uint32_t>(random() % 100);
  }
  if (random() % 4 == 0 && !hull.faces.empty()) hull.faces.pop_back();
}

TEST(CertificatesDistorted, ProveNothingFalse) {
  std::mt19937_64 random(11);
  const QueryStratum& stratum = query_strata().front();
  int n_refused = 0;
  for (int k = 0; k < 40; ++k) {
    const QueryScene at = stratum.scene(random, k);
    const Separation truth = signed_distance(at.a, at.b, at.pose);
    Separation farther = truth, nearer = truth;
    const double wrong = 1e-7 * (at.a.circumradius() + at.b.circumradius());
    if (!(truth.upper - truth.lower < wrong)) continue;
    farther.lower = farther.signed_distance = farther.upper = truth.upper + wrong;
    nearer.lower = nearer.signed_distance = nearer.upper = truth.lower - wrong;
    farther.has_witnesses = nearer.has_witnesses = false;
    const SeparationCertificate certificate = certify(at.a, at.b, at.pose, truth);
    const FirstContact hit = linear_cast(at.a, at.b, at.pose, at.motion.velocity + Vec3d{1e-3, 0.0, 0.0});
    const ContactCertificate of_hit = certify(at.a, at.b, at.pose, at.motion.velocity + Vec3d{1e-3, 0.0, 0.0}, hit);
    for (int j = 0; j < 40; ++j) {
      SeparationCertificate c = certificate;
      distort(c.dir, random);
      distort(c.hull, random);
      EXPECT_FALSE(check_certificate(at.a, at.b, at.pose, farther, c).is_proven);
      EXPECT_FALSE(check_certificate(at.a, at.b, at.pose, nearer, c).is_proven);
      ContactCertificate m = of_hit;
      for (auto& apart : m.apart) distort(apart.dir, random);
      distort(m.hull, random);
      FirstContact other = hit;
      other.verdict = hit.verdict.outcome == Outcome::disjoint ? Verdict::overlap(DecidedBy::gjk)
                                                               : Verdict::disjoint(DecidedBy::gjk);
      if (hit.verdict.outcome == Outcome::disjoint) {
        other.lower = other.time = 0.0;
        other.upper = 1e6;
        m.times.assign(m.hull.witnesses.size(), 1.0);
      } else {
        for (auto& apart : m.apart) apart.to = HUGE_VAL;
      }
      EXPECT_FALSE(
          check_certificate(at.a, at.b, at.pose, at.motion.velocity + Vec3d{1e-3, 0.0, 0.0}, other, m).is_proven);
      n_refused += 3;
    }
  }
  EXPECT_GT(n_refused, 2000);
}

}  // namespace

void PrintTo(const QueryStratum& stratum, std::ostream* out) { *out << stratum.name; }

}  // namespace vex
