// Rays and moving bodies against compounds: along the tree of their parts' boxes, and no later than what is proven to
// be met.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "engine/numeric/errors.h"
#include "engine/query/motion_input.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "engine/scene/compound_boxes.h"

namespace vex {
namespace {

// What moves: this box about a point, in the compound's frame.
struct MovingBox {
  Vec3d centre, half_extents;
};

MovingBox moving_box(const Aabb& box) { return {0.5 * box.lower + 0.5 * box.upper, 0.5 * box.upper - 0.5 * box.lower}; }

// What the pairs seen so far say of when the union is met.
class EarliestContact {
 public:
  explicit EarliestContact(double until) : until_(until) {}

  /// The latest time that matters.
  double until() const { return std::fmin(until_, is_met() ? best_.contact.upper : HUGE_VAL); }
  /// Nothing is earlier.
  bool is_at_start() const { return is_met() && best_.contact.upper == 0.0; }

  void take(const Compound& a, std::uint32_t part, std::uint32_t part_b, const FirstContact& found) {
    ++best_.n_pairs;
    n_support_calls_ += found.n_support_calls;
    by_ = std::max(by_, found.verdict.by);
    if (found.verdict.outcome == Outcome::disjoint) return;
    least_lower_ = std::fmin(least_lower_, found.lower);
    if (found.verdict.outcome == Outcome::undecided) {
      if (!undecided_) undecided_ = {found.verdict, part, part_b};
      return;
    }
    if (is_met() && !(std::tie(found.upper, found.time, part_b, part) <
                      std::tie(best_.contact.upper, best_.contact.time, best_.part_b, best_.part_a))) {
      return;
    }
    const std::uint32_t n_pairs = best_.n_pairs;
    best_ = {a.is_in_place(part) ? found : in_world(found, a.compound_from_part(part)), part, part_b, n_pairs};
  }

  CompoundContact answer() const {
    CompoundContact answer = best_;
    FirstContact& contact = answer.contact;
    if (is_met()) {
      contact.lower = std::fmin(contact.lower, least_lower_);
    } else if (undecided_) {
      contact.verdict = undecided_->verdict;
      answer.part_a = undecided_->part_a;
      answer.part_b = undecided_->part_b;
      contact.time = contact.lower = least_lower_;
      contact.upper = HUGE_VAL;
    } else {
      contact.verdict = Verdict::disjoint(by_);
      contact.time = contact.lower = contact.upper = HUGE_VAL;
    }
    contact.n_support_calls = n_support_calls_;
    return answer;
  }

 private:
  struct Open {
    Verdict verdict;
    std::uint32_t part_a, part_b;
  };

  bool is_met() const { return best_.part_a != Compound::kNoPart; }

  double until_;
  CompoundContact best_;
  double least_lower_ = HUGE_VAL;
  std::optional<Open> undecided_;
  DecidedBy by_ = DecidedBy::outer_bound;
  int n_support_calls_ = 0;
};

// ask(part, until) of the parts on the way of a box that moves straight, as far as it matters.
template <class Ask>
void along_way(const Compound& a, const MovingBox& box, const Vec3d& motion, std::uint32_t part_b,
               EarliestContact& earliest, const Ask& ask) {
  const double more =
      0x1p-44 * (norm_1(box.centre) + norm_1(box.half_extents) + norm_1(a.bounds().lower) + norm_1(a.bounds().upper));
  const Vec3d margin = box.half_extents + Vec3d{more, more, more};
  a.tree().along_ray(box.centre, motion, margin, earliest.until(), [&](std::uint32_t part, double) {
    earliest.take(a, part, part_b, ask(part, earliest.until()));
    return earliest.is_at_start() ? -1.0 : earliest.until();
  });
}

void cast_part(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion, std::uint32_t part_b,
               EarliestContact& earliest) {
  along_way(a, moving_box(box_seen(b, a_from_b)), motion, part_b, earliest, [&](std::uint32_t part, double until) {
    const Transformd& pose = a.compound_from_part(part).a_from_b();
    const Vec3d seen = a.is_in_place(part) ? motion : motion_seen_from(pose, motion);
    return linear_cast(a.body(part), b, a.part_from_b(part, a_from_b), seen, until);
  });
}

}  // namespace

CompoundContact cast_ray(const Compound& a, const Vec3d& origin, const Vec3d& dir, double until) {
  require_motion(dir, until);
  if (!is_finite(origin)) throw InputError("a ray's origin is not finite - give finite numbers");
  EarliestContact earliest(until);
  along_way(a, {origin, {}}, dir, 0, earliest, [&](std::uint32_t part, double last) {
    const Transformd& pose = a.compound_from_part(part).a_from_b();
    if (a.is_in_place(part)) return cast_ray(a.body(part), origin, dir, last);
    return cast_ray(a.body(part), pose.direction_to_b(origin - pose.translation), motion_seen_from(pose, dir), last);
  });
  return earliest.answer();
}

CompoundContact linear_cast(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion,
                            double until) {
  require_motion(motion, until);
  EarliestContact earliest(until);
  cast_part(a, b, a_from_b, motion, 0, earliest);
  return earliest.answer();
}

CompoundContact linear_cast(const Compound& a, const Compound& b, const Pose& a_from_b, const Vec3d& motion,
                            double until) {
  require_motion(motion, until);
  EarliestContact earliest(until);
  for (std::size_t part = 0; part < b.size(); ++part) {
    cast_part(a, b.body(part), b.frame_from_part(part, a_from_b), motion, static_cast<std::uint32_t>(part), earliest);
    if (earliest.is_at_start()) break;
  }
  return earliest.answer();
}

CompoundContact time_of_impact(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                               double until) {
  require_end(until);
  if (!is_finite(motion.velocity) || !is_finite(motion.angular_velocity)) {
    throw InputError("a velocity is not finite - give finite numbers");
  }
  // However it turns, the body is in the ball of its reach about its origin, which moves straight.
  const double reach =
      b.reach() * (1.0 + 2.0 * kSeenOtherwise) + 0x1p-46 * norm_1(a_from_b.a_from_b().translation) + 0x1p-500;
  const Vec3d origin = a_from_b.a_from_b().translation, half{reach, reach, reach};
  EarliestContact earliest(until);
  const auto ask = [&](std::uint32_t part, double last) {
    const Transformd& pose = a.compound_from_part(part).a_from_b();
    const RigidMotion seen = a.is_in_place(part) ? motion
                                                 : RigidMotion{motion_seen_from(pose, motion.velocity),
                                                               motion_seen_from(pose, motion.angular_velocity)};
    return time_of_impact(a.body(part), b, a.part_from_b(part, a_from_b), seen, last);
  };
  along_way(a, {origin, half}, motion.velocity, 0, earliest, ask);
  return earliest.answer();
}

}  // namespace vex
