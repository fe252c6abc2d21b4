// Many bodies: poses in, pairs out.
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include "engine/scene/scene.h"
#include "python/bindings/body.h"
#include "python/bindings/scene_rows.h"

namespace vex::python {
namespace {

using Images = py::array_t<std::int32_t, py::array::c_style>;

/// One at a time: Python's threads may share a scene, whose queries release the GIL.
class PyScene {
  /// Waits for other threads; but a support function that asks the scene that asks it would wait for itself, and so
  /// would a signal's handler.
  template <class Work>
  auto exclusively(const Work& work) {
    return interruptibly([&] {
      std::unique_lock lock(*mutex_, std::defer_lock);
      if (is_called_by_a_query()) {
        if (!lock.try_lock()) {
          throw UsageError(
              "a support function or a signal's handler asks a scene that is busy, with it perhaps - ask another one");
        }
      } else {
        while (!lock.try_lock_for(std::chrono::milliseconds(100))) end_if_interrupted();
      }
      return work();
    });
  }

 public:
  PyScene(const std::optional<std::vector<double>>& box, const std::string& broad_phase, double skin, int threads)
      : scene_(made(box, settings_of(broad_phase, skin, threads))) {}

  ShapeId add_shape(const PyBody& body) {
    return exclusively([&] { return scene_.add_shape(body.body.body); });
  }
  /// Numbers of the bodies that were added, one a pose. Images: by which they were moved before.
  std::vector<BodyId> add(const py::array_t<std::uint32_t, py::array::c_style>& shapes, const Floats& rows,
                          const std::optional<Floats>& translations, const std::optional<Images>& images) {
    const PoseRows poses(rows, translations);
    if (static_cast<std::size_t>(shapes.size()) != poses.size()) {
      throw UsageError("not a shape for each pose - give one each");
    }
    if (images && static_cast<std::size_t>(images->size()) != 3 * poses.size()) {
      throw UsageError("not an image for each pose - give one each");
    }
    const std::int32_t* const image = images ? images->data() : nullptr;
    const std::uint32_t* const shape = shapes.data();
    return exclusively([&] {
      // All are looked at before one is added: what is removed again leaves a gap in the numbers.
      std::vector<Pose> all(poses.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (k % 256 == 0) end_if_interrupted();
        if (shape[k] >= scene_.n_shapes()) throw UsageError("no such shape");
        all[k] = poses[k];
      }
      std::vector<BodyId> bodies;
      bodies.reserve(all.size());
      try {
        for (std::size_t k = 0; k < all.size(); ++k) {
          if (k % 256 == 0) end_if_interrupted();
          const ImageOffset moved =
              image == nullptr ? ImageOffset{} : ImageOffset{image[3 * k], image[3 * k + 1], image[3 * k + 2]};
          bodies.push_back(scene_.add(shape[k], all[k], moved));
        }
      } catch (...) {
        for (const BodyId body : bodies) scene_.remove(body);  // all or none
        throw;
      }
      return bodies;
    });
  }
  void remove(BodyId body) {
    exclusively([&] { scene_.remove(known(body)); });
  }
  void move(BodyId body, const Floats& rows, const std::optional<Floats>& translations) {
    const PoseRows poses(rows, translations);
    if (poses.size() != 1) throw UsageError("not one pose - give one");
    exclusively([&] { scene_.move(known(body), poses[0]); });
  }
  void move_all(const Floats& rows, const std::optional<Floats>& translations) {
    const PoseRows poses(rows, translations);
    exclusively([&] {
      std::vector<Pose> all(poses.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (k % 256 == 0) end_if_interrupted();
        all[k] = poses[k];
      }
      scene_.move_all(all);
    });
  }
  /// What a scene of the same settings and shapes is made from again: of each number the shape, -1 where no body has
  /// it; rotation, translation and image.
  py::tuple bodies() {
    std::vector<std::int64_t> shapes;
    std::vector<Transformd> poses;
    std::vector<ImageOffset> images;
    exclusively([&] {
      for (BodyId body = 0; body < scene_.end(); ++body) {
        if (body % 256 == 0) end_if_interrupted();
        const bool is_there = scene_.has(body);
        shapes.push_back(is_there ? static_cast<std::int64_t>(scene_.shape_of(body)) : -1);
        poses.push_back(is_there ? scene_.pose(body) : Transformd{});
        images.push_back(is_there ? scene_.image(body) : ImageOffset{});
      }
    });
    const auto n = static_cast<py::ssize_t>(poses.size());
    Floats rotations({n, py::ssize_t{3}, py::ssize_t{3}}), translations({n, py::ssize_t{3}});
    Images moved({n, py::ssize_t{3}});
    for (std::size_t k = 0; k < poses.size(); ++k) {
      double* const rotation = rotations.mutable_data() + 9 * k;
      put(rotation, poses[k].row_x);
      put(rotation + 3, poses[k].row_y);
      put(rotation + 6, poses[k].row_z);
      put(translations.mutable_data() + 3 * k, poses[k].translation);
      std::copy(images[k].begin(), images[k].end(), moved.mutable_data() + 3 * k);
    }
    return py::make_tuple(py::array_t<std::int64_t>(n, shapes.data()), rotations, translations, moved);
  }
  std::size_t size() {
    return exclusively([&] { return scene_.size(); });
  }
  /// Rotation and translation, and the image of a body.
  py::tuple pose(BodyId body) {
    Transformd at;
    ImageOffset image{};
    exclusively([&] {
      at = scene_.pose(known(body));
      image = scene_.image(body);
    });
    return py::make_tuple(arrays_of(at), image);
  }

