// What is known of the pairs of a scene from one step to the next: for bodies that move little (internal).
//
// After L. Verlet's neighbour lists (Phys. Rev. 159, 98, 1967): the pairs whose balls are nearer than a skin are listed
// once, and as long as no body is farther than half of it from where it was no other pair can meet. Of each listed pair
// it is kept what was last proven, a plane between the bodies or a ball in their Minkowski difference, and whether the
// bodies can have used up the clearance that it showed (E26): a pair is asked again only then. A pair is not even
// looked at before any two bodies can have used up so much: of each step only what the body that moved most has moved
// is needed for that.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/scene/broad_phases.h"
#include "engine/scene/known_hull.h"
#include "engine/scene/large_vector.h"
#include "engine/scene/pair_search.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/shift_table.h"

namespace vex {

class PairMemory final : public PairKeeper {
 public:
  /// Lists the pairs that the broad phase, made for the skin, finds, and has the bodies tracked from now on. What is
  /// known of a pair that was listed before is kept.
  void build(SceneBodies& bodies, const BroadPhases& phases, const SceneKernel& kernel, double skin, int n_threads);
  void forget() { is_there_ = false; }
  /// Whether the list is of this skin and no body is too far from where it was. To be asked before each look at all
  /// pairs.
  bool holds(SceneBodies& bodies, double skin);

  const ShiftTable& shifts() const { return shifts_; }
  std::size_t n_blocks() const { return (list_.pairs.size() + kBlock - 1) / kBlock; }
  /// The pairs of a block: those of which nothing is known any more, and balls tell nothing, are asked, by numbers of
  /// bodies, with this for a keeper.
  void look(std::size_t block, PairSearch& search);
  /// What overlaps, once all that was asked is settled; sorted.
  void collect(int n_threads, std::vector<ScenePair>& out);

  void keep_as_it_stands(std::uint64_t tag, Outcome outcome) override;
  void keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) override;
  void keep_overlap(std::uint64_t tag, const Vec3d& point, const std::array<Vec3d, 3>& corners,
                    double clearance) override;

 private:
  static constexpr std::size_t kBlock = 4096;
  static constexpr double kNever = -HUGE_VAL;  // of `until`: the pair has to be looked at
  // Of lengths, as kStretch of scene_bodies.cpp: what rotations that are ones to within 2e-7 change, twice over.
  static constexpr double kLess = 1.0 - 0x1p-18;
  // Of the skin and the largest radius, by the clock: a list ends then, so that sums of turns stay small (E26).
  static constexpr double kMostTravel = 16.0;
  // What is left of a pair's clearance is `limit` less what both have turned, and less how far the way from a to b has
  // come towards what bounds it.
  struct alignas(32) Known {
    enum class Kind : std::uint32_t {
      nothing,
      half_space,      // the plane between the bodies: the way along its axis, which leads from b to a
      hull,            // of what is known of the difference, about the ball: the most of the way along its normals
      hull_and_facet,  // and a triangle in the difference, for another tip
      ball,            // the way's distance from `hull.axis`
      balls_apart,     // the other way round: what the way is longer than `limit`, however the bodies have turned
      at_rest,         // none is known: the pair is as it is while neither has moved, by their travels
    };
    Kind kind = Kind::nothing;
    KnownHull hull;  // or travels, bit for bit
    double limit = 0.0;

