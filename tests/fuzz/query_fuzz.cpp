#include "query_fuzz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"
#include "engine/query/certificate.h"
#include "engine/query/contact_certificate.h"
#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "engine/query/separation_certificate.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/support/convex_body.h"
#include "engine/support/validate.h"

namespace vex::tests {
namespace {

MostAsked g_most;

/// Numbers from bytes; zeros when they are used up.
class Bytes {
 public:
  explicit Bytes(std::string_view data) : rest_(data) {}

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  unsigned below(unsigned n) { return byte() % n; }

  /// Mostly of usual sizes, some of them special, some of any bits.
  double number() {
    static constexpr double kSpecial[] = {0.0,
                                          -0.0,
                                          1.0,
                                          -1.0,
                                          1e-300,
                                          -1e300,
                                          1e300,
                                          5e-324,
                                          1e-160,
                                          1e160,
                                          std::numeric_limits<double>::infinity(),
                                          -std::numeric_limits<double>::infinity(),
                                          std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::max(),
                                          1.0 + 0x1p-52,
                                          0x1p-30};
    const std::uint8_t kind = byte();
    if (kind < 160) return (static_cast<double>(kind) - 80.0) / 32.0;
    if (kind < 200) return kSpecial[kind % std::size(kSpecial)];
    std::array<std::uint8_t, 8> bits{};
    for (std::uint8_t& one : bits) one = byte();
    double value = 0.0;
    std::memcpy(&value, bits.data(), sizeof value);
    if (kind < 230) return std::ldexp(std::frexp(value, &ignored_), static_cast<int>(kind) - 215);
    return value;
  }
  /// A length that a body may claim.
  double length() {
    const double value = std::fabs(number());
    return std::isfinite(value) && value < 1e300 ? value : 1.0;
  }
  Vec3d vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Vec3d finite_vector() {
    const Vec3d v = vector();
    return is_finite(v) ? v : Vec3d{1.0, 0.5, 0.25};
  }

 private:
  std::string_view rest_;
  int ignored_ = 0;
};

enum class Lie : std::uint8_t {
  none,
  nearest,       // the nearest of its points, not the farthest
  some_point,    // any of them
  noise,         // anything within a ball, by the direction
  restless,      // another one at each call
  no_number,     // NaN for some directions
  infinite,      // infinity for some
  beyond,        // a point as far as the direction is long
  zero,          // always the origin
  outside_ball,  // points beyond the circumradius
  kCount
};

/// Counts how often any copy of it is asked.
struct Liar {
  std::vector<Vec3d> points;
  Lie lie = Lie::none, lie_of_core = Lie::none;
  std::uint32_t noise = 1;
  Vec3d centre_{};
  double circumradius_ = 1.0, inradius_ = 0.0, error = 0.0, core_error = 0.0, ball = 0.0, rolling = 0.0;
  bool as_kernels = false;
  std::optional<ExactForm> form;
  std::optional<Generators> sum;
  std::shared_ptr<std::uint64_t> n_calls;
  std::uint64_t n_most = kMostPointsOfAQuery;

  Vec3d answer(const Vec3d& dir, Lie how) const {
    ++*n_calls;
    if (*n_calls > n_most) throw std::logic_error("broken: a query ends");
    std::uint32_t hash = noise;
    for (const double coordinate : {dir.x, dir.y, dir.z}) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ static_cast<std::uint32_t>(bits ^ (bits >> 32))) * 0x9E3779B1u;
      hash ^= hash >> 15;
    }
    if (how == Lie::restless) hash += static_cast<std::uint32_t>(*n_calls) * 0x85EBCA77u;
    const auto unit = [&hash] {
      hash = hash * 1664525u + 1013904223u;
      return static_cast<double>(hash) * 0x1p-31 - 1.0;
    };
    Vec3d found = points.front();
    for (const Vec3d& p : points) {
      const bool is_farther = dot(dir, p) > dot(dir, found);
      if (how == Lie::nearest ? !is_farther : is_farther) found = p;
    }
    switch (how) {
      case Lie::none:
      case Lie::nearest: return found;
      case Lie::some_point: return points[hash % points.size()];
      case Lie::noise:
      case Lie::restless: return {centre_.x + unit(), centre_.y + unit(), centre_.z + unit()};
      case Lie::no_number: return hash % 4 == 0 ? Vec3d{std::nan(""), found.y, found.z} : found;
      case Lie::infinite: return hash % 4 == 0 ? Vec3d{found.x, -HUGE_VAL, found.z} : found;
      case Lie::beyond: return found + dir;
      case Lie::zero: return {};
      default: return 1e3 * found;
    }
  }

