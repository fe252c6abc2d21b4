// What queries of distance and depth are asked about: pairs of bodies of all kinds, and poses far, near and in contact.
#pragma once

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "engine/query/overlap.h"
#include "engine/sampling/domain.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {

/// Two bodies by their texts: those of `parse_shape`, or hull:N, the hull of N points on an ellipsoid 1:2:3.
struct SeparationKind {
  std::string a, b;
  std::string name() const { return a == b ? a : a + " " + b; }
};

inline void PrintTo(const SeparationKind& kind, std::ostream* out) { *out << kind.name(); }

/// Every size multiplied by the scale.
inline ConvexBody separation_body(const std::string& text, double scale = 1.0) {
  if (!text.starts_with("hull:")) return parse_shape(text, scale).body;
  const int n = std::stoi(text.substr(5));
  return test_point_hull(n, {scale, 2.0 * scale, 3.0 * scale}, static_cast<std::uint64_t>(n)).body;
}

/// Every body of `kTestBodies` with itself and with another; ellipsoids as flat as 1e-6, sizes as different as 1e6,
/// needles, hulls.
inline std::vector<SeparationKind> separation_kinds() {
  std::vector<SeparationKind> kinds;
  for (const char* body : kTestBodies) kinds.push_back({body, body});
  for (std::size_t k = 0; k < kTestBodies.size(); ++k) {
    kinds.push_back({kTestBodies[k], kTestBodies[(k + 7) % kTestBodies.size()]});
  }
  for (const auto& [a, b] : {std::pair{"ellipsoid:1,1,1e-3", "ellipsoid:1,1,1e-3"},
                             {"ellipsoid:1,1,1e-6", "ellipsoid:1,1,1e-6"},
                             {"ellipsoid:1,1,1e-6", "box:1,1,1"},
                             {"ellipsoid:1,1,1e-3", "cylinder:1,0.5"},
                             {"box:1e6,1e6,1e6", "box:1,1,1"},
                             {"sphere:1e-6", "box:1,1,1"},
                             {"ellipsoid:1,2,3", "ellipsoid:1e6,2e6,3e6"},
                             {"cone:1,0.5", "cylinder:1e6,1e6"},
                             {"capsule:100,0.01", "box:1e-3,1e-3,1"},
                             {"ellipsoid:1e-3,1e-3,1", "needle:2"},
                             {"hull:20", "hull:20"},
                             {"hull:100", "hull:100"},
                             {"hull:100", "box:1,1,1"},
                             {"hull:20", "ellipsoid:1,2,3"}}) {
    kinds.push_back({a, b});
  }
  return kinds;
}

/// B's centre at `step` from A's; R of the pose stays.
inline void put_centres_apart(const ConvexBody& a, const ConvexBody& b, const Vec3d& step, Transformd& pose) {
  pose.translation = {};
  pose.translation = (a.centre() - pose(b.centre())) + step;
}

/// A line of B's centre through A's and a turn of B, and where the bodies come into contact along it: the truth of a
/// pose beside it must be learnt from a referee.
struct ContactLine {
  Transformd turn;
  Vec3d unit_dir;
  double contact = 0.0;

  ContactLine(const ConvexBody& a, const ConvexBody& b, const Transformd& turn_of_b, const Vec3d& dir)
      : turn(turn_of_b), unit_dir((1.0 / norm(dir)) * dir) {
    double apart = 1.01 * (a.circumradius() + b.circumradius());
    for (int step = 0; step < 64; ++step) {
      const double middle = 0.5 * (contact + apart);
      (overlap(a, b, at(a, b, middle)).outcome == Outcome::disjoint ? apart : contact) = middle;
    }
  }
  Transformd at(const ConvexBody& a, const ConvexBody& b, double distance) const {
    Transformd pose = turn;
    put_centres_apart(a, b, distance * unit_dir, pose);
    return pose;
  }
};

inline ContactLine random_contact_line(const ConvexBody& a, const ConvexBody& b, std::mt19937_64& random) {
  const Transformd turn = random_rotation(random);
  return {a, b, turn, random_direction(random)};
}

/// 2^-3 ... 2^-50 of R_A + R_B from contact along a line, on either side, the k-th of a sequence of poses.
inline Transformd beside_contact(const ConvexBody& a, const ConvexBody& b, const ContactLine& line, int k) {
  const double shift = std::ldexp(a.circumradius() + b.circumradius(), -3 - (k / 2) % 48);
  return line.at(a, b, line.contact + (k % 2 == 0 ? shift : -shift));
}
inline Transformd near_contact_pose(const ConvexBody& a, const ConvexBody& b, std::mt19937_64& random, int k) {
  return beside_contact(a, b, random_contact_line(a, b, random), k);
}

/// B's frame is A's, but for quarter turns and for what a turn there and back leaves of rounding, and B's centre is
/// along an axis of it from A's: faces, edges and rims meet flush, and ways out tie. Near contact, deep, or the same.
inline Transformd aligned_pose(const ConvexBody& a, const ConvexBody& b, std::mt19937_64& random, int k) {
  Transformd turn;
  const Transformd r = random_rotation(random);
  const auto there_and_back = [&r](const Vec3d& x) {
    return r.direction_to_b({dot(r.row_x, x), dot(r.row_y, x), dot(r.row_z, x)});
  };
  if (random() % 2 == 0) {
    turn = {there_and_back(turn.row_x), there_and_back(turn.row_y), there_and_back(turn.row_z), {}};
  }
  for (std::uint64_t n = random() % 4; n > 0; --n) turn = {turn.row_y, -turn.row_x, turn.row_z, {}};
  for (std::uint64_t n = random() % 4; n > 0; --n) turn = {turn.row_x, turn.row_z, -turn.row_y, {}};
  const double sign = random() % 2 == 0 ? 1.0 : -1.0;
  const std::uint64_t axis = random() % 3;
  const ContactLine line(a, b, turn, {axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0});
  switch (random() % 8) {
    case 0: return line.at(a, b, 0.0);
    case 1: return line.at(a, b, random_in_unit_interval(random) * line.contact);
    case 2: return line.at(a, b, (1.0 + random_in_unit_interval(random)) * line.contact);
    case 3: return line.at(a, b, line.contact);
    default: return beside_contact(a, b, line, k);
  }
}

}  // namespace vex
