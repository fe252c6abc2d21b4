// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: a pose is the
// same bits everywhere.
#include "engine/numeric/packet_memory.h"
#include "engine/sampling/points/philox_packets.h"
#include "engine/sampling/poses/fitted_kernel.h"
#include "engine/sampling/poses/pose_columns.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {
namespace VEX_ISA {
namespace {

constexpr int W = kRegisterLanes;
using L = Packet<W>;

// Work on some hundred trials goes step by step, not trial by trial, and in a step several registers at a time: what is
// one chain of operations, a series or a root, then stands beside others like it, and a processor sees no farther.
class Drawing {
 public:
  Drawing(const PoseRecipe& recipe, std::uint64_t first, PoseColumns& columns)
      : recipe_(recipe), first_(first), columns_(columns), keys_(recipe.seed) {}

  void draw(std::size_t n) {
    columns_.n_disjoint = columns_.n_overlap = 0;
    columns_.n_open = n;
    if (recipe_.fitted != nullptr) {
      draw_fitted();
      return;
    }
    draw_coordinates(0, nullptr);
    draw_coordinates(1, nullptr);
    if (recipe_.domain->kind == Domain::Kind::ball) {
      sines_and_cosines(1, 0);
      cube_roots(2);
    }
    place();
    const int dimension = recipe_.law->dimension();
    for (int block = 2; 2 * block < 3 + dimension; ++block) draw_coordinates(block, columns_.row);
    draw_angles();
    turn();
  }

 private:
  static constexpr std::size_t kChain = 4 * kRegisterLanes;
  using Chain = Packet<kChain>;

  // Coordinates 2 block and 2 block + 1 of the open trials: of these rows, or of all.
  void draw_coordinates(int block, const std::uint64_t* rows) {
    double* const even = columns_.coordinates[2 * block];
    double* const odd = columns_.coordinates[2 * block + 1];
    const std::size_t n = columns_.n_open;
    if (recipe_.points != nullptr) {
      const double* const from = recipe_.points + static_cast<std::size_t>(2 * block) * PoseColumns::kStride;
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t row = rows != nullptr ? rows[k] : k;
        even[k] = from[row];
        odd[k] = from[PoseColumns::kStride + row];
      }
      return;
    }
    for (std::size_t k = 0; k < n; k += kPhiloxAtOnce * kRegisterLanes) {
      std::array<PacketBits<W>, kPhiloxAtOnce> index;
      for (std::size_t j = 0; j < kPhiloxAtOnce; ++j) {
        const std::size_t at = k + j * kRegisterLanes;
        index[j] = rows != nullptr ? PacketBits<W>::load(rows + at) + PacketBits<W>(first_)
                                   : PacketBits<W>::numbers_from(first_ + at);
      }
      draw_two_coordinates(keys_, Stream::pose, static_cast<std::uint32_t>(block), index, even + k, odd + k);
    }
  }

