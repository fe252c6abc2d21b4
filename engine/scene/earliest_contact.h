// When a compound is first met: what its parts are asked, and what their answers come to (internal).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "engine/scene/compound.h"

namespace vex {

/// What the pairs seen so far say of when the union is met.
class EarliestContact {
 public:
  explicit EarliestContact(double until) : until_(until) {}

  /// The latest time that matters.
  double until() const { return std::fmin(until_, is_met() ? best_.contact.upper : HUGE_VAL); }
  /// Nothing is earlier.
  bool is_at_start() const { return is_met() && best_.contact.upper == 0.0; }

  /// In the compound's frame.
  void take(std::uint32_t part, std::uint32_t part_b, const FirstContact& found) {
    ++best_.n_pairs;
    n_support_calls_ += found.n_support_calls;
    by_ = std::max(by_, found.verdict.by);
    if (found.verdict.outcome == Outcome::disjoint) return;
    least_lower_ = std::fmin(least_lower_, found.lower);
    if (found.verdict.outcome == Outcome::undecided) {
      if (!is_open_) open_ = {found.verdict, part, part_b};
      is_open_ = true;
      return;
    }
    if (is_met() && !(std::tie(found.upper, found.time, part_b, part) <
                      std::tie(best_.contact.upper, best_.contact.time, best_.part_b, best_.part_a))) {
      return;
    }
    const std::uint32_t n_pairs = best_.n_pairs;
    best_ = {found, part, part_b, n_pairs};
  }

  CompoundContact answer() const {
    CompoundContact answer = best_;
    FirstContact& contact = answer.contact;
    if (is_met()) {
      contact.lower = std::fmin(contact.lower, least_lower_);
    } else if (is_open_) {
      contact.verdict = open_.verdict;
      answer.part_a = open_.part_a;
      answer.part_b = open_.part_b;
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
    std::uint32_t part_a = Compound::kNoPart, part_b = Compound::kNoPart;
  };

  bool is_met() const { return best_.part_a != Compound::kNoPart; }

  double until_;
  CompoundContact best_;
  double least_lower_ = HUGE_VAL;
  Open open_{};  // the first pair that is undecided
  bool is_open_ = false;
  DecidedBy by_ = DecidedBy::outer_bound;
  int n_support_calls_ = 0;
};

/// What moves: this box about a point, in the compound's frame.
struct MovingBox {
  Vec3d centre, half_extents;
};

inline MovingBox moving_box(const Aabb& box) {
  return {0.5 * box.lower + 0.5 * box.upper, 0.5 * box.upper - 0.5 * box.lower};
}

/// ask(part, until), in the compound's frame, of the parts on the way of a box that moves straight, as far as it
/// matters.
template <class Ask>
void along_way(const Compound& a, const MovingBox& box, const Vec3d& motion, std::uint32_t part_b,
               EarliestContact& earliest, const Ask& ask) {
  const double more =
      0x1p-44 * (norm_1(box.centre) + norm_1(box.half_extents) + norm_1(a.bounds().lower) + norm_1(a.bounds().upper));
  const Vec3d margin = box.half_extents + Vec3d{more, more, more};
  a.tree().along_ray(box.centre, motion, margin, earliest.until(), [&](std::uint32_t part, double) {
    earliest.take(part, part_b, ask(part, earliest.until()));
    return earliest.is_at_start() ? -1.0 : earliest.until();
  });
}

}  // namespace vex
