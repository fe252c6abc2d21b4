#include "engine/query/exact/placed_forms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vex {
namespace {

double largest_coordinate(const Vec3d& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

double largest_length(const ExactForm& form) {
  double largest = form.ball_radius;
  for (const Vec3d& p : form.points) largest = std::max(largest, largest_coordinate(p));
  for (const ExactForm::Piece& piece : form.pieces) {
    largest = std::max({largest, largest_coordinate(piece.centre), largest_coordinate(piece.semi_axes)});
  }
  return largest;
}

// The points less the first one, times a power of two that brings the largest coordinate between 1/2 and 1: each
// coordinate within 2 u of that.
std::vector<Vec3d> unit_offsets(const std::vector<Vec3d>& points) {
  double largest = 0.0;
  for (const Vec3d& p : points) largest = std::max(largest, largest_coordinate(p));
  const double factor = largest < 0x1p1000 ? 1.0 : 0.25;
  std::vector<Vec3d> offsets;
  offsets.reserve(points.size());
  largest = 0.0;
  for (const Vec3d& p : points) {
    offsets.push_back(factor * p - factor * points.front());
    largest = std::max(largest, largest_coordinate(offsets.back()));
  }
  if (largest == 0.0) return offsets;
  const int exponent = std::ilogb(largest) + 1;
  for (Vec3d& p : offsets) p = times_power_of_two(p, -exponent);
  return offsets;
}

bool is_finite(const Transformd& pose) {
  return is_finite(pose.row_x) && is_finite(pose.row_y) && is_finite(pose.row_z) && is_finite(pose.translation);
}

}  // namespace

VertexSet::VertexSet(const std::vector<Vec3d>& offsets) {
  for (std::vector<double>* const of : {&x_, &y_, &z_}) of->reserve(offsets.size());
  for (const Vec3d& p : offsets) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

const std::vector<std::size_t>& VertexSet::farthest(const Vec3d& dir) const {
  constexpr std::size_t kBlock = 16, kChains = 4;
  const std::size_t n = x_.size(), n_blocks = (n + kBlock - 1) / kBlock;
  found_.clear();
  values_.resize(n);
  most_of_block_.resize(n_blocks);
  double* const values = values_.data();
  double largest = -HUGE_VAL;
  for (std::size_t i = 0; i < n; ++i) values[i] = dot(Vec3d{x_[i], y_[i], z_[i]}, dir);
  for (std::size_t block = 0; block < n_blocks; ++block) {
    // Several maxima side by side: each waits for its last comparison.
    std::array<double, kChains> most;
    most.fill(-HUGE_VAL);
    const std::size_t end = std::min(n, (block + 1) * kBlock);
    std::size_t i = block * kBlock;
    for (; i + kChains <= end; i += kChains) {
      for (std::size_t k = 0; k < kChains; ++k) most[k] = larger(values[i + k], most[k]);
    }
    for (; i < end; ++i) most[0] = larger(values[i], most[0]);
    most_of_block_[block] = larger(larger(most[0], most[1]), larger(most[2], most[3]));
    largest = larger(most_of_block_[block], largest);
  }
  const double least = largest - 0x1p-45;
  for (std::size_t block = 0; block < n_blocks; ++block) {
    if (!(most_of_block_[block] >= least)) continue;
    for (std::size_t i = block * kBlock, end = std::min(n, i + kBlock); i < end; ++i) {
      if (values[i] >= least) found_.push_back(i);
    }
  }
  return found_;
}

std::optional<PlacedForms> placed_forms(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                        bool turns) {
  std::optional<ExactForm> form_a = a.exact_form(), form_b = b.exact_form();
  if (!form_a || !form_b) return std::nullopt;
  PlacedForms forms{std::move(*form_a), std::move(*form_b), a_from_b, {}, VertexSet({}), VertexSet({}), false};
  forms.is_b_rounded = forms.b.is_polytope() && !turns;
  const double length_a = largest_length(forms.a), length_b = largest_length(forms.b);
  if (!std::isfinite(length_a) || !std::isfinite(length_b) || !is_finite(a_from_b)) return std::nullopt;
  for (const Vec3d& p : forms.b.points) {
    forms.placed_b.push_back(a_from_b(p));
    if (!is_finite(forms.placed_b.back())) return std::nullopt;
  }
  forms.points_a = VertexSet(unit_offsets(forms.a.points));
  std::vector<Vec3d> offsets_b = unit_offsets(forms.is_b_rounded ? forms.placed_b : forms.b.points);
  if (!forms.is_b_rounded) {
    Transformd turn = a_from_b;
    turn.translation = {};
    for (Vec3d& p : offsets_b) p = turn(p);
  }
  forms.points_b = VertexSet(offsets_b);
  return forms;
}

}  // namespace vex
