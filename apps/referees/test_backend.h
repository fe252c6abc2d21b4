// A test of one pose, made an overlap backend.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "engine/numeric/expect.h"
#include "engine/query/overlap_backend.h"

namespace vex {

inline Verdict verdict_of_test(Outcome outcome) {
  return {outcome, DecidedBy::peer, outcome == Outcome::undecided ? UndecidedReason::rounding : UndecidedReason::none};
}
inline Verdict verdict_of_test(const Verdict& verdict) { return verdict; }

/// `Test`: from a pose to an Outcome or a Verdict.
template <class Test>
class TestBackend final : public OverlapBackend {
 public:
  explicit TestBackend(Test test) : test_(std::move(test)) {}
  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = verdict_of_test(test_(a_from_b[k].a_from_b()));
  }

 private:
  Test test_;
};

template <class Test>
std::unique_ptr<OverlapBackend> test_backend(Test test) {
  return std::make_unique<TestBackend<Test>>(std::move(test));
}

}  // namespace vex
