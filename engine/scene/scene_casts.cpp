// Queries of what is not one of the scene's bodies: visitors, rays, moving visitors; and nearest neighbours. They go
// through the tree of the bodies' boxes.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/numeric/number_text.h"
#include "engine/query/overlap.h"
#include "engine/scene/scene_impl.h"

namespace vex {
namespace {

// A ray longer than so many boxes is refused, and a query that would have to look at more copies of the box.
constexpr double kMostBoxes = 1e6, kMostImagesOfAQuery = 1e7;

// How many images on each side may hold what is within `reach` of a point of the box.
std::array<int, 3> images_within(const std::optional<PeriodicBox>& box, double reach) {
  if (!box) return {};
  const Vec3d faces = box->face_distances();
  const auto n = [reach](double face) { return std::fmax(std::ceil(reach * (1.0 + 0x1p-20) / face), 1.0); };
  const double x = n(faces.x), y = n(faces.y), z = n(faces.z);
  const double all = (2.0 * x + 1.0) * (2.0 * y + 1.0) * (2.0 * z + 1.0);
  if (!(all <= kMostImagesOfAQuery)) {
    throw InputError("a query of a periodic scene reaches over " + shortest_number(reach) + ", that is over " +
                     shortest_number(all) + " copies of the box - give a box that is less flat, or a smaller body");
  }
  return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
}

template <class Visit>
void each_image(const std::array<int, 3>& n, const Visit& visit) {
  for (int z = -n[2]; z <= n[2]; ++z) {
    for (int y = -n[1]; y <= n[1]; ++y) {
      end_if_interrupted();
      for (int x = -n[0]; x <= n[0]; ++x) visit(ImageOffset{x, y, z});
    }
  }
}

}  // namespace

// A visitor of a periodic scene is moved into the box; images are told from where it came.
struct Scene::Impl::Visit {
  Visit(Impl& impl, const ConvexBody& body, const Pose& world_from_body)
      : scene(impl), visitor(body), pose(world_from_body.a_from_b()), bounds(shape_bounds(body)) {
    SceneBodies::check_size(body);
    SceneBodies::check_rotation(pose);
    if (!(norm_1(pose.translation) <= 1e100)) {
      throw InputError("a visitor of a scene is more than 1e100 away - move it nearer");
    }
    if (impl.bodies_.box()) {
      pose = impl.bodies_.wrapped(pose, bounds.centre, &moved_by);
    }
    const double more = 0x1p-18 * (bounds.radius + norm_1(bounds.centre)) + 0x1p-46 * norm_1(pose.translation);
    box = bounding_box(body, Pose::unchecked(pose));
    box = {box.lower - Vec3d{more, more, more}, box.upper + Vec3d{more, more, more}};
  }

  Vec3d shift(const ImageOffset& image) const {
    return scene.bodies_.box() ? scene.bodies_.box()->shift(image) : Vec3d{};
  }
  // Moved against the image, to the bodies as they are.
  Aabb box_at(const ImageOffset& image) const {
    const Vec3d by = shift(image);
    const double more = 0x1p-50 * norm_1(by);
    const Vec3d wider{more, more, more};
    return {(box.lower - by) - wider, (box.upper - by) + wider};
  }
  // Of a body's copy in the visitor's frame.
  Transformd relative_pose(BodyId body, const ImageOffset& image) const {
    return vex::relative_pose(pose, scene.bodies_.pose(body), shift(image));
  }
  const ConvexBody& shape_of(BodyId body) const { return scene.bodies_.shapes()[scene.bodies_.shape_of()[body]]; }

