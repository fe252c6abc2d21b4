// Many bodies in one frame, in open space or in a periodic box, and what pairs of them are asked.
//
// A query takes the pairs that may be near each other from a broad phase (a grid of cells, or a tree of boxes), and
// sends them through stages that cost more and more, each of which settles what it can prove: circumscribed balls,
// cylinders of needles and plates, bodies' own boxes and ellipsoids, packets, twice the precision, whole numbers.
// Nothing is computed that was not asked for, and every stage counts what it saw and settled.
//
// The verdict of a pair is that of `overlap` for the pose `relative_pose` of b in a's frame: the two poses in the scene
// are combined in double precision once, in a fixed order, and of the result the answer is proven. Of a user's own body
// without an exact form a scene may prove more than `overlap`, which then says undecided. Every answer is the
// same for any number of threads, any broad phase and any instruction set (but for SceneAnswer::pair).
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/numeric/instruction_set.h"
#include "engine/scene/aabb.h"
#include "engine/scene/clusters.h"
#include "engine/scene/scene_pair.h"
#include "engine/support/convex_body.h"

namespace vex {

enum class BroadPhase : std::uint8_t {
  automatic,  // by the work that each is expected to be, from sizes and density
  grid,       // cells as large as the largest circumscribed ball: bodies of like size
  tree,       // of axis-aligned boxes: unlike sizes, needles, open space with far bodies
};

struct SceneSettings {
  BroadPhase broad_phase = BroadPhase::automatic;
  int n_threads = 1;
  InstructionSet instruction_set = best_instruction_set();
  /// For scenes that move in small steps: a length, above 0, makes `overlapping_pairs` remember the pairs whose balls
  /// are nearer than this, until a body's centre is half of it from where it was (docs/scenes.md has the details), and
  /// what was proven of each, as long as it holds.
  double skin = 0.0;
};

/// Not to be used by several threads at once; it starts `n_threads` of its own.
class Scene {
 public:
  /// Rotations are as poses' (Pose), but to within this: the product of two of them is a pose then.
  static constexpr double kRotationTolerance = 2e-7;
  /// No body may reach over more than so many copies of the box.
  static constexpr int kMostImages = 16;

  /// Open space. Throws UsageError where settings make no sense.
  explicit Scene(const SceneSettings& settings = {});
  /// A body outside of the box is moved into it when it is placed, by whole lattice vectors: `pose` tells where it is.
  explicit Scene(const PeriodicBox& box, const SceneSettings& settings = {});
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  void set(const SceneSettings& settings);
  const SceneSettings& settings() const;
  const std::optional<PeriodicBox>& box() const;

  /// A shape that bodies share; a copy of the same body is the same shape.
  ShapeId add_shape(const ConvexBody& body);
  std::size_t n_shapes() const;
  const ConvexBody& shape(ShapeId shape) const;

  /// The body takes the lowest number that no body has. Throws InputError where the pose is none for a scene, or the
  /// body reaches over more than kMostImages copies of the box. `moved`: by which image it was moved into the box
  /// before, as a body of a scene that was stored: `image` tells of both.
  BodyId add(ShapeId shape, const Pose& world_from_body, const ImageOffset& moved = {});
  BodyId add(const ConvexBody& body, const Pose& world_from_body);
  /// One body at each pose, in their order: as fast as they can come. Where one is refused none is added.
  void add(ShapeId shape, std::span<const Pose> world_from_body);
  void remove(BodyId body);
  /// Removes all bodies; shapes stay, and memory is kept for the next ones.
  void clear();
  /// In a periodic box: about so many bodies will come, one after another, of the shapes that there are. It changes
  /// nothing but the time of queries of one body and of added ones.
  void expect(std::size_t n_bodies);
  void move(BodyId body, const Pose& world_from_body);
  /// Of all bodies, poses[k] of body k; throws UsageError where bodies are missing between.
  void move_all(std::span<const Pose> world_from_body);

  std::size_t size() const;     // how many bodies
  BodyId end() const;           // one more than the largest number of a body
  bool has(BodyId body) const;  // whether there is one of this number
  ShapeId shape_of(BodyId body) const;
  /// Where it is; and by how many lattice vectors it was moved into the box.
  Transformd pose(BodyId body) const;
  ImageOffset image(BodyId body) const;

  /// Of b's copy in a's frame: `vex::relative_pose` of both poses and the copy's shift. Verdicts, distances and
  /// contacts of the pair are about this pose.
  Transformd relative_pose(const ScenePair& pair) const;

  /// The pairs that share a point.
  void overlapping_pairs(ScenePairs& out);
  /// The pairs whose distance is at most this: proven, but no distance is computed.
  void pairs_within(double distance, ScenePairs& out);
  /// The same, with the distance of each.
  void distances_within(double distance, SceneDistances& out);
  /// Whether any pair overlaps; ends at the first.
  SceneAnswer any_overlap();
  /// What is within `margin` of each other, with contacts; poses and points in the frame of body a.
  void contact_manifolds(SceneManifolds& out, double margin = 0.0);
  void contact_manifolds(SceneManifolds& out, const ManifoldSettings& settings);

  /// The pairs of one body: it is `a` or `b`, as in overlapping_pairs.
  void overlaps_of(BodyId body, ScenePairs& out);
  /// What bodies that were added one after another met: the pairs of each body from `first` on with those before it,
  /// and with its own copies, in the order of these bodies: by b, a, image. One thread does it. `joined`, where there
  /// is one, knows all bodies and what those before `first` are joined by; it is told of each pair, does not have those
  /// tested that it joins already, with this image, and the results are the pairs that changed it, in the order in
  /// which they did. `judge`, where there is one, decides all pairs whose circumscribed balls may meet instead of the
  /// engine; they count as `scalar`.
  void overlaps_of_added(BodyId first, ScenePairs& out, Clusters* joined = nullptr, const PairJudge* judge = nullptr);
  /// The bodies that a visitor overlaps, which are `b`; `a` is kNoBody.
  void overlaps_of(const ConvexBody& visitor, const Pose& world_from_body, ScenePairs& out);
  /// Whether this body would overlap any other one if it were at that pose: a trial move. Nothing is moved.
  Outcome would_overlap(BodyId body, const Pose& world_from_body);
  /// The body nearest to one, or to a visitor; copies of itself are neighbours, too.
  SceneNeighbour nearest(BodyId body);
  SceneNeighbour nearest(const ConvexBody& visitor, const Pose& world_from_body);

  /// The first body on a ray, or that a moving visitor meets: the one that is proven to be met soonest; `undecided`
  /// lists what may be met before it. In a periodic box `until` must be finite, and the time grows linearly with the
  /// boxes that the way passes.
  SceneHit cast_ray(const Vec3d& origin, const Vec3d& dir, double until = HUGE_VAL);
  SceneHit linear_cast(const ConvexBody& visitor, const Pose& world_from_body, const Vec3d& motion,
                       double until = HUGE_VAL);

  /// Clusters of bodies that overlap, or are within a distance (as hard cores with a soft shell), and which of them
  /// wrap around the box. Pairs that are in one cluster already are not tested. Numbers below `end` that no body has
  /// are left out: their label is kNoCluster.
  void clusters(Clusters& out, double distance = 0.0);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vex