  Vec3d support(const Vec3d& dir) const {
    const Vec3d core = answer(dir, lie);
    const double length = norm(dir);
    return ball > 0.0 && length > 0.0 ? core + (ball / length) * dir : core;
  }
  Vec3d core_support(const Vec3d& dir) const { return answer(dir, lie_of_core); }
  double core_support_error() const { return core_error; }
  double support_error() const { return error; }
  double ball_radius() const { return ball; }
  double rolling_radius() const { return rolling; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }
  bool rounds_as_kernels() const { return as_kernels; }
  std::optional<ExactForm> exact_form() const { return form; }
  std::optional<Generators> generators() const { return sum; }
};

Liar liar(Bytes& bytes, const std::shared_ptr<std::uint64_t>& n_calls) {
  Liar body;
  body.n_calls = n_calls;
  const unsigned claims = bytes.byte();
  const auto some_lie = [&bytes] { return static_cast<Lie>(bytes.below(static_cast<unsigned>(Lie::kCount))); };
  body.lie = some_lie();
  body.lie_of_core = (claims & 1) != 0 ? some_lie() : body.lie;
  body.noise = 1u + bytes.byte() * 2654435761u;
  for (unsigned n = 1 + bytes.below(9); n > 0; --n) {
    body.points.push_back(body.lie == Lie::none ? bytes.finite_vector() : bytes.vector());
  }
  double reach = 0.0;
  for (const Vec3d& p : body.points) reach = std::fmax(reach, std::isfinite(norm(p)) ? norm(p) : 0.0);
  // What it says of itself: true as far as it knows, or not at all.
  body.circumradius_ = (claims & 2) != 0 ? bytes.length() : reach;
  body.centre_ = (claims & 4) != 0 ? bytes.finite_vector() : Vec3d{};
  body.error = (claims & 8) != 0 ? bytes.length() : 0.0;
  body.core_error = body.error;
  if ((claims & 16) != 0) body.ball = bytes.length();
  if ((claims & 32) != 0) {
    body.inradius_ = std::fmin(bytes.length(), body.circumradius_);
    body.rolling = bytes.length();
    body.as_kernels = bytes.below(2) == 1;
  }
  if ((claims & 64) != 0) {
    ExactForm form;
    if (bytes.below(2) == 0) {
      for (const Vec3d& p : body.points) form.points.push_back(is_finite(p) ? p : Vec3d{});
    } else {
      for (unsigned n = bytes.below(4); n > 0; --n) form.points.push_back(bytes.finite_vector());
      for (unsigned n = bytes.below(3); n > 0; --n) {
        const double x = bytes.length(), y = bytes.length(), z = bytes.length();
        form.pieces.push_back({bytes.finite_vector(), {x, y, z}, bytes.below(2) == 1});
      }
      if (form.points.empty() && form.pieces.empty()) form.points.push_back({});
    }
    form.ball_radius = bytes.below(2) == 0 ? body.ball : bytes.length();
    body.form = form;
  }
  if ((claims & 128) != 0) {
    Generators sum;
    sum.centre = bytes.finite_vector();
    sum.n_vectors = static_cast<int>(bytes.below(4));
    for (int k = 0; k < sum.n_vectors; ++k) sum.vectors[static_cast<std::size_t>(k)] = bytes.finite_vector();
    body.sum = sum;
  }
  return body;
}

Transformd pose_of(Bytes& bytes) {
  const auto w = bytes.number(), x = bytes.number(), y = bytes.number(), z = bytes.number();
  Transformd pose;
  if (std::isfinite(w + x + y + z) && norm_1(Vec3d{x, y, z}) + std::fabs(w) > 0.0) {
    pose = rotation_from_quaternion(w, x, y, z);
  }
  pose.translation = bytes.vector();
  return pose;
}

SeparationSettings settings_of(Bytes& bytes) {
  SeparationSettings settings;
  if (bytes.below(4) != 0) return settings;
  settings.relative_gap = bytes.number();
  settings.max_distance = bytes.number();
  // Of more the caller has to wait for more.
  static constexpr int kCalls[] = {kMaxSupportCalls, 0, 1, 4, 5, 40, -1, std::numeric_limits<int>::min(), 2000};
  settings.max_support_calls = kCalls[bytes.below(std::size(kCalls))];
  return settings;
}

double until_of(Bytes& bytes) { return bytes.below(2) == 0 ? HUGE_VAL : bytes.number(); }

void check(const Verdict& verdict) { demand(verdict.outcome <= Outcome::undecided, "there is an outcome"); }