  Impl& scene;
  const ConvexBody& visitor;
  Transformd pose;
  ShapeBounds bounds;
  ImageOffset moved_by{};
  Aabb box;
};

const BodyTree& Scene::Impl::tree() {
  require_no_judge();
  return phases_.tree_of_bodies(bodies_, checked_reach(0.0), settings_.n_threads);
}

void Scene::overlaps_of(const ConvexBody& visitor, const Pose& world_from_body, ScenePairs& out) {
  Impl::Visit visit(*impl_, visitor, world_from_body);
  const BodyTree& tree = impl_->tree();
  out.pairs.clear();
  out.undecided.clear();
  out.counts = {};
  SceneCounts::Stage& scalar = out.counts[SceneStage::scalar];
  each_image(images_within(box(), visit.bounds.radius + impl_->bodies().largest_radius()),
             [&](const ImageOffset& image) {
               tree.tree().meeting(visit.box_at(image), [&](std::uint32_t leaf) {
                 const BodyId body = tree.body_of(leaf);
                 ++scalar.seen;
                 const Outcome outcome =
                     overlap(visitor, visit.shape_of(body), Pose::unchecked(visit.relative_pose(body, image))).outcome;
                 if (outcome != Outcome::undecided) ++scalar.settled;
                 if (outcome == Outcome::disjoint) return;
                 (outcome == Outcome::overlap ? out.pairs : out.undecided)
                     .push_back({kNoBody, body, image_difference(image, visit.moved_by)});
               });
             });
  std::sort(out.pairs.begin(), out.pairs.end());
  std::sort(out.undecided.begin(), out.undecided.end());
}

SceneNeighbour Scene::Impl::nearest(const ConvexBody& visitor, const Pose& pose, BodyId itself) {
  Visit visit(*this, visitor, pose);
  const BodyTree& tree = this->tree();
  SceneNeighbour best;
  double bound = HUGE_VAL;
  // As far as the visitor sees, in the scene's frame (E26).
  const double rounding = 0x1p-44 * (norm_1(visit.pose.translation) + norm_1(visit.bounds.centre) +
                                     (bodies_.box() ? 64.0 * bodies_.box()->largest_coordinate() : 0.0));
  const auto widened = [&](double distance) { return distance * (1.0 + 0x1p-18) + rounding + kTrifle; };
  const auto look = [&](const ImageOffset& image) {
    tree.tree().by_distance(visit.box_at(image), bound, [&](std::uint32_t leaf, double) {
      const BodyId body = tree.body_of(leaf);
      if (body == itself && image == visit.moved_by) return bound;
      const Separation found =
          distance(visitor, visit.shape_of(body), Pose::unchecked(visit.relative_pose(body, image)));
      const ImageOffset told = image_difference(image, visit.moved_by);
      // By the upper bounds, which the value is near to: where nothing is known a value says nothing.
      if (best.body == kNoBody ||
          std::tie(found.upper, found.signed_distance, body, told) <
              std::tie(best.separation.upper, best.separation.signed_distance, best.body, best.image)) {
        best = {body, told, found};
        // Of very large or small bodies a distance may have no upper bound; that of two of their points always is one.
        const Vec3d way = (bodies_.centre(body) + visit.shift(image)) - visit.pose(visit.bounds.centre);
        const double by_points = safe_norm(way) + visit.bounds.radius + bodies_.largest_radius();
        bound = widened(std::fmax(std::fmin(found.upper, by_points), 0.0));
      }
      return bound;
    });
  };
  // The box's own neighbours first: they bound how far the others can matter.
  const std::array<int, 3> around = images_within(bodies_.box(), 0.0);
  each_image(around, look);
  if (!bodies_.box() || best.body == kNoBody) return best;
  const std::array<int, 3> farther =
      images_within(bodies_.box(), bound + visit.bounds.radius + bodies_.largest_radius());
  each_image(farther, [&](const ImageOffset& image) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(image[k]) > around[k]) {
        look(image);
        return;
      }
    }
  });
  return best;
}

SceneNeighbour Scene::nearest(const ConvexBody& visitor, const Pose& world_from_body) {
  return impl_->nearest(visitor, world_from_body, kNoBody);
}

SceneNeighbour Scene::nearest(BodyId body) {
  impl_->require(body);
  return impl_->nearest(shape(shape_of(body)), Pose::unchecked(pose(body)), body);
}

