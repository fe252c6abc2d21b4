// The images of a periodic scene that a query looks at, numbered (internal).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/scene/periodic_box.h"

namespace vex {

/// All images with components from -n_images to n_images, numbered in their order; without a box only the bodies
/// themselves.
class ShiftTable {
 public:
  ShiftTable() : ShiftTable(std::nullopt, {}) {}
  ShiftTable(const std::optional<PeriodicBox>& box, const std::array<int, 3>& n_images) { assign(box, n_images); }
  /// Other images, in the memory of those before.
  void assign(const std::optional<PeriodicBox>& box, const std::array<int, 3>& n_images);

  std::uint32_t size() const { return static_cast<std::uint32_t>(images_.size()); }
  std::uint32_t number(const ImageOffset& image) const {
    return static_cast<std::uint32_t>(((image[0] + n_[0]) * (2 * n_[1] + 1) + (image[1] + n_[1])) * (2 * n_[2] + 1) +
                                      (image[2] + n_[2]));
  }
  const std::array<int, 3>& n_images() const { return n_; }
  std::uint32_t home() const { return number({}); }
  /// The number of minus the image.
  std::uint64_t opposite(std::uint64_t number) const { return images_.size() - 1 - number; }
  /// Whether of a pair, the second of which is moved by this shift, the second comes first: by the bodies' numbers, and
  /// of a body and its own copy by the image. That is as good as random, so no branch hangs on it.
  bool is_reversed(std::uint32_t first, std::uint32_t second, std::uint64_t number) const {
    return (first > second) | ((first == second) & (number < opposite(number)));
  }
  const ImageOffset& image(std::uint64_t number) const { return images_[number]; }
  Vec3d shift(std::uint64_t number) const {
    const double* const row = rows_.data() + 4 * number;
    return {row[0], row[1], row[2]};
  }
  /// The shift of each number, as a row of four doubles.
  const double* rows() const { return rows_.data(); }
  /// No shift moves anything farther along a coordinate axis.
  double largest_shift() const;

 private:
  std::array<int, 3> n_{};
  std::vector<double> rows_;
  std::vector<ImageOffset> images_;
};

}  // namespace vex
