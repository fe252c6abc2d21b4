// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: a relative pose
// is the same bits everywhere.
#include "engine/scene/scene_kernel.h"

#include "engine/numeric/packet_memory.h"

namespace vex {
namespace VEX_ISA {
namespace {

constexpr int W = kRegisterLanes;
using L = Packet<W>;
using Mask = PacketMask<W>;
using Bits = PacketBits<W>;
using Vec = Vec3<L>;

// A pose and what is asked of it; rows by RowOfEach.
Transform<L> pose_of(const double* poses, const Bits& places) {
  const RowOfEach<W> rows(poses, places + (places << 1));
  Transform<L> pose;
  pose.row_x = rows.read(0, &pose.translation.x);
  pose.row_y = rows.read(1, &pose.translation.y);
  pose.row_z = rows.read(2, &pose.translation.z);
  return pose;
}

// Scene::relative_pose: R_a^T v.
Vec turned_back(const Transform<L>& a, const Vec& v) { return a.direction_to_b(v); }

Vec row_product(const L& x, const L& y, const L& z, const Transform<L>& b) {
  return {(x * b.row_x.x + y * b.row_y.x) + z * b.row_z.x, (x * b.row_x.y + y * b.row_y.y) + z * b.row_z.y,
          (x * b.row_x.z + y * b.row_y.z) + z * b.row_z.z};
}

Vec column(const Transform<L>& pose, int axis) {
  if (axis == 0) return {pose.row_x.x, pose.row_y.x, pose.row_z.x};
  if (axis == 1) return {pose.row_x.y, pose.row_y.y, pose.row_z.y};
  return {pose.row_x.z, pose.row_y.z, pose.row_z.z};
}

Vec times(const Transform<L>& pose, const Vec3d& v) {
  return {(pose.row_x.x * L(v.x) + pose.row_x.y * L(v.y)) + pose.row_x.z * L(v.z),
          (pose.row_y.x * L(v.x) + pose.row_y.y * L(v.y)) + pose.row_y.z * L(v.z),
          (pose.row_z.x * L(v.x) + pose.row_z.y * L(v.y)) + pose.row_z.z * L(v.z)};
}

L clamped(const L& x, double half) { return larger(L(-half), smaller(x, L(half))); }

// Whether cylinders with these axes, d from the first centre to the second, are apart along a direction (E26).
class Cylinders {
 public:
  Cylinders(const CylinderPair& pair, const Vec& axis_a, const Vec& axis_b, const Vec& d)
      : pair_(pair), a_(axis_a), b_(axis_b), d_(d) {
    slack_ = L(0x1p-18) * (L(pair.half_a + pair.radius_a + pair.half_b + pair.radius_b) + norm_1(d));
  }

  Mask are_apart() const {
    Mask apart(false);
    if (pair_.are_long) apart = are_apart_along(between_axes());
    if (pair_.is_flat_a) apart = either(apart, are_apart_along(a_));
    if (pair_.is_flat_b) apart = either(apart, are_apart_along(b_));
    return apart;
  }

 private:
  Mask are_apart_along(const Vec& n) const {
    const L reach_a = L(pair_.half_a) * absolute(dot(n, a_)) + L(pair_.radius_a) * norm(cross(n, a_));
    const L reach_b = L(pair_.half_b) * absolute(dot(n, b_)) + L(pair_.radius_b) * norm(cross(n, b_));
    return absolute(dot(n, d_)) - (reach_a + reach_b) > slack_ * norm_1(n);
  }

  // From the point of the first axis nearest to the second axis to that one's (C. Ericson, Real-Time Collision
  // Detection, section 5.1.9); any other would do for the proof.
  Vec between_axes() const {
    const L along = dot(a_, b_), of_a = dot(a_, d_), of_b = dot(b_, d_);
    const L across = larger(L(1.0) - along * along, L(0x1p-40));
    L s = clamped((of_a - along * of_b) / across, pair_.half_a);
    const L t = clamped(along * s - of_b, pair_.half_b);
    s = clamped(along * t + of_a, pair_.half_a);
    return (d_ + t * b_) - s * a_;
  }

