#include "engine/support/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

using Claim = Violation::Claim;
using Exact = DoubleDouble;  // with bodies about as large as 1, products and sums to 1e-30

// Below it nothing is said to be broken: what the sums here could round off, by far.
constexpr double kRoundingOfExact = 0x1p-95;

Vec3<Exact> exactly(const Vec3d& v) { return {Exact(v.x), Exact(v.y), Exact(v.z)}; }
Exact product(const Vec3d& a, const Vec3<Exact>& b) { return dot(exactly(a), b); }
bool is_same(const Vec3d& a, const Vec3d& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
std::string vector_text(const Vec3d& v) {
  return "(" + shortest_number(v.x) + ", " + shortest_number(v.y) + ", " + shortest_number(v.z) + ")";
}

/// Directions of a cube's inside, made from whole numbers: the same on every machine.
class Directions {
 public:
  explicit Directions(std::uint64_t seed) : random_(seed) {}

  Vec3d any() {
    while (true) {
      const Vec3d d{coordinate(), coordinate(), coordinate()};
      const double square = dot(d, d);
      if (square > 1e-4 && square < 1.0) return d;
    }
  }
  /// A unit in the last place up, down or not at all, in each coordinate.
  Vec3d beside(const Vec3d& d) { return {beside(d.x), beside(d.y), beside(d.z)}; }

 private:
  double coordinate() { return std::ldexp(static_cast<double>(random_() >> 11U), -52) - 1.0; }
  double beside(double x) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    const std::uint64_t pick = random_() % 3;
    return pick == 0 ? x : std::nextafter(x, pick == 1 ? kFar : -kFar);
  }

  std::mt19937_64 random_;
};

class Validation {
 public:
  explicit Validation(const ConvexBody& body) : body_(body), form_(body.exact_form()) {
    const double reach = body.reach();
    exponent_ = reach > 0.0 && std::isfinite(reach) ? std::ilogb(reach) : 0;
    error_ = scaled(body.support_error());
    core_error_ = scaled(body.core_support_error());
    centre_ = scaled(body.centre());
  }

  std::vector<Violation> run(const ValidationSettings& settings) {
    if (!is_finite(body_.support({}))) broken(Claim::finite_points, {}, Exact(HUGE_VAL));
    Directions directions(settings.seed);
    add_axes();
    for (std::size_t k = 0; k < settings.n_directions; ++k) add(directions.any());
    for (std::size_t k = 0; k < settings.n_directions; k += 4) add_hard(&directions);
    add_ties_of_powers();
    for (const Asked& asked : asked_) {
      end_if_interrupted();
      check_alone(asked);
    }
    check_form();
    check_rolling_radius();
    for (const Asked& asked : asked_) {
      end_if_interrupted();
      check_against_others(asked);
    }
    std::vector<Violation> found;
    for (std::optional<Violation>& worst : worst_) {
      if (worst) found.push_back(described(*std::move(worst)));
    }
    return found;
  }

 private:
  struct Asked {
    Vec3d dir;
    double length;  // of the direction, rounded
    Vec3d point;    // scaled
  };

  double scaled(double length) const { return std::ldexp(length, -exponent_); }
  Vec3d scaled(const Vec3d& v) const { return {scaled(v.x), scaled(v.y), scaled(v.z)}; }

  /// Keeps the worst. `by`: scaled, of a direction of length 1.
  void broken(Claim claim, const Vec3d& dir, const Exact& by) {
    const double excess = by.value();
    std::optional<Violation>& worst = worst_[static_cast<std::size_t>(claim)];
    if (!(excess <= kRoundingOfExact) && (!worst || !(excess <= worst->by))) worst = Violation{claim, dir, excess, {}};
  }

  std::optional<Vec3d> add(const Vec3d& dir) {
    end_if_interrupted();
    const double length = norm(dir);
    if (!(length > 0x1p-300 && length < 0x1p300)) return std::nullopt;
    const Vec3d point = body_.support(dir);
    if (!is_finite(point)) {
      broken(Claim::finite_points, dir, Exact(HUGE_VAL));
      return std::nullopt;
    }
    asked_.push_back({dir, length, scaled(point)});
    return asked_.back().point;
  }

