// What the tests of vex_scene share.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/golden/program.h"

namespace vex::golden {

inline const std::string kSceneHeader = "body,x,y,z,qw,qx,qy,qz\n";
inline const std::string kPairHeader = "a,b,image_x,image_y,image_z\n";

/// A row of a body that is not turned.
std::string upright(const std::string& body, double x, double y, double z);

class SceneTest : public ProgramTest {
 protected:
  SceneTest() : ProgramTest(VEX_SCENE_PROGRAM) {}

  /// Runs it on this content of scene.csv, and expects success.
  Finished run_on(const std::string& content, Words words) const;
  /// The rows, without the summary.
  std::string rows_of(const std::string& content, Words words) const;
  /// Exit code and message for this content of scene.csv; no file beside it is left.
  void expect_refused(const std::string& content, const Words& words, int exit_code, const std::string& part) const;
};

/// A .glb file taken apart. `fault` says what is wrong with its layout or its accessors; empty where all is right.
struct Glb {
  nlohmann::json document;
  std::string numbers;
  std::string fault;

  explicit Glb(const std::string& file);
  /// The numbers of an accessor, a row each.
  std::vector<std::vector<double>> rows(std::size_t accessor) const;

 private:
  std::string fault_of_accessors() const;
};

}  // namespace vex::golden
