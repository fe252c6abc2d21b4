// What the judge said of many answers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "engine/query/certificate.h"
#include "tests/referees/separation_judge.h"

namespace vex {

/// Hexadecimal, so that it can be pasted into a test.
inline std::string pose_as_source(const Transformd& pose) {
  std::string text = "{";
  const char* separator = "";
  for (const Vec3d& v : {pose.row_x, pose.row_y, pose.row_z, pose.translation}) {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "%s{%a, %a, %a}", separator, v.x, v.y, v.z);
    text += numbers;
    separator = ", ";
  }
  return text + "}";
}

/// Lengths relative to the judgement's size.
struct SeparationTally {
  std::uint64_t n = 0, n_apart = 0, n_wrong = 0, n_bounds_violated = 0, n_undecided = 0, n_unknown = 0;
  std::uint64_t n_certificates = 0, n_not_accepted = 0;
  double worst_distance = 0.0, worst_depth = 0.0, widest = 0.0, widest_unknown = 0.0, farthest_off = 0.0,
         n_support_calls = 0.0;
  struct Fault {
    std::uint64_t n = 0;
    std::string first;  // with its figure and its pose
  };
  std::map<std::string, Fault> faults;

  void add(const Transformd& pose, const Separation& answer, const SeparationJudgement& judgement) {
    ++n;
    const bool is_apart = judgement.lower > 0.0;
    n_apart += is_apart ? 1 : 0;
    double& worst = is_apart ? worst_distance : worst_depth;
    worst = std::max(worst, judgement.error);
    n_bounds_violated += judgement.bounds_hold ? 0 : 1;
    n_undecided += answer.verdict.outcome == Outcome::undecided ? 1 : 0;
    n_unknown += judgement.is_known ? 0 : 1;
    double& widest_of = judgement.is_known ? widest : widest_unknown;
    widest_of = std::max(widest_of, judgement.width);
    farthest_off = std::max(farthest_off, judgement.points_off);
    n_support_calls += answer.n_support_calls;
    if (!judgement.is_right()) ++n_wrong;
    for (const std::string& text : judgement.faults) blame(pose, text);
  }
  /// Of the exact checker.
  void add(const Transformd& pose, const CertificateCheck& check) {
    ++n_certificates;
    if (check.is_proven) return;
    ++n_not_accepted;
    blame(pose, "certificate: " + check.fault);
  }

 private:
  void blame(const Transformd& pose, const std::string& text) {
    Fault& fault = faults[text.substr(0, text.find(" ("))];
    if (fault.n++ == 0) fault.first = text + " at " + pose_as_source(pose);
  }
};

}  // namespace vex
