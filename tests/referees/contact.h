// Where two polytopes come into contact along a ray.
#pragma once

#include "apps/referees/exact_overlap.h"
#include "engine/query/overlap.h"
#include "tests/referees/polytopes.h"

namespace vex::exact {

/// The translations t * dir at which B, turned by `pose`, is apart from A and overlaps it, one bit of t from each
/// other.
struct Contact {
  double apart, together;
};

/// Bisection to the last bit. The engine decides while it can, which only saves time: whatever a test then claims of
/// the neighbourhood it must ask of `overlap` above.
inline Contact contact_along(const TestPolytope& a, const TestPolytope& b, Transformd pose, const Vec3d& dir) {
  Contact contact{10.0 * (a.body.reach() + b.body.reach()) / norm(dir), 0.0};
  for (int step = 0; step < 64; ++step) {
    const double middle = 0.5 * (contact.apart + contact.together);
    pose.translation = middle * dir;
    const Outcome fast = vex::overlap(a.body, b.body, pose).outcome;
    const bool meets =
        fast == Outcome::undecided ? overlap(a.vertices, placed(b.vertices, pose)) : fast == Outcome::overlap;
    (meets ? contact.together : contact.apart) = middle;
  }
  return contact;
}

}  // namespace vex::exact
