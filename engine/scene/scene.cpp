#include "engine/scene/scene.h"

#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/scene/scene_impl.h"

namespace vex {

Scene::Scene(const SceneSettings& settings) : impl_(std::make_unique<Impl>(std::nullopt, settings)) {}
Scene::Scene(const PeriodicBox& box, const SceneSettings& settings) : impl_(std::make_unique<Impl>(box, settings)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

void Scene::set(const SceneSettings& settings) { impl_->set(settings); }
const SceneSettings& Scene::settings() const { return impl_->settings(); }
const std::optional<PeriodicBox>& Scene::box() const { return impl_->bodies().box(); }

ShapeId Scene::add_shape(const ConvexBody& body) { return impl_->add_shape(body); }
std::size_t Scene::n_shapes() const { return impl_->bodies().shapes().size(); }
const ConvexBody& Scene::shape(ShapeId shape) const {
  if (shape >= n_shapes()) throw UsageError("a scene has no shape " + std::to_string(shape) + " - add it first");
  return impl_->bodies().shapes()[shape];
}

BodyId Scene::add(ShapeId shape, const Pose& pose, const ImageOffset& moved) { return impl_->add(shape, pose, moved); }
BodyId Scene::add(const ConvexBody& body, const Pose& pose) { return impl_->add(impl_->add_shape(body), pose, {}); }
void Scene::add(ShapeId shape, std::span<const Pose> poses) { impl_->add(shape, poses); }
void Scene::remove(BodyId body) { impl_->remove(body); }
void Scene::clear() { impl_->clear(); }
void Scene::expect(std::size_t n_bodies) { impl_->expect(n_bodies); }
void Scene::move(BodyId body, const Pose& pose) { impl_->move(body, pose); }
void Scene::move_all(std::span<const Pose> poses) { impl_->move_all(poses); }

std::size_t Scene::size() const { return impl_->bodies().size(); }
BodyId Scene::end() const { return impl_->bodies().end(); }
bool Scene::has(BodyId body) const { return impl_->bodies().has(body); }
ShapeId Scene::shape_of(BodyId body) const {
  impl_->require(body);
  return impl_->bodies().shape_of()[body];
}
Transformd Scene::pose(BodyId body) const {
  impl_->require(body);
  return impl_->bodies().pose(body);
}
ImageOffset Scene::image(BodyId body) const {
  impl_->require(body);
  return impl_->bodies().image(body);
}

Transformd Scene::relative_pose(const ScenePair& pair) const {
  const SceneBodies& bodies = impl_->bodies();
  impl_->require(pair.a);
  impl_->require(pair.b);
  return vex::relative_pose(bodies.pose(pair.a), bodies.pose(pair.b),
                            bodies.box() ? bodies.box()->shift(pair.image) : Vec3d{});
}

void Scene::overlapping_pairs(ScenePairs& out) {
  if (settings().skin == 0.0) {
    pairs_within(0.0, out);
    return;
  }
  impl_->find_remembered_pairs(out);
}

void Scene::pairs_within(double distance, ScenePairs& out) {
  impl_->find_pairs(distance, {});
  impl_->collect(out);
}

SceneAnswer Scene::any_overlap() {
  impl_->find_pairs(0.0, [](PairSearch& search) { return search.pairs.empty(); });
  ScenePairs& found = impl_->pairs_buffer();
  impl_->collect(found);
  SceneAnswer answer;
  answer.counts = found.counts;
  if (!found.pairs.empty()) {
    answer.outcome = Outcome::overlap;
    answer.pair = found.pairs.front();
    return answer;
  }
  answer.n_undecided = found.undecided.size();
  if (!found.undecided.empty()) {
    answer.outcome = Outcome::undecided;
    answer.pair = found.undecided.front();
  }
  return answer;
}

}  // namespace vex