  const CylinderPair& pair_;
  const Vec &a_, &b_, &d_;
  L slack_;
};

class Placing {
 public:
  Placing(const PlaceQuery& query, PlacedPairs& out) : query_(query), out_(out) {}

  void run() {
    out_.n_overlapping = 0;
    for (std::size_t k = 0; k < query_.n; k += W) Bits::numbers_from(k).store(out_.row + k);
    set_open(query_.n);
    if (query_.cylinders != nullptr) part_by_cylinders();
    out_.n_after_cylinders = out_.n_open;
    const bool is_central = query_.centre_b.x == 0.0 && query_.centre_b.y == 0.0 && query_.centre_b.z == 0.0;
    if (query_.quick == nullptr) {
      turn(nullptr, false);
      return;
    }
    const QuickVerdict quick = *query_.quick;
    if (is_central) part_by_place(quick);
    turn(&quick, is_central);
  }

 private:
  // Of the open pairs k ... k + W - 1: the places of their bodies, and the number of the shift.
  struct Places {
    Bits a, b, shift;
  };
  Places places(std::size_t k) const {
    if (out_.n_open == query_.n && k + W <= query_.n) {
      return {Bits::load(query_.a + k), Bits::load(query_.b + k), Bits::load(query_.shift + k)};
    }
    const Bits row = Bits::load(out_.row + k);
    return {gather(query_.a, row), gather(query_.b, row), gather(query_.shift, row)};
  }
  Vec shift(const Places& at) const {
    L fourth;
    return RowOfEach<W>(query_.shifts, at.shift).read(0, &fourth);
  }
  // (t_b - t_a) + shift.
  Vec between(const Transform<L>& a, const Vec& b, const Places& at) const { return (b - a.translation) + shift(at); }
  Vec translation_of(const Bits& places) const {
    const RowOfEach<W> rows(query_.poses, places + (places << 1));
    Vec t;
    rows.read(0, &t.x);
    rows.read(1, &t.y);
    rows.read(2, &t.z);
    return t;
  }

  // Behind the open rows stand some that are read and not meant.
  void set_open(std::size_t n) {
    out_.n_open = n;
    Bits(0).store(out_.row + n);
  }
  // Keeps those that are on of the packet at k, behind the `n` that are kept already.
  std::size_t keep(const Mask& on, std::size_t k, std::size_t n) {
    const Compaction<W> kept(on);
    kept.store(out_.row + n, Bits::load(out_.row + k));
    return n + static_cast<std::size_t>(kept.n());
  }
  void add_overlapping(const Mask& on, std::size_t k) {
    const Compaction<W> kept(on);
    kept.store(out_.overlapping + out_.n_overlapping, Bits::load(out_.row + k));
    out_.n_overlapping += static_cast<std::size_t>(kept.n());
  }

  void part_by_cylinders() {
    const CylinderPair cylinders = *query_.cylinders;
    const std::size_t n = out_.n_open;
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Places at = places(k);
      const Transform<L> a = pose_of(query_.poses, at.a), b = pose_of(query_.poses, at.b);
      const Vec d = between(a, b.translation, at) + (times(b, query_.centre_b) - times(a, query_.centre_a));
      const Vec axis_a = column(a, cylinders.axis_a), axis_b = column(b, cylinders.axis_b);
      const Mask apart = Cylinders(cylinders, axis_a, axis_b, d).are_apart();
      n_kept = keep(but_not(Mask::first(n - k), apart), k, n_kept);
    }
    set_open(n_kept);
  }

  // What b's place alone settles, before the rotations are multiplied.
  void part_by_place(const QuickVerdict& quick) {
    const std::size_t n = out_.n_open;
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Places at = places(k);
      const Transform<L> a = pose_of(query_.poses, at.a);
      const Vec t = turned_back(a, between(a, translation_of(at.b), at));
      const QuickVerdict::Answer<L> answer = quick.at(t);
      const Mask trials = Mask::first(n - k);
      add_overlapping(but_not(both(trials, answer.overlap), answer.disjoint), k);
      n_kept = keep(but_not(trials, either(answer.disjoint, answer.overlap)), k, n_kept);
    }
    set_open(n_kept);
  }

