#include "engine/query/checker/inner_balls.h"

#include <algorithm>
#include <vector>

#include "engine/query/checker/exact_pair.h"

namespace vex::checker {
namespace {

using whole::Dyadic;
using whole::DyadicVector;

struct Ball {
  DyadicVector centre;
  Dyadic radius;
};

// Of a body without its own ball, in its own frame: in an ellipsoid the ball of its least semi-axis.
std::vector<Ball> balls_in(const ExactForm& form) {
  std::vector<Ball> balls;
  for (const ExactForm::Piece& piece : form.pieces) {
    const Vec3d& axes = piece.semi_axes;
    const double least = piece.is_dome ? 0.0 : std::min({axes.x, axes.y, axes.z});
    balls.push_back({whole::exactly(piece.centre), Dyadic(least)});
  }
  return balls;
}

// Of a hull of points, a point of it.
DyadicVector middle_of(const DyadicVector& p, const DyadicVector& q) {
  const Dyadic half(1, -1);
  const DyadicVector sum = p + q;
  return {half * sum.x, half * sum.y, half * sum.z};
}

// No vector is made shorter by R than by this factor: |R'R - I|, as large as the root of the sum of its squares at
// most, is no less than 1 - |R x|^2 of a unit vector.
Dyadic least_stretch(const ExactPose& pose) {
  const DyadicVector x{pose.row_x.x, pose.row_y.x, pose.row_z.x}, y{pose.row_x.y, pose.row_y.y, pose.row_z.y},
      z{pose.row_x.z, pose.row_y.z, pose.row_z.z};
  const Dyadic one(1.0), two(2.0);
  const Dyadic xx = dot(x, x) - one, yy = dot(y, y) - one, zz = dot(z, z) - one, xy = dot(x, y), yz = dot(y, z),
               zx = dot(z, x);
  const Dyadic off = root_from_above(xx * xx + yy * yy + zz * zz + two * (xy * xy + yz * yz + zx * zx));
  return off < one ? one - off : Dyadic();
}

}  // namespace

bool balls_come_as_near_as(const ExactForm& a, const ExactForm& b, const Transformd& a_from_b, const Dyadic& upper) {
  const auto is_any = [](const ExactForm& form) { return !form.points.empty() || !form.pieces.empty(); };
  if (!is_any(a) || !is_any(b)) return false;
  std::vector<Ball> in_a = balls_in(a), in_b;
  if (in_a.empty()) {
    in_a.push_back({middle_of(whole::exactly(a.points.front()), whole::exactly(a.points.back())), Dyadic()});
  }
  const ExactPose pose = exactly(a_from_b);
  const Dyadic stretch = least_stretch(pose);
  for (const Ball& ball : balls_in(b)) in_b.push_back({pose(ball.centre), stretch * ball.radius});
  if (b.is_polytope()) {
    // Each vertex is rounded as it is placed.
    const Vec3d first = a_from_b(b.points.front()), last = a_from_b(b.points.back());
    in_b.push_back({middle_of(whole::exactly(first), whole::exactly(last)), Dyadic()});
  } else if (in_b.empty()) {
    in_b.push_back({pose(middle_of(whole::exactly(b.points.front()), whole::exactly(b.points.back()))), Dyadic()});
  }
  const Dyadic own = Dyadic(a.ball_radius) + Dyadic(b.ball_radius);
  for (const Ball& of_a : in_a) {
    for (const Ball& of_b : in_b) {
      const DyadicVector off = of_b.centre - of_a.centre;
      // |off| - radii <= upper.
      const Dyadic most = of_a.radius + of_b.radius + own + upper;
      if (whole::sign(most) >= 0 && !(most * most < dot(off, off))) return true;
    }
  }
  return false;
}

}  // namespace vex::checker
