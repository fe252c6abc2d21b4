// What vex_pair is asked, in words: what they mean, and which of them do not go together.
#include "apps/vex_pair/query_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/query/margin.h"
#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

QueryWords words_of(const std::string& query, const std::string& motion = "") {
  QueryWords words;
  words.query = query;
  if (query == "ray") words.ray = motion;
  if (query == "cast") words.cast = motion;
  if (query == "toi") words.toi = motion;
  return words;
}

// The words are refused with an Error of this kind, which says this, and what to do.
template <class Refusal>
void expect_refused(const QueryWords& words, const std::string& part) {
  SCOPED_TRACE(part);
  try {
    interpret_query(words);
    FAIL() << "not refused";
  } catch (const Refusal& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find(" - "), std::string::npos) << "what to do is missing: " << message;
  }
}

void expect_vector(const Vec3d& found, double x, double y, double z) {
  EXPECT_EQ(found.x, x);
  EXPECT_EQ(found.y, y);
  EXPECT_EQ(found.z, z);
}

TEST(QueryOptions, EveryQueryHasAName) {
  EXPECT_EQ(interpret_query({}).query, Query::overlap);
  EXPECT_EQ(interpret_query(words_of("overlap")).query, Query::overlap);
  EXPECT_EQ(interpret_query(words_of("distance")).query, Query::distance);
  EXPECT_EQ(interpret_query(words_of("depth")).query, Query::depth);
  EXPECT_EQ(interpret_query(words_of("signed")).query, Query::signed_distance);
  EXPECT_EQ(interpret_query(words_of("ray", "0,0,0,1,0,0")).query, Query::ray);
  EXPECT_EQ(interpret_query(words_of("cast", "1,0,0")).query, Query::cast);
  EXPECT_EQ(interpret_query(words_of("toi", "0,0,0,0,0,0")).query, Query::time_of_impact) << "rest is a motion, too";
  EXPECT_EQ(interpret_query(words_of("manifold")).query, Query::manifold);
  expect_refused<UsageError>(words_of("volume"), "not a choice (\"volume\" for --query)");
  expect_refused<UsageError>(words_of("Distance"), "not a choice");
}

TEST(QueryOptions, FourContactsGoWithAManifoldThatNeedNotBeProven) {
  QueryWords words = words_of("manifold");
  EXPECT_FALSE(interpret_query(words).four_at_most);
  words.four_at_most = true;
  EXPECT_TRUE(interpret_query(words).four_at_most);
  words.certificate = true;
  expect_refused<UsageError>(words, "--four-at-most with --certificate");
  words = words_of("distance");
  words.four_at_most = true;
  expect_refused<UsageError>(words, "--four-at-most with --query distance");
}

TEST(QueryOptions, NumbersOfAMotion) {
  const QuerySettings ray = interpret_query(words_of("ray", "1,2,3, -4 ,0x1p-1,6"));
  expect_vector(ray.ray_origin, 1, 2, 3);
  expect_vector(ray.velocity, -4, 0.5, 6);
  const QuerySettings cast = interpret_query(words_of("cast", "0,0,1e-300"));
  expect_vector(cast.velocity, 0, 0, 1e-300);
  const QuerySettings impact = interpret_query(words_of("toi", "1,2,3,4,5,360"));
  expect_vector(impact.velocity, 1, 2, 3);
  expect_vector(impact.angular_velocity_degrees, 4, 5, 360);
  expect_refused<UsageError>(words_of("ray", "0,0,0,1,0"), "wrong number of numbers (5 for --ray)");
  expect_refused<UsageError>(words_of("cast", "1,0,x"), "not a number (\"x\" for --cast)");
  expect_refused<UsageError>(words_of("toi", "1,0,0"), "wrong number of numbers (3 for --toi)");
  expect_refused<InputError>(words_of("ray", "0,0,0,inf,0,0"), "not finite");
  expect_refused<InputError>(words_of("cast", "nan,0,0"), "not finite");
  expect_refused<InputError>(words_of("toi", "0,0,0,0,0,1e999"), "out of the range of doubles");
}

TEST(QueryOptions, ADirectionHasALength) {
  expect_refused<InputError>(words_of("ray", "1,2,3,0,0,0"), "a direction of length 0 (0,0,0 for --ray)");
  expect_refused<InputError>(words_of("cast", "0,-0,0"), "a direction of length 0 (0,0,0 for --cast)");
}

TEST(QueryOptions, WhatAQueryNeedsAndWhatItDoesNotHave) {
  expect_refused<UsageError>(words_of("ray"), "a ray is asked for and not given (--query ray) - add --ray ox,oy,oz");
  expect_refused<UsageError>(words_of("cast"), "not given (--query cast) - add --cast dx,dy,dz");
  expect_refused<UsageError>(words_of("toi"), "not given (--query toi) - add --toi vx,vy,vz,wx,wy,wz");
  for (const char* query : {"", "overlap", "distance", "depth", "signed", "manifold", "cast", "toi"}) {
    QueryWords words = words_of(query, "1,0,0");
    words.ray = "0,0,0,1,0,0";
    expect_refused<UsageError>(words, "a ray is given and not asked for (--ray with --query ");
  }
  QueryWords words = words_of("ray", "0,0,0,1,0,0");
  words.cast = "1,0,0";
  expect_refused<UsageError>(words, "(--cast with --query ray) - add --query cast, or leave it out");
  words = words_of("distance");
  words.toi = "1,0,0,0,0,0";
  expect_refused<UsageError>(words, "(--toi with --query distance)");
}

