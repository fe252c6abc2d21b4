// A mesh file and a named body.
//
//   mesh_and_shape FILE NAME      prints the formula's <V_ex> and whether the bodies overlap at the same place
#include <vex/vex.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const vex::Body mesh = vex::load(argv[1]), shape = vex::parse_shape(argv[2]);
    const vex::Verdict verdict = vex::overlap(mesh, shape, vex::Transformd{});
    std::printf("%.9g %s\n", vex::average_excluded_volume(mesh.measures, shape.measures),
                vex::name_of(verdict.outcome).data());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
