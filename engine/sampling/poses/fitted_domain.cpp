#include "engine/sampling/poses/fitted_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/query/packets/packet_overlap.h"

namespace vex {
namespace {

double reach_along(const ConvexBody& body, const Vec3d& dir) { return dot(dir, body.support(dir)); }

// The long axis, the short one, or both: each where it is unlike the middle one. Of a body whose widths are all much
// the same, and of a needle, whose widths but one are nothing, the one that differs more, as a ratio.
std::size_t axes_of_their_own(const IntervalsOf<double>& own, std::array<std::size_t, 2>& axes) {
  constexpr double kUnlike = 1.5;
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::ranges::stable_sort(order, {}, [&own](std::size_t k) { return own[k].upper - own[k].lower; });
  const auto width = [&](std::size_t rank) { return own[order[rank]].upper - own[order[rank]].lower; };
  const bool is_rather_long = width(2) * width(0) >= width(1) * width(1);
  const bool has_long = width(2) > kUnlike * width(1), has_short = width(1) > kUnlike * width(0);
  const bool is_strip = has_long && has_short;
  axes = {is_strip || is_rather_long ? order[2] : order[0], order[0]};
  return is_strip ? 2 : 1;
}

// One scan finds h(n) and h(-n), for which a table is asked twice: up to here it takes less time.
constexpr std::size_t kMostScannedBothWays = 96;

}  // namespace

FittedDomain::FittedDomain(const ConvexBody& a, const ConvexBody& b) : a_(a), b_(b) {
  pair_.margin = 2.0 * (a.support_error() + b.support_error()) + 0x1p-43 * (a.reach() + b.reach());
  for (std::size_t k = 0; k < 3; ++k) {
    pair_.own_a[k] = {-reach_along(a, -frame_axis(k)), reach_along(a, frame_axis(k))};
    pair_.own_b[k] = {-reach_along(b, -frame_axis(k)), reach_along(b, frame_axis(k))};
  }
  pair_.n_axes_a = axes_of_their_own(pair_.own_a, pair_.axes_a);
  pair_.n_axes_b = axes_of_their_own(pair_.own_b, pair_.axes_b);
  // A's axes with the largest that B can add, whose circumscribed ball is about its centre; slightly enlarged, so that
  // rounding cannot make it the smaller one.
  const auto half_extent = [&](std::size_t k) {
    return (0.5 * (pair_.own_a[k].upper - pair_.own_a[k].lower) + b.circumradius() + 2.0 * pair_.margin) *
           (1.0 + 0x1p-40);
  };
  largest_half_extent_ = {half_extent(0), half_extent(1), half_extent(2)};
}

Parallelepiped FittedDomain::at(const Transformd& rotation) const {
  const std::array<Vec3d, 3> rows = {rotation.row_x, rotation.row_y, rotation.row_z};
  const std::array<Vec3d, 3> axes_b = {Vec3d{rows[0].x, rows[1].x, rows[2].x}, Vec3d{rows[0].y, rows[1].y, rows[2].y},
                                       Vec3d{rows[0].z, rows[1].z, rows[2].z}};
  Parallelepiped best;
  const auto take = [&best](bool is_better, const Parallelepiped& set) {
    if (is_better) best = set;
  };
  FittedSets<double, decltype(take)> sets(pair_, 0.0, take);
  const auto heights = [](const ConvexBody& body, const Vec3d& dir) -> Heights<double> {
    return {reach_along(body, dir), reach_along(body, -dir)};
  };
  const auto along = [&](const Vec3d& normal) {
    return sets.along(heights(a_, normal), heights(b_, rotation.direction_to_b(normal)));
  };

  IntervalsOf<double> along_a, along_b;
  for (std::size_t k = 0; k < 3; ++k) {
    along_a[k] = sets.along_axis_of_a(k, heights(b_, rows[k]));
    along_b[k] = sets.along_axis_of_b(k, heights(a_, axes_b[k]));
  }
  sets.consider_axes_of_a(along_a);
  sets.consider_axes_of_b(axes_b, along_b);
  for (std::size_t i = 0; i < pair_.n_axes_a; ++i) {
    for (std::size_t j = 0; j < pair_.n_axes_b; ++j) {
      const std::size_t axis_a = pair_.axes_a[i], axis_b = pair_.axes_b[j];
      const auto across = decltype(sets)::Across::of(axis_a, axes_b[axis_b]);
      if (!across.is_usable()) continue;
      sets.consider_across(axis_a, axes_b[axis_b], across, along_a[axis_a], along_b[axis_b], along(across.c),
                           along(across.a), along(across.b));
    }
  }
  return best;
}

namespace {

// A body as its own axis u and what is across it: it is as long along u, and nowhere wider across u. Between two
// directions across u that it was asked for, an angle of delta apart, a width is at most the larger of theirs divided
// by cos(delta / 2), and 1 + 2^-20 besides covers the rounding of the directions.
struct LongAndAcross {
  double length, across = 0.0;

