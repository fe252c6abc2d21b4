#include "apps/peers/ccd_backend.h"

#include "apps/peers/ccd_body.h"
#include "engine/numeric/expect.h"

namespace vex {
namespace {

class CcdBackend final : public OverlapBackend {
 public:
  using Query = int (*)(const void*, const void*, const ccd_t*);

  CcdBackend(const ConvexBody& a, const ConvexBody& b, Query query) : query_(query) {
    ccd_.mpr_tolerance = 1e-12;
    a_.body = &a;
    b_.body = &b;
  }

  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) {
      a_.n_support_calls = 0;
      b_.n_support_calls = 0;
      b_.a_from_b = &a_from_b[k].a_from_b();
      const int meets = query_(&a_, &b_, &ccd_);
      if (a_.has_given_up() || b_.has_given_up()) {
        verdicts[k] = Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
      } else {
        verdicts[k] = meets != 0 ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
      }
    }
  }

 private:
  Query query_;
  ccd_t ccd_ = ccd_of_bodies();
  CcdBody a_, b_;
};

BackendKind kind(const char* name, CcdBackend::Query query) {
  return {name,
          true,
          [query](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<CcdBackend>(a, b, query); },
          {}};
}

}  // namespace

BackendKind ccd_gjk_backend() { return kind("ccd-gjk", ccdGJKIntersect); }
BackendKind ccd_mpr_backend() { return kind("ccd-mpr", ccdMPRIntersect); }

}  // namespace vex