// Goes along the way piece by piece, none longer than the box, so that few images are looked at for each. `cast`
// answers of a body and its image, no later than a time; its contact is in the body's frame.
SceneHit Scene::Impl::cast(const Vec3d& from, const Vec3d& dir, const Vec3d& half_extents, double reach, double until,
                           const Cast& cast) {
  if (!is_finite(from) || !is_finite(dir) || !(norm_1(dir) > 0.0)) {
    throw InputError("a ray of a scene has no finite origin, or no direction - give finite numbers, a direction but 0");
  }
  if (!(until >= 0.0)) throw UsageError("a ray ends before it begins - give an end from 0 on");
  const std::optional<PeriodicBox>& box = bodies_.box();
  double piece = HUGE_VAL;
  std::array<int, 3> n_images{};
  if (box) {
    const Vec3d faces = box->face_distances();
    const double least = std::fmin(faces.x, std::fmin(faces.y, faces.z));
    piece = least / safe_norm(dir);
    if (!std::isfinite(until) || !(piece > 0.0) || !(until <= kMostBoxes * piece)) {
      throw UsageError(
          "a ray of a periodic scene is longer than 10^6 boxes - give an end, and a direction of usual length");
    }
    n_images = images_within(box, least + reach + bodies_.largest_radius());
  }
  const BodyTree& tree = this->tree();
  SceneHit best;
  best.contact.verdict = Verdict::disjoint(DecidedBy::gjk);
  best.contact.time = best.contact.lower = best.contact.upper = HUGE_VAL;
  std::vector<std::pair<ScenePair, double>> rivals;  // all that may be met, and the time before which each is not
  double last = until;
  for (double start = 0.0; start <= last; start += piece) {
    Vec3d origin = from + start * dir;
    ImageOffset moved_by{};
    if (box) origin = box->wrapped(origin, &moved_by);
    each_image(n_images, [&](const ImageOffset& image) {
      const Vec3d shift = box ? box->shift(image) : Vec3d{};
      const double more = 0x1p-44 * (norm_1(origin) + norm_1(from) + norm_1(shift) + norm_1(start * dir) +
                                     norm_1(tree.tree().bounds().upper) + norm_1(tree.tree().bounds().lower));
      const Vec3d margin = half_extents + Vec3d{more, more, more};
      const double end = std::fmin(piece * (1.0 + 0x1p-30), last - start);
      tree.tree().along_ray(origin - shift, dir, margin, end, [&](std::uint32_t leaf, double) {
        const BodyId body = tree.body_of(leaf);
        const ImageOffset told = image_difference(image, moved_by);
        const FirstContact contact = cast(body, told, last);
        if (contact.verdict.outcome == Outcome::disjoint) return last - start;
        rivals.push_back({{kNoBody, body, told}, contact.lower});
        // The one that is proven to be met soonest: what is not met by then is met later.
        if (contact.verdict.outcome == Outcome::overlap &&
            (best.body == kNoBody || std::tie(contact.upper, contact.time, body, told) <
                                         std::tie(best.contact.upper, best.contact.time, best.body, best.image))) {
          best.body = body;
          best.image = told;
          best.contact = contact;
          last = std::fmin(last, contact.upper);
        }
        return last - start;
      });
    });
    if (!box) break;
  }
  const ScenePair first{kNoBody, best.body, best.image};
  for (const auto& [pair, lower] : rivals) {
    if (lower <= best.contact.upper && pair != first) best.undecided.push_back(pair);
  }
  std::sort(best.undecided.begin(), best.undecided.end());
  best.undecided.erase(std::unique(best.undecided.begin(), best.undecided.end()), best.undecided.end());
  if (best.body == kNoBody) {
    if (!best.undecided.empty()) {
      best.contact.verdict = Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
      best.contact.lower = HUGE_VAL;
      for (const auto& [pair, lower] : rivals) best.contact.lower = std::fmin(best.contact.lower, lower);
      best.contact.time = best.contact.lower;
    }
    return best;
  }
  // From the body's frame to the scene's.
  const Transformd pose = bodies_.pose(best.body);
  const Vec3d shift = box ? box->shift(best.image) : Vec3d{};
  best.contact.normal = direction_to_a(pose, best.contact.normal);
  best.contact.point_a = pose(best.contact.point_a) + shift;
  best.contact.point_b = pose(best.contact.point_b) + shift;
  return best;
}

SceneHit Scene::cast_ray(const Vec3d& origin, const Vec3d& dir, double until) {
  return impl_->cast(origin, dir, {}, 0.0, until, [&](BodyId body, const ImageOffset& image, double last) {
    const Transformd pose = this->pose(body);
    const Vec3d from = (origin - pose.translation) - (box() ? box()->shift(image) : Vec3d{});
    return vex::cast_ray(shape(shape_of(body)), pose.direction_to_b(from), pose.direction_to_b(dir), last);
  });
}

SceneHit Scene::linear_cast(const ConvexBody& visitor, const Pose& world_from_body, const Vec3d& motion, double until) {
  const Transformd& of_visitor = world_from_body.a_from_b();
  const Impl::Visit visit(*impl_, visitor, world_from_body);
  const Vec3d half = 0.5 * (visit.box.upper - visit.box.lower);
  const Vec3d centre = of_visitor(visitor.centre());
  // The box about the centre that holds the body's own one.
  const Vec3d own = visit.pose(visitor.centre()), off = 0.5 * (visit.box.upper + visit.box.lower) - own;
  const Vec3d extents = half + Vec3d{std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)};
  return impl_->cast(centre, motion, extents, visit.bounds.radius, until,
                     [&](BodyId body, const ImageOffset& image, double last) {
                       const Transformd pose = this->pose(body);
                       const Vec3d shift = box() ? box()->shift(image) : Vec3d{};
                       return vex::linear_cast(shape(shape_of(body)), visitor,
                                               Pose::unchecked(vex::relative_pose(pose, of_visitor, -shift)),
                                               pose.direction_to_b(motion), last);
                     });
}

}  // namespace vex
