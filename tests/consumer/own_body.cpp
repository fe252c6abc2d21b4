// A body of one's own with the engine alone: x^2 + y^2 + z^2 <= r^2, 0 <= z.
//
//   own_body R DISTANCE      whether two such, their flat faces DISTANCE apart, overlap; and what `validate` finds
#include <vex/engine/numeric/rounding.h>
#include <vex/engine/query/overlap.h>
#include <vex/engine/support/validate.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

struct Dome {
  double r;

  // The sphere's point where the direction looks up, and a point of the rim where it does not.
  vex::Vec3d support(const vex::Vec3d& d) const {
    const double up = d.z > 0.0 ? d.z : 0.0, length = std::sqrt(d.x * d.x + d.y * d.y + up * up);
    if (length == 0.0) return {};
    return {r * (d.x / length), r * (d.y / length), r * (up / length)};
  }
  double support_error() const { return 8.0 * vex::kUnitRoundoff * r; }
  vex::Vec3d centre() const { return {}; }
  double circumradius() const { return r * (1.0 + 0x1p-48); }
  double inradius() const { return 0.0; }
};

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const vex::ConvexBody dome = Dome{std::atof(argv[1])};
  vex::Transformd below;  // turned about x, so that the flat faces look at each other
  below.row_y.y = below.row_z.z = -1.0;
  below.translation.z = -std::atof(argv[2]);
  std::printf("%s %s\n", vex::name_of(vex::overlap(dome, dome, below).outcome).data(),
              vex::validate(dome).empty() ? "valid" : "not valid");
}
