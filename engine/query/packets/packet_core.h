// The support mappings of cores, over packets (packet.h): no more than kernels need, and nothing that is not theirs.
#pragma once

#include "engine/numeric/packet_memory.h"
#include "engine/query/packets/core_form.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

// Long ones are called: inlined, they were as fast, and each pair of cores had eight of them.
#define VEX_OUT_OF_LINE __attribute__((noinline))

/// A vertex, exactly.
struct BoxCore {
  explicit BoxCore(const CoreForm& form) : lower(form.lower), upper(form.upper) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {select_by_sign(dir.x, L(lower.x), L(upper.x)), select_by_sign(dir.y, L(lower.y), L(upper.y)),
            select_by_sign(dir.z, L(lower.z), L(upper.z))};
  }

  /// From the nearest point of the core to p: a first guess at what separates it from a body about there. Zero where p
  /// is inside.
  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    const auto beyond = [](const L& x, double low, double high) {
      return larger(x - L(high), L(0.0)) - larger(L(low) - x, L(0.0));
    };
    return {beyond(p.x, lower.x, upper.x), beyond(p.y, lower.y, upper.y), beyond(p.z, lower.z, upper.z)};
  }
  /// Whether it is more than the direction from the centre.
  bool has_direction() const { return lower.x < upper.x || lower.y < upper.y || lower.z < upper.z; }

  Vec3d lower, upper;
};

/// D (D d / |D d|): each coordinate within 7.6 u of itself, as that of the body's own mapping (E2).
struct EllipsoidCore {
  explicit EllipsoidCore(const CoreForm& form) : semi_axes(form.semi_axes) {
    double shortest = semi_axes.x < semi_axes.y ? semi_axes.x : semi_axes.y;
    shortest = shortest < semi_axes.z ? shortest : semi_axes.z;
    const auto square = [](double x) { return x * x; };
    weights = {square(shortest / semi_axes.x), square(shortest / semi_axes.y), square(shortest / semi_axes.z)};
  }

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> image{L(semi_axes.x) * dir.x, L(semi_axes.y) * dir.y, L(semi_axes.z) * dir.z};
    const L scale = L(1.0) / norm(image);
    return {L(semi_axes.x) * (scale * image.x), L(semi_axes.y) * (scale * image.y), L(semi_axes.z) * (scale * image.z)};
  }

  /// Across the ellipsoid of this shape that goes through p.
  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    return {L(weights.x) * p.x, L(weights.y) * p.y, L(weights.z) * p.z};
  }
  bool has_direction() const { return weights.x < 1.0 || weights.y < 1.0 || weights.z < 1.0; }

  Vec3d semi_axes, weights;  // the latter D^-2, up to a factor
};

/// The direction that an ellipsoid in the place of the core's bounding box would have: for cores whose own is not
/// known.
struct BoundsDirection {
  explicit BoundsDirection(const CoreForm& form) : middle(0.5 * (form.lower + form.upper)) {
    const Vec3d extent = form.upper - form.lower;
    double longest = extent.x > extent.y ? extent.x : extent.y;
    longest = longest > extent.z ? longest : extent.z;
    const auto weight = [&](double length) {
      const double share = length > 0x1p-6 * longest ? length / longest : 0x1p-6;
      return longest > 0.0 ? 0x1p-12 / (share * share) : 1.0;
    };
    weights = {weight(extent.x), weight(extent.y), weight(extent.z)};
  }

  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    const Vec3<L> from = p - broadcast<L>(middle);
    return {L(weights.x) * from.x, L(weights.y) * from.y, L(weights.z) * from.z};
  }
  bool has_direction() const {
    const auto is_near = [](double a, double b) { return a < 1.2 * b && b < 1.2 * a; };
    return !is_near(weights.x, weights.y) || !is_near(weights.y, weights.z);
  }

  Vec3d middle, weights;
};

/// A vertex, and of those that tie the first.
struct VerticesCore : BoundsDirection {
  explicit VerticesCore(const CoreForm& form)
      : BoundsDirection(form), x(form.x.data()), y(form.y.data()), z(form.z.data()), n(form.x.size()) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    L best = dot(Vec3<L>{L(x[0]), L(y[0]), L(z[0])}, dir), index(0.0);
    for (std::size_t i = 1; i < n; ++i) {
      const L value = dot(Vec3<L>{L(x[i]), L(y[i]), L(z[i])}, dir);
      const MaskOf<L> better = value > best;
      best = select(better, value, best);
      index = select(better, L(static_cast<double>(i)), index);
    }
    return {gather(x, index), gather(y, index), gather(z, index)};
  }

  const double *x, *y, *z;
  std::size_t n;
};

