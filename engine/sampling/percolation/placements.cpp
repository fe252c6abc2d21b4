#include "engine/sampling/percolation/placements.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {

Placements::Placements(std::vector<BodyPart> parts, const BodyOrientations& orientations, std::uint64_t seed)
    : parts_(std::move(parts)), orientations_(orientations), seed_(seed) {
  if (parts_.empty()) throw UsageError("no body is to be placed - give one");
  const OrientationLaw::Kind law = orientations_.law.kind();
  if (law == OrientationLaw::Kind::fixed || law == OrientationLaw::Kind::angle || law == OrientationLaw::Kind::each) {
    throw UsageError("orientations " + orientations_.law.name() +
                     " are about two bodies, and many are placed - choose another law");
  }
  double sum = 0.0;
  for (const BodyPart& part : parts_) {
    if (!(part.fraction > 0.0 && part.fraction <= 1e100)) {
      throw UsageError("a body's part of the number is " + shortest_number(part.fraction) + " - give one above 0");
    }
    sum += part.fraction;
  }
  double so_far = 0.0;
  for (const BodyPart& part : parts_) {
    up_to_.push_back((so_far += part.fraction) / sum);
    is_ball_.push_back(part.body.inradius() >= part.body.circumradius());
  }
  if (parts_.size() > 1) {
    n_drawn_ = kDimension;
  } else if (is_ball_.front()) {
    n_drawn_ = 3;
  } else {
    n_drawn_ = orientations_.law.kind() == OrientationLaw::Kind::aligned && !orientations_.uniform_polar_angle ? 3 : 6;
  }
}

namespace {

std::uint64_t index_of(const RealisationId& id, std::uint32_t k) {
  return (std::uint64_t{id.size} << 58) | (std::uint64_t{id.realisation} << 32) | std::uint64_t{k};
}

}  // namespace

Placements::Placed Placements::operator()(const RealisationId& id, std::uint32_t k, double edge) const {
  Point u{};
  draw_unit_cube(seed_, Stream::percolation, index_of(id, k), std::span(u).first(n_drawn_));
  const std::uint32_t part = part_at(u);
  return {part, Pose::unchecked(pose_at(u, part, edge))};
}

void Placements::many(const RealisationId& id, std::uint32_t first, std::uint32_t n, double edge, InstructionSet set,
                      Many& out) const {
  constexpr std::size_t kStride = kAtOnce + TrialPoints::kSpare;
  double columns[(kDimension + 1) * kStride];
  out.part.resize(n);
  out.world_from_body.resize(n);
  for (std::uint32_t begin = 0; begin < n; begin += kAtOnce) {
    const std::uint32_t n_here = std::min(kAtOnce, n - begin);
    draw_unit_cubes(set, seed_, Stream::percolation, index_of(id, first + begin), static_cast<int>(n_drawn_), n_here,
                    columns, kStride);
    Point u{};
    for (std::uint32_t k = 0; k < n_here; ++k) {
      for (std::size_t c = 0; c < n_drawn_; ++c) u[c] = columns[c * kStride + k];
      const std::uint32_t part = out.part[begin + k] = part_at(u);
      out.world_from_body[begin + k] = Pose::unchecked(pose_at(u, part, edge));
    }
  }
}

// Position, rotation, and of a mixture the part; what is not drawn is not used.
std::uint32_t Placements::part_at(const Point& u) const {
  if (parts_.size() == 1) return 0;
  return static_cast<std::uint32_t>(std::upper_bound(up_to_.begin(), up_to_.end() - 1, u[6]) - up_to_.begin());
}

Transformd Placements::pose_at(const Point& u, std::uint32_t part, double edge) const {
  const std::span<const double> turn = std::span<const double>(u).subspan(3, 3);
  Transformd rotation;
  if (is_ball_[part]) {
    rotation = Transformd{};
  } else if (orientations_.uniform_polar_angle) {
    const SinCos<double> theta = sincospi(u[3]);
    rotation = rotation_of_axis(theta.sin, theta.cos, u[4], u[5]);
  } else {
    rotation = orientations_.law.rotation_of_body(turn);
  }
  const Vec3d centre{edge * (u[0] - 0.5), edge * (u[1] - 0.5), edge * (u[2] - 0.5)};
  return placed(rotation, centre, parts_[part].body.centre());
}

}  // namespace vex
