#include "engine/sampling/virial/triangle_columns.h"

namespace vex {
namespace {

void make_triangles_one_by_one(const TriangleMap& map, std::size_t n, TriangleColumns& columns) {
  make_triangles_over<double>(
      map, n, columns, [](const double* from) { return *from; }, [](double* to, double x) { *to = x; });
}

}  // namespace

MakeTriangles triangle_maker(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::make_triangles;
#include "engine/numeric/kernel_sets.inc"
  return make_triangles_one_by_one;
}

}  // namespace vex