  LongAndAcross(const ConvexBody& body, const IntervalsOf<double>& own, std::size_t axis) {
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    const auto width = [&own](std::size_t k) { return own[k].upper - own[k].lower; };
    length = width(axis);
    constexpr int kDirections = 48;
    constexpr double kDelta = std::numbers::pi / kDirections;
    for (int k = 0; k < kDirections; ++k) {
      const Vec3d dir = std::cos(kDelta * k) * frame_axis(next) + std::sin(kDelta * k) * frame_axis(last);
      across = std::fmax(across, reach_along(body, dir) + reach_along(body, -dir));
    }
    across *= (1.0 + 0x1p-20) / std::cos(0.5 * kDelta);
    // The box of its widths is smaller for no body but a box, and a box is as large.
    across = std::fmin(across, std::hypot(width(next), width(last)));
  }
};

// E27, for the sines of the angle between the axes from `low` to `high`; `reach` of both bodies.
double largest_volume_at(const LongAndAcross& a, const LongAndAcross& b, double margin, double reach, double low,
                         double high) {
  const auto sum = [&](double widening) { return a.across + b.across + 2.0 * widening; };
  const double own = margin + 0x1p-43 * reach, d = sum(own), ends = a.length + b.length + 2.0 * own;
  const double of_a = (ends + b.across) * (d + b.length * high) * (d + b.length * high);
  const double of_b = (ends + a.across) * (d + a.length * high) * (d + a.length * high);
  if (!(low > 0.0)) return std::fmin(of_a, of_b);
  const double tilted = margin + 0x1p-43 * reach / low, w = sum(tilted), l = a.length + b.length + 2.0 * tilted;
  const double rods = w * (w * w / low + w * (a.length + b.length) + a.length * b.length * high);
  const double plates = w * (l * l / low + l * (a.across + b.across) + a.across * b.across * high);
  return std::fmin(std::fmin(of_a, of_b), std::fmin(rods, plates));
}

}  // namespace

double FittedDomain::largest_volume() const {
  const Vec3d& half = largest_half_extent_;
  double least = 8.0 * (half.x * half.y * half.z);
  constexpr int kEach = 16, kLast = 16 * kEach;  // sines between 2^(-k/16) and the next, to 2^-16
  for (std::size_t i = 0; i < pair_.n_axes_a; ++i) {
    for (std::size_t j = 0; j < pair_.n_axes_b; ++j) {
      const LongAndAcross a(a_, pair_.own_a, pair_.axes_a[i]), b(b_, pair_.own_b, pair_.axes_b[j]);
      double largest = 0.0;
      for (int k = 0; k <= kLast; ++k) {
        const double high = std::exp2(-static_cast<double>(k) / kEach);
        const double low = k == kLast ? 0.0 : std::exp2(-static_cast<double>(k + 1) / kEach);
        largest = std::fmax(largest, largest_volume_at(a, b, pair_.margin, a_.reach() + b_.reach(), low, high));
      }
      least = std::fmin(least, largest);
    }
  }
  return least * (1.0 + 0x1p-20);
}

KernelHeights::KernelHeights(const ConvexBody& body) : body_(&body) {
  // Within these lengths an ellipsoid's squares neither over- nor underflow, nor do a table's products (E17, E18).
  if (!body.rounds_as_kernels() || !(body.reach() > kLeastPacketReach && body.reach() < kLargestPacketReach)) return;
  form_ = core_form(body);
  if (!form_) return;
  if (form_->kind == CoreForm::Kind::table) take_vertices(body.exact_form()->points);
  const auto is_opposite = [](const Vec3d& x, const Vec3d& y) { return x.x == -y.x && x.y == -y.y && x.z == -y.z; };
  is_symmetric_ = form_->kind == CoreForm::Kind::ellipsoid ||
                  (form_->kind == CoreForm::Kind::box && is_opposite(form_->lower, form_->upper));
}

void KernelHeights::take_vertices(const std::vector<Vec3d>& vertices) {
  if (vertices.size() > kMostScannedBothWays) return;
  form_->kind = CoreForm::Kind::vertices;
  for (const Vec3d& p : vertices) {
    form_->x.push_back(p.x);
    form_->y.push_back(p.y);
    form_->z.push_back(p.z);
  }
}

const CoreForm* KernelHeights::core() const {
  if (!form_) return nullptr;
  switch (form_->kind) {
    case CoreForm::Kind::pieces:
    case CoreForm::Kind::powers:
    case CoreForm::Kind::profile: return nullptr;
    case CoreForm::Kind::table: return form_->table.cells == nullptr ? nullptr : &*form_;
    case CoreForm::Kind::box:
    case CoreForm::Kind::ellipsoid:
    case CoreForm::Kind::vertices: break;
  }
  return &*form_;
}

void KernelHeights::of_body(const ConvexBody::Columns& dirs, std::size_t n, double* along, double* against) const {
  body_->heights(dirs, n, along, against);
}

Domain fitted_domain(const ConvexBody& a, const ConvexBody& b) {
  Domain domain;
  domain.kind = Domain::Kind::fitted;
  domain.half_extent = FittedDomain(a, b).largest_half_extent();
  domain.volume = 8.0 * (domain.half_extent.x * domain.half_extent.y * domain.half_extent.z);
  return domain;
}

}  // namespace vex
