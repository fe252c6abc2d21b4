#include "engine/query/search/contact_patches.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

constexpr std::size_t kOfPatch = 12;

}  // namespace

void ContactPatches::take(const std::vector<ContactCorner>& corners) {
  corners_ = corners;
  patches_.clear();
  // Strips along y, about as wide as their patches are long.
  const std::size_t n = corners_.size(), n_patches = (n + kOfPatch - 1) / kOfPatch;
  const std::size_t n_strips = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n_patches))));
  const std::size_t of_strip = kOfPatch * ((n_patches + n_strips - 1) / std::max<std::size_t>(n_strips, 1));
  const auto at_x = [](const ContactCorner& corner) { return corner.at.x; };
  const auto at_y = [](const ContactCorner& corner) { return corner.at.y; };
  std::ranges::sort(corners_, {}, at_x);
  for (std::size_t strip = 0; strip < n; strip += of_strip) {
    const std::size_t end = std::min(strip + of_strip, n);
    const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(strip);
    std::ranges::sort(begin, corners_.begin() + static_cast<std::ptrdiff_t>(end), {}, at_y);
    for (std::size_t from = strip; from < end; from += kOfPatch) {
      patches_.push_back(patch_of(from, std::min(from + kOfPatch, end)));
    }
  }
  most_above_.resize(patches_.size());
}

ContactPatches::Patch ContactPatches::patch_of(std::size_t from, std::size_t to) const {
  PlanarPoint least = corners_[from].at, most = least;
  double height = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    const PlanarPoint& at = corners_[k].at;
    least = {std::min(least.x, at.x), std::min(least.y, at.y)};
    most = {std::max(most.x, at.x), std::max(most.y, at.y)};
    height += corners_[k].height / static_cast<double>(to - from);
  }
  const PlanarPoint middle = 0.5 * (least + most);
  // Least squares; any slope will do where they are on a line.
  double xx = 0.0, xy = 0.0, yy = 0.0, xh = 0.0, yh = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    const PlanarPoint off = corners_[k].at - middle;
    const double up = corners_[k].height - height;
    xx += off.x * off.x;
    xy += off.x * off.y;
    yy += off.y * off.y;
    xh += off.x * up;
    yh += off.y * up;
  }
  const double determinant = xx * yy - xy * xy;
  Patch patch{from, to, middle, 0.5 * (most - least), {{middle, height}, {}}};
  if (determinant > 0x1p-30 * xx * yy) {
    patch.cover.slope = {(xh * yy - yh * xy) / determinant, (yh * xx - xh * xy) / determinant};
  }
  double rest = 0.0;
  for (std::size_t k = from; k < to; ++k) rest = std::max(rest, patch.cover.height_of(corners_[k]));
  patch.cover.through.height += rest;
  return patch;
}

double ContactPatches::most_above(const Patch& patch, const ContactPlane& plane) {
  const double in_the_middle = plane.height_of(patch.cover.through);
  const PlanarPoint steeper = patch.cover.slope - plane.slope;
  const double beside = std::fabs(steeper.x) * patch.half.x + std::fabs(steeper.y) * patch.half.y;
  const double rounding = 0x1p-48 * (std::fabs(patch.cover.through.height) + std::fabs(plane.through.height) +
                                     std::fabs(in_the_middle) + beside);
  return in_the_middle + beside + rounding;
}

void ContactPatches::look_near(const PlanarPoint& place) {
  std::array<double, kNear> distances;
  distances.fill(HUGE_VAL);
  n_near_ = std::min(kNear, patches_.size());
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const Patch& patch = patches_[k];
    const PlanarPoint off = place - patch.middle;
    const double distance = std::max(std::fabs(off.x) - patch.half.x, std::fabs(off.y) - patch.half.y);
    if (!(distance < distances.back())) continue;
    std::size_t at = kNear - 1;
    for (; at > 0 && distance < distances[at - 1]; --at) {
      distances[at] = distances[at - 1];
      near_[at] = near_[at - 1];
    }
    distances[at] = distance;
    near_[at] = k;
  }
}

const ContactCorner* ContactPatches::farthest_near(const ContactPlane& plane, double least) const {
  const ContactCorner* farthest = nullptr;
  for (std::size_t i = 0; i < n_near_; ++i) look_at(patches_[near_[i]], plane, least, farthest);
  return farthest;
}

const ContactCorner* ContactPatches::least_below(const ContactPlane& plane, const PlanarPoint& from,
                                                 const PlanarPoint& beyond, double least) const {
  const ContactCorner* first = nullptr;
  double height_of_first = 0.0, off_of_first = 0.0;
  for (std::size_t i = 0; i < n_near_; ++i) {
    const Patch& patch = patches_[near_[i]];
    for (std::size_t k = patch.from; k < patch.to; ++k) {
      const double off = dot(beyond, corners_[k].at - from);
      if (!(off > least)) continue;
      const double height = plane.height_of(corners_[k]);
      if (first != nullptr && !(height * off_of_first > height_of_first * off)) continue;
      first = &corners_[k];
      height_of_first = height;
      off_of_first = off;
    }
  }
  return first;
}

void ContactPatches::look_at(const Patch& patch, const ContactPlane& plane, double& least,
                             const ContactCorner*& farthest) const {
  for (std::size_t k = patch.from; k < patch.to; ++k) {
    const double by = plane.height_of(corners_[k]);
    if (by > least) {
      least = by;
      farthest = &corners_[k];
    }
  }
}

const ContactCorner* ContactPatches::farthest_above(const ContactPlane& plane, double least) {
  const ContactCorner* farthest = nullptr;
  // The one that may be the highest first: most of the others are below its corners then.
  std::size_t first = 0;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    most_above_[k] = most_above(patches_[k], plane);
    if (most_above_[k] > most_above_[first]) first = k;
  }
  if (patches_.empty() || !(most_above_[first] > least)) return nullptr;
  look_at(patches_[first], plane, least, farthest);
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    if (most_above_[k] > least && k != first) look_at(patches_[k], plane, least, farthest);
  }
  return farthest;
}

}  // namespace vex
