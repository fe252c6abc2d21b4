#include "engine/query/search/advancement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/numeric/directions.h"
#include "engine/query/search/advance_search.h"
#include "engine/query/search/parting_start.h"
#include "engine/query/search/ray_search.h"
#include "engine/query/search/separation_search.h"
#include "engine/query/separation_with_verdict.h"

namespace vex {
namespace {

// A motion that needs more is given up and said to be, with the time until which nothing touches: one of some hundred
// turns on the way, or along a gap that is a billionth of the bodies.
constexpr int kMostSupportCalls = 45 << 7;
// Of them for a proof of contact where bodies touch to within rounding, as those that slide on each other may for as
// long as they move.
constexpr int kMostCallsOfTouch = 1 << 11;
// As many of these as an answer in twice the precision or in whole numbers costs beside its own.
constexpr int kCallsOfFineAnswer = 6;
// Of the circumradii: an advance in which the bodies may come nearer by no more than this; and how many of them in a
// row.
constexpr double kShortAdvance = 0x1p-20;
constexpr int kMostShortAdvances = 64;
// Trials of how late there is contact; and of how early once it is found.
constexpr int kMostDoublings = 64, kMostHalvings = 2;

// Of the circumradii: nearer than this the normal has hardly turned since the last gap was measured.
constexpr double kNearGap = 0x1p-12;
// Of such a gap: as well as it need be known, for an advance leaves more of it than that.
constexpr double kRoughly = 0x1p-4;
// And farther away the line between the centres will do for a normal.
constexpr double kFarGap = 2.0;
// What happens later is not looked at.
constexpr double kLatest = 0x1p480;

class Advancement {
 public:
  /// As `advance_to_contact`.
  Advancement(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const RelativeMotion& motion,
              const OverlapAnswer& start, bool ends, double last, std::vector<ApartDuring>* record)
      : a_(a),
        b_(b),
        record_(record),
        sweep_(a, b, a_from_b, motion.of_b, motion.spin_of_a, motion.is_exact),
        advances_(sweep_, a.circumradius() + b.circumradius()),
        start_(a, b, a_from_b, start, motion.turns, sweep_, record),
        size_(a.circumradius() + b.circumradius()),
        is_curved_(!a.is_rounded_polytope() || !b.is_rounded_polytope()),
        is_apart_at_start_(start.verdict.outcome == Outcome::disjoint),
        ends_(ends),
        last_(last),
        overlap_(start) {}

