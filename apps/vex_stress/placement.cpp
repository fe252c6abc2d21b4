#include "apps/vex_stress/placement.h"

#include <cmath>
#include <utility>

#include "apps/referees/difference_body.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/poses/pose_map.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

// 32 bits of a stratum's name (FNV-1a), so that a new stratum changes no other one's poses.
std::uint32_t hash_of(std::string_view name) {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

ExactForm form_of(const ConvexBody& body, const std::string& name) {
  std::optional<ExactForm> form = body.exact_form();
  if (!form)
    throw InputError("a body without an exact form (" + name + ") - the strata are made of bodies that tell theirs");
  return *std::move(form);
}

}  // namespace

Draw::Draw(std::uint64_t seed, std::string_view stratum, std::uint64_t index)
    : seed_(seed), index_((std::uint64_t{hash_of(stratum)} << 32) | (index & 0xffffffu)) {
  draw_unit_cube(seed_, Stream::pose, index_, numbers_);
}

double Draw::operator()() {
  if (next_ == kMany) {
    ++n_refilled_;
    draw_unit_cube(seed_, Stream::pose, index_ | (n_refilled_ << 24), numbers_);
    next_ = 0;
  }
  return numbers_[next_++];
}

std::size_t Draw::below(std::size_t n) { return static_cast<std::size_t>((*this)() * static_cast<double>(n)); }

Vec3d Draw::unit_direction() {
  const double u = (*this)(), v = (*this)();
  return uniform_in_unit_ball(u, v, 1.0);
}

Transformd Draw::rotation() {
  const double u = (*this)(), v = (*this)(), w = (*this)();
  return uniform_rotation(u, v, w);
}

StressPair::StressPair(std::string pair_name, ConvexBody body_a, ConvexBody body_b)
    : name(std::move(pair_name)),
      a(std::move(body_a)),
      b(std::move(body_b)),
      form_a(form_of(a, name)),
      form_b(form_of(b, name)),
      features_a(features_of(form_a)),
      features_b(features_of(form_b)) {}

StressPair named_pair(const std::string& text) {
  const std::size_t blank = text.find(' ');
  const std::string first = text.substr(0, blank);
  const std::string second = blank == std::string::npos ? first : text.substr(blank + 1);
  return {text, parse_shape(first).body, parse_shape(second).body};
}

StressPose beside_contact(const StressPair& pair, const Transformd& turn, const Vec3d& normal, double distance) {
  Transformd at_origin = turn;
  at_origin.translation = {};
  const exact::DifferenceBody difference(pair.form_a, pair.form_b, at_origin);
  const exact::Vec3dd w = difference.support({normal.x, normal.y, normal.z}).approximately;
  const double scale = 1.0 / difference.scale();
  StressPose result{at_origin, normal};
  const Vec3d contact = scale * Vec3d{w.x.value(), w.y.value(), w.z.value()};
  result.a_from_b.translation = contact + distance * normal;
  return result;
}

StressPose with_points_at(const Vec3d& p_a, const Vec3d& p_b, const Transformd& turn, const Vec3d& normal,
                          double distance) {
  StressPose result{turn, normal};
  result.a_from_b.translation = {};
  result.a_from_b.translation = (p_a - result.a_from_b(p_b)) + distance * normal;
  return result;
}

double random_distance(const StressPair& pair, Draw& draw) {
  const double exponent = 3.0 + static_cast<double>(draw.below(14));
  const double sign = draw.sign();
  return sign * std::pow(10.0, -exponent) * pair.size();
}

StressPose place_near(const StressPair& pair, Draw& draw) {
  const Transformd turn = draw.rotation();
  const Vec3d normal = draw.unit_direction();
  return beside_contact(pair, turn, normal, random_distance(pair, draw));
}

}  // namespace vex
