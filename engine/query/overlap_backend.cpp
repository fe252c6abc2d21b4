#include "engine/query/overlap_backend.h"

#include "engine/numeric/expect.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

class GjkBackend final : public OverlapBackend {
 public:
  GjkBackend(const ConvexBody& a, const ConvexBody& b) : a_(a), b_(b) {}

  void decide(std::span<const Transformd> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = overlap(a_, b_, a_from_b[k]);
  }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
};

}  // namespace

BackendKind gjk_backend() {
  return {
      "gjk", false, [](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<GjkBackend>(a, b); }, {}};
}

}  // namespace vex