  // Where a trial is put depends on how it is turned.
  void draw_fitted() {
    const std::size_t n = columns_.n_open;
    for (int block = 0; 2 * block < 3 + recipe_.law->dimension(); ++block) draw_coordinates(block, nullptr);
    draw_angles();
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> turned = rotation(k);
      store(0, k, turned.row_x);
      store(3, k, turned.row_y);
      store(6, k, turned.row_z);
      PacketBits<W>::numbers_from(k).store(columns_.row + k);
    }
    Fitting fitting(*recipe_.fitted, columns_);
    for (std::size_t k = 0; k < n; k += PoseColumns::kMostFitted) {
      fitting.fit(k, n - k < PoseColumns::kMostFitted ? n - k : PoseColumns::kMostFitted);
    }
    const L largest(recipe_.domain->volume);
    for (std::size_t k = 0; k < n; k += W) {
      (L::load(columns_.share + k) / largest).store(columns_.share + k);
    }
    if (recipe_.quick == nullptr) return;
    const QuickVerdict quick = *recipe_.quick;
    Counts counts;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> pose = pose_at(k);
      const L share = L::load(columns_.share + k);
      const QuickVerdict::Answer<L> answer = quick(pose, pose(broadcast<L>(recipe_.centre_b)));
      const PacketMask<W> trials = PacketMask<W>::first(n - k);
      Compaction<W>(counts.apart(answer, trials)).store(columns_.share_disjoint + counts.n_disjoint, share);
      Compaction<W>(counts.meet(answer, trials)).store(columns_.share_overlap + counts.n_overlap, share);
      const Compaction<W> open(counts.left(answer, trials));
      open.store(columns_.share + counts.n_open, share);
      move_up(open, counts, k, pose);
    }
    take_home(counts);
  }

  void draw_angles() {
    if (recipe_.law->kind() != OrientationLaw::Kind::isotropic) return;
    sines_and_cosines(4, 0);
    sines_and_cosines(5, 1);
  }

  // Of the angle that is this coordinate, in turns.
  void sines_and_cosines(int coordinate, int angle) {
    const double* const from = columns_.coordinates[coordinate];
    double* const sines = columns_.sine[angle];
    double* const cosines = columns_.cosine[angle];
    for (std::size_t k = 0; k < columns_.n_open; k += kChain) {
      const Chain v = Chain::load(from + k);
      const SinCos<Chain> of = sincospi(v + v);
      of.sin.store(sines + k);
      of.cos.store(cosines + k);
    }
  }
  SinCos<L> angle(int number, std::size_t k) const {
    return {L::load(columns_.sine[number] + k), L::load(columns_.cosine[number] + k)};
  }
  void cube_roots(int coordinate) {
    double* const column = columns_.coordinates[coordinate];
    for (std::size_t k = 0; k < columns_.n_open; k += kChain) cube_root(Chain::load(column + k)).store(column + k);
  }

  L coordinate(int number, std::size_t k) const { return L::load(columns_.coordinates[number] + k); }

  Vec3<L> position(const Domain& domain, std::size_t k) const {
    const L u = coordinate(0, k), w = coordinate(2, k);
    if (domain.kind == Domain::Kind::ball) return position_in_ball(domain, in_unit_ball(u, angle(0, k), w));
    return position_in_box(domain, u, coordinate(1, k), w);
  }

  // The positions of all trials; those that are decided by them go.
  void place() {
    const std::size_t n = columns_.n_open;
    const Domain domain = *recipe_.domain;
    for (std::size_t k = 0; k < n; k += W) {
      store(9, k, position(domain, k));
      PacketBits<W>::numbers_from(k).store(columns_.row + k);
    }
    if (recipe_.quick == nullptr) return;
    const QuickVerdict quick = *recipe_.quick;
    Counts counts;
    for (std::size_t k = 0; k < n; k += W) {
      const Vec3<L> at = load(9, k);
      const L odd = coordinate(3, k);
      const Compaction<W> open(counts.left(quick.at(at), PacketMask<W>::first(n - k)));
      open.store(columns_.poses[9] + counts.n_open, at.x);
      open.store(columns_.poses[10] + counts.n_open, at.y);
      open.store(columns_.poses[11] + counts.n_open, at.z);
      open.store(columns_.coordinates[3] + counts.n_open, odd);
      open.store(columns_.row + counts.n_open, PacketBits<W>::numbers_from(k));
      counts.n_open += static_cast<std::size_t>(open.n());
    }
    take_home(counts);
  }
  Vec3<L> load(std::size_t column, std::size_t k) const {
    return {L::load(columns_.poses[column] + k), L::load(columns_.poses[column + 1] + k),
            L::load(columns_.poses[column + 2] + k)};
  }
  void store(std::size_t column, std::size_t k, const Vec3<L>& v) {
    v.x.store(columns_.poses[column] + k);
    v.y.store(columns_.poses[column + 1] + k);
    v.z.store(columns_.poses[column + 2] + k);
  }

  Transform<L> rotation(std::size_t k) const {
    if (recipe_.law->kind() == OrientationLaw::Kind::isotropic) {
      return uniform_rotation(coordinate(3, k), angle(0, k), angle(1, k));
    }
    std::array<L, OrientationLaw::kMaxDimension> point;
    for (int c = 0; c < recipe_.law->dimension(); ++c) point[static_cast<std::size_t>(c)] = coordinate(3 + c, k);
    return recipe_.law->rotation(std::span<const L>(point));
  }

  // The rotations of the open trials; those that are decided by them go.
  void turn() {
    const std::size_t n = columns_.n_open;
    const bool is_central = recipe_.centre_b.x == 0.0 && recipe_.centre_b.y == 0.0 && recipe_.centre_b.z == 0.0;
    for (std::size_t k = 0; k < n; k += W) {
      Transform<L> pose = rotation(k);
      // Of a centre at the origin nothing is taken off the position.
      if (!is_central) {
        pose = placed(pose, load(9, k), recipe_.centre_b);
        store(9, k, pose.translation);
      }
      store(0, k, pose.row_x);
      store(3, k, pose.row_y);
      store(6, k, pose.row_z);
    }
    if (recipe_.quick == nullptr || !recipe_.quick->turned_pays()) return;
    const QuickVerdict quick = *recipe_.quick;
    Counts counts;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> pose = pose_at(k);
      move_up(Compaction<W>(counts.left(quick.turned(pose), PacketMask<W>::first(n - k))), counts, k, pose);
    }
    take_home(counts);
  }

  // A loop's own: members would be read again after each store.
  struct Counts {
    std::size_t n_disjoint = 0, n_overlap = 0, n_open = 0;

    // Of these trials those that the answer leaves open.
    PacketMask<W> left(const QuickVerdict::Answer<L>& answer, const PacketMask<W>& trials) {
      n_disjoint += static_cast<std::size_t>(__builtin_popcount(lanes_on(apart(answer, trials))));
      n_overlap += static_cast<std::size_t>(__builtin_popcount(lanes_on(meet(answer, trials))));
      return but_not(trials, either(answer.disjoint, answer.overlap));
    }
    static PacketMask<W> apart(const QuickVerdict::Answer<L>& answer, const PacketMask<W>& trials) {
      return both(trials, answer.disjoint);
    }
    static PacketMask<W> meet(const QuickVerdict::Answer<L>& answer, const PacketMask<W>& trials) {
      return but_not(both(trials, answer.overlap), answer.disjoint);
    }
  };
  Transform<L> pose_at(std::size_t k) const { return {load(0, k), load(3, k), load(6, k), load(9, k)}; }
  // The trials of `open` behind those that are open already: from k on they have been read.
  void move_up(const Compaction<W>& open, Counts& counts, std::size_t k, const Transform<L>& pose) {
    const PacketBits<W> row = PacketBits<W>::load(columns_.row + k);
    std::size_t column = 0;
    for (const Vec3<L>* part : {&pose.row_x, &pose.row_y, &pose.row_z, &pose.translation}) {
      open.store(columns_.poses[column++] + counts.n_open, part->x);
      open.store(columns_.poses[column++] + counts.n_open, part->y);
      open.store(columns_.poses[column++] + counts.n_open, part->z);
    }
    open.store(columns_.row + counts.n_open, row);
    counts.n_open += static_cast<std::size_t>(open.n());
  }
  void take_home(const Counts& counts) {
    columns_.n_open = counts.n_open;
    columns_.n_disjoint += counts.n_disjoint;
    columns_.n_overlap += counts.n_overlap;
  }

  const PoseRecipe& recipe_;
  std::uint64_t first_;
  PoseColumns& columns_;
  PhiloxKeys keys_;
};

}  // namespace

__attribute__((flatten)) void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n,
                                         PoseColumns& columns) {
  Drawing(recipe, first, columns).draw(n);
}

}  // namespace VEX_ISA
}  // namespace vex
