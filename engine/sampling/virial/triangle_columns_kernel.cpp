// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: a triangle is
// the same bits everywhere.
#include "engine/numeric/packet.h"
#include "engine/numeric/packet_memory.h"
#include "engine/sampling/virial/triangle_columns.h"

namespace vex {
namespace VEX_ISA {

__attribute__((flatten)) void make_triangles(const TriangleMap& map, std::size_t n, TriangleColumns& columns) {
  using L = Packet<kRegisterLanes>;
  const TriangleMap of_its_own = map;  // which no store can change
  make_triangles_over<L>(
      of_its_own, n, columns, [](const double* from) { return L::load(from); },
      [](double* to, const L& x) { x.store(to); });
}

}  // namespace VEX_ISA
}  // namespace vex
