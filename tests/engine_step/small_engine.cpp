#include "tests/engine_step/small_engine.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/directions.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

// R v; direction_to_b is its inverse.
Vec3d turned(const Transformd& pose, const Vec3d& v) {
  return {dot(pose.row_x, v), dot(pose.row_y, v), dot(pose.row_z, v)};
}

}  // namespace

BodyId SmallEngine::add(const ConvexBody& shape, double mass, const Vec3d& inertia, const Vec3d& position) {
  const BodyId id = scene_.add(shape, Transformd{.translation = position});
  bodies_.push_back({.inverse_mass = 1.0 / mass,
                     .inverse_inertia = {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z},
                     .position = position});
  world_from_body_.emplace_back();
  poses_.push_back(pose(id));
  return id;
}

BodyId SmallEngine::add_still(const ConvexBody& shape, const Pose& pose) {
  const BodyId id = scene_.add(shape, pose);
  bodies_.push_back({.position = pose.a_from_b().translation});
  world_from_body_.push_back(pose.a_from_b());
  poses_.push_back(pose);
  return id;
}

Pose SmallEngine::pose(BodyId id) const {
  const Body& body = bodies_[id];
  if (body.inverse_mass == 0.0) return poses_[id];
  Transformd pose = rotation_from_quaternion(body.turn[0], body.turn[1], body.turn[2], body.turn[3]);
  pose.translation = body.position;
  return pose;
}

Vec3d SmallEngine::inverse_inertia_times(BodyId id, const Vec3d& v) const {
  const Transformd& pose = world_from_body_[id];
  const Vec3d own = pose.direction_to_b(v), &inverse = bodies_[id].inverse_inertia;
  return turned(pose, {inverse.x * own.x, inverse.y * own.y, inverse.z * own.z});
}

// How much faster a point goes along a unit direction for an impulse of 1 on it.
double SmallEngine::inverse_mass_along(BodyId id, const Vec3d& arm, const Vec3d& dir) const {
  return bodies_[id].inverse_mass + dot(dir, cross(inverse_inertia_times(id, cross(arm, dir)), arm));
}

Vec3d SmallEngine::velocity_of(BodyId id, const Vec3d& arm) const {
  return bodies_[id].velocity + cross(bodies_[id].angular_velocity, arm);
}

void SmallEngine::push(BodyId id, const Vec3d& arm, const Vec3d& impulse) {
  Body& body = bodies_[id];
  if (body.inverse_mass == 0.0) return;
  body.velocity = body.velocity + body.inverse_mass * impulse;
  body.angular_velocity = body.angular_velocity + inverse_inertia_times(id, cross(arm, impulse));
}

void SmallEngine::find_constraints(Counts& counts) {
  scene_.contact_manifolds(manifolds_, {.margin = settings_.margin, .four_at_most = true});
  std::swap(last_, constraints_);
  constraints_.clear();
  const double h = settings_.time_step;
  for (const SceneManifolds::Entry& entry : manifolds_.entries) {
    const BodyId a = entry.pair.a, b = entry.pair.b;
    if (bodies_[a].inverse_mass == 0.0 && bodies_[b].inverse_mass == 0.0) continue;
    const Transformd& pose = world_from_body_[a];
    const Vec3d normal = turned(pose, entry.manifold.separation.normal);
    const Vec3d beside = cross(least_axis(normal), normal), across = (1.0 / norm(beside)) * beside;
    for (const ContactManifold::Contact& contact : entry.manifold.contacts) {
      Constraint one{.a = a, .b = b, .feature_a = contact.feature_a, .feature_b = contact.feature_b};
      one.normal = normal;
      one.across = {across, cross(normal, across)};
      one.arm_a = pose(contact.point_a) - bodies_[a].position;
      one.arm_b = pose(contact.point_b) - bodies_[b].position;
      const auto mass_along = [&](const Vec3d& dir) {
        return 1.0 / (inverse_mass_along(a, one.arm_a, dir) + inverse_mass_along(b, one.arm_b, dir));
      };
      one.mass = mass_along(normal);
      for (std::size_t k = 0; k < 2; ++k) one.mass_across[k] = mass_along(one.across[k]);
      const double gap = contact.signed_distance - settings_.skin;
      one.target = gap > 0.0 ? -gap / h : 0.2 / h * std::max(0.0, -gap - settings_.slop);
      const double closing = -dot(normal, velocity_of(b, one.arm_b) - velocity_of(a, one.arm_a));
      if (settings_.restitution > 0.0 && closing > 1.0 && closing * h > gap) {
        one.target = std::max(one.target, settings_.restitution * closing);
      }
      constraints_.push_back(one);
      counts.deepest = std::min(counts.deepest, contact.signed_distance);
    }
  }
  std::ranges::sort(constraints_, {}, &Constraint::key);
  counts.n_contacts = constraints_.size();
}