  py::tuple pairs(double distance) {
    ScenePairs found;
    exclusively([&] { distance == 0.0 ? scene_.overlapping_pairs(found) : scene_.pairs_within(distance, found); });
    return answer(found);
  }
  py::tuple distances(double distance) {
    SceneDistances distances;
    exclusively([&] { scene_.distances_within(distance, distances); });
    return py::make_tuple(rows_of(distances), rows_of(distances.undecided), stages_of(distances.counts));
  }
  /// A row each contact, those of a pair one after another.
  py::tuple contact_manifolds(double margin, double feature_angle, bool four_at_most) {
    SceneManifolds manifolds;
    exclusively([&] {
      scene_.contact_manifolds(manifolds,
                               {.margin = margin, .feature_angle = feature_angle, .four_at_most = four_at_most});
    });
    return py::make_tuple(rows_of(manifolds), rows_of(manifolds.undecided), stages_of(manifolds.counts));
  }
  /// The answer, an undecided pair where that is the answer, counts.
  py::tuple any_overlap() {
    const SceneAnswer found = exclusively([&] { return scene_.any_overlap(); });
    std::vector<ScenePair> undecided;
    if (found.outcome == Outcome::undecided) undecided.push_back(found.pair);
    return py::make_tuple(number_of(found.outcome), rows_of(undecided), stages_of(found.counts));
  }
  py::tuple overlaps_of(BodyId body) {
    ScenePairs found;
    exclusively([&] { scene_.overlaps_of(known(body), found); });
    return answer(found);
  }
  py::tuple overlaps_of_visitor(const PyBody& visitor, const Floats& rows, const std::optional<Floats>& translations) {
    const PoseRows poses(rows, translations);
    if (poses.size() != 1) throw UsageError("not one pose - give one");
    ScenePairs found;
    exclusively([&] { scene_.overlaps_of(visitor.body.body, poses[0], found); });
    return answer(found);
  }
  std::int8_t would_overlap(BodyId body, const Floats& rows, const std::optional<Floats>& translations) {
    const PoseRows poses(rows, translations);
    if (poses.size() != 1) throw UsageError("not one pose - give one");
    return number_of(exclusively([&] { return scene_.would_overlap(known(body), poses[0]); }));
  }
  /// Body, image, distance, lower, upper.
  py::tuple nearest(BodyId body) {
    const SceneNeighbour found = exclusively([&] { return scene_.nearest(known(body)); });
    if (found.body == kNoBody) return py::make_tuple(-1, ImageOffset{}, HUGE_VAL, HUGE_VAL, HUGE_VAL);
    const Separation& s = found.separation;
    return py::make_tuple(body_number(found.body), found.image, std::max(s.signed_distance, 0.0),
                          std::max(s.lower, 0.0), std::max(s.upper, 0.0));
  }
  /// Verdict, body, image, time, lower, upper, normal, point; what may be met before.
  py::tuple ray_cast(const Floats& origin, const Floats& dir, double until) {
    const Rows3 from(origin), along(dir);
    if (from.size() != 1 || along.size() != 1) throw UsageError("not one origin and one direction - give one each");
    const SceneHit hit = exclusively([&] { return scene_.cast_ray(from[0], along[0], until); });
    return answer(hit);
  }
  py::tuple linear_cast(const PyBody& visitor, const Floats& rows, const std::optional<Floats>& translations,
                        const Floats& motion, double until) {
    const PoseRows poses(rows, translations);
    const Rows3 by(motion);
    if (poses.size() != 1 || by.size() != 1) throw UsageError("not one pose and one motion - give one each");
    const SceneHit hit = exclusively([&] { return scene_.linear_cast(visitor.body.body, poses[0], by[0], until); });
    return answer(hit);
  }
  /// Labels, number of clusters, whether each wraps along a, b, c; undecided pairs, counts.
  py::tuple clusters(double distance) {
    Clusters clusters;
    exclusively([&] { scene_.clusters(clusters, distance); });
    const std::vector<std::uint32_t> labels = clusters.labels();
    py::array_t<std::int64_t> label(static_cast<py::ssize_t>(labels.size()));
    py::array_t<bool> wraps({static_cast<py::ssize_t>(clusters.n_clusters()), py::ssize_t{3}});
    for (std::size_t k = 0; k < labels.size(); ++k) {
      label.mutable_data()[k] = labels[k] == kNoCluster ? -1 : static_cast<std::int64_t>(labels[k]);
      if (labels[k] == kNoCluster) continue;
      const std::array<bool, 3> along = clusters.wraps(static_cast<BodyId>(k));
      for (std::size_t i = 0; i < 3; ++i) wraps.mutable_data()[3 * labels[k] + i] = along[i];
    }
    return py::make_tuple(label, wraps, rows_of(clusters.undecided), stages_of(clusters.counts));
  }

