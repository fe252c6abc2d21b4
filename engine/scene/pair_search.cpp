#include "engine/scene/pair_search.h"

#include <algorithm>
#include <bit>

#include "engine/query/overlap.h"

namespace vex {
namespace {

// Bodies of a scene are turned as exactly as Scene::kRotationTolerance asks, and two of them together as a pose is.
constexpr double kRelativeRotationError = Pose::kRotationTolerance;
// So many pairs of two shapes at once pay for what is made of the two shapes.
constexpr std::size_t kWorthAKind = 16, kFewShapes = 8;
// So many pairs of several kinds wait before they are sorted.
constexpr std::size_t kWaitingOfKinds = 8192;

// More are forgotten, and made again where they are needed.
constexpr std::size_t kMostKinds = 4096;
constexpr std::uint32_t kNoChain = ~std::uint32_t{0};

std::uint64_t key_of(ShapeId a, ShapeId b) { return (std::uint64_t{a} << 32) | b; }

// They are read some thousand instructions later.
void prefetch_pose(const double* poses, std::uint64_t place) {
  const double* const pose = poses + kNumbersABody * place;
  __builtin_prefetch(pose);
  __builtin_prefetch(pose + kNumbersABody - 1);
}

}  // namespace

PairSearch::Kind::Kind(const PairQuestion& question, ShapeId shape_a, ShapeId shape_b)
    : pair(question.bodies->shapes()[shape_a], question.bodies->shapes()[shape_b], question.margin),
      quick(pair.narrow().a, pair.narrow().b, kRelativeRotationError),
      packets(make_packet_overlap(packet_kernel(question.set), pair.narrow().a, pair.narrow().b)),
      cylinders(cylinder_pair(question.bodies->bounds(shape_a), question.bodies->bounds(shape_b), question.margin)) {}

void PairSearch::begin(const PairQuestion& question, PairKeeper* keeper) {
  if (question.set != question_.set || question.margin != question_.margin) kinds_.clear();
  question_ = question;
  keeper_ = keeper;
  joined = nullptr;
  judge = nullptr;
  near.n = 0;
  near.n_seen = 0;
  // Nothing that a query which ended by an exception has left is true.
  waiting_.n = 0;
  entries_.clear();
  if (kinds_.size() > kMostKinds) kinds_.clear();
  pairs.clear();
  undecided.clear();
  counts = {};
  if (!placed_) placed_ = std::make_unique<PlacedPairs>();
  answers_.resize(kBatch);
  if (keeper_ != nullptr && !clearances_) clearances_ = std::make_unique<PacketClearances>();
}

// The pair is written where it stays: made elsewhere, it would be copied before its parts have arrived there.
void PairSearch::add_pair(LargeVector<ScenePair>& list, const Pairs& asked, std::size_t row) const {
  ScenePair& pair = list.emplace_back();
  pair.a = body_at(asked.a[row]);
  pair.b = body_at(asked.b[row]);
  pair.image = question_.shifts->image(asked.shift[row]);
}

// The body with the lower number comes first; of a body and its own copy the image is positive.
void PairSearch::orient() {
  counts[SceneStage::balls].seen += near.n_seen;
  counts[SceneStage::balls].settled += near.n_seen - near.n;
  const ShiftTable& shifts = *question_.shifts;
  waiting_.make_room(near.n);
  std::size_t n = waiting_.n;
  // What is stored may be what these belong to: they would be read again each time.
  std::uint64_t *const to_a = waiting_.a.data(), *const to_b = waiting_.b.data(),
                       *const to_shift = waiting_.shift.data();
  const std::size_t n_near = near.n;
  for (std::size_t k = 0; k < n_near; ++k) {
    std::uint64_t a = near.places[k] & 0xffffffffu, b = near.places[k] >> 32, shift = near.shift[k];
    const BodyId id_a = body_at(a), id_b = body_at(b);
    const std::uint64_t where_swapped = shifts.is_reversed(id_a, id_b, shift) ? ~std::uint64_t{0} : 0,
                        both = (a ^ b) & where_swapped;
    a ^= both;
    b ^= both;
    shift ^= (shift ^ shifts.opposite(shift)) & where_swapped;
    if (joined != nullptr) {
      ++counts[SceneStage::joined].seen;
      if (is_joined({std::min(id_a, id_b), std::max(id_a, id_b), shifts.image(shift)})) continue;
    }
    prefetch_pose(question_.poses, a);
    prefetch_pose(question_.poses, b);
    to_a[n] = a;
    to_b[n] = b;
    to_shift[n++] = shift;
  }
  waiting_.n = n;
  near.n = 0;
  near.n_seen = 0;
}

void PairSearch::take() {
  orient();
  settle_waiting();
}

void PairSearch::ask(std::uint64_t place_a, std::uint64_t place_b, std::uint64_t shift, std::uint64_t tag) {
  prefetch_pose(question_.poses, place_a);
  prefetch_pose(question_.poses, place_b);
  waiting_.add(place_a, place_b, shift, tag);
  if (waiting_.n % kBatch == 0) settle_waiting();
}

void PairSearch::settle_judged() {
  const Pairs asked = waiting_.from(0, waiting_.n);
  for (std::size_t row = 0; row < asked.n; ++row) {
    if (joined != nullptr && is_joined(pair_of(asked, row))) continue;
    const Transformd pose =
        relative_pose(SceneBodies::pose_at(question_.poses, asked.a[row]),
                      SceneBodies::pose_at(question_.poses, asked.b[row]), question_.shifts->shift(asked.shift[row]));
    SceneCounts::Stage& stage = counts[SceneStage::scalar];
    ++stage.seen;
    const Outcome outcome = (*judge)(question_.shape[asked.a[row]], question_.shape[asked.b[row]], pose);
    if (outcome != Outcome::undecided) ++stage.settled;
    if (outcome == Outcome::overlap) add_overlap(asked, row);
    if (outcome == Outcome::undecided) add_pair(undecided, asked, row);
  }
  waiting_.n = 0;
}

void PairSearch::add_overlap(const Pairs& asked, std::size_t row) {
  add_pair(pairs, asked, row);
  if (joined == nullptr) return;
  const ScenePair& pair = pairs.back();
  if (joined->join(pair.a, pair.b, pair.image) == Clusters::Joined::closed) pairs.pop_back();
}

bool PairSearch::is_joined(const ScenePair& pair) {
  if (!joined->knows(pair.a, pair.b, pair.image)) return false;
  ++counts[SceneStage::joined].settled;
  return true;
}

// Of the pairs that the bounds left open: those that have proven others to overlap may have joined them.
void PairSearch::leave_out_joined(const Pairs& asked) {
  PlacedPairs& placed = *placed_;
  std::size_t n = 0;
  for (std::size_t k = 0; k < placed.n_open; ++k) {
    if (is_joined(pair_of(asked, placed.row[k]))) continue;
    placed.row[n] = placed.row[k];
    for (auto& column : placed.poses) column[n] = column[k];
    ++n;
  }
  placed.n_open = n;
}

void PairSearch::settle_waiting() {
  if (judge != nullptr) return settle_judged();
  const bool is_one_kind = question_.bodies->shapes().size() == 1;
  if (is_one_kind) {
    settle_all(kBatch);
  } else if (waiting_.n >= kWaitingOfKinds) {
    settle_by_kinds();
  }
}

void PairSearch::finish() {
  orient();
  if (judge != nullptr) {
    settle_judged();
  } else if (question_.bodies->shapes().size() == 1) {
    settle_all(1);
  } else {
    settle_by_kinds();
  }
}

// All but fewer than so many.
void PairSearch::settle_all(std::size_t keep_below) {
  std::size_t first = 0;
  while (waiting_.n - first >= keep_below) {
    const Pairs batch = waiting_.from(first, std::min(kBatch, waiting_.n - first));
    Kind* const kind = kind_of(key_of(0, 0), batch.n);
    for (std::size_t k = 0; kind == nullptr && k < batch.n; ++k) settle_one(batch, k);
    if (kind != nullptr) settle_batch(*kind, batch);
    first += batch.n;
    if (first == waiting_.n) break;
  }
  waiting_.leave_out_first(first);
}

// The number of the kind's chain, a new one where it has none. Entries are at most half full; the first that is free or
// the kind's own counts, from where the key falls.
std::size_t PairSearch::chain_of(std::uint64_t key) {
  const std::size_t mask = entries_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & mask;
  while (entries_[at] != kNoChain && chains_[entries_[at]].key != key) at = (at + 1) & mask;
  if (entries_[at] == kNoChain) {
    entries_[at] = static_cast<std::uint32_t>(chains_.size());
    chains_.push_back({key, kNoChain, 0, static_cast<std::uint32_t>(at)});
  }
  return entries_[at];
}

void PairSearch::settle_by_kinds() {
  if (entries_.size() < 2 * waiting_.n) entries_.assign(std::bit_ceil(2 * waiting_.n), kNoChain);
  chains_.clear();
  next_.resize(waiting_.n);
  for (std::size_t k = waiting_.n; k-- > 0;) {
    Chain& chain = chains_[chain_of(key_of(question_.shape[waiting_.a[k]], question_.shape[waiting_.b[k]]))];
    next_[k] = chain.head;
    chain.head = static_cast<std::uint32_t>(k);
    ++chain.length;
  }
  for (const Chain& chain : chains_) {
    entries_[chain.entry] = kNoChain;
    Kind* const kind = kind_of(chain.key, chain.length);
    batch_.n = 0;
    for (std::uint32_t k = chain.head; k != kNoChain; k = next_[k]) {
      if (kind == nullptr) {
        settle_one(waiting_.from(0, waiting_.n), k);
        continue;
      }
      batch_.add(waiting_.a[k], waiting_.b[k], waiting_.shift[k], waiting_.tag[k]);
      if (batch_.n == kBatch || next_[k] == kNoChain) {
        settle_batch(*kind, batch_.from(0, batch_.n));
        batch_.n = 0;
      }
    }
  }
  waiting_.n = 0;
}

// None where too few pairs of it are waiting to pay for it. Answers do not depend on that, where both shapes have exact
// forms: what bounds and packets prove, `overlap` proves too. Of other shapes bounds may prove more.
PairSearch::Kind* PairSearch::kind_of(std::uint64_t key, std::size_t n_waiting) {
  const auto at = kinds_.find(key);
  if (at != kinds_.end()) return at->second.get();
  const ShapeId a = static_cast<ShapeId>(key >> 32), b = static_cast<ShapeId>(key & 0xffffffffu);
  const SceneBodies& bodies = *question_.bodies;
  const bool are_exact = bodies.bounds(a).has_exact_form && bodies.bounds(b).has_exact_form;
  if (are_exact && n_waiting < kWorthAKind && bodies.shapes().size() > kFewShapes) return nullptr;
  return kinds_.emplace(key, std::make_unique<Kind>(question_, a, b)).first->second.get();
}

void PairSearch::settle_batch(Kind& kind, const Pairs& asked) {
  PlacedPairs& placed = *placed_;
  const std::size_t n = asked.n;
  const bool has_cylinders = kind.cylinders.says_anything();
  // Bounds tell no clearance, and packets do: of pairs that are remembered these are asked.
  const bool asks_bounds = keeper_ == nullptr || !kind.packets;
  question_.kernel.place(
      {question_.poses, question_.shifts->rows(), asked.a, asked.b, asked.shift, n, kind.pair.narrow().a.centre(),
       kind.pair.narrow().b.centre(), has_cylinders ? &kind.cylinders : nullptr, asks_bounds ? &kind.quick : nullptr},
      placed);
  if (has_cylinders) {
    counts[SceneStage::cylinders].seen += n;
    counts[SceneStage::cylinders].settled += n - placed.n_after_cylinders;
  }
  if (asks_bounds) {
    counts[SceneStage::bounds].seen += placed.n_after_cylinders;
    counts[SceneStage::bounds].settled += placed.n_after_cylinders - placed.n_open;
  }
  if (keeper_ != nullptr && placed.n_open < n) {
    // What is not open, and does not overlap (below), is apart.
    for (std::size_t row = 0; row < n; ++row) keeper_->keep_as_it_stands(asked.tag[row], Outcome::disjoint);
  }
  for (std::size_t k = 0; k < placed.n_overlapping; ++k) {
    const std::uint64_t row = placed.overlapping[k];
    add_overlap(asked, row);
    if (keeper_ != nullptr) keeper_->keep_as_it_stands(asked.tag[row], Outcome::overlap);
  }
  if (joined != nullptr) leave_out_joined(asked);
  const PoseTable poses{placed.poses[0], PlacedPairs::kStride, placed.n_open};
  if (kind.packets) {
    kind.packets->decide(poses, answers_.data(), keeper_ != nullptr ? clearances_.get() : nullptr);
    counts[SceneStage::packets].seen += placed.n_open;
  }
  for (std::size_t k = 0; k < placed.n_open; ++k) {
    const std::uint64_t row = placed.row[k];
    const PacketAnswer found = kind.packets ? answers_[k] : PacketAnswer::open;
    if (found == PacketAnswer::open) {
      answer(within_margin(kind.pair, Pose::unchecked(poses.pose(k))), asked, row);
      continue;
    }
    ++counts[SceneStage::packets].settled;
    if (found == PacketAnswer::overlap) add_overlap(asked, row);
    if (keeper_ != nullptr) keep_clearance(asked, row, k);
  }
}

// Of the k-th answer of the packets.
void PairSearch::keep_clearance(const Pairs& asked, std::size_t row, std::size_t k) {
  const double clearance = clearances_->length[k];
  if (!(clearance > 0.0)) {
    const bool overlaps = answers_[k] == PacketAnswer::overlap;
    keeper_->keep_as_it_stands(asked.tag[row], overlaps ? Outcome::overlap : Outcome::disjoint);
    return;
  }
  const Transformd a = SceneBodies::pose_at(question_.poses, asked.a[row]);
  const auto in_scene = [&](const Vec3d& v) -> Vec3d { return {dot(a.row_x, v), dot(a.row_y, v), dot(a.row_z, v)}; };
  const Vec3d in_a{clearances_->where[0][k], clearances_->where[1][k], clearances_->where[2][k]};
  const Vec3d where = in_scene(in_a);
  if (answers_[k] == PacketAnswer::overlap) {
    const auto corner = [&](std::size_t c) {
      return in_scene({clearances_->corners[c][k], clearances_->corners[c + 1][k], clearances_->corners[c + 2][k]});
    };
    keeper_->keep_overlap(asked.tag[row], where, {corner(0), corner(3), corner(6)}, clearance);
  } else {
    keeper_->keep_apart(asked.tag[row], (1.0 / norm(in_a)) * where, clearance);
  }
}

void PairSearch::settle_one(const Pairs& asked, std::size_t row) {
  const Transformd pose =
      relative_pose(SceneBodies::pose_at(question_.poses, asked.a[row]),
                    SceneBodies::pose_at(question_.poses, asked.b[row]), question_.shifts->shift(asked.shift[row]));
  const std::vector<ConvexBody>& shapes = question_.bodies->shapes();
  const MarginPairs pair(shapes[question_.shape[asked.a[row]]], shapes[question_.shape[asked.b[row]]],
                         question_.margin);
  answer(within_margin(pair, Pose::unchecked(pose)), asked, row);
}

void PairSearch::answer(const Verdict& verdict, const Pairs& asked, std::size_t row) {
  ++counts[SceneStage::scalar].seen;
  const SceneStage later = verdict.by == DecidedBy::exact ? SceneStage::exact : SceneStage::double_double;
  const bool is_decided = verdict.outcome != Outcome::undecided;
  if (is_decided && verdict.by == DecidedBy::gjk) {
    ++counts[SceneStage::scalar].settled;
  } else {
    ++counts[later].seen;
    if (is_decided) ++counts[later].settled;
  }
  if (verdict.outcome == Outcome::overlap) add_overlap(asked, row);
  if (verdict.outcome == Outcome::undecided) add_pair(undecided, asked, row);
  if (keeper_ != nullptr) keeper_->keep_as_it_stands(asked.tag[row], verdict.outcome);
}

}  // namespace vex