// What the same features did in the step before is about what they will do in this one.
void SmallEngine::warm_start(Counts& counts) {
  auto last = last_.begin();
  for (Constraint& one : constraints_) {
    while (last != last_.end() && last->key() < one.key()) ++last;
    if (last == last_.end() || last->key() != one.key()) continue;
    ++counts.n_kept;
    if (!settings_.warm_starts) continue;
    const Vec3d impulse = last->whole_impulse();
    one.impulse = last->impulse;
    for (std::size_t k = 0; k < 2; ++k) one.impulse_across[k] = dot(one.across[k], impulse);
    push(one.a, one.arm_a, -one.whole_impulse());
    push(one.b, one.arm_b, one.whole_impulse());
  }
}

void SmallEngine::solve() {
  for (int iteration = 0; iteration < settings_.n_iterations; ++iteration) {
    for (Constraint& one : constraints_) {
      const auto apply = [&](const Vec3d& impulse) {
        push(one.a, one.arm_a, -impulse);
        push(one.b, one.arm_b, impulse);
      };
      const auto velocity = [&] { return velocity_of(one.b, one.arm_b) - velocity_of(one.a, one.arm_a); };
      for (std::size_t k = 0; k < 2; ++k) {
        const double most = settings_.friction * one.impulse, before = one.impulse_across[k];
        one.impulse_across[k] = std::clamp(before - one.mass_across[k] * dot(one.across[k], velocity()), -most, most);
        apply((one.impulse_across[k] - before) * one.across[k]);
      }
      const double before = one.impulse;
      one.impulse = std::max(0.0, before + one.mass * (one.target - dot(one.normal, velocity())));
      apply((one.impulse - before) * one.normal);
    }
  }
}

// Until when in this step a fast body meets none of the still ones; it stops short of the first by the skin.
double SmallEngine::time_free(BodyId id, Counts& counts) const {
  const Body& body = bodies_[id];
  const double h = settings_.time_step;
  double first = h;
  bool is_hit = false;
  for (BodyId other = 0; other < bodies_.size(); ++other) {
    if (bodies_[other].inverse_mass != 0.0) continue;
    const Transformd& pose = world_from_body_[other];
    const RigidMotion motion{pose.direction_to_b(body.velocity), pose.direction_to_b(body.angular_velocity)};
    const FirstContact contact = time_of_impact(scene_.shape(scene_.shape_of(other)), scene_.shape(scene_.shape_of(id)),
                                                Pose::unchecked(scene_.relative_pose({other, id})), motion, first);
    // What is undecided is met, perhaps, but not before `lower`.
    if (contact.verdict.outcome == Outcome::disjoint) continue;
    is_hit = true;
    first = std::min(first, contact.lower);
  }
  if (!is_hit) return h;
  ++counts.n_impacts;
  const double reach = scene_.shape(scene_.shape_of(id)).reach();
  const double speed = norm(body.velocity) + norm(body.angular_velocity) * reach;
  return std::max(0.0, first - settings_.skin / speed);
}

void SmallEngine::move(BodyId id, double time) {
  Body& body = bodies_[id];
  body.position = body.position + time * body.velocity;
  const double angle = time * norm(body.angular_velocity);
  if (!(angle > 0.0)) return;
  const Vec3d v = (std::sin(0.5 * angle) / norm(body.angular_velocity)) * body.angular_velocity;
  const auto [w, x, y, z] = body.turn;
  const Vec3d u{x, y, z};
  const double c = std::cos(0.5 * angle);
  const Vec3d part = c * u + w * v + cross(v, u);
  body.turn = {c * w - dot(v, u), part.x, part.y, part.z};
  const double length = std::hypot(std::hypot(body.turn[0], body.turn[1]), std::hypot(body.turn[2], body.turn[3]));
  for (double& component : body.turn) component /= length;
}

SmallEngine::Counts SmallEngine::step() {
  Counts counts;
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    if (bodies_[id].inverse_mass > 0.0) {
      bodies_[id].velocity = bodies_[id].velocity + settings_.time_step * settings_.gravity;
    }
    poses_[id] = pose(id);
    world_from_body_[id] = poses_[id].a_from_b();
  }
  scene_.move_all(poses_);
  find_constraints(counts);
  warm_start(counts);
  solve();
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    const Body& body = bodies_[id];
    if (body.inverse_mass == 0.0) continue;
    move(id, body.is_fast && settings_.finds_impacts ? time_free(id, counts) : settings_.time_step);
  }
  return counts;
}

}  // namespace vex
