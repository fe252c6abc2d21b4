// Compounds, and bodies, that turn while they move, against each other and against half-spaces.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/query/motion_input.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "engine/scene/compound_boxes.h"
#include "engine/scene/earliest_contact.h"
#include "engine/scene/moving_parts.h"

namespace vex {
namespace {

// How far a body comes in an interval whose boxes are looked at in one, of its size; how many intervals there are at
// most; and the largest angle, in radians, that is looked at in intervals at all.
constexpr double kWayOfInterval = 0.5, kMostIntervals = 128.0, kMostAngle = 0x1p20;

void require_velocities(const RigidMotion& motion) {
  if (is_finite(motion.velocity) && is_finite(motion.angular_velocity)) return;
  throw InputError("a velocity is not finite - give finite numbers");
}

// However it turns, the body is in the ball of its reach about its origin, which moves straight.
double reach_seen(const MovingPart& b) {
  return b.body.reach() * (1.0 + 2.0 * kSeenOtherwise) + 0x1p-46 * norm_1(b.frame_from_body.a_from_b().translation) +
         0x1p-500;
}

class CompoundImpact {
 public:
  CompoundImpact(const Compound& a, const RigidMotion& motion_a, const RigidMotion& motion_b, double until)
      : a_(a),
        motion_a_(motion_a),
        motion_b_(motion_b),
        relative_{motion_b.velocity - motion_a.velocity, motion_b.angular_velocity},
        earliest_(until) {
    if (!is_finite(relative_.velocity)) throw InputError("velocities are too far apart - choose another unit of time");
  }

  CompoundContact run(const std::vector<MovingPart>& parts) {
    if (turns(motion_a_)) {
      by_intervals(parts);
    } else {
      for (const MovingPart& b : parts) {
        along(b);
        if (earliest_.is_at_start()) break;
      }
    }
    return earliest_.answer();
  }

 private:
  // Of an A that does not turn: the boxes stand, and a ball about B's part goes past them.
  void along(const MovingPart& b) {
    const double reach = reach_seen(b);
    const MovingBox box = turns(motion_b_) ? MovingBox{b.frame_from_body.a_from_b().translation, {reach, reach, reach}}
                                           : moving_box(box_seen(b.body, b.frame_from_body));
    along_way(a_, box, relative_.velocity, b.number, earliest_,
              [&](std::uint32_t part, double last) { return ask(part, b, last); });
  }

  // Of an A that turns, in its own frame, where its boxes stand: one interval of time after the other, of each of B's
  // parts the box in the middle, as much wider as the part can move in half of it.
  void by_intervals(const std::vector<MovingPart>& parts) {
    double reach_b = 0.0, least_size = HUGE_VAL;
    for (const MovingPart& b : parts) {
      const double off = norm_1(b.frame_from_body.a_from_b().translation - origin_of(parts));
      reach_b = std::fmax(reach_b, reach_seen(b) + off);
      least_size = std::fmin(least_size, b.body.circumradius());
    }
    const auto farthest = [](double x, double y) { return std::fmax(std::fabs(x), std::fabs(y)); };
    const Aabb& box = a_.bounds();
    const double reach_a = norm(Vec3d{farthest(box.lower.x, box.upper.x), farthest(box.lower.y, box.upper.y),
                                      farthest(box.lower.z, box.upper.z)});
    const double radii = (reach_a + reach_b) * (1.0 + 2.0 * kSeenOtherwise);
    const std::optional<Window> window = when_near(origin_of(parts), radii);
    if (!window) return;
    const double spin_a = safe_norm(motion_a_.angular_velocity), spin_b = safe_norm(motion_b_.angular_velocity);
    const double speed =
        (safe_norm(relative_.velocity) + spin_b * reach_b + spin_a * (radii + reach_b)) * (1.0 + kSeenOtherwise);
    const double duration = window->to - window->from;
    // What times, turns and places are off by, and lengths on the way to them: of sizes, of the way to where they meet,
    // and of times that are next to nothing.
    const double rounding =
        0x1p-20 * radii + 0x1p-40 * (norm_1(origin_of(parts)) + speed * window->to) + std::fmax(speed, 1.0) * 0x1p-1060;
    const bool is_short = window->to * (spin_a + spin_b) < kMostAngle && speed * duration < HUGE_VAL;
    const double n =
        is_short
            ? std::ceil(std::clamp(speed * duration / (kWayOfInterval * least_size + 0x1p-500), 1.0, kMostIntervals))
            : 1.0;
    for (double k = 0.0; k < n; ++k) {
      // Of an end that is infinite there is one interval, from the window's first time on.
      const double from = k > 0.0 ? window->from + duration * (k / n) : window->from;
      if (from > earliest_.until()) break;
      const double middle = is_short ? window->from + duration * ((k + 0.5) / n) : from;
      const double wide = is_short ? speed * (0.5 * duration / n) * (1.0 + kSeenOtherwise) + rounding : HUGE_VAL;
      for (const MovingPart& b : parts) {
        if (earliest_.is_at_start()) return;
        meeting(b, middle, wide);
      }
    }
  }

