#include "engine/query/checker/exact_pair.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/numeric/pose.h"
#include "engine/query/checker/turning.h"

namespace vex::checker {
namespace {

using whole::Dyadic;
using whole::DyadicVector;
using whole::Integer;

const Dyadic& larger(const Dyadic& p, const Dyadic& q) { return p < q ? q : p; }

Dyadic largest_axis(const ExactForm::Piece& piece) {
  return Dyadic(std::max({piece.semi_axes.x, piece.semi_axes.y, piece.semi_axes.z}));
}

DyadicVector image_of(const ExactForm::Piece& piece, const DyadicVector& dir) {
  const bool is_rim = piece.is_dome && whole::sign(dir.z) < 0;
  return {Dyadic(piece.semi_axes.x) * dir.x, Dyadic(piece.semi_axes.y) * dir.y,
          is_rim ? Dyadic() : Dyadic(piece.semi_axes.z) * dir.z};
}

// A rotation to within 1e-6 makes nothing longer than this.
const Dyadic kMostStretch(1.0000016);

Dyadic square_of(const DyadicVector& v) { return dot(v, v); }

// No point is farther from `centre`: |q + D x|^2 <= |q|^2 + 2 max q . D x + (max D)^2.
Dyadic reach_from(const DyadicVector& centre, std::span<const DyadicVector> points,
                  std::span<const ExactForm::Piece> pieces) {
  Dyadic most_sq;
  for (const DyadicVector& p : points) most_sq = larger(most_sq, square_of(p - centre));
  for (const ExactForm::Piece& piece : pieces) {
    const DyadicVector q = whole::exactly(piece.centre) - centre;
    const Dyadic most = largest_axis(piece);
    most_sq =
        larger(most_sq, square_of(q) + Dyadic(2.0) * root_from_above(square_of(image_of(piece, q))) + most * most);
  }
  return root_from_above(most_sq);
}

// Of points and pieces, in the frame of both.
Dyadic support_from_above(std::span<const ExactForm::Piece> pieces, std::span<const DyadicVector> points,
                          const DyadicVector& dir) {
  Dyadic largest;
  bool is_any = false;
  const auto consider = [&](const Dyadic& value) {
    if (!is_any || largest < value) largest = value;
    is_any = true;
  };
  for (const DyadicVector& point : points) consider(dot(point, dir));
  for (const ExactForm::Piece& piece : pieces) {
    const DyadicVector image = image_of(piece, dir);
    consider(dot(whole::exactly(piece.centre), dir) + root_from_above(dot(image, image)));
  }
  return largest;
}

std::vector<DyadicVector> exact_points(std::span<const Vec3d> points) {
  std::vector<DyadicVector> all;
  all.reserve(points.size());
  for (const Vec3d& p : points) all.push_back(whole::exactly(p));
  return all;
}

// What of the form `near` means: its vertex, or the support point of a piece in the direction `dir`, that is nearest to
// it. Whichever is taken is a point of the body; approximate by 2^-kBits of the piece's size, vertices exact.
struct Meant {
  std::optional<std::size_t> vertex;
  DyadicVector point;
};
Meant meant_point(const ExactForm& form, std::span<const DyadicVector> points, const Vec3d& near,
                  const DyadicVector& dir) {
  const DyadicVector target = whole::exactly(near);
  const auto square_of_distance = [&target](const DyadicVector& p) { return dot(p - target, p - target); };
  Meant best;
  Dyadic best_sq;
  bool is_any = false;
  for (const ExactForm::Piece& piece : form.pieces) {
    const DyadicVector image = image_of(piece, dir);
    const Dyadic length = root_from_above(dot(image, image));
    DyadicVector point = whole::exactly(piece.centre);
    if (whole::sign(length) > 0) {
      const DyadicVector along{quotient(image.x, length), quotient(image.y, length), quotient(image.z, length)};
      point = point + image_of(piece, along);
    }
    const Dyadic sq = square_of_distance(point);
    if (is_any && !(sq < best_sq)) continue;
    best.point = point;
    best_sq = sq;
    is_any = true;
  }
  if (form.points.empty()) return best;
  const auto distance = [&near](const Vec3d& p) {
    return std::fabs(p.x - near.x) + std::fabs(p.y - near.y) + std::fabs(p.z - near.z);
  };
  const auto nearest =
      std::ranges::min_element(form.points, [&](const Vec3d& p, const Vec3d& q) { return distance(p) < distance(q); });
  const std::size_t index = static_cast<std::size_t>(nearest - form.points.begin());
  if (is_any && !(square_of_distance(points[index]) < best_sq)) return best;
  return {index, points[index]};
}

Dyadic length_1(const Vec3d& v) { return Dyadic(std::fabs(v.x)) + Dyadic(std::fabs(v.y)) + Dyadic(std::fabs(v.z)); }

}  // namespace

Dyadic root_from_above(const Dyadic& square) {
  if (whole::sign(square) == 0) return {};
  Integer mantissa = square.mantissa;
  int exponent = square.exponent;
  int raise = std::max(0, 2 * kBits - static_cast<int>(msb(mantissa)));
  if (((exponent - raise) & 1) != 0) ++raise;
  mantissa <<= static_cast<unsigned>(raise);
  return {whole::floor_of_root(mantissa) + 1, (exponent - raise) / 2};
}

Dyadic quotient(const Dyadic& numerator, const Dyadic& denominator) {
  if (whole::sign(numerator) == 0) return {};
  const Integer magnitude = abs(numerator.mantissa);
  const int raise =
      std::max(0, kBits + 2 + static_cast<int>(msb(denominator.mantissa)) - static_cast<int>(msb(magnitude)));
  const Integer rounded = (magnitude << static_cast<unsigned>(raise)) / denominator.mantissa;
  return {numerator.mantissa.sign() < 0 ? Integer(-rounded) : rounded,
          numerator.exponent - denominator.exponent - raise};
}

bool is_at_least(const Dyadic& x, const Dyadic& c, const Dyadic& dir_sq) {
  const Dyadic square = x * x, bound_sq = c * c * dir_sq;
  if (whole::sign(c) <= 0) return whole::sign(x) >= 0 || !(bound_sq < square);
  return whole::sign(x) > 0 && !(square < bound_sq);
}

bool is_more_than(const Dyadic& x, const Dyadic& c, const Dyadic& dir_sq) {
  const Dyadic square = x * x, bound_sq = c * c * dir_sq;
  if (whole::sign(c) == 0) return whole::sign(x) > 0;
  if (whole::sign(c) < 0) return whole::sign(x) >= 0 || square < bound_sq;
  return whole::sign(x) > 0 && bound_sq < square;
}

DyadicVector exactly(const ExactVector& vector) {
  DyadicVector sum;
  for (const ExactVector::Part& part : vector.parts) {
    DyadicVector exact = whole::exactly(part.value);
    for (Dyadic* const x : {&exact.x, &exact.y, &exact.z}) x->exponent += part.exponent;
    sum = sum + exact;
  }
  return sum;
}

DyadicVector ExactPose::operator()(const DyadicVector& point) const {
  return DyadicVector{dot(row_x, point), dot(row_y, point), dot(row_z, point)} + translation;
}

DyadicVector ExactPose::direction_to_b(const DyadicVector& dir) const {
  return {row_x.x * dir.x + row_y.x * dir.y + row_z.x * dir.z, row_x.y * dir.x + row_y.y * dir.y + row_z.y * dir.z,
          row_x.z * dir.x + row_y.z * dir.y + row_z.z * dir.z};
}

ExactPose exactly(const Transformd& pose) {
  return {whole::exactly(pose.row_x),
          whole::exactly(pose.row_y),
          whole::exactly(pose.row_z),
          whole::exactly(pose.translation),
          {}};
}

ExactPair::ExactPair(ExactForm a, ExactForm b, ExactPose pose)
    : a_(std::move(a)),
      b_(std::move(b)),
      pose_(std::move(pose)),
      points_a_(exact_points(a_.points)),
      points_b_(exact_points(b_.points)) {}

std::optional<ExactPair> ExactPair::of(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                       std::string& fault) {
  std::optional<ExactForm> form_a = a.exact_form(), form_b = b.exact_form();
  if (!form_a || !form_b)
    fault = "a body has no exact form";
  else if (!is_finite(a_from_b.translation))
    fault = "the pose is not finite";
  else if (!is_rotation(a_from_b))
    fault = "the pose is no rotation";
  if (!fault.empty()) return std::nullopt;
  for (const Vec3d& p : form_b->points) {
    if (is_finite(a_from_b(p))) continue;
    fault = "a placed vertex is not finite";
    return std::nullopt;
  }
  ExactPair pair(std::move(*form_a), std::move(*form_b), exactly(a_from_b));
  if (pair.b_.is_polytope()) {
    for (const Vec3d& p : pair.b_.points) pair.placed_b_.push_back(whole::exactly(a_from_b(p)));
  }
  return pair;
}

ExactPair ExactPair::moved(ExactPose pose) const { return {a_, b_, std::move(pose)}; }

Dyadic ExactPair::support_of_a(const DyadicVector& dir) const { return support_from_above(a_.pieces, points_a_, dir); }

Dyadic ExactPair::support_of_b(const DyadicVector& dir) const {
  if (!placed_b_.empty()) return support_from_above({}, placed_b_, dir);
  const Dyadic support =
      support_from_above(b_.pieces, points_b_, pose_.direction_to_b(dir)) + dot(pose_.translation, dir);
  if (whole::sign(pose_.error) == 0) return support;
  return support + pose_.error * reach_of_b() * root_from_above(dot(dir, dir));
}

Dyadic ExactPair::gap_of_cores(const DyadicVector& dir) const { return -(support_of_a(dir) + support_of_b(-dir)); }

bool ExactPair::is_separated_by(const DyadicVector& dir) const {
  const Dyadic dir_sq = dot(dir, dir);
  return whole::sign(dir_sq) > 0 && is_more_than(gap_of_cores(dir), radii(), dir_sq);
}

DyadicVector ExactPair::placed_vertex(std::size_t i) const {
  return placed_b_.empty() ? pose_(points_b_[i]) : placed_b_[i];
}

DyadicVector ExactPair::point_of_a(const Witness& witness) const {
  return meant_point(a_, points_a_, witness.point_a, whole::exactly(witness.dir) + whole::exactly(witness.dir_low))
      .point;
}

DyadicVector ExactPair::point_of_b(const Witness& witness) const {
  const Meant meant =
      meant_point(b_, points_b_, witness.point_b, whole::exactly(witness.dir_b) + whole::exactly(witness.dir_b_low));
  return meant.vertex ? placed_vertex(*meant.vertex) : pose_(meant.point);
}

DyadicVector ExactPair::core_point(const Witness& witness) const { return point_of_a(witness) - point_of_b(witness); }

Dyadic ExactPair::margin() const {
  const auto of_pieces = [](const ExactForm& form) {
    Dyadic sum;
    for (const ExactForm::Piece& piece : form.pieces) sum = sum + length_1(piece.semi_axes);
    return sum;
  };
  const auto length = [](const DyadicVector& v) {
    return (whole::sign(v.x) < 0 ? -v.x : v.x) + (whole::sign(v.y) < 0 ? -v.y : v.y) +
           (whole::sign(v.z) < 0 ? -v.z : v.z);
  };
  const Dyadic rounded =
      of_pieces(a_) + (length(pose_.row_x) + length(pose_.row_y) + length(pose_.row_z)) * of_pieces(b_);
  const Dyadic of_pose = whole::sign(pose_.error) == 0 ? Dyadic() : pose_.error * reach_of_b();
  return rounded * Dyadic(1, 16 - kBits) + of_pose;
}

Dyadic ExactPair::reach_of_b() const { return reach_from({}, points_b_, b_.pieces); }

namespace {

// |axis x (pose(x) - t)| over a body in its own frame, or of a ball about it.
Dyadic reach_across(const ExactPose& pose, const DyadicVector& axis, const DyadicVector& centre,
                    std::span<const DyadicVector> points, std::span<const ExactForm::Piece> pieces) {
  const auto across = [&](const DyadicVector& p) { return cross(axis, pose(p) - pose.translation); };
  Dyadic own_sq;
  for (const DyadicVector& p : points) own_sq = larger(own_sq, square_of(across(p)));
  const Dyadic turned = kMostStretch * root_from_above(square_of(axis));
  for (const ExactForm::Piece& piece : pieces) {
    // |w x R(c + D x)|^2 <= |w x R c|^2 + 2 max R^T ((w x R c) x w) . D x + (|w| |R| max D)^2.
    const DyadicVector of_centre = across(whole::exactly(piece.centre));
    const DyadicVector image = image_of(piece, pose.direction_to_b(cross(of_centre, axis)));
    const Dyadic most = turned * largest_axis(piece);
    own_sq = larger(own_sq, square_of(of_centre) + Dyadic(2.0) * root_from_above(square_of(image)) + most * most);
  }
  const Dyadic of_ball = root_from_above(square_of(across(centre))) + turned * reach_from(centre, points, pieces);
  const Dyadic own = root_from_above(own_sq);
  return own < of_ball ? own : of_ball;
}

}  // namespace

Dyadic ExactPair::reach_of_b_across(const DyadicVector& axis, const DyadicVector& centre) const {
  return reach_across(pose_, axis, centre, points_b_, b_.pieces);
}

Dyadic ExactPair::reach_of_a_across(const DyadicVector& axis, const DyadicVector& centre) const {
  return reach_across(exactly(Transformd{}), axis, centre, points_a_, a_.pieces);
}

Dyadic ExactPair::reach_of_a_from(const DyadicVector& centre) const {
  return reach_from(centre, points_a_, a_.pieces) + Dyadic(a_.ball_radius);
}

}  // namespace vex::checker