/// A vertex whose computed product with the direction is the largest of all (E17), found by the table of directions.
struct TableCore : BoundsDirection {
  explicit TableCore(const CoreForm& form) : BoundsDirection(form), table(form.table) {}

  template <class L>
  VEX_OUT_OF_LINE Vec3<L> support(const Vec3<L>& dir) const {
    const auto rows = rows_of(dir);
    // A lane whose list has ended goes on in the next one: what stands there is a vertex, too. So the number of rounds,
    // which the processor would like to foresee, is mostly the same.
    L n, unused;
    Vec3<L> best = rows.read(0, &n);
    if (any(n > L(kLongList))) [[unlikely]] {
      return one_by_one(rows, n, dir);
    }
    L best_value = dot(best, dir);
    for (std::size_t k = 1; k < kScannedAtLeast || any(n > L(static_cast<double>(k))); k += 2) {
      const Vec3<L> next = rows.read(k, &unused), second = rows.read(k + 1, &unused);
      const L next_value = dot(next, dir), second_value = dot(second, dir);
      const L value = larger(second_value, next_value);
      const MaskOf<L> is_second = second_value > next_value, is_better = value > best_value;
      best = vex::select<L>(is_better, vex::select<L>(is_second, second, next), best);
      best_value = larger(value, best_value);
    }
    return best;
  }

 private:
  /// The lists of the cells that the directions are in. Any lane's, also of a NaN, is one of the table's.
  template <int W>
  RowOfEach<W> rows_of(const Vec3<Packet<W>>& dir) const {
    using L = Packet<W>;
    using Bits = PacketBits<W>;
    const Vec3<L> place{L(table.scale.x) * dir.x, L(table.scale.y) * dir.y, L(table.scale.z) * dir.z};
    const L size_x = absolute(place.x), size_y = absolute(place.y);
    const L size = larger(size_x, larger(size_y, absolute(place.z)));
    const PacketMask<W> is_x = size_x >= size, is_y = size_y >= size;
    const Vec3<L> from_y{place.y, place.z, place.x}, from_z{place.z, place.x, place.y};
    const Vec3<L> turned = vex::select<L>(is_x, place, vex::select<L>(is_y, from_y, from_z));
    const L half = L(0.5) / size;
    // Not below 0, which a product that is not rounded may lead to; nor a NaN.
    L p = larger(L(0.5) + half * turned.y, L(0.0)), q = larger(L(0.5) + half * turned.z, L(0.0));
    const PacketMask<W> is_negative = turned.x < L(0.0);
    const auto of_axis = [&](std::size_t axis) {
      return select(is_negative, number_of<W>(table.cells[2 * axis + 1]), number_of<W>(table.cells[2 * axis]));
    };
    L cell = select(is_x, of_axis(0), select(is_y, of_axis(1), of_axis(2)));
    const Bits of_place(DirectionTable::kPlaceBits), of_width(DirectionTable::kWidthBits);
    for (;;) {
      const L upper = from_bits(bits_of(cell) & of_width);
      const PacketMask<W> is_divided = upper > L(1.0);
      if (!any(is_divided)) break;
      const L width = larger(upper, L(1.0));
      p = p * width;
      q = q * width;
      const L column = whole_below(p, width), row = whole_below(q, width);
      p = p - column;
      q = q - row;
      const Bits inner = (bits_of((row * width + column) + L(0x1p52)) + bits_of(cell)) & of_place;
      cell = select(is_divided, from_bits(gather(table.cells, bits_of(select(is_divided, from_bits(inner), L(0.0))))),
                    cell);
    }
    return RowOfEach<W>(&table.vertices->x, bits_of(cell) & of_place);
  }

