// The hull of points; and what is no body or no pose is refused, in this project's build type too.
#include <vex/vex.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

template <class Make>
bool is_refused(const Make& make) {
  try {
    make();
    return false;
  } catch (const vex::InputError&) {
    return true;
  }
}

}  // namespace

int main() {
  const std::vector<vex::Vec3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}};
  const vex::Body hull = vex::hull_of(corners);
  if (std::abs(hull.measures.volume - 1.0 / 6.0) > 1e-15) return 1;
  vex::Transformd mirrored;
  mirrored.row_x.x = -1.0;
  const bool all = is_refused([] { vex::Box(std::numeric_limits<double>::quiet_NaN(), 1, 1); }) &&
                   is_refused([] { vex::Box(-1, 1, 1); }) && is_refused([] { vex::Sphere(0); }) &&
                   is_refused([&] { vex::overlap(hull, hull, mirrored); }) &&
                   is_refused([] { vex::hull_of(std::vector<vex::Vec3d>{{0, 0, 0}, {1, 0, 0}}); });
  try {
    vex::Sphere(-1);
  } catch (const std::invalid_argument& error) {  // what a caller of any library would catch
    return all ? 0 : 2;
  }
  return 3;
}
