#include "engine/support/cell_contest.h"

#include <array>
#include <cmath>

namespace vex {
namespace {

// In lists up to this long every vertex meets every other one, in longer ones only the best of nearby parts. Where few
// are left, this is what tells the last of them apart.
constexpr std::size_t kAllPairs = 24;
// The best of a long list are sought among so many of it: they need not be the very best.
constexpr std::size_t kSample = 2000;

// Two numbers in one register. Of plain loops the compiler makes wide operations only where a selection cannot raise a
// floating-point exception, which it must assume of comparisons: this way the table is built in two thirds of the time.
using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
/// A number for each part of a cell.
using OfParts = std::array<Pair, kCellParts / 2>;

double at_part(const OfParts& numbers, std::size_t part) { return numbers[part / 2][part % 2]; }

/// The parts whose number is not negative, a bit each.
std::uint32_t parts_not_negative(const OfParts& numbers) {
  using Bits [[gnu::vector_size(sizeof(Pair))]] = std::int64_t;
  Bits bits{0, 0}, bit{1, 2};
  for (const Pair& number : numbers) {
    bits |= (number >= 0.0) & bit;
    bit <<= 2;
  }
  return static_cast<std::uint32_t>(bits[0] | bits[1]);
}

/// The part with the least number, found as in a tournament: half as long as one after the other.
std::size_t part_with_least(const OfParts& numbers) {
  std::array<Pair, kCellParts / 4> value, index;
  for (std::size_t k = 0; k < value.size(); ++k) {
    const auto first = static_cast<double>(4 * k);
    const Pair low{first, first + 1.0}, high{first + 2.0, first + 3.0};
    const Pair a = numbers[2 * k], b = numbers[2 * k + 1];
    index[k] = b < a ? high : low;
    value[k] = b < a ? b : a;
  }
  for (std::size_t n = value.size() / 2; n > 0; n /= 2) {
    for (std::size_t k = 0; k < n; ++k) {
      index[k] = value[k + n] < value[k] ? index[k + n] : index[k];
      value[k] = value[k + n] < value[k] ? value[k + n] : value[k];
    }
  }
  return static_cast<std::size_t>(value[0][1] < value[0][0] ? index[0][1] : index[0][0]);
}

class Contest {
 public:
  Contest(const VertexList& list, const DirectionCell& cell, const std::array<double, 3>& scale, double margin)
      : list_(list), scale_(scale), margin_(margin), half_(0.5 / kCellGrid * cell.width) {
    for (std::size_t k = 0; k < kCellGrid; ++k) {
      const double offset = static_cast<double>(2 * k + 1) * half_;
      s_[k / 2][k % 2] = cell.s0 + offset;
      t_[k] = cell.t0 + offset;
    }
    find_best();
  }

  std::uint32_t parts_of(std::size_t i, bool may_face_elsewhere) {
    least_.fill(Pair{HUGE_VAL, HUGE_VAL});
    if (list_.size() <= kAllPairs) {
      for (std::size_t r = 0; r < list_.size(); ++r) meet(i, r);
    } else {
      if (may_face_elsewhere) {
        meet(i, best(kCellGrid + 1));
        if (parts_not_negative(least_) == 0) return 0;
      }
      meet_nearby(i);
    }
    return parts_not_negative(least_);
  }

 private:
  std::size_t best(std::size_t part) const { return static_cast<std::size_t>(at_part(best_, part)); }

  /// The products of vertex i with the directions in the middles of the parts.
  OfParts products(std::size_t i) const {
    OfParts values;
    const double w = list_.w[i] * scale_[0], y = list_.y[i] * scale_[1], z = list_.z[i] * scale_[2];
    const std::array<Pair, 2> sideways = {s_[0] * y, s_[1] * y};
    for (std::size_t row = 0; row < kCellGrid; ++row) {
      const double base = w + t_[row] * z;
      for (std::size_t j = 0; j < 2; ++j) values[2 * row + j] = base + sideways[j];
    }
    return values;
  }

  /// For each part a vertex that is good at its middle. Which one it is matters to nothing but speed.
  void find_best() {
    most_.fill(Pair{-HUGE_VAL, -HUGE_VAL});
    const std::size_t step = 1 + list_.size() / kSample;
    for (std::size_t i = 0; i < list_.size(); i += step) {
      const OfParts values = products(i);
      const auto number = static_cast<double>(i);
      const Pair index{number, number};
      for (std::size_t k = 0; k < values.size(); ++k) {
        best_[k] = values[k] > most_[k] ? index : best_[k];
        most_[k] = values[k] > most_[k] ? values[k] : most_[k];
      }
    }
  }

  /// Lowers, for each part, what vertex i has more than vertex r, and the margin, at the corner of the part where that
  /// is most. Where it is negative, r has the larger computed product with every direction of the part.
  void meet(std::size_t i, std::size_t r) {
    if (r == i) return;
    const double w = (list_.w[i] - list_.w[r]) * scale_[0];
    const double y = (list_.y[i] - list_.y[r]) * scale_[1];
    const double z = (list_.z[i] - list_.z[r]) * scale_[2];
    const double most = (w + half_ * (std::fabs(y) + std::fabs(z))) + margin_;
    const std::array<Pair, 2> sideways = {s_[0] * y, s_[1] * y};
    for (std::size_t row = 0; row < kCellGrid; ++row) {
      const double base = most + t_[row] * z;
      for (std::size_t j = 0; j < 2; ++j) {
        const Pair value = base + sideways[j];
        Pair& least = least_[2 * row + j];
        least = value < least ? value : least;
      }
    }
  }

  /// Meets the best of the part where the vertex is least short of the best, and of three parts around: those on the
  /// sides where it is less short. From the others these stand between it and the part.
  void meet_nearby(std::size_t i) {
    OfParts short_of = products(i);
    for (std::size_t k = 0; k < short_of.size(); ++k) short_of[k] = most_[k] - short_of[k];
    const std::size_t nearest = part_with_least(short_of);
    const auto beside = [&](std::size_t place, std::size_t stride) {
      if (place == 0) return nearest + stride;
      if (place + 1 == kCellGrid) return nearest - stride;
      return at_part(short_of, nearest + stride) < at_part(short_of, nearest - stride) ? nearest + stride
                                                                                       : nearest - stride;
    };
    const std::size_t across = beside(nearest % kCellGrid, 1), along = beside(nearest / kCellGrid, kCellGrid);
    for (const std::size_t part : {nearest, across, along, along + across - nearest}) meet(i, best(part));
  }

  const VertexList& list_;
  std::array<double, 3> scale_;
  double margin_;
  double half_;  // of a part's width
  // The middles of the parts: of each two columns, and of each row.
  std::array<Pair, kCellGrid / 2> s_{};
  std::array<double, kCellGrid> t_{};
  OfParts best_{}, most_{};  // the vertices that are good at the middles, and their products
  OfParts least_{};
};

}  // namespace

void find_contenders(const VertexList& list, const DirectionCell& cell, const std::array<double, 3>& scale,
                     double margin, std::vector<std::uint32_t>* parts_of_each) {
  Contest contest(list, cell, scale, margin);
  parts_of_each->resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) (*parts_of_each)[i] = contest.parts_of(i, cell.is_face());
}

}  // namespace vex