  /// Of lists as those around the normal of a facet with many vertices: one after the other, a register of vertices
  /// together. Of vertices that tie the first one of the list answers, as it does where lanes are asked together: which
  /// of the two ways a lane goes hangs on its neighbours.
  template <int W>
  static Vec3<Packet<W>> one_by_one(const RowOfEach<W>& rows, const Packet<W>& n, const Vec3<Packet<W>>& dir) {
    using L = Packet<W>;
    const Stored<W> dirs(dir);
    double length[kCount<W>];
    n.store(length);
    Stored<W> best_of_each;
    for (std::size_t lane = 0; lane < kCount<W>; ++lane) {
      const Vec3<L> one_dir{L(dirs.x[lane]), L(dirs.y[lane]), L(dirs.z[lane])};
      const RowOfEach<W> list(rows.at(lane));
      L unused;
      Vec3<L> best = list.read(0, &unused);
      L best_value = dot(best, one_dir), best_round(0.0);
      for (std::size_t k = kCount<W>; k < static_cast<std::size_t>(length[lane]); k += kCount<W>) {
        const Vec3<L> next = list.read(k, &unused);
        const L value = dot(next, one_dir);
        const MaskOf<L> is_better = value > best_value;
        best = vex::select<L>(is_better, next, best);
        best_round = select(is_better, L(static_cast<double>(k)), best_round);
        best_value = larger(value, best_value);
      }
      const Stored<W> bests(best);
      double values[kCount<W>], rounds[kCount<W>];
      best_value.store(values);
      best_round.store(rounds);
      std::size_t first = 0;
      for (std::size_t k = 1; k < kCount<W>; ++k) {
        const bool comes_first = values[k] == values[first] && rounds[k] < rounds[first];
        first = values[k] > values[first] || comes_first ? k : first;
      }
      best_of_each.x[lane] = bests.x[first];
      best_of_each.y[lane] = bests.y[first];
      best_of_each.z[lane] = bests.z[first];
    }
    return {L::load(best_of_each.x), L::load(best_of_each.y), L::load(best_of_each.z)};
  }
  template <int W>
  static constexpr std::size_t kCount = static_cast<std::size_t>(W);
  template <int W>
  struct Stored {
    Stored() = default;
    explicit Stored(const Vec3<Packet<W>>& v) {
      v.x.store(x);
      v.y.store(y);
      v.z.store(z);
    }
    double x[kCount<W>], y[kCount<W>], z[kCount<W>];
  };

  /// A whole number up to `last` with `a` at most 1 above it: of two that are, either. Never a NaN for none.
  template <class L>
  static L whole_below(const L& a, const L& width) {
    return smaller(nearest_whole(a - L(0.5)), width - L(1.0));
  }
  template <int W>
  static Packet<W> number_of(std::uint64_t cell) {
    return from_bits(PacketBits<W>(cell));
  }

  static constexpr std::size_t kScannedAtLeast = 3;
  static constexpr double kLongList = 48.0;

  DirectionTable table;
};

/// The best piece's c + D (D d / |D d|), with what E18 says of its error.
struct PiecesCore : BoundsDirection {
  explicit PiecesCore(const CoreForm& form)
      : BoundsDirection(form), pieces(form.pieces.data()), n(form.pieces.size()) {}

  template <class L>
  VEX_OUT_OF_LINE Vec3<L> support(const Vec3<L>& dir) const {
    Vec3<L> best;
    L best_value(0.0);
    for (std::size_t i = 0; i < n;) {
      const CoreForm::Piece& piece = pieces[i];
      const bool is_first = i == 0;
      Vec3<L> p = broadcast<L>(piece.centre);
      L value = dot(p, dir);
      for (++i; i < n && pieces[i].is_like_last; ++i) {
        const Vec3<L> other = broadcast<L>(pieces[i].centre);
        const L other_value = dot(other, dir);
        const MaskOf<L> is_better = other_value > value;
        p = vex::select<L>(is_better, other, p);
        value = select(is_better, other_value, value);
      }
      const Vec3d d = piece.semi_axes;
      if (d.x > 0.0 || d.y > 0.0 || d.z > 0.0) {
        Vec3<L> image{L(d.x) * dir.x, L(d.y) * dir.y, L(d.z) * dir.z};
        if (piece.is_dome) image.z = larger(image.z, L(0.0));
        const L length_sq = dot(image, image);
        // Shorter ones add nothing, and their squares may have lost their digits.
        const MaskOf<L> has_length = length_sq > L(0x1p-900);
        const L length = square_root(select(has_length, length_sq, L(1.0)));
        const L scale = select(has_length, L(1.0), L(0.0)) / length;
        value = value + length_sq * scale;
        p = p + Vec3<L>{L(d.x) * (scale * image.x), L(d.y) * (scale * image.y), L(d.z) * (scale * image.z)};
      }
      if (is_first) {
        best = p;
        best_value = value;
        continue;
      }
      const MaskOf<L> is_better = value > best_value;
      best = vex::select<L>(is_better, p, best);
      best_value = select(is_better, value, best_value);
    }
    return best;
  }

  const CoreForm::Piece* pieces;
  std::size_t n;
};

#undef VEX_OUT_OF_LINE

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