    static Known at_rest(const std::array<double, 2>& travels) {
      Known known{Kind::at_rest, {}, travels[0]};
      std::memcpy(known.hull.axis.data(), &travels[1], sizeof(double));
      return known;
    }
    Kind without_facet() const {
      static_assert(static_cast<int>(Kind::hull_and_facet) == static_cast<int>(Kind::hull) + 1);
      return static_cast<Kind>(static_cast<std::uint32_t>(kind) - (kind == Kind::hull_and_facet ? 1u : 0u));
    }
    // Of one at rest.
    bool has_travels(const std::array<double, 2>& travels) const {
      return limit == travels[0] && std::memcmp(hull.axis.data(), &travels[1], sizeof(double)) == 0;
    }
  };
  static_assert(sizeof(Known) == 32);
  struct Listed {
    BodyId a, b;
    std::uint32_t shift;  // of b's copy when the list was made
    // Among the pairs of a.
    std::uint64_t key() const { return (std::uint64_t{b} << 32) | shift; }
    friend bool operator==(const Listed&, const Listed&) = default;
    friend bool operator<(const Listed& p, const Listed& q) {
      return (p.a < q.a) | ((p.a == q.a) & (p.key() < q.key()));
    }
  };
  // Of each pair, in their order, by the bodies' numbers and the shift's: what is known of it, until when it need not
  // be looked at, by the clock, and whether it overlaps.
  struct List {
    std::vector<std::uint32_t> starts;  // of each body, the first pair that it is the first of; and their end
    LargeVector<Listed> pairs;
    LargeVector<Known> known;
    LargeVector<double> until;
    LargeVector<std::uint8_t> overlaps;
    void make_room(std::size_t n);
  };
  void find_pairs_within_skin(const BroadPhases& phases, const SceneKernel& kernel, int n_threads);
  void list(int n_threads);
  void list_of(std::size_t first_body, std::size_t end_body);
  void carry_over(std::size_t from, std::size_t to);
  Known known_by_balls(const Listed& pair) const;
  // The numbers, counted from `first`, of those of which something is true; how many. Whether it is true is as good as
  // random: each number is written in any case.
  template <class IsTrue>
  static std::size_t numbers_of(std::size_t first, std::size_t end, std::uint32_t* numbers, const IsTrue& is_true) {
    std::size_t n = 0;
    for (std::size_t k = first; k < end; ++k) {
      numbers[n] = static_cast<std::uint32_t>(k - first);
      n += is_true(k) ? 1u : 0u;
    }
    return n;
  }
  // From a's centre to that of b's copy.
  Vec3d way(const Listed& pair) const;
  double turned(const Listed& pair) const;
  std::array<double, 2> travels(const Listed& pair) const;
  ImageOffset image(const Listed& pair) const;
  // Of the clearance: above 0 while what is known holds.
  double left(const Known& known, const Listed& pair, const Vec3d& way) const;
  double clock_when(double left) const;
  bool keep_what_balls_tell(std::uint64_t tag, const Vec3d& way);
  void keep(std::uint64_t tag, bool overlaps, double left);
  bool keep_if_it_has(std::uint64_t tag, Known::Kind kind, const KnownHull& hull, double limit, const Vec3d& way,
                      double least);
  bool keep_around_core(std::uint64_t tag, const Vec3d& way, const Vec3d& tip, double least);
  void keep_ball(std::uint64_t tag, const Vec3d& way, double radius);
  double core_of(const Listed& pair) const;
  bool renew_hull(std::size_t k, const Vec3d& way);
  void look_closer(std::size_t k, const Vec3d& way, PairSearch& search);

  bool is_there_ = false;
  double skin_ = 0.0;
  bool is_by_boxes_ = false;  // the list is
  double rounding_ = 0.0;     // a clearance below this is as good as none (E26)
  const SceneBodies* bodies_ = nullptr;
  ShiftTable shifts_;
  // No two bodies together have moved by more than what this has grown by, since the list was made (E26).
  double clock_ = 0.0, holds_until_ = 0.0;
  List list_;
  LargeVector<KnownFacet> facet_;  // no list takes it over from the one before: to ask again costs no more
  // Memory that is kept: for the list before this one, the broad phase's shifts by their numbers here, what its parts
  // find, and the keys of that, by first bodies.
  List before_;
  std::vector<std::uint32_t> number_;
  std::vector<std::vector<Listed>> found_;
  LargeVector<std::uint64_t> keys_;
  std::vector<std::size_t> n_overlaps_;  // of each block; then those before it
};

inline Vec3d PairMemory::way(const Listed& pair) const {
  return bodies_->tracked(pair.b).centre - bodies_->tracked(pair.a).centre + shifts_.shift(pair.shift);
}
inline double PairMemory::turned(const Listed& pair) const {
  return bodies_->tracked(pair.a).turned + bodies_->tracked(pair.b).turned;
}
inline std::array<double, 2> PairMemory::travels(const Listed& pair) const {
  return {bodies_->travel(pair.a), bodies_->travel(pair.b)};
}
inline ImageOffset PairMemory::image(const Listed& pair) const {
  const ImageOffset& then = shifts_.image(pair.shift);
  if (!(bodies_->has_crossed(pair.a) | bodies_->has_crossed(pair.b))) return then;
  return image_sum(then, image_difference(bodies_->crossed(pair.b), bodies_->crossed(pair.a)));
}

}  // namespace vex
