// What the tests of vex_pair share: poses as files, and rows taken apart.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tests/golden/program.h"

namespace vex::golden {

inline const std::string kMatrixHeader = "r11,r12,r13,r21,r22,r23,r31,r32,r33,tx,ty,tz\n";
inline const std::string kQuaternionHeader = "tx,ty,tz,qw,qx,qy,qz\n";

std::vector<std::string> lines_of(const std::string& text);
/// Of a text with an object of JSON a line.
std::vector<nlohmann::json> objects_of(const std::string& text);

/// tx, ty, tz, qw, qx, qy, qz of random poses, of which about half overlap for two unit cubes; of any length.
std::vector<std::array<double, 7>> random_poses(std::size_t n);
/// As a file, the numbers in decimal.
std::string quaternion_file(const std::vector<std::array<double, 7>>& poses);
/// The same poses as matrices, in hexadecimal.
std::string matrix_file(const std::vector<std::array<double, 7>>& poses);

class Pair : public ProgramTest {
 protected:
  Pair() : ProgramTest(VEX_PAIR_PROGRAM) {}

  /// Of two unit cubes.
  Finished cubes(Words words) const;
  void expect_wrong(const Words& words, int exit_code, const std::string& part) const;
  /// For run_and_signal: its first answers are there.
  std::function<bool(pid_t)> has_answered() const;
};

class PairQuery : public Pair {};
class PairRefusal : public Pair {};
class PairStream : public Pair {};

}  // namespace vex::golden
