#include "engine/query/exact/extended_difference.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/expect.h"
#include "engine/numeric/whole.h"
#include "engine/support/combinators.h"

namespace vex {
namespace {

// The middle of the box about points and centres; zero where there are none.
class Box {
 public:
  void add(const Vec3d& p) {
    lower_ = is_any_ ? Vec3d{std::min(lower_.x, p.x), std::min(lower_.y, p.y), std::min(lower_.z, p.z)} : p;
    upper_ = is_any_ ? Vec3d{std::max(upper_.x, p.x), std::max(upper_.y, p.y), std::max(upper_.z, p.z)} : p;
    is_any_ = true;
  }
  Vec3d middle() const { return 0.5 * lower_ + 0.5 * upper_; }

 private:
  Vec3d lower_, upper_;
  bool is_any_ = false;
};

Vec3d middle_of(const std::vector<Vec3d>& points, const std::vector<ExactForm::Piece>& pieces) {
  Box box;
  for (const Vec3d& p : points) box.add(p);
  for (const ExactForm::Piece& piece : pieces) box.add(piece.centre);
  return box.middle();
}

// Nothing is lost: a difference of two doubles has two parts.
Vec3e difference(const Vec3d& p, const Vec3d& q) {
  return {two_sum(p.x, -q.x), two_sum(p.y, -q.y), two_sum(p.z, -q.z)};
}

Vec3e times_power_of_two(const Vec3e& v, int exponent) {
  const Vec3d high = times_power_of_two(high_part(v), exponent), low = times_power_of_two(low_part(v), exponent);
  return {{high.x, low.x}, {high.y, low.y}, {high.z, low.z}};
}

// One more than the exponent of the largest coordinate; a very small number where all are zero.
constexpr int kNoExponent = -4000;
int exponent_of(double length) { return length > 0.0 ? std::ilogb(length) + 1 : kNoExponent; }
int exponent_of(const Vec3d& v) {
  return std::max({exponent_of(std::fabs(v.x)), exponent_of(std::fabs(v.y)), exponent_of(std::fabs(v.z))});
}

double largest_coordinate(const Vec3d& a) { return larger(std::fabs(a.x), larger(std::fabs(a.y), std::fabs(a.z))); }
int exponent_of(const std::vector<Vec3d>& points, const Vec3d& middle) {
  double largest = 0.0;
  for (const Vec3d& p : points) largest = larger(largest_coordinate(p - middle), largest);
  return exponent_of(largest);
}

int exponent_of(const ExactForm& form, const Vec3d& middle) {
  int largest = std::max(exponent_of(form.ball_radius), exponent_of(form.points, middle));
  for (const ExactForm::Piece& piece : form.pieces) {
    largest = std::max({largest, exponent_of(piece.centre - middle), exponent_of(piece.semi_axes)});
  }
  return largest;
}

}  // namespace

LocalForms::LocalForms(const PlacedForms& forms) : forms_(forms) {
  const ExactForm &a = forms.a, &b = forms.b;
  middle_a_ = middle_of(a.points, a.pieces);
  middle_b_ = middle_of(b.points, b.pieces);
  // The vector between the middles is exact before it is rounded to two doubles: what cancels is not lost.
  whole::DyadicVector between;
  int exponent_b = 0;
  if (forms.is_b_rounded) {
    middle_of_placed_b_ = middle_of(forms.placed_b, {});
    between = whole::exactly(middle_of_placed_b_) - whole::exactly(middle_a_);
    exponent_b = exponent_of(forms.placed_b, middle_of_placed_b_);
  } else {
    between = whole::placed(forms.a_from_b, whole::exactly(middle_b_)) - whole::exactly(middle_a_);
    exponent_b = exponent_of(b, middle_b_);
  }
  const int exponent_between =
      std::max({whole::exponent_of(between.x), whole::exponent_of(between.y), whole::exponent_of(between.z)});
  // |R x| <= 1.74 |x|, and what is between beside it.
  exponent_ = std::max({exponent_of(a, middle_a_), exponent_b + 1, exponent_between + 1}) + 1;
  exponent_ = std::max(exponent_, -1100);

  for (const ExactForm::Piece& piece : a.pieces) {
    pieces_a_.push_back({local(piece.centre, middle_a_), local(piece.semi_axes, {}), piece.is_dome});
  }
  for (const ExactForm::Piece& piece : b.pieces) {
    pieces_b_.push_back({local(piece.centre, middle_b_), local(piece.semi_axes, {}), piece.is_dome});
  }
  const Transformd& pose = forms.a_from_b;
  a_from_b_ = {extended(pose.row_x),
               extended(pose.row_y),
               extended(pose.row_z),
               {whole::rounded(between.x, exponent_), whole::rounded(between.y, exponent_),
                whole::rounded(between.z, exponent_)}};
  ball_radius_ = Extended(std::ldexp(a.ball_radius, -exponent_)) + Extended(std::ldexp(b.ball_radius, -exponent_));
}

Vec3e LocalForms::local(const Vec3d& point, const Vec3d& middle) const {
  return times_power_of_two(difference(point, middle), -exponent_);
}

Vec3d LocalForms::own(const Vec3e& local, const Vec3d& middle) const {
  return middle + times_power_of_two(high_part(local), exponent_);
}

Vec3e LocalForms::arm_of_b() const {
  VEX_EXPECT(!forms_.is_b_rounded);
  return turned(local(middle_b_, {}));
}

Vec3e LocalForms::turned(const Vec3e& point) const {
  return {dot(a_from_b_.row_x, point), dot(a_from_b_.row_y, point), dot(a_from_b_.row_z, point)};
}

// c + D D d / |D d|, and its height, for the piece that is farthest.
LocalForms::Farthest LocalForms::farthest_piece(const std::vector<Piece>& pieces, const Vec3e& dir) const {
  Farthest best;
  for (const Piece& piece : pieces) {
    const Vec3e& axes = piece.semi_axes;
    Vec3e image{axes.x * dir.x, axes.y * dir.y, axes.z * dir.z};
    if (piece.is_dome && image.z < Extended(0.0)) image.z = Extended(0.0);
    const Vec3e unit = ball_support(Extended(1.0), scaled_to_unit_exponent(image));
    const Vec3e point = piece.centre + Vec3e{axes.x * unit.x, axes.y * unit.y, axes.z * unit.z};
    const Extended height = dot(point, dir);
    if (!best.is_any || height > best.height) best = {point, {}, height, true};
  }
  return best;
}

namespace {

// Where more vertices than these tie, as those of a face that the direction is across, all are made once.
constexpr std::size_t kMany = 8;

// Directions are between 2^-100 and 2^100 long; a vertex set wants them near 1.
Vec3d vertex_direction(const Vec3e& dir) { return scaled_to_unit_exponent(high_part(dir)); }

}  // namespace

Vec3e LocalForms::vertex_of_a(std::size_t i) const { return local(forms_.a.points[i], middle_a_); }

Vec3e LocalForms::vertex_of_b(std::size_t i) const {
  return forms_.is_b_rounded ? local(forms_.placed_b[i], middle_of_placed_b_)
                             : turned(local(forms_.b.points[i], middle_b_));
}

LocalForms::Farthest LocalForms::farthest_of_a(const Vec3e& dir) const {
  Farthest best = farthest_piece(pieces_a_, dir);
  if (best.is_any) best.own = own(best.point, middle_a_);
  const std::vector<std::size_t>& open = forms_.points_a.farthest(vertex_direction(dir));
  for (std::size_t i = 0; open.size() > kMany && vertices_a_.size() < forms_.a.points.size(); ++i) {
    vertices_a_.push_back(vertex_of_a(i));
  }
  for (const std::size_t i : open) {
    const Vec3e point = open.size() > kMany ? vertices_a_[i] : vertex_of_a(i);
    const Extended height = dot(point, dir);
    if (!best.is_any || height > best.height) best = {point, forms_.a.points[i], height, true};
  }
  return best;
}

LocalForms::Farthest LocalForms::farthest_of_b(const Vec3e& dir, const Vec3e& dir_b) const {
  Farthest best = farthest_piece(pieces_b_, dir_b);
  if (best.is_any) {
    best.own = own(best.point, middle_b_);
    best.point = turned(best.point);
    best.height = dot(best.point, dir);
  }
  const std::vector<std::size_t>& open = forms_.points_b.farthest(vertex_direction(dir));
  for (std::size_t i = 0; open.size() > kMany && vertices_b_.size() < forms_.b.points.size(); ++i) {
    vertices_b_.push_back(vertex_of_b(i));
  }
  for (const std::size_t i : open) {
    const Vec3e point = open.size() > kMany ? vertices_b_[i] : vertex_of_b(i);
    const Extended height = dot(point, dir);
    if (!best.is_any || height > best.height) best = {point, forms_.b.points[i], height, true};
  }
  return best;
}

Vec3e ExtendedDifference::support(const Vec3e& dir) const {
  const Vec3e dir_b = forms_.a_from_b().direction_to_b(-dir);
  const LocalForms::Farthest a = forms_.farthest_of_a(dir), b = forms_.farthest_of_b(-dir, dir_b);
  Vec3e w = (a.point - b.point) - forms_.a_from_b().translation;
  if (forms_.ball_radius() > Extended(0.0)) w = w + ball_support(forms_.ball_radius(), dir);
  if (records_ != nullptr) {
    records_->push_back({w, {high_part(dir), low_part(dir), high_part(dir_b), low_part(dir_b), a.own, b.own}});
  }
  const Extended length = norm(dir);
  if (length > Extended(0.0)) {
    const Extended gap = -(dot(dir, w) / length);
    const double lower = gap.high - 0x1p-52 * std::fabs(gap.high) - 2.0 * kExtendedError;
    if (lower > gap_lower_) {
      gap_lower_ = lower;
      best_dir_ = dir;
    }
  }
  return w;
}

}  // namespace vex
