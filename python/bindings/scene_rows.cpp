#include "python/bindings/scene_rows.h"

#include <algorithm>
#include <string>

namespace vex::python {
namespace {

struct PairRow {
  std::int64_t a, b;  // -1: no body
  std::int32_t image[3];
};
struct DistanceRow {
  std::int64_t a, b;
  std::int32_t image[3];
  double distance, lower, upper;
  double normal[3], point_a[3], point_b[3];
};
struct SceneContactRow {
  std::int64_t a, b;
  std::int32_t image[3];
  double normal[3], point_a[3], point_b[3], distance;
  std::uint64_t feature_a, feature_b;
};

template <class Row>
Row row_of_pair(const ScenePair& pair) {
  Row row{};
  row.a = body_number(pair.a);
  row.b = body_number(pair.b);
  std::copy(pair.image.begin(), pair.image.end(), row.image);
  return row;
}

}  // namespace

py::array rows_of(const std::vector<ScenePair>& pairs) {
  py::array_t<PairRow> array(static_cast<py::ssize_t>(pairs.size()));
  std::transform(pairs.begin(), pairs.end(), array.mutable_data(), row_of_pair<PairRow>);
  return array;
}

py::array rows_of(const SceneDistances& distances) {
  py::array_t<DistanceRow> array(static_cast<py::ssize_t>(distances.entries.size()));
  DistanceRow* to = array.mutable_data();
  for (const auto& [pair, found] : distances.entries) {
    *to = row_of_pair<DistanceRow>(pair);
    to->distance = std::max(found.signed_distance, 0.0);
    to->lower = std::max(found.lower, 0.0);
    to->upper = std::max(found.upper, 0.0);
    if (found.has_witnesses) {
      put(to->normal, found.normal);
      put(to->point_a, found.point_a);
      put(to->point_b, found.point_b);
    } else {
      for (double* const v : {to->normal, to->point_a, to->point_b}) put_nan(v);
    }
    ++to;
  }
  return array;
}

py::array rows_of(const SceneManifolds& manifolds) {
  std::size_t n = 0;
  for (const SceneManifolds::Entry& entry : manifolds.entries) n += entry.manifold.contacts.size();
  py::array_t<SceneContactRow> array(static_cast<py::ssize_t>(n));
  SceneContactRow* to = array.mutable_data();
  for (const auto& [pair, manifold] : manifolds.entries) {
    for (const ContactManifold::Contact& contact : manifold.contacts) {
      *to = row_of_pair<SceneContactRow>(pair);
      put(to->normal, manifold.separation.normal);
      put_contact(*to++, contact);
    }
  }
  return array;
}

py::dict stages_of(const SceneCounts& counts) {
  py::dict dict;
  for (int k = 0; k < kNSceneStages; ++k) {
    const auto stage = static_cast<SceneStage>(k);
    const SceneCounts::Stage& count = counts[stage];
    if (count.seen > 0) dict[py::str(std::string(name_of(stage)))] = py::make_tuple(count.seen, count.settled);
  }
  return dict;
}

void register_scene_rows() {
  PYBIND11_NUMPY_DTYPE(PairRow, a, b, image);
  PYBIND11_NUMPY_DTYPE(DistanceRow, a, b, image, distance, lower, upper, normal, point_a, point_b);
  PYBIND11_NUMPY_DTYPE(SceneContactRow, a, b, image, normal, point_a, point_b, distance, feature_a, feature_b);
}

}  // namespace vex::python