 private:
  static SceneSettings settings_of(const std::string& broad_phase, double skin, int threads) {
    SceneSettings settings;
    settings.n_threads = number_of_threads(threads);
    settings.skin = skin;
    if (broad_phase == "grid") {
      settings.broad_phase = BroadPhase::grid;
    } else if (broad_phase == "tree") {
      settings.broad_phase = BroadPhase::tree;
    } else if (broad_phase != "automatic") {
      throw UsageError("not a broad phase (" + broad_phase + ") - there are automatic, grid and tree");
    }
    return settings;
  }
  static Scene made(const std::optional<std::vector<double>>& box, const SceneSettings& settings) {
    if (!box) return Scene(settings);
    const std::vector<double>& b = *box;
    if (b.size() != 3 && b.size() != 6) {
      throw UsageError("not a box - give its edges (Lx, Ly, Lz), or these and its tilts (xy, xz, yz)");
    }
    return b.size() == 3 ? Scene(PeriodicBox(b[0], b[1], b[2]), settings)
                         : Scene(PeriodicBox(b[0], b[1], b[2], b[3], b[4], b[5]), settings);
  }

  BodyId known(BodyId body) const {
    if (!scene_.has(body)) {
      throw UsageError("no body has this number (" + std::to_string(body) + ") - `add` tells the numbers");
    }
    return body;
  }
  static py::tuple answer(const ScenePairs& found) {
    return py::make_tuple(rows_of(found.pairs), rows_of(found.undecided), stages_of(found.counts));
  }
  static py::tuple answer(const SceneHit& hit) {
    const FirstContact& contact = hit.contact;
    const auto triple = [](const Vec3d& v) { return py::make_tuple(v.x, v.y, v.z); };
    return py::make_tuple(number_of(contact.verdict.outcome), body_number(hit.body), hit.image, contact.time,
                          contact.lower, contact.upper, triple(contact.normal), triple(contact.point_a),
                          rows_of(hit.undecided));
  }

  Scene scene_;
  std::unique_ptr<std::timed_mutex> mutex_ = std::make_unique<std::timed_mutex>();
};

}  // namespace

void bind_scenes(py::module_& module) {
  register_scene_rows();
  const auto poses = py::arg("poses"), body = py::arg("body"), visitor = py::arg("visitor");
  const auto translations = py::arg("translations").none(true);
  py::class_<PyScene>(module, "Scene", "Many bodies, in open space or in a periodic box.")
      .def(py::init<const std::optional<std::vector<double>>&, const std::string&, double, int>(),
           py::arg("box").none(true), py::arg("broad_phase"), py::arg("skin"), py::arg("threads"))
      .def("add_shape", &PyScene::add_shape, body)
      .def("add", &PyScene::add, py::arg("shapes"), poses, translations, py::arg("images").none(true))
      .def("bodies", &PyScene::bodies)
      .def("remove", &PyScene::remove, body)
      .def("move", &PyScene::move, body, poses, translations)
      .def("move_all", &PyScene::move_all, poses, translations)
      .def("size", &PyScene::size)
      .def("pose", &PyScene::pose, body)
      .def("pairs", &PyScene::pairs, py::arg("distance"))
      .def("distances", &PyScene::distances, py::arg("distance"))
      .def("contact_manifolds", &PyScene::contact_manifolds, py::arg("margin"), py::arg("feature_angle"),
           py::arg("four_at_most"))
      .def("any_overlap", &PyScene::any_overlap)
      .def("overlaps_of", &PyScene::overlaps_of, body)
      .def("overlaps_of_visitor", &PyScene::overlaps_of_visitor, visitor, poses, translations)
      .def("would_overlap", &PyScene::would_overlap, body, poses, translations)
      .def("nearest", &PyScene::nearest, body)
      .def("ray_cast", &PyScene::ray_cast, py::arg("origin"), py::arg("direction"), py::arg("until"))
      .def("linear_cast", &PyScene::linear_cast, visitor, poses, translations, py::arg("motion"), py::arg("until"))
      .def("clusters", &PyScene::clusters, py::arg("distance"));
}

}  // namespace vex::python