void ask(unsigned query, const ConvexBody& a, const ConvexBody& b, const Pose& pose, Bytes& bytes) {
  switch (query) {
    case 0: {
      OverlapCertificate certificate;
      const Verdict verdict = overlap(a, b, pose, &certificate);
      check(verdict);
      static_cast<void>(check_certificate(a, b, pose.a_from_b(), verdict.outcome, certificate));
      break;
    }
    case 1: check(overlap(a, b, pose, nullptr, settings_of(bytes).max_support_calls)); break;
    case 2: {
      const SeparationSettings settings = settings_of(bytes);
      WarmStart warm;
      check(signed_distance(a, b, pose, settings, &warm).verdict);
      check(signed_distance(a, b, pose, settings, &warm).verdict);
      break;
    }
    case 14: {
      const Separation found = signed_distance(a, b, pose);
      static_cast<void>(check_certificate(a, b, pose, found, certify(a, b, pose, found)));
      break;
    }
    case 3: check(distance(a, b, pose, settings_of(bytes)).verdict); break;
    case 4: check(penetration_depth(a, b, pose, settings_of(bytes)).verdict); break;
    case 5: {
      const Vec3d motion = bytes.vector();
      check(linear_cast(a, b, pose, motion, until_of(bytes)).verdict);
      break;
    }
    case 15: {
      const Vec3d motion = bytes.vector();
      const FirstContact found = linear_cast(a, b, pose, motion);
      static_cast<void>(check_certificate(a, b, pose, motion, found, certify(a, b, pose, motion, found)));
      break;
    }
    case 16: {
      const RigidMotion motion{bytes.vector(), bytes.vector()};
      const FirstContact found = time_of_impact(a, b, pose, motion, 4.0);
      static_cast<void>(check_certificate(a, b, pose, motion, found, certify(a, b, pose, motion, found, 4.0), 4.0));
      break;
    }
    case 6: {
      const Vec3d origin = bytes.vector(), dir = bytes.vector();
      check(cast_ray(a, origin, dir, until_of(bytes)).verdict);
      break;
    }
    case 7: {
      const RigidMotion of_b{bytes.vector(), bytes.vector()};
      check(time_of_impact(a, b, pose, of_b, until_of(bytes)).verdict);
      break;
    }
    case 8: {
      const RigidMotion of_a{bytes.vector(), bytes.vector()}, of_b{bytes.vector(), bytes.vector()};
      check(time_of_impact(a, b, pose, of_a, of_b, until_of(bytes)).verdict);
      break;
    }
    case 9: {
      const double margin = bytes.number(), angle = bytes.number();
      const ContactManifold found = contact_manifold(a, b, pose, margin, angle);
      demand(found.contacts.size() <= 64, "a manifold has no more corners than its faces");
      break;
    }
    case 10: {
      const BodyPoints points{bytes.vector(), bytes.vector()};
      Transformd rotation = pose.a_from_b();
      rotation.translation = {};
      static_cast<void>(radial_function(a, b, points, Pose(rotation), bytes.vector(), bytes.number()));
      break;
    }
    case 11: static_cast<void>(validate(a, {20, bytes.byte()})); break;
    case 12: static_cast<void>(with_margin(a, bytes.number())); break;
    case 13: static_cast<void>(prove_again(a, b, pose, static_cast<Outcome>(bytes.below(3)))); break;
    default: throw std::logic_error("broken: a query without a case");
  }
}

constexpr std::array kQueries = {"overlap",
                                 "overlap, few calls",
                                 "signed_distance",
                                 "distance",
                                 "depth",
                                 "linear_cast",
                                 "cast_ray",
                                 "time_of_impact",
                                 "time_of_impact of two",
                                 "contact_manifold",
                                 "radial_function",
                                 "validate",
                                 "with_margin",
                                 "prove_again",
                                 "certificate of a distance",
                                 "certificate of a cast",
                                 "certificate of an impact"};

}  // namespace

MostAsked most_asked() { return g_most; }

void query_liars(std::string_view data) {
  Bytes bytes(data);
  const unsigned query = bytes.below(kQueries.size());
  const auto n_calls = std::make_shared<std::uint64_t>(0);
  try {
    Liar first = liar(bytes, n_calls), second = liar(bytes, n_calls);
    const bool is_slow = std::string(kQueries[query]).starts_with("certificate");
    if (is_slow) first.n_most = second.n_most = 10 * kMostPointsOfAQuery;
    const ConvexBody a(first), b(second);
    const Pose pose(pose_of(bytes));
    *n_calls = 0;
    ask(query, a, b, pose, bytes);
  } catch (const InputError&) {
    // What a body says of itself, or a pose, is refused where it cannot be.
  } catch (const UsageError&) {
    // Nor do all settings mean something.
  } catch (const std::exception& error) {
    throw std::logic_error(std::string(kQueries[query]) + ": " + error.what());
  }
  if (*n_calls > g_most.n_points) g_most = {*n_calls, kQueries[query]};
}

std::vector<FuzzFormat> query_formats() { return {{"query", query_liars}}; }

}  // namespace vex::tests
