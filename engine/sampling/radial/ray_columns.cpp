#include "engine/sampling/radial/ray_columns.h"

namespace vex {
namespace {

void make_rays_one_by_one(const RadialNumbers& map, std::size_t n, RayColumns& columns) {
  make_rays_over<double>(
      map, n, columns, [](const double* from) { return *from; }, [](double* to, double x) { *to = x; });
}

}  // namespace

MakeRays ray_maker(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::make_rays;
#include "engine/numeric/kernel_sets.inc"
  return make_rays_one_by_one;
}

}  // namespace vex
