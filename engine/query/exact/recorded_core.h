// A - B without the balls in twice the precision, of which every point that was looked at is kept as a witness: what
// certificates are searched for in.
#pragma once

#include <vector>

#include "engine/query/exact/core_proof.h"
#include "engine/query/exact/extended_difference.h"
#include "engine/query/search/query_error.h"

namespace vex {

class RecordedCore {
 public:
  struct Point {
    Vec3e w;
    std::size_t call;  // which record it is
  };
  struct Record {
    Witness witness;
    bool is_late;  // of B at the end of its way
  };

  /// B goes straight from one place to another, given as the ways from where the forms have it, in their units. Points
  /// are those of the difference from all of B on its way.
  explicit RecordedCore(const LocalForms& forms, const Vec3e& from = {}, const Vec3e& to = {})
      : forms_(forms), from_(from), to_(to) {}

  Point support(const Vec3e& normal) const;

  const Record& record(const Point& point) const { return records_[point.call]; }
  /// Along which, of all directions that were looked at, the bodies are farthest apart, or least deep in each other.
  ExactVector best_dir() const;
  /// About what is lost to rounding, in the units of the forms. No bound: what is found here the checker judges.
  static QueryError<Extended> error() { return {Extended(16.0), Extended(0x1p-97)}; }

 private:
  const LocalForms& forms_;
  Vec3e from_, to_;
  mutable std::vector<Record> records_;
  mutable Extended best_gap_{-HUGE_VAL};
  mutable Vec3e best_dir_;
};

/// Bounds of the signed distance of the cores, `gap` of the forms' unit apart if they can be.
CoreProof prove_nearness(const RecordedCore& core, const Vec3d& first_dir, double gap, int max_support_calls);

}  // namespace vex