  void turn(const QuickVerdict* quick, bool is_placed) {
    const std::size_t n = out_.n_open;
    std::size_t n_kept = 0;
    for (std::size_t k = 0; k < n; k += W) {
      const Places at = places(k);
      const Transform<L> a = pose_of(query_.poses, at.a), b = pose_of(query_.poses, at.b);
      Transform<L> pose;
      pose.row_x = row_product(a.row_x.x, a.row_y.x, a.row_z.x, b);
      pose.row_y = row_product(a.row_x.y, a.row_y.y, a.row_z.y, b);
      pose.row_z = row_product(a.row_x.z, a.row_y.z, a.row_z.z, b);
      pose.translation = turned_back(a, between(a, b.translation, at));
      Mask open = Mask::first(n - k);
      if (quick != nullptr && (!is_placed || quick->turned_pays())) {
        const QuickVerdict::Answer<L> answer =
            is_placed ? quick->turned(pose) : (*quick)(pose, pose(broadcast<L>(query_.centre_b)));
        add_overlapping(but_not(both(open, answer.overlap), answer.disjoint), k);
        open = but_not(open, either(answer.disjoint, answer.overlap));
      }
      const Compaction<W> kept(open);
      std::size_t column = 0;
      for (const Vec* part : {&pose.row_x, &pose.row_y, &pose.row_z, &pose.translation}) {
        kept.store(out_.poses[column++] + n_kept, part->x);
        kept.store(out_.poses[column++] + n_kept, part->y);
        kept.store(out_.poses[column++] + n_kept, part->z);
      }
      n_kept = keep(open, k, n_kept);
    }
    set_open(n_kept);
  }

  const PlaceQuery& query_;
  PlacedPairs& out_;
};

}  // namespace

namespace {

// `meet` of a vector from centre to centre and of the sum of the radii.
template <class Meet>
void find_near_where(const NearQuery& query, NearPairs& out, const Meet& meet) {
  std::size_t n = out.n;
  std::uint64_t n_seen = 0;
  for (std::uint64_t i = query.first; i < query.end; ++i) {
    const Vec centre{L(query.x[i]), L(query.y[i]), L(query.z[i])};
    const L radius(query.radius[i]);
    for (std::size_t r = 0; r < query.n_ranges; ++r) {
      const NearRange range = query.ranges[r];
      const std::uint64_t first = range.is_own ? i + 1 : range.first;
      if (first >= range.end) continue;
      n_seen += range.end - first;
      const Vec from = centre - broadcast<L>(range.by);
      const Bits shift(range.shift);
      for (std::uint64_t j = first; j < range.end; j += W) {
        const Vec d = Vec{L::load(query.x + j), L::load(query.y + j), L::load(query.z + j)} - from;
        const Compaction<W> kept(both(Mask::first(range.end - j), meet(d, radius + L::load(query.radius + j))));
        kept.store(out.places + n, (Bits::numbers_from(j) << 32) | Bits(i));
        shift.store(out.shift + n);
        n += static_cast<std::size_t>(kept.n());
      }
    }
  }
  out.n = n;
  out.n_seen += n_seen;
}

}  // namespace

__attribute__((flatten)) void find_near(const NearQuery& asked, NearPairs& out) {
  const NearQuery query = asked;  // what is stored may be what it points to: it would be read again each time
  if (query.extents == nullptr) {
    find_near_where(query, out, [](const Vec& d, const L& reach) { return dot(d, d) <= reach * reach; });
    return;
  }
  const Vec extents = broadcast<L>(*query.extents);
  find_near_where(query, out, [&extents](const Vec& d, const L& more) {
    return both(both(absolute(d.x) <= extents.x + more, absolute(d.y) <= extents.y + more),
                absolute(d.z) <= extents.z + more);
  });
}