TEST(QueryOptions, AMarginIsALengthOfOverlapAndManifold) {
  const auto with_margin = [](const std::string& query, const std::string& margin) {
    QueryWords words = words_of(query, query == "ray" ? "0,0,0,1,0,0" : query == "cast" ? "1,0,0" : "1,0,0,0,0,0");
    words.margin = margin;
    return words;
  };
  EXPECT_EQ(interpret_query(with_margin("overlap", "0.25")).margin, 0.25);
  EXPECT_EQ(interpret_query(with_margin("manifold", "0x1p-3")).margin, 0.125);
  EXPECT_EQ(interpret_query(with_margin("", "0")).margin, 0.0);
  for (const char* query : {"distance", "depth", "signed", "ray", "cast", "toi"}) {
    expect_refused<UsageError>(with_margin(query, "0.1"), "a margin goes with overlap and manifold");
  }
  expect_refused<UsageError>(with_margin("overlap", "-0.1"), "a margin below 0 (-0.1 for --margin)");
  expect_refused<UsageError>(with_margin("overlap", "1,2"), "wrong number of numbers (2 for --margin)");
  expect_refused<InputError>(with_margin("overlap", "inf"), "not finite");
  expect_refused<InputError>(with_margin("overlap", "1e151"), "a margin out of range");
  expect_refused<InputError>(with_margin("manifold", "1e-151"), "a margin out of range");
}

TEST(QueryOptions, ACertificateIsOfAnyQuery) {
  for (QueryWords words : {words_of(""), words_of("overlap"), words_of("distance"), words_of("depth"),
                           words_of("signed"), words_of("manifold"), words_of("ray", "0,0,0,1,0,0"),
                           words_of("cast", "1,0,0"), words_of("toi", "0,0,0,0,0,1")}) {
    words.certificate = true;
    EXPECT_TRUE(interpret_query(words).with_certificate) << words.query;
  }
}

TEST(QueryOptions, AnEndIsOfMotionsAndALargestDistanceOfDistances) {
  for (QueryWords words : {words_of("ray", "0,0,0,1,0,0"), words_of("cast", "1,0,0"), words_of("toi", "0,0,0,0,0,1")}) {
    EXPECT_EQ(interpret_query(words).until, HUGE_VAL);
    words.until = "2.5";
    EXPECT_EQ(interpret_query(words).until, 2.5);
    words.until = "-1";
    expect_refused<UsageError>(words, "an end below 0 (-1 for --until)");
  }
  QueryWords words = words_of("distance");
  words.max_distance = "0.25";
  EXPECT_EQ(interpret_query(words).max_distance, 0.25);
  words.until = "1";
  expect_refused<UsageError>(words, "(--until with --query distance)");
  words = words_of("signed");
  words.max_distance = "1";
  expect_refused<UsageError>(words, "(--max-distance with --query signed)");
}

TEST(QueryOptions, AMovesWithAnImpactOnly) {
  QueryWords words = words_of("toi", "0,0,0,0,0,1");
  words.toi_a = "1,2,3,4,5,6";
  const QuerySettings settings = interpret_query(words);
  expect_vector(settings.velocity_a, 1, 2, 3);
  expect_vector(settings.angular_velocity_a_degrees, 4, 5, 6);
  words = words_of("cast", "1,0,0");
  words.toi_a = "1,2,3,4,5,6";
  expect_refused<UsageError>(words, "(--toi-a with --query cast)");
}

// What a pair of bodies is widened by: on the side that was asked for, and by no more than the next double.
TEST(QueryOptions, AMarginIsRoundedToTheSafeSide) {
  std::mt19937_64 random(20020711);
  std::uniform_real_distribution<double> exponent(-40.0, 40.0), mantissa(1.0, 2.0);
  std::size_t n_rounded = 0;
  for (int k = 0; k < 100000; ++k) {
    const double radius = std::ldexp(mantissa(random), static_cast<int>(exponent(random)));
    const double margin = std::ldexp(mantissa(random), static_cast<int>(exponent(random)));
    const double down = margin_rounded_down(radius, margin), up = margin_rounded_up(radius, margin);
    const DoubleDouble exact = two_sum(radius, margin);
    ASSERT_GE(down, 0.0);
    ASSERT_LE(down, margin);
    ASSERT_GE(up, margin);
    const double low = radius + down, high = radius + up;
    ASSERT_TRUE(low < exact.high || (low == exact.high && exact.low >= 0.0)) << radius << " " << margin;
    ASSERT_TRUE(high > exact.high || (high == exact.high && exact.low <= 0.0)) << radius << " " << margin;
    ASSERT_LE(high, std::nextafter(std::nextafter(low, HUGE_VAL), HUGE_VAL));
    if (exact.low != 0.0) ++n_rounded;
  }
  EXPECT_GT(n_rounded, 50000u);
}

}  // namespace
}  // namespace vex