  void add_axes() {
    for (const double x : {-1.0, -0.0, 0.0, 1.0}) {
      for (const double y : {-1.0, -0.0, 0.0, 1.0}) {
        for (const double z : {-1.0, -0.0, 0.0, 1.0}) {
          if (x != 0.0 || y != 0.0 || z != 0.0) add({x, y, z});
        }
      }
    }
  }

  /// The normals of the face and of the edge that the support points of near directions span, if they do, and beside.
  void add_hard(Directions* directions) {
    const Vec3d dir = directions->any();
    const auto near = [&] { return dir + 0.3 * directions->any(); };
    const std::optional<Vec3d> p = add(dir), q = add(near()), r = add(near());
    if (!p || !q || !r) return;
    for (const Vec3d& normal : {cross(*q - *p, *r - *p), cross(cross(*q - *p, dir), *q - *p)}) {
      const double length = norm(normal);
      if (!(length > 0x1p-200)) continue;
      const Vec3d unit = (1.0 / length) * normal;
      for (const Vec3d& hard : {unit, -unit}) {
        add(hard);
        add(directions->beside(hard));
      }
    }
  }

  /// A power that is nearly 1 or nearly infinite differs from that in a few directions alone: where the heights of two
  /// semi-axes are the same, or those of the ellipse across and of the axis along.
  void add_ties_of_powers() {
    const std::optional<PowerForm> powers = body_.power_form();
    if (!powers) return;
    const Vec3d axes = scaled(powers->semi_axes);
    const double root = 1.0 / dual_norm(1.0, 1.0, powers->across);
    const double across[][2] = {{1.0, 0.0}, {0.0, 1.0}, {root, root}, {root, -root}};
    for (const auto& [u, v] : across) {
      for (const double w : {0.0, 1.0, -1.0}) {
        for (double beside = 0.0; beside < 1.0; beside = beside == 0.0 ? 0x1p-48 : 16.0 * beside) {
          const Vec3d tie{u / axes.x, v / axes.y, w / axes.z};
          add({tie.x * (1.0 + beside), tie.y, tie.z});
          add({tie.x, tie.y * (1.0 + beside), tie.z});
          add({-tie.x, tie.y, tie.z * (1.0 + beside)});
        }
      }
    }
  }

  void check_alone(const Asked& asked) {
    const auto& [dir, length, point] = asked;
    const Vec3<Exact> at = exactly(point);
    const Exact one_by = Exact(1.0) / norm(exactly(dir));
    const Exact height = product(dir, at) * one_by;  // of a direction of length 1
    for (const double factor : {0x1p-100, 0x1p100}) {
      const Vec3d other = scaled(body_.support(factor * dir));
      if (!is_finite(other)) {
        broken(Claim::finite_points, factor * dir, Exact(HUGE_VAL));
        continue;
      }
      broken(Claim::scale, factor * dir, height - product(dir, exactly(other)) * one_by - Exact(2.0 * error_));
    }
    const Exact centre = product(dir, exactly(centre_)) * one_by;
    broken(Claim::centre, dir, centre - height - Exact(2.0 * error_));
    broken(Claim::circumradius, dir, norm(at - exactly(centre_)) - Exact(scaled(body_.circumradius())) - Exact(error_));
    if (body_.inradius() > 0.0) {
      broken(Claim::inradius, dir, centre + Exact(scaled(body_.inradius())) - height - Exact(error_));
    }
    if (body_.ball_radius() > 0.0) {
      const Exact core = product(dir, exactly(scaled(body_.core_support(dir)))) * one_by;
      const Exact off = height - core - Exact(scaled(body_.ball_radius()));
      broken(Claim::ball_part, dir, (off.high < 0.0 ? -off : off) - Exact(error_) - Exact(core_error_));
    }
    if (body_.generators()) {
      const Exact off = height_of_generators(dir) * one_by - product(dir, exactly(core_of(dir))) * one_by;
      broken(Claim::generators, dir, (off.high < 0.0 ? -off : off) - Exact(core_error_));
    }
    if (const std::optional<PowerForm> powers = body_.power_form()) {
      const double expected = height_of_powers(*powers, dir);
      const Exact off = (Exact(expected) - product(dir, exactly(core_of(dir)))) * one_by;
      broken(Claim::power_form, dir,
             (off.high < 0.0 ? -off : off) - Exact(core_error_) - Exact(0x1p-46 * expected) * one_by);
    }
    if (const std::optional<ProfileForm> profile = body_.profile_form()) {
      const Vec3d at_profile = std::visit([&seen = dir](const auto& its) { return its.support(seen); }, *profile);
      const Exact off = product(dir, exactly(scaled(at_profile)) - exactly(core_of(dir))) * one_by;
      const double its_error = scaled(std::visit([](const auto& its) { return its.support_error(); }, *profile));
      broken(Claim::profile_form, dir, (off.high < 0.0 ? -off : off) - Exact(core_error_) - Exact(its_error));
    }
  }

