#include "apps/vex_pair/query_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "apps/common/numbers.h"
#include "apps/vex_pair/pose_text.h"
#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

// An option that one query has and needs.
struct OwnOption {
  Query query;
  const char* name;
  const char* numbers;
  const char* what;
  std::string QueryWords::*word;
};
constexpr std::array kOwnOptions = {
    OwnOption{Query::ray, "--ray", "ox,oy,oz,dx,dy,dz", "a ray", &QueryWords::ray},
    OwnOption{Query::cast, "--cast", "dx,dy,dz", "a motion without a turn", &QueryWords::cast},
    OwnOption{Query::time_of_impact, "--toi", "vx,vy,vz,wx,wy,wz", "a motion", &QueryWords::toi}};

Query query_of_word(const std::string& word) {
  if (word.empty()) return Query::overlap;
  const auto* const found = std::ranges::find_if(kQueries, [&](Query query) { return name_of(query) == word; });
  if (found != kQueries.end()) return *found;
  std::string names;
  for (const Query query : kQueries) names += (names.empty() ? "" : ", ") + std::string(name_of(query));
  throw UsageError("not a choice (\"" + word + "\" for --query) - choose one of " + names);
}

void require_own_options(const QueryWords& words, Query query) {
  const std::string asked = "--query " + std::string(name_of(query));
  for (const OwnOption& option : kOwnOptions) {
    const bool is_given = !(words.*option.word).empty(), is_needed = option.query == query;
    if (is_given && !is_needed) {
      throw UsageError(std::string(option.what) + " is given and not asked for (" + option.name + " with " + asked +
                       ") - add --query " + std::string(name_of(option.query)) + ", or leave it out");
    }
    if (is_needed && !is_given) {
      throw UsageError(std::string(option.what) + " is asked for and not given (" + asked + ") - add " + option.name +
                       " " + option.numbers);
    }
  }
  if (!words.margin.empty() && query != Query::overlap && query != Query::manifold) {
    throw UsageError("a margin goes with overlap and manifold (--margin with " + asked +
                     ") - leave it out; --query distance tells how near the bodies are");
  }
  if (words.four_at_most && query != Query::manifold) {
    throw UsageError("four contacts go with manifold (--four-at-most with " + asked +
                     ") - leave it out, or add --query manifold");
  }
  if (words.four_at_most && words.certificate) {
    throw UsageError(
        "four of a manifold's contacts need not surround the nearest points, which is what is proven (--four-at-most "
        "with --certificate) - leave one of them out");
  }
  if (!words.toi_a.empty() && query != Query::time_of_impact) {
    throw UsageError("a motion of A goes with toi (--toi-a with " + asked + ") - leave it out, or add --query toi");
  }
  if (!words.until.empty() && !is_of_motion(query)) {
    throw UsageError("an end goes with motions (--until with " + asked +
                     ") - leave it out, or ask for ray, cast or toi");
  }
  if (!words.max_distance.empty() && query != Query::distance) {
    throw UsageError("a largest distance goes with distance (--max-distance with " + asked +
                     ") - leave it out, or add --query distance");
  }
}

// The numbers of a ray or a motion.
void read_motion(const std::string& word, const char* option, std::span<double> numbers) {
  read_numbers(word, option, numbers);
  for (const double number : numbers) {
    if (std::fabs(number) <= kFarthest) continue;
    throw InputError("a number out of range (" + short_number(number) + " for " + option + ", and " +
                     short_number(kFarthest) + " is the most) - choose another unit of length or of time");
  }
}

// A time or a distance, from 0 up; inf is none, as without the option.
double end_of_word(const std::string& word, const char* option) {
  if (word == "inf") return HUGE_VAL;
  std::array<double, 1> number{};
  read_motion(word, option, number);
  if (number[0] < 0.0) throw UsageError("an end below 0 (" + word + " for " + option + ") - give 0 or more");
  return number[0] + 0.0;  // not -0
}

double margin_of_word(const std::string& word) {
  std::array<double, 1> number{};
  read_numbers(word, "--margin", number);
  const double margin = number[0];
  if (margin < 0.0) throw UsageError("a margin below 0 (" + word + " for --margin) - give 0 or more");
  if (margin != 0.0 && !(margin >= kQueriedSizes.smallest && margin <= kQueriedSizes.largest)) {
    throw InputError("a margin out of range (" + word + " for --margin) - choose another unit of length");
  }
  return margin;
}

