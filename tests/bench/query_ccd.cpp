#include <limits>
#include <memory>

#include "apps/peers/ccd_body.h"
#include "tests/bench/query_contenders.h"

namespace vex {
namespace {

using Query = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);

struct CcdPair {
  CcdBody a, b;
  ccd_t ccd = ccd_of_bodies();
};

SeparationContender depth(const char* name, const char* setting, Query query, double tolerance) {
  return {name, setting, false, [query, tolerance](const SeparationPoses& poses) -> SeparationAnswer {
            if (poses.goal != SeparationGoal::depth) return {};
            const auto pair = std::make_shared<CcdPair>();
            pair->a.body = &poses.body;
            pair->b.body = &poses.body;
            pair->ccd.max_iterations = 100;  // as in its documentation; without it its GJK need not end
            pair->ccd.epa_tolerance = tolerance;
            pair->ccd.mpr_tolerance = tolerance;
            return [&poses, pair, query](std::size_t k) {
              pair->a.n_support_calls = 0;
              pair->b.n_support_calls = 0;
              pair->b.a_from_b = &poses.poses[k].a_from_b();
              ccd_real_t found = 0.0;
              ccd_vec3_t dir, position;
              const bool meets = query(&pair->a, &pair->b, &pair->ccd, &found, &dir, &position) == 0;
              const bool is_answer = meets && !pair->a.has_given_up() && !pair->b.has_given_up();
              return is_answer ? -found : std::numeric_limits<double>::quiet_NaN();
            };
          }};
}

}  // namespace

std::vector<SeparationContender> ccd_separations() {
  return {depth("libccd EPA", "ccdGJKPenetration, epa_tolerance 1e-4, its default", ccdGJKPenetration, 1e-4),
          depth("libccd EPA 1e-10", "ccdGJKPenetration, epa_tolerance 1e-10", ccdGJKPenetration, 1e-10),
          depth("libccd MPR", "ccdMPRPenetration, mpr_tolerance 1e-4, its default", ccdMPRPenetration, 1e-4),
          depth("libccd MPR 1e-10", "ccdMPRPenetration, mpr_tolerance 1e-10", ccdMPRPenetration, 1e-10)};
}

}  // namespace vex
