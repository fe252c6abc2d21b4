// A - B without the balls in 256 bits, of which every point that was looked at is kept as a witness: what certificates
// are searched for in where twice the precision does not tell the nearest point's direction, as of flat bodies that are
// 2^-54 of their size apart and lean towards each other by as little.
#pragma once

#include <vector>

#include "engine/numeric/float_256.h"
#include "engine/query/checker/exact_pair.h"
#include "engine/query/exact/core_proof.h"
#include "engine/query/exact/extended_difference.h"

namespace vex {

class FineCore {
 public:
  struct Point {
    Vec3<Float256> w;
    std::size_t call;  // which record it is
  };
  struct Record {
    Witness witness;
    bool is_late = false;
  };

  /// Holds references.
  FineCore(const checker::ExactPair& pair, const LocalForms& forms) : pair_(pair), forms_(forms) {}

  /// The direction is rounded to two doubles a coordinate, for that is what a witness tells; the point is the one that
  /// the checker makes of it. Which part of a body is farthest is told in twice the precision.
  Point support(const Vec3<Float256>& normal) const;

  const Record& record(const Point& point) const { return records_[point.call]; }
  /// Along which, of all directions that were looked at, the bodies are farthest apart, or least deep in each other.
  ExactVector best_dir() const;
  /// About what is lost to rounding, in the units of the forms. No bound: what is found here the checker judges.
  static QueryError<Float256> error() { return {Float256(16.0), Float256(0x1p-236)}; }

 private:
  const checker::ExactPair& pair_;
  const LocalForms& forms_;
  mutable std::vector<Record> records_;
  mutable Float256 best_gap_{-HUGE_VAL};
  mutable Vec3<Float256> best_dir_;
};

/// As of a `RecordedCore`: milliseconds.
CoreProof prove_nearness(const FineCore& core, const Vec3d& first_dir, double gap, int max_support_calls);

}  // namespace vex