  struct Window {
    double from, to;
  };
  // B's parts are told from one point, the origin of its frame, if it turns.
  Vec3d origin_of(const std::vector<MovingPart>& parts) const {
    return parts.front().frame_from_body.a_from_b().translation;
  }
  std::optional<Window> when_near(const Vec3d& from_a, double radii) const {
    const Vec3d& v = relative_.velocity;
    const double wide = radii + 0x1p-40 * norm_1(from_a), speed = safe_norm(v), end = earliest_.until();
    if (!(speed > 0.0)) {
      if (safe_norm(from_a) > wide) return std::nullopt;
      // What one body alone has not met in one turn it never does.
      const double turn = turns(motion_b_) ? HUGE_VAL : 7.0 / safe_norm(motion_a_.angular_velocity);
      return Window{0.0, std::fmin(end, turn)};
    }
    const Vec3d along = (1.0 / speed) * v;
    const double least = safe_norm(cross(from_a, along));
    if (least > wide) return std::nullopt;
    const double at_least = -dot(from_a, along),
                 half = std::sqrt(wide - least) * std::sqrt(wide + least) + 0x1p-20 * wide;
    const Window window{std::fmax(0.0, std::nextafter((at_least - half) / speed, -HUGE_VAL)),
                        std::fmin(end, std::nextafter((at_least + half) / speed, HUGE_VAL))};
    if (!(window.from <= window.to)) return std::nullopt;
    return window;
  }

  void meeting(const MovingPart& b, double time, double wide) {
    Aabb box{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    if (wide < HUGE_VAL) {
      const Pose a_then = Pose::unchecked(pose_at({}, {{}, motion_a_.angular_velocity}, time));
      const Pose b_then = Pose::unchecked(pose_at(b.frame_from_body.a_from_b(), relative_, time));
      const Aabb then = box_seen(b.body, relative_pose(a_then, b_then));
      const Vec3d margin{wide, wide, wide};
      if (is_finite(then.lower) && is_finite(then.upper)) box = {then.lower - margin, then.upper + margin};
    }
    a_.tree().meeting(box, [&](std::uint32_t part) {
      if (!asked_.insert((std::uint64_t{part} << 32) | b.number).second) return;
      earliest_.take(part, b.number, ask(part, b, earliest_.until()));
    });
  }

  FirstContact ask(std::uint32_t part, const MovingPart& b, double until) const {
    const MovingPair pair = moving_pair(a_, part, b, motion_a_, motion_b_);
    return seen_by_compounds(time_of_impact(pair.a, pair.b, pair.pose, pair.of_a, pair.of_b, until), pair);
  }

  const Compound& a_;
  const RigidMotion& motion_a_;
  const RigidMotion& motion_b_;
  RigidMotion relative_;
  EarliestContact earliest_;
  std::unordered_set<std::uint64_t> asked_;
};

template <class B>
CompoundContact impact_of(const Compound& a, const B& b, const Pose& a_from_b, const RigidMotion& motion_a,
                          const RigidMotion& motion_b, double until) {
  require_end(until);
  require_velocities(motion_a);
  require_velocities(motion_b);
  return CompoundImpact(a, motion_a, motion_b, until).run(moving_parts(b, a_from_b, turns(motion_b)));
}

}  // namespace

CompoundContact time_of_impact(const Compound& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                               double until) {
  return impact_of(a, b, a_from_b, RigidMotion{}, motion, until);
}
CompoundContact time_of_impact(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                               const RigidMotion& motion_a, const RigidMotion& motion_b, double until) {
  return impact_of(a, b, a_from_b, motion_a, motion_b, until);
}
CompoundContact time_of_impact(const Compound& a, const Compound& b, const Pose& a_from_b, const RigidMotion& motion_a,
                               const RigidMotion& motion_b, double until) {
  return impact_of(a, b, a_from_b, motion_a, motion_b, until);
}

CompoundContact time_of_impact(const HalfSpace& a, const Compound& b, const Pose& a_from_b, const RigidMotion& motion,
                               double until) {
  require_end(until);
  require_velocities(motion);
  EarliestContact earliest(until);
  for (const MovingPart& part : moving_parts(b, a_from_b, turns(motion))) {
    if (earliest.is_at_start()) break;
    FirstContact found = time_of_impact(a, part.body, part.frame_from_body, motion, earliest.until());
    if (found.verdict.outcome == Outcome::overlap) found.point_b_in_b = found.point_b_in_b - part.displaced_by;
    earliest.take(0, part.number, found);
  }
  return earliest.answer();
}

}  // namespace vex
