// --require-confinement, and what is said where the reader of mesh files cannot be confined.
#include <string>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

constexpr const char* kNote = "note: the process that reads mesh files is not confined (";

class ProgramConfinement : public ProgramTest {
 protected:
  ProgramConfinement() {
    write_file("cube.obj", cube_obj());
    // Read by assimp: the four vertices and faces of a tetrahedron.
    write_file("a.dae",
               "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
               "version=\"1.4.1\"><asset/><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
               "id=\"f\" count=\"12\">1 1 1 1 -1 -1 -1 1 -1 -1 -1 1</float_array><technique_common><accessor "
               "source=\"#f\" count=\"4\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
               "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
               "id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"4\"><input "
               "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2 0 3 1 0 2 3 1 3 2</p></triangles></mesh>"
               "</geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node "
               "id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
               "<instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    write_file("b.dae", read_file("a.dae"));
  }

  Finished without(const std::string& what, const std::string& words) const {
    return shell(std::string("\"") + VEX_WITHOUT + "\" " + what + " \"$VEX\" " + words + " --trials 1000 --quiet");
  }
  static std::size_t n_notes(const Finished& finished) {
    std::size_t n = 0;
    for (std::size_t at = finished.err.find(kNote); at != std::string::npos; at = finished.err.find(kNote, at + 1)) ++n;
    return n;
  }
};

#ifdef VEX_WITH_SECCOMP
TEST_F(ProgramConfinement, IsThereAndSaysNothing) {
  const Finished finished = run({"a.dae", "b.dae", "--require-confinement", "--trials", "1000", "--quiet"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
}
#endif

TEST_F(ProgramConfinement, WhereItIsRefusedIsSaidOnceOrRequired) {
  const Finished finished = without("filter", "a.dae b.dae");
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(n_notes(finished), 1U) << finished.err;
  EXPECT_NE(finished.err.find("--require-confinement refuses"), std::string::npos) << finished.err;
  expect_refusal(without("filter", "a.dae --require-confinement"), 3, "it cannot be confined, as was required");
  // Formats that vex reads itself need no such process, and nothing is said of it.
  const Finished strict = without("filter", "cube.obj --require-confinement");
  EXPECT_EQ(strict.exit_code, 0) << strict.err;
  EXPECT_EQ(strict.err, "");
}

TEST_F(ProgramConfinement, WithoutLimitsNothingIsRead) {
#ifdef VEX_SANITIZED
  GTEST_SKIP() << "the sanitizer itself asks for the limits that are refused here";
#endif
  expect_refusal(without("limits", "a.dae"), 3, "its limits are refused: Operation not permitted");
}

}  // namespace
}  // namespace vex::golden