  FirstContact run() {
    const RigidSweep::Window window = sweep_.window();
    if (ends_ && !(window.from <= window.to)) return nothing();
    time_ = ends_ ? std::fmin(window.from, std::numeric_limits<double>::max()) : 0.0;
    until_ = std::fmin(window.to, std::fmin(last_, kLatest));
    if (time_ > last_) return nothing();
    ends_ = until_ >= last_ || (ends_ && window.to < kLatest);
    // Of an end that is the start nothing is known but what is known of the start. Where the window begins later the
    // balls are apart when it does, too.
    if (time_ >= until_ && !(time_ > 0.0) && !is_apart_at_start_) return undecided(UndecidedReason::rounding);
    while (!is_spent()) {
      if (time_ >= until_) return touched_ || !ends_ ? undecided(UndecidedReason::rounding) : nothing();
      double gap = 0.0;
      Separation apart = separation_now(gap);
      last_gap_ = std::fmax(gap, 0.0);
      last_normal_ = apart.normal;
      // Bodies that slide by each other hardly farther away than rounding come on no more than they turn in, so slowly
      // that they count as touching.
      const bool creeps = n_short_advances_ > kMostShortAdvances;
      if (gap > sweep_.rounding_at(time_) && !creeps) {
        const double from = time_;
        const double advance = advances_.longest(apart.normal, time_, until_, gap);
        time_ += advance;
        const bool is_short = advance * sweep_.most_speed(apart.normal) < kShortAdvance * size_;
        n_short_advances_ = is_short ? n_short_advances_ + 1 : 0;
        // Where they are then, what bends from the start on is more than any gap that only twice the precision tells.
        if (!is_short) start_.leave();
        if (record_ != nullptr && !touched_) record_->push_back({from, time_, apart.normal});
        continue;
      }
      const double apart_until = touched_ ? time_ : start_.apart_until(time_, until_, apart.normal);
      if (apart_until > time_) {
        time_ = apart_until;
        // Those that go on as slowly are looked at again at once.
        n_short_advances_ = std::min(n_short_advances_, kMostShortAdvances);
        continue;
      }
      n_short_advances_ = 0;
      // The first place where the bodies may touch is the answer's, and the least time of contact not before it.
      if (!touched_) {
        touched_ = true;
        n_calls_before_touch_ = n_calls();
        // Bodies that are nearer than their pose is known may be in each other as it is rounded.
        if (!apart.has_witnesses) {
          const Pose pose = Pose::unchecked(sweep_.relative_pose(time_));
          look_at(time_);
          apart = counted_and_turned(time_, signed_distance(a_, b_, pose, overlap_));
        }
        contact_.lower = time_;
        contact_.normal = apart.normal;
        contact_.point_a = apart.point_a;
        contact_.point_b = apart.point_b;
        contact_.point_b_in_b = apart.point_b_in_b;
      }
      if (finds_contact(apart)) return found();
      if (!(time_ < until_)) return undecided(UndecidedReason::rounding);
    }
    return undecided(n_calls() > kMostSupportCalls ? UndecidedReason::iteration_cap : UndecidedReason::rounding);
  }

 private:
  Separation separation_at(double time, double relative_gap) {
    SeparationSettings settings;
    settings.relative_gap = relative_gap;
    const Pose pose = Pose::unchecked(sweep_.relative_pose(time));
    look_at(time);
    return counted_and_turned(time, distance(a_, b_, pose, settings, &warm_start_, overlap_));
  }
  // A distance is not below it, as far as double precision tells. Of bodies that touch nobody asks here whether they
  // do, which takes as long as all the rest.
  double distance_lower_at(double time) {
    const Transformd pose = sweep_.relative_pose(time);
    Separation found;
    search_in_double({a_, b_, pose, SeparationGoal::distance, {}}, nullptr, found);
    n_support_calls_ += found.n_support_calls;
    return found.lower;
  }
  // What `overlap` says is asked once of each time.
  void look_at(double time) {
    if (time != time_of_overlap_) overlap_.reset();
    time_of_overlap_ = time;
  }
  Separation counted_and_turned(double time, Separation found) {
    n_support_calls_ += found.n_support_calls;
    if (touched_ && found.verdict.by != DecidedBy::gjk) price_of_touch_ += kCallsOfFineAnswer;
    for (Vec3d* const v : {&found.normal, &found.point_a, &found.point_b}) *v = sweep_.turned_with_a(time, *v);
    return found;
  }

  double gap_along(const Separation& apart) {
    return apart.has_witnesses ? sweep_.gap_during(apart.normal, time_, 0.0) : 0.0;
  }

  // And the gap along its normal.
  Separation separation_now(double& gap) {
    if (last_gap_ > kFarGap * size_ && last_gap_ < HUGE_VAL) {
      Separation apart;
      apart.verdict = Verdict::disjoint(DecidedBy::gjk);
      apart.has_witnesses = true;
      apart.normal = unit_along(sweep_.between_centres(time_));
      gap = gap_along(apart);
      if (gap > size_) return apart;
    }
    if (is_curved_ && last_gap_ < kNearGap * size_ && norm_1(last_normal_) > 0.0) {
      Separation apart;
      apart.verdict = Verdict::disjoint(DecidedBy::gjk);
      apart.has_witnesses = true;
      apart.normal = last_normal_;
      apart.upper = HUGE_VAL;
      look_closer(apart);
      gap = gap_along(apart);
      return apart;
    }
    // Gaps shrink as the squares of those before them; so much of the next one is left open.
    const double last = std::fmin(1.0, last_gap_ / size_);
    Separation apart = separation_at(time_, 0x1p-7 * last * last);
    // Nearer than was thought: nothing is said of a gap before it is known as well as it can be, and along this normal.
    gap = gap_along(apart);
    if (!apart.has_witnesses || !(gap > 0.5 * apart.upper)) {
      look_closer(apart);
      gap = gap_along(apart);
    }
    return apart;
  }

