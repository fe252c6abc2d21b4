// From pairs whose balls may meet to verdicts: the stages of a scene's query, one thread's (internal).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "engine/numeric/pose_algebra.h"
#include "engine/query/margin.h"
#include "engine/scene/clusters.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/shift_table.h"

namespace vex {

/// What the threads of a query share. Places are of the table of poses.
struct PairQuestion {
  const SceneBodies* bodies;
  const double* poses;   // rows of four doubles, kRowsABody a place
  const BodyId* id;      // of each place, or null where places are numbers of bodies, but for the visitor's
  const ShapeId* shape;  // of each place
  const ShiftTable* shifts;
  SceneKernel kernel;
  InstructionSet set;
  double margin = 0.0;                        // pairs are asked whether they are this near
  std::uint64_t visitor = ~std::uint64_t{0};  // the place of a body's trial pose,
  BodyId visitor_id = kNoBody;                // and the body
};

/// What is told of pairs that are asked by a tag, beside their verdicts.
class PairKeeper {
 public:
  virtual ~PairKeeper() = default;
  /// The pair as it stands is apart, overlaps, or is undecided: nothing more is known.
  virtual void keep_as_it_stands(std::uint64_t tag, Outcome outcome) = 0;
  /// Along this unit vector, which leads from a to b in the scene's frame, the bodies are at least so far apart.
  virtual void keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) = 0;
  /// Their Minkowski difference, a's points less b's, has a ball of this radius about the origin, and these points, in
  /// the scene's frame: one beyond the origin, and the corners of a triangle there.
  virtual void keep_overlap(std::uint64_t tag, const Vec3d& point, const std::array<Vec3d, 3>& corners,
                            double clearance) = 0;
};

/// Keeps what it makes of kinds of pairs from one query to the next, for one margin.
class PairSearch {
 public:
  /// Where to send pairs that the broad phase finds; `take` empties it.
  NearPairs near;

  /// Where there is a keeper all pairs come by `ask`.
  void begin(const PairQuestion& question, PairKeeper* keeper = nullptr);
  /// Settles what can be settled of the near pairs in whole batches.
  void take();
  /// A pair in the order of its numbers whose balls may meet.
  void ask(std::uint64_t place_a, std::uint64_t place_b, std::uint64_t shift, std::uint64_t tag);
  /// Settles all.
  void finish();

  /// Of those proven and those undecided; a caller may empty them between. Where `joined` is, of those proven the ones
  /// that changed it.
  LargeVector<ScenePair> pairs, undecided;
  SceneCounts counts;
  /// Not null: pairs that are proven to overlap are joined here, and what is in one cluster already is not tested. To
  /// be set after `begin`.
  Clusters* joined = nullptr;
  /// Not null: what it says of a pair is the verdict. To be set after `begin`.
  const PairJudge* judge = nullptr;

 private:
  static constexpr std::size_t kBatch = PacketOverlap::kMostTrials;

  // Pairs in the order of their numbers, in columns.
  struct Pairs {
    const std::uint64_t *a, *b, *shift, *tag;
    std::size_t n;
  };
  // Columns grow and are not made smaller: what is behind the n pairs is room.
  struct Oriented {
    std::vector<std::uint64_t> a, b, shift, tag;  // tags only with a keeper
    std::size_t n = 0;
    std::array<std::vector<std::uint64_t>*, 4> columns() { return {&a, &b, &shift, &tag}; }
    void make_room(std::size_t more) {
      if (n + more <= tag.size()) return;  // the last one: where memory gives out the first ones may be longer
      for (std::vector<std::uint64_t>* column : columns()) column->resize(2 * (n + more));
    }
    void add(std::uint64_t place_a, std::uint64_t place_b, std::uint64_t number, std::uint64_t its_tag) {
      make_room(1);
      a[n] = place_a;
      b[n] = place_b;
      shift[n] = number;
      tag[n++] = its_tag;
    }
    void leave_out_first(std::size_t n_first) {
      for (std::vector<std::uint64_t>* column : columns()) {
        std::copy(column->data() + n_first, column->data() + n, column->data());
      }
      n -= n_first;
    }
    Pairs from(std::size_t first, std::size_t n_pairs) const {
      return {a.data() + first, b.data() + first, shift.data() + first, tag.data() + first, n_pairs};
    }
  };
  // Two shapes, in the order of the bodies.
  struct Kind {
    Kind(const PairQuestion& question, ShapeId a, ShapeId b);
    // Bounds and packets are asked of the narrow ones: what they prove is true of the margin itself (E26).
    MarginPairs pair;
    QuickVerdict quick;
    std::unique_ptr<PacketOverlap> packets;  // or none
    CylinderPair cylinders;
  };

  void orient();
  void settle_waiting();
  void settle_judged();
  void settle_all(std::size_t keep_below);
  void settle_by_kinds();
  void settle_batch(Kind& kind, const Pairs& asked);
  void settle_one(const Pairs& asked, std::size_t row);
  void add_overlap(const Pairs& asked, std::size_t row);
  bool is_joined(const ScenePair& pair);
  void leave_out_joined(const Pairs& asked);
  void answer(const Verdict& verdict, const Pairs& asked, std::size_t row);
  void keep_clearance(const Pairs& asked, std::size_t row, std::size_t k);
  Kind* kind_of(std::uint64_t key, std::size_t n_waiting);
  BodyId body_at(std::uint64_t place) const {
    if (question_.id != nullptr) return question_.id[place];
    return place == question_.visitor ? question_.visitor_id : static_cast<BodyId>(place);
  }
  ScenePair pair_of(const Pairs& asked, std::size_t row) const {
    return {body_at(asked.a[row]), body_at(asked.b[row]), question_.shifts->image(asked.shift[row])};
  }
  void add_pair(LargeVector<ScenePair>& list, const Pairs& asked, std::size_t row) const;

  PairQuestion question_;
  PairKeeper* keeper_ = nullptr;
  Oriented waiting_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Kind>> kinds_;
  std::unique_ptr<PlacedPairs> placed_;
  std::vector<PacketAnswer> answers_;
  std::unique_ptr<PacketClearances> clearances_;  // with a keeper
  // Of settle_by_kinds: chains of waiting pairs of one kind, and a table that tells a kind's chain.
  struct Chain {
    std::uint64_t key;
    std::uint32_t head, length, entry;
  };
  std::size_t chain_of(std::uint64_t key);
  std::vector<Chain> chains_;
  std::vector<std::uint32_t> entries_, next_;
  Oriented batch_;
};

}  // namespace vex