namespace {

typedef double FourDoubles __attribute__((vector_size(32)));
typedef float FourFloats __attribute__((vector_size(16)));
#if defined(__AVX2__)
typedef float Floats __attribute__((vector_size(32)));
typedef std::int32_t FloatMask __attribute__((vector_size(32)));
unsigned bits_of(const FloatMask& mask) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}
#else
typedef FourFloats Floats;
typedef std::int32_t FloatMask __attribute__((vector_size(16)));
unsigned bits_of(const FloatMask& mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  const FloatMask bits = mask & FloatMask{1, 2, 4, 8};
  return static_cast<unsigned>((bits[0] | bits[1]) | (bits[2] | bits[3]));
#endif
}
#endif
constexpr std::size_t kFloats = sizeof(Floats) / sizeof(float);
static_assert(BallBlock::kLanes == 8 && BallBlock::kLanes % kFloats == 0 && sizeof(BallBlock) == 192);

Floats floats_at(const float* from) {
  Floats values;
  __builtin_memcpy(&values, from, sizeof values);
  return values;
}
Floats all_of(float x) { return x - Floats{}; }
Floats length_of(const Floats& x) { return x < 0.0f ? -x : x; }

// Bit k: whether the ball in lane k may meet the one that is asked about; `meet` of the vector from centre to centre
// and of the sum of the radii.
template <class Meet>
unsigned meeting_lanes(const BallBlock& balls, const FourFloats& from, float radius, const Meet& meet) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < BallBlock::kLanes; k += kFloats) {
    const FloatMask meets = meet(floats_at(balls.x + k) - all_of(from[0]), floats_at(balls.y + k) - all_of(from[1]),
                                 floats_at(balls.z + k) - all_of(from[2]), floats_at(balls.radius + k) + radius);
    bits |= bits_of(meets) << k;
  }
  return bits;
}

template <class Meet>
void find_in_blocks_where(const BallQuery& query, NearPairs& out, const Meet& meet) {
  const FourDoubles centre = {query.centre.x, query.centre.y, query.centre.z, 0.0};
  constexpr std::size_t kAtOnce = 64 / BallBlock::kLanes;
  std::size_t n = out.n;
  for (std::size_t first = 0; first < query.n; first += kAtOnce) {
    const std::size_t n_here = query.n - first < kAtOnce ? query.n - first : kAtOnce;
    std::uint64_t bits = 0;
    for (std::size_t b = 0; b < n_here; ++b) {
      const BallBlockAt at = query.at[first + b];
      const BallBlock& balls = query.blocks[at.block];
      FourDoubles shift, origin;
      __builtin_memcpy(&shift, query.shifts + 4 * std::size_t{at.shift}, sizeof shift);
      __builtin_memcpy(&origin, balls.origin, sizeof origin);
      const FourDoubles from = ((centre - shift) - origin) * query.units;
      bits |= std::uint64_t{meeting_lanes(balls, __builtin_convertvector(from, FourFloats), query.radius, meet)}
              << (b * BallBlock::kLanes);
    }
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t bit = static_cast<std::size_t>(__builtin_ctzll(bits));
      const BallBlockAt at = query.at[first + bit / BallBlock::kLanes];
      const std::uint64_t body = query.blocks[at.block].body[bit % BallBlock::kLanes];
      out.places[n] = (body << 32) | query.place;
      out.shift[n++] = at.shift;
    }
  }
  out.n = n;
}

}  // namespace

__attribute__((flatten)) void find_in_blocks(const BallQuery& asked, NearPairs& out) {
  const BallQuery query = asked;  // as in find_near
  if (query.extents == nullptr) {
    find_in_blocks_where(query, out, [](const Floats& x, const Floats& y, const Floats& z, const Floats& reach) {
      return (x * x + y * y) + z * z <= reach * reach;
    });
    return;
  }
  const Floats e_x = all_of(query.extents[0]), e_y = all_of(query.extents[1]), e_z = all_of(query.extents[2]);
  find_in_blocks_where(query, out, [&](const Floats& x, const Floats& y, const Floats& z, const Floats& more) {
    return (length_of(x) <= e_x + more) & (length_of(y) <= e_y + more) & (length_of(z) <= e_z + more);
  });
}

__attribute__((flatten)) void place_pairs(const PlaceQuery& query, PlacedPairs& out) { Placing(query, out).run(); }

}  // namespace VEX_ISA
}  // namespace vex
