// Bodies that are apart where a motion starts, by a gap that double precision takes for contact: until when they stay
// apart (docs/derivations.md, E23).
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/query/certificate.h"
#include "engine/query/exact/extended_difference.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/rigid_sweep.h"

namespace vex {

/// Of one motion. Holds references.
class PartingStart {
 public:
  /// `start`: what `overlap_answer` says of the bodies. `turns`: as of a `RelativeMotion`. `record`: null, or what
  /// receives the steps.
  PartingStart(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const OverlapAnswer& start,
               bool turns, RigidSweep& sweep, std::vector<ApartDuring>* record)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        start_(start),
        turns_(turns),
        sweep_(sweep),
        record_(record),
        may_look_(start.verdict.outcome == Outcome::disjoint) {}

  /// A time until which nothing touches from `from` on, `last` at most, shown along `normal` and, at first, along what
  /// parts the bodies at the start; `from` where nothing is shown.
  double apart_until(double from, double last, const Vec3d& normal);
  /// The bodies have moved too far for more to be shown.
  void leave() { may_look_ = false; }

 private:
  // False where the bodies have no forms, or where nothing is known of how far the forms' cores reach.
  bool find_forms();
  double shown_until(double from, double last, const Vec3d& dir);

  const ConvexBody& a_;
  const ConvexBody& b_;
  Transformd a_from_b_;
  const OverlapAnswer& start_;
  bool turns_;
  RigidSweep& sweep_;
  std::vector<ApartDuring>* record_;
  struct Forms {
    explicit Forms(PlacedForms of) : placed(std::move(of)), local(placed) {}
    PlacedForms placed;
    LocalForms local;
  };
  std::unique_ptr<Forms> forms_;
  bool may_look_;
  int n_looks_ = 0;
};

}  // namespace vex