Vec3d direction_of(const Vec3d& dir, const char* option) {
  if (dir.x == 0.0 && dir.y == 0.0 && dir.z == 0.0) {
    throw InputError(std::string("a direction of length 0 (0,0,0 for ") + option + ") - any other length will do");
  }
  return dir;
}

}  // namespace

void declare_query_options(OptionParser& options, QueryWords& words, const std::string& heading) {
  options
      .add_option(
          "--query", words.query,
          "overlap (default): do A and B share a point? distance: how far apart? depth: how deep in each other, "
          "the shortest way out? signed: distance or depth, as the case is. ray: which body does a ray hit "
          "first, and when? cast: when does B meet A, moving straight? toi: when, moving and turning? manifold: "
          "signed, and the points where faces touch")
      .type_name("NAME")
      .group(heading);
  options
      .add_option("--ray", words.ray,
                  "Of --query ray: origin and direction, of any length but 0, in A's frame. The parameter is in units "
                  "of the direction's length. Hit is \"either\" where rounding leaves open which body is first")
      .type_name("ox,oy,oz,dx,dy,dz")
      .group(heading);
  options
      .add_option("--cast", words.cast, "Of --query cast: how B moves, in A's frame; the parameter is in units of this")
      .type_name("dx,dy,dz")
      .group(heading);
  options
      .add_option("--toi", words.toi,
                  "Of --query toi: B's velocity, and its angular velocity about its origin in degrees, each per unit "
                  "of time, in A's frame")
      .type_name("vx,vy,vz,wx,wy,wz")
      .group(heading);
  options
      .add_option("--toi-a", words.toi_a,
                  "Of --query toi: the same of A, which moves as well, in its own frame as it is at first. Two bodies "
                  "that turn and stay where they are need --until")
      .type_name("vx,vy,vz,wx,wy,wz")
      .group(heading);
  options
      .add_option("--margin", words.margin,
                  "Of --query overlap: a gap up to this counts as an overlap. Of manifold: contacts are given up to "
                  "this gap (default 0)")
      .type_name("M")
      .group(heading);
  options
      .add_flag("--four-at-most", words.four_at_most,
                "Of --query manifold: of more than four contacts those four that are enough for a body to rest on, the "
                "same ones from step to step")
      .group(heading);
  options
      .add_option("--until", words.until,
                  "Of ray, cast and toi: the last parameter or time that is looked at. That there is no contact then "
                  "means until this one. Of balls, a contact within rounding of it is undecided")
      .type_name("T")
      .group(heading);
  options
      .add_option("--max-distance", words.max_distance,
                  "Of --query distance: larger ones need not be known. The search ends once it is proven that the "
                  "bodies are farther apart")
      .type_name("D")
      .group(heading);
  options
      .add_flag("--certificate", words.certificate,
                "Give what proves each answer, verdict and bounds, and whether exact arithmetic has proven it again "
                "from that")
      .group(heading);
}

QuerySettings interpret_query(const QueryWords& words) {
  QuerySettings settings;
  settings.query = query_of_word(words.query);
  require_own_options(words, settings.query);
  std::array<double, 6> n{};
  if (!words.ray.empty()) {
    read_motion(words.ray, "--ray", n);
    settings.ray_origin = {n[0], n[1], n[2]};
    settings.velocity = direction_of({n[3], n[4], n[5]}, "--ray");
  }
  if (!words.cast.empty()) {
    read_motion(words.cast, "--cast", std::span(n).first<3>());
    settings.velocity = direction_of({n[0], n[1], n[2]}, "--cast");
  }
  if (!words.toi.empty()) {
    read_motion(words.toi, "--toi", n);
    settings.velocity = {n[0], n[1], n[2]};
    settings.angular_velocity_degrees = {n[3], n[4], n[5]};
  }
  if (!words.toi_a.empty()) {
    read_motion(words.toi_a, "--toi-a", n);
    settings.velocity_a = {n[0], n[1], n[2]};
    settings.angular_velocity_a_degrees = {n[3], n[4], n[5]};
  }
  if (!words.margin.empty()) settings.margin = margin_of_word(words.margin);
  if (!words.until.empty()) settings.until = end_of_word(words.until, "--until");
  if (!words.max_distance.empty()) settings.max_distance = end_of_word(words.max_distance, "--max-distance");
  settings.with_certificate = words.certificate;
  settings.four_at_most = words.four_at_most;
  return settings;
}

}  // namespace vex
