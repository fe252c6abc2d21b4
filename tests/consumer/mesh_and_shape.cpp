// A mesh file and a named body, by the packages' other two libraries.
//
//   mesh_and_shape FILE NAME      prints the formula's <V_ex> and whether the bodies overlap at the same place
#include <vex/engine/query/overlap.h>
#include <vex/meshes/convex_mesh.h>
#include <vex/shapes/any_shape.h>
#include <vex/shapes/excluded_volume.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const vex::ConvexMesh mesh = vex::load_convex_mesh(argv[1]);
    const vex::MeasuredBody shape = vex::parse_shape(argv[2]);
    const vex::Verdict verdict = vex::overlap(mesh.body, shape.body, vex::Transformd{});
    std::printf("%.9g %s\n", vex::average_excluded_volume(mesh.measures, shape.measures),
                vex::name_of(verdict.outcome).data());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
