// What scenes answer with: pairs of bodies, what each stage of the search saw and settled.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/query/contact_manifold.h"
#include "engine/query/first_contact.h"
#include "engine/query/separation.h"
#include "engine/scene/periodic_box.h"

namespace vex {

/// Numbers of bodies and of shapes, given by a scene from 0 on.
using BodyId = std::uint32_t;
using ShapeId = std::uint32_t;
inline constexpr BodyId kNoBody = ~BodyId{0};

/// Body a and the copy of body b that `image` lattice vectors away from where b is. a < b; or a = b, a body that is
/// longer than the box and its own copy, the first component of whose image that is not 0 is positive. In open space
/// images are 0.
struct ScenePair {
  BodyId a = kNoBody, b = kNoBody;
  ImageOffset image{};

  friend auto operator<=>(const ScenePair&, const ScenePair&) = default;
};

/// The stages in the order in which a pair comes to them, until one settles it. A pair comes to those alone that say
/// something of its two shapes.
enum class SceneStage : std::uint8_t {
  unmoved,    // what was proven of the pair still holds: the bodies cannot have used up the clearance that it showed
  balls,      // circumscribed balls apart
  joined,     // only clusters are asked for, and the bodies are in one already, with the same offset; looked at once
              // more where the bounds settle nothing
  cylinders,  // circumscribed cylinders of needles and plates apart
  bounds,     // a body's own box or ellipsoid against the other's balls, circumscribed and inscribed
  packets,    // the search in double precision, several pairs at a time
  scalar,     // the same, one pair at a time
  double_double,  // curved bodies, in twice the precision
  exact,          // polytopes, spheres and capsules, in whole numbers
};
inline constexpr int kNSceneStages = 9;
std::string_view name_of(SceneStage stage);

/// How many pairs came to each stage, and how many it settled.
struct SceneCounts {
  struct Stage {
    std::uint64_t seen = 0, settled = 0;
  };
  std::array<Stage, kNSceneStages> stages{};

  Stage& operator[](SceneStage stage) { return stages[static_cast<std::size_t>(stage)]; }
  const Stage& operator[](SceneStage stage) const { return stages[static_cast<std::size_t>(stage)]; }
  SceneCounts& operator+=(const SceneCounts& other);
};

/// A caller's own test of two shapes, b's at this pose in a's frame. Calls of the scene that asks it, other than those
/// that tell of its bodies, throw UsageError.
using PairJudge = std::function<Outcome(ShapeId a, ShapeId b, const Transformd& a_from_b)>;

/// A caller's buffer: it is overwritten by each query that takes it, and keeps its memory. Sorted by a, b, image, but
/// for Scene::overlaps_of_added.
struct ScenePairs {
  std::vector<ScenePair> pairs;      // proven to overlap, or to be within the distance
  std::vector<ScenePair> undecided;  // neither is proven: curved bodies that touch to within rounding, or bodies within
                                     // a last place of the distance
  SceneCounts counts;
};

/// Pairs within a distance, with it.
struct SceneDistances {
  struct Entry {
    ScenePair pair;
    Separation separation;  // in the frame of body a: Scene::relative_pose tells b's pose there
  };
  std::vector<Entry> entries;        // sorted; of pairs that overlap signed_distance is 0
  std::vector<ScenePair> undecided;  // whether they are within the distance
  SceneCounts counts;
};

/// The touching pairs with their contacts. A caller's buffer: of pairs that come and go it keeps the memory of their
/// contacts.
struct SceneManifolds {
  struct Entry {
    ScenePair pair;
    ContactManifold manifold;  // in the frame of body a
  };
  std::vector<Entry> entries;
  std::vector<ScenePair> undecided;
  SceneCounts counts;

  /// So many entries; those that are too many are put by for when there are more again.
  void resize(std::size_t n);

 private:
  std::vector<Entry> spare_;
};

/// Whether any two bodies overlap.
struct SceneAnswer {
  Outcome outcome = Outcome::disjoint;  // undecided: no pair is proven to overlap, and not all are proven apart
  ScenePair pair;                       // one that overlaps, or is undecided; which one may depend on the threads
  /// How many pairs are undecided, the same for any number of threads; nothing where the search ended at an overlap.
  std::optional<std::uint64_t> n_undecided;
  SceneCounts counts;
};

/// The first body that a ray or a moving body meets.
struct SceneHit {
  BodyId body = kNoBody;  // none: nothing is met
  ImageOffset image{};
  FirstContact contact;              // normal and points in the scene's frame; disjoint where nothing is met
  std::vector<ScenePair> undecided;  // bodies (as b) of which it is not proven that they are not met before; sorted
};

/// The nearest neighbour.
struct SceneNeighbour {
  BodyId body = kNoBody;  // none: there is no other body
  ImageOffset image{};
  Separation separation;  // from the asking body's frame; 0 where they overlap. No other body has a lower `upper`
};

}  // namespace vex