  // Of bodies that nearly touch: B cast straight at A, which finds their planes of contact to rounding.
  void look_closer(Separation& apart) {
    // Of bodies that touch a rough answer's points may be far apart, and its normal far off.
    if (apart.verdict.outcome == Outcome::undecided) apart = separation_at(time_, 0.0);
    if (!apart.has_witnesses || apart.verdict.outcome != Outcome::disjoint) return;
    const Vec3d normal = sweep_.turned_back(time_, apart.normal), dir = -scaled_to_unit_exponent(normal);
    RaySearch search(a_, b_, sweep_.relative_pose(time_), dir);
    search.look_roughly(kRoughly);
    const RayBounds bounds = search.run(normal, true);
    n_support_calls_ += search.n_support_calls();
    RaySearch::Touch touch = search.touch();
    for (Vec3d* const v : {&touch.normal, &touch.point_a, &touch.point_b}) *v = sweep_.turned_with_a(time_, *v);
    if (bounds.is_miss || !(bounds.upper < HUGE_VAL) || !(norm_1(touch.normal) > 0.0)) {
      apart = separation_at(time_, 0.0);
      return;
    }
    apart.normal = touch.normal;
    apart.point_a = touch.point_a;
    apart.point_b = touch.point_b;
    apart.point_b_in_b = touch.point_b_in_b;
    apart.upper = std::fmin(apart.upper, std::ldexp(bounds.upper, -search.exponent()) * norm(dir));
  }

  // In which the bodies come to be in each other by some roundings, enough for double precision to see it, if they go
  // on as they do at first and are as far apart as they may be.
  double first_step(const Vec3d& normal, double most_apart) {
    const double most_speed = norm_1(normal) > 0.0 ? sweep_.most_speed(normal) : 0.0;
    if (!(most_speed > 0.0)) return 0.0;
    const double a_moment = 0x1p-16 * size_ / most_speed;
    const double speed =
        (sweep_.gap_during(normal, time_, 0.0) - sweep_.gap_during(normal, time_ + a_moment, 0.0)) / a_moment;
    return (16.0 * sweep_.rounding_at(time_) + most_apart) / std::fmax(speed, 0x1p-10 * most_speed);
  }

  // A time of contact, proven, as little after this one as doubling finds it. Where the bodies are seen to be apart
  // again first, the motion goes on from there.
  bool finds_contact(const Separation& apart) {
    const Vec3d& normal = apart.normal;
    const double most_apart = apart.has_witnesses ? std::fmax(apart.upper, 0.0) : 0.0;
    const double remaining = until_ - time_;
    const double least = least_step(normal);
    double step = std::fmax(first_step(normal, most_apart), least);
    double before = 0.0;
    for (int k = 0; k < kMostDoublings; ++k, before = step, step *= 2.0) {
      if (is_spent()) return false;
      step = std::fmin(step, remaining);
      if (sweep_.meets_at(time_ + step)) {
        double after = step;
        for (int h = 0; before > 0.0 && h < kMostHalvings; ++h) {
          const double middle = 0.5 * (before + after);
          (sweep_.meets_at(time_ + middle) ? after : before) = middle;
        }
        contact_.upper = time_ + after;
        return true;
      }
      const double gap = k % 8 < 7 && norm_1(normal) > 0.0 ? sweep_.gap_during(normal, time_ + step, 0.0)
                                                           : distance_lower_at(time_ + step);
      const bool is_apart = gap > 4.0 * sweep_.rounding_at(time_ + step);
      if (k == 0 && is_apart && finds_contact_before(step, normal, least)) return true;
      if (is_apart || step >= remaining) {
        time_ += step;
        return false;
      }
    }
    time_ = until_;
    return false;
  }

