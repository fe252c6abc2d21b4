// A small engine on vex's scenes: rigid bodies that fall, touch, stack and roll. It shows what an engine takes from
// vex, and tests that this is enough: manifolds with features that persist, in memory that is kept, and times of
// impact.
//
// A step: velocities by gravity; the scene's manifolds; sequential impulses on the contacts, begun with those of the
// step before that the same features made (E. Catto, Iterative dynamics with temporal coherence, GDC 2005); poses by
// the new velocities (semi-implicit Euler), of fast bodies no farther than to the time of impact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/query/first_contact.h"
#include "engine/scene/scene.h"

namespace vex {

struct SmallEngineSettings {
  Vec3d gravity{0.0, 0.0, -9.81};
  double time_step = 1.0 / 60.0;
  int n_iterations = 10;
  double friction = 0.5;
  double restitution = 0.0;  // of what comes nearer by more than 1 length a unit of time
  /// Contacts are solved from this gap on: what closes it within a step is slowed down to close it just so.
  double margin = 0.02;
  /// Bodies rest at this gap; and overlaps of less than `slop` more are left as they are, of more are parted by a fifth
  /// a step (J. Baumgarte, 1972).
  double skin = 0.0, slop = 1e-3;
  bool warm_starts = true;
  bool finds_impacts = true;  // of fast bodies
};

class SmallEngine {
 public:
  using Settings = SmallEngineSettings;
  struct Body {
    double inverse_mass = 0.0;
    Vec3d inverse_inertia{};  // about the axes of the body's frame, whose origin is the centre of mass
    Vec3d position{};
    std::array<double, 4> turn{1.0, 0.0, 0.0, 0.0};  // w, x, y, z: world from body
    Vec3d velocity{}, angular_velocity{};
    bool is_fast = false;
  };
  /// What a step saw.
  struct Counts {
    std::size_t n_contacts = 0;
    std::size_t n_kept = 0;  // of these the features made a contact in the step before, too
    std::size_t n_impacts = 0;
    double deepest = 0.0;  // signed distance
  };

  explicit SmallEngine(const Settings& settings = {}) : settings_(settings) {}

  /// Inertia: the principal moments.
  BodyId add(const ConvexBody& shape, double mass, const Vec3d& inertia, const Vec3d& position);
  BodyId add_still(const ConvexBody& shape, const Pose& pose);
  Body& body(BodyId id) { return bodies_[id]; }
  std::size_t size() const { return bodies_.size(); }
  Pose pose(BodyId id) const;
  Scene& scene() { return scene_; }

  Counts step();

 private:
  struct Constraint {
    BodyId a, b;
    FeatureId feature_a, feature_b;
    Vec3d normal{}, arm_a{}, arm_b{};
    std::array<Vec3d, 2> across{};
    double mass = 0.0, target = 0.0;  // along the normal; the velocity there is to be the target at least
    std::array<double, 2> mass_across{};
    double impulse = 0.0;  // so far
    std::array<double, 2> impulse_across{};

    Vec3d whole_impulse() const {
      return impulse * normal + impulse_across[0] * across[0] + impulse_across[1] * across[1];
    }
    auto key() const { return std::array<std::uint64_t, 4>{a, b, feature_a, feature_b}; }
  };

  Vec3d inverse_inertia_times(BodyId id, const Vec3d& v) const;
  double inverse_mass_along(BodyId id, const Vec3d& arm, const Vec3d& dir) const;
  Vec3d velocity_of(BodyId id, const Vec3d& arm) const;
  void push(BodyId id, const Vec3d& arm, const Vec3d& impulse);
  void find_constraints(Counts& counts);
  void warm_start(Counts& counts);
  void solve();
  double time_free(BodyId id, Counts& counts) const;
  void move(BodyId id, double time);

  Settings settings_;
  Scene scene_;
  std::vector<Body> bodies_;
  std::vector<Transformd> world_from_body_;  // of this step
  std::vector<Pose> poses_;
  SceneManifolds manifolds_;
  std::vector<Constraint> constraints_, last_;  // sorted by key
};

}  // namespace vex