  Vec3d core_of(const Vec3d& dir) const { return scaled(body_.core_support(dir)); }

  Exact height_of_generators(const Vec3d& dir) const {
    const Generators& generators = *body_.generators();
    Exact height = product(dir, exactly(scaled(generators.centre)));
    for (int k = 0; k < generators.n_vectors; ++k) {
      const Exact along = product(dir, exactly(scaled(generators.vectors[static_cast<std::size_t>(k)])));
      height = height + (along.high < 0.0 ? -along : along);
    }
    return height;
  }

  static double dual_norm(double u, double v, double p) {
    const double largest = std::max(u, v);
    if (!(largest > 0.0) || p == 1.0) return largest;
    const double dual = std::isinf(p) ? 1.0 : p / (p - 1.0);
    return largest * std::pow(1.0 + std::pow(std::min(u, v) / largest, dual), 1.0 / dual);
  }

  /// In double, as such a body's own mapping.
  double height_of_powers(const PowerForm& powers, const Vec3d& dir) const {
    const Vec3d axes = scaled(powers.semi_axes);
    const double across = dual_norm(axes.x * std::fabs(dir.x), axes.y * std::fabs(dir.y), powers.across);
    return dual_norm(across, axes.z * std::fabs(dir.z), powers.along);
  }

  /// Without the ball that is claimed to roll in it the core must still be convex. (In double: a radius that is too
  /// large by a part in 10^6 is allowed by the claim.)
  void check_rolling_radius() {
    constexpr double kAllowed = 1e-5;
    const double radius = scaled(body_.rolling_radius());
    if (!(radius > 0.0)) return;
    std::vector<Vec3d> inner;
    for (const Asked& asked : asked_) inner.push_back(core_of(asked.dir) - (radius / asked.length) * asked.dir);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      end_if_interrupted();
      for (std::size_t j = 0; j < inner.size(); ++j) {
        const double farther = dot(asked_[i].dir, inner[j] - inner[i]) / asked_[i].length;
        if (farther > kAllowed * radius + 2.0 * core_error_ + 0x1p-45) {
          broken(Claim::rolling_radius, asked_[i].dir, Exact(farther));
        }
      }
    }
  }

  /// Of a polytope of very many vertices, along some of the directions.
  void check_form() {
    constexpr std::size_t kMostProducts = 20'000'000;
    if (!form_) return;
    const std::size_t stride = 1 + asked_.size() * form_->points.size() / kMostProducts;
    for (std::size_t k = 0; k < asked_.size(); k += stride) {
      end_if_interrupted();
      const auto& [dir, length, point] = asked_[k];
      const Exact off =
          (height_of_form(dir) - product(dir, exactly(point))) / norm(exactly(dir)) + Exact(scaled(form_->ball_radius));
      broken(Claim::support_error, dir, (off.high < 0.0 ? -off : off) - Exact(error_));
    }
  }

  /// The true support function of the exact form without its ball, scaled.
  Exact height_of_form(const Vec3d& dir) const {
    Exact highest(-HUGE_VAL);
    const auto take = [&highest](const Exact& height) {
      if (highest.high == -HUGE_VAL || (height - highest).high > 0.0) highest = height;
    };
    for (const Vec3d& p : form_->points) take(product(dir, exactly(scaled(p))));
    for (const ExactForm::Piece& piece : form_->pieces) {
      const Vec3<Exact> d = exactly(dir), axes = exactly(scaled(piece.semi_axes));
      Vec3<Exact> stretched{axes.x * d.x, axes.y * d.y, axes.z * d.z};
      if (piece.is_dome && dir.z < 0.0) stretched.z = Exact(0.0);
      take(product(dir, exactly(scaled(piece.centre))) + norm_or_zero(stretched));
    }
    return highest;
  }
  static Exact norm_or_zero(const Vec3<Exact>& v) {
    return v.x.high == 0.0 && v.y.high == 0.0 && v.z.high == 0.0 ? Exact(0.0) : norm(v);
  }

  /// A point within e of the body is no farther than h(d) + e |d|, and h(d) is at most d . s(d) + e |d|.
  void check_against_others(const Asked& asked) {
    const auto& [dir, length, point] = asked;
    // In double first, where a sum of three products is off by less than 8 u of |d| |p - q|: nearly all are far nearer.
    const double allowed = 2.0 * error_ * length;
    for (const Asked& other : asked_) {
      const Vec3d beyond = other.point - point;
      if (!(dot(dir, beyond) > allowed - 0x1p-49 * length * norm_1(beyond))) continue;
      if (is_same(other.point, point)) continue;
      const Exact farther = product(dir, exactly(other.point) - exactly(point)) / norm(exactly(dir));
      broken(Claim::convexity, dir, farther - Exact(2.0 * error_));
    }
  }

  Violation described(Violation violation) const {
    violation.by = std::ldexp(violation.by, exponent_);
    violation.text = words_for(violation.claim) + " (by " + shortest_number(violation.by) + ", for the direction " +
                     vector_text(violation.dir) + ")";
    return violation;
  }

  std::string words_for(Claim claim) const {
    switch (claim) {
      case Claim::finite_points: return "a support point is not finite";
      case Claim::convexity:
        return "the support point of another direction is farther than the direction's own: no convex body has this "
               "support mapping to within its support error, " +
               shortest_number(body_.support_error());
      case Claim::support_error:
        return "a support point is farther from what the exact form says than the support error, " +
               shortest_number(body_.support_error());
      case Claim::scale: return "the support point depends on the length of the direction";
      case Claim::centre: return "the centre is outside the body";
      case Claim::circumradius: return "the circumradius is too small, " + shortest_number(body_.circumradius());
      case Claim::inradius: return "the inradius is too large, " + shortest_number(body_.inradius());
      case Claim::generators: return "the core is not the sum of the generators";
      case Claim::power_form: return "the core is not the superellipsoid of the power form";
      case Claim::profile_form: return "the core does not have the outline of the profile form";
      case Claim::rolling_radius:
        return "no ball of the rolling radius rolls in the core, " + shortest_number(body_.rolling_radius());
      case Claim::ball_part: return "the support point is not that of the core with the ball about it";
    }
    return "";
  }

  const ConvexBody& body_;
  std::optional<ExactForm> form_;
  int exponent_ = 0;  // lengths here are times 2^-exponent
  double error_ = 0.0, core_error_ = 0.0;
  Vec3d centre_;
  std::vector<Asked> asked_;
  std::array<std::optional<Violation>, 12> worst_;  // by claim
};

}  // namespace

std::vector<Violation> validate(const ConvexBody& body, const ValidationSettings& settings) {
  if (settings.n_directions == 0) throw UsageError("a validation without directions - give one at least");
  return Validation(body).run(settings);
}

}  // namespace vex