  // The shortest step worth a trial: of the times until now, or of one in which the bodies come as far as they are
  // large.
  double least_step(const Vec3d& normal) const {
    const double most_speed = norm_1(normal) > 0.0 ? sweep_.most_speed(normal) : 0.0;
    const double a_while = most_speed > 0.0 ? std::fmin(until_, size_ / most_speed) : until_;
    return 0x1p-50 * std::fmax(time_, 0x1p-10 * a_while);
  }

  // Where the first step has gone too far: a thin part of one body may have passed through the other's rim meanwhile.
  bool finds_contact_before(double step, const Vec3d& normal, double least) {
    for (step *= 0x1p-4; step > least && !is_spent(); step *= 0x1p-4) {
      if (sweep_.gap_during(normal, time_ + step, 0.0) > 4.0 * sweep_.rounding_at(time_ + step)) continue;
      if (!sweep_.meets_at(time_ + step)) continue;
      contact_.upper = time_ + step;
      return true;
    }
    return false;
  }

  int n_calls() const { return n_support_calls_ + sweep_.n_support_calls(); }
  bool is_spent() const {
    return n_calls() > kMostSupportCalls ||
           (touched_ && n_calls() - n_calls_before_touch_ + price_of_touch_ > kMostCallsOfTouch);
  }
  FirstContact counted(FirstContact contact) const {
    contact.n_support_calls = n_calls();
    return contact;
  }
  FirstContact nothing() const {
    return counted({Verdict::disjoint(DecidedBy::gjk), HUGE_VAL, HUGE_VAL, HUGE_VAL, {}, {}, {}, 0});
  }
  FirstContact undecided(UndecidedReason reason) const {
    FirstContact contact = contact_;
    contact.verdict = Verdict::undecided(DecidedBy::gjk, reason);
    if (!touched_) contact.lower = time_;
    contact.time = contact.lower;
    contact.upper = HUGE_VAL;
    return counted(contact);
  }
  FirstContact found() const {
    FirstContact contact = contact_;
    contact.verdict = Verdict::overlap(DecidedBy::gjk);
    // Normal and points are those of the bodies as they are then, however much later a contact is proven.
    contact.time = contact.lower;
    return counted(contact);
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  std::vector<ApartDuring>* record_;
  RigidSweep sweep_;
  AdvanceSearch<RigidSweep> advances_;
  PartingStart start_;
  double size_;
  // Distances of polytopes and balls come to an end by themselves; small ones of curved bodies are dear.
  bool is_curved_;
  bool is_apart_at_start_;
  bool ends_;
  double last_;  // that is looked at
  double time_ = 0.0, until_ = 0.0;
  double last_gap_ = HUGE_VAL;
  Vec3d last_normal_;
  bool touched_ = false;
  FirstContact contact_;
  WarmStart warm_start_;
  // At the start the pose is the one that was asked about: a turn by nothing moves no coordinate.
  std::optional<OverlapAnswer> overlap_;
  double time_of_overlap_ = 0.0;
  int n_support_calls_ = 0, n_calls_before_touch_ = 0, price_of_touch_ = 0, n_short_advances_ = 0;
};

}  // namespace

FirstContact advance_to_contact(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                const RelativeMotion& motion, const OverlapAnswer& start, bool ends, double last,
                                std::vector<ApartDuring>* record) {
  return Advancement(a, b, a_from_b, motion, start, ends, last, record).run();
}

}  // namespace vex
