// Distances, depths and contacts over arrays of poses.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "engine/query/contact_manifold.h"
#include "engine/query/manifold_certificate.h"
#include "engine/query/separation.h"
#include "engine/query/separation_certificate.h"
#include "engine/query/separation_of_many.h"
#include "python/bindings/body.h"
#include "python/bindings/proofs.h"

namespace vex::python {
namespace {

struct SeparationRow {
  double value, lower, upper;
  double normal[3], point_a[3], point_b[3];
  std::int8_t verdict;
  bool is_rough;
};
struct ManifoldRow {
  double point_a[3], point_b[3], distance;
  std::uint64_t feature_a, feature_b;
};

SeparationRow row_of(const Separation& found, SeparationGoal goal) {
  SeparationRow row{};
  row.verdict = number_of(found.verdict.outcome);
  row.is_rough = found.is_rough;
  row.value = found.signed_distance;
  row.lower = found.lower;
  row.upper = found.upper;
  if (goal == SeparationGoal::depth) {
    row.value = 0.0 - row.value;
    row.lower = -found.upper;
    row.upper = -found.lower;
  }
  if (goal != SeparationGoal::signed_distance) {  // a distance, and a depth, is never below 0
    row.value = std::max(row.value, 0.0);
    row.lower = std::max(row.lower, 0.0);
    row.upper = std::max(row.upper, 0.0);
  }
  if (found.has_witnesses) {
    put(row.normal, found.normal);
    put(row.point_a, found.point_a);
    put(row.point_b, found.point_b);
  } else {
    for (double* const to : {row.normal, row.point_a, row.point_b}) put_nan(to);
  }
  return row;
}

/// With a state rows are steps of one motion: in their order, each beginning where the one before has ended.
template <SeparationGoal goal>
py::tuple separation_of_poses(const PyBody& a, const PyBody& b, const Floats& rows,
                              const std::optional<Floats>& translations, double relative_gap, double max_distance,
                              bool certify_answers, WarmStart* warm_start, int threads) {
  if (!(relative_gap >= 0.0)) throw UsageError("a relative gap is a number from 0 up - 0 asks for full precision");
  if (std::isnan(max_distance)) throw UsageError("a largest distance that is no number - leave it out");
  const PoseRows poses(rows, translations);
  py::array_t<SeparationRow> result(static_cast<py::ssize_t>(poses.size()));
  SeparationRow* const to = result.mutable_data();
  SeparationSettings settings;
  settings.relative_gap = relative_gap;
  settings.max_distance = max_distance;
  Proofs proofs(certify_answers, poses.size());
  const auto set = [&](std::size_t k, const Pose& pose, const Separation& found) {
    to[k] = row_of(found, goal);
    if (proofs.is_wanted()) {
      proofs.set(k, check_certificate(a.body, b.body, pose, found, certify(a.body, b.body, pose, found)));
    }
  };
  if (warm_start == nullptr) {
    over_rows(poses.size(), threads, ManySeparations::kMostPoses, [&] {
      return [&, many = std::make_shared<ManySeparations>(a.body, b.body, goal, settings),
              found = std::vector<Separation>(std::min(poses.size(), ManySeparations::kMostPoses))](
                 std::size_t first, std::size_t last) mutable {
        alignas(64) double columns[kPoseColumns][PacketOverlap::kStride];
        poses.set_columns(first, last, columns[0]);
        const PoseTable table{columns[0], PacketOverlap::kStride, last - first};
        many->answer(table, found);
        for (std::size_t k = first; k < last; ++k) set(k, Pose::unchecked(table.pose(k - first)), found[k - first]);
      };
    });
    return py::make_tuple(result, proofs.arrays());
  }
  // Its own, since threads of Python's may share the one that was given.
  WarmStart state = *warm_start;
  over_each_pose(poses, 1, [&](std::size_t k, const Pose& pose) {
    constexpr auto query = goal == SeparationGoal::signed_distance ? signed_distance
                           : goal == SeparationGoal::distance      ? distance
                                                                   : penetration_depth;
    set(k, pose, query(a.body, b.body, pose, settings, &state));
  });
  *warm_start = state;
  return py::make_tuple(result, proofs.arrays());
}

/// A state may be of anything, even bytes at random: it is asked, and not believed.
py::tuple bytes_of(const WarmStart& state) {
  return py::make_tuple(py::bytes(reinterpret_cast<const char*>(&state), sizeof state));
}
WarmStart warm_start_of(const py::tuple& state) {
  const auto bytes = state.size() == 1 ? state[0].cast<std::string>() : std::string();
  WarmStart made;
  if (bytes.size() == sizeof made) std::memcpy(&made, bytes.data(), sizeof made);  // of another version: empty
  return made;
}

/// Of each pose the separation and the contacts.
py::tuple manifolds(const PyBody& a, const PyBody& b, const Floats& rows, const std::optional<Floats>& translations,
                    double margin, double feature_angle, bool four_at_most, bool certify_answers, int threads) {
  const PoseRows poses(rows, translations);
  std::vector<ContactManifold> found(poses.size());
  Proofs proofs(certify_answers, poses.size());
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    thread_local ManifoldMemory memory;
    contact_manifold(a.body, b.body, pose,
                     {.margin = margin, .feature_angle = feature_angle, .four_at_most = four_at_most}, memory,
                     found[k]);
    if (proofs.is_wanted()) {
      const ManifoldCertificate certificate = certify(a.body, b.body, pose, found[k]);
      proofs.set(k, check_certificate(a.body, b.body, pose, found[k], certificate, margin, feature_angle));
    }
  });
  py::list result;
  for (const ContactManifold& manifold : found) {
    py::array_t<ManifoldRow> contacts(static_cast<py::ssize_t>(manifold.contacts.size()));
    ManifoldRow* to = contacts.mutable_data();
    for (const ContactManifold::Contact& contact : manifold.contacts) put_contact(*to++, contact);
    py::array_t<SeparationRow> separation(1);
    *separation.mutable_data() = row_of(manifold.separation, SeparationGoal::signed_distance);
    result.append(py::make_tuple(separation, contacts));
  }
  return py::make_tuple(result, proofs.arrays());
}

}  // namespace

void bind_separations(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(SeparationRow, value, lower, upper, normal, point_a, point_b, verdict, is_rough);
  PYBIND11_NUMPY_DTYPE(ManifoldRow, point_a, point_b, distance, feature_a, feature_b);

  const auto a = py::arg("a"), b = py::arg("b"), poses = py::arg("poses"), threads = py::arg("threads"),
             certify = py::arg("certify"), relative_gap = py::arg("relative_gap"),
             max_distance = py::arg("max_distance");
  const auto translations = py::arg("translations").none(true), warm_start = py::arg("warm_start").none(true);
  py::class_<WarmStart>(
      module, "WarmStart",
      "What was found of a pair, for the next query of the same pair in a pose not far from this one.", py::is_final())
      .def(py::init<>())
      .def("__copy__", [](const WarmStart& state) { return state; })
      .def(
          "__deepcopy__", [](const WarmStart& state, const py::object&) { return state; }, py::arg("memo"))
      .def(py::pickle(&bytes_of, &warm_start_of));
  module.def("signed_distance", &separation_of_poses<SeparationGoal::signed_distance>, a, b, poses, translations,
             relative_gap, max_distance, certify, warm_start, threads);
  module.def("distance", &separation_of_poses<SeparationGoal::distance>, a, b, poses, translations, relative_gap,
             max_distance, certify, warm_start, threads);
  module.def("depth", &separation_of_poses<SeparationGoal::depth>, a, b, poses, translations, relative_gap,
             max_distance, certify, warm_start, threads);
  module.def("contact_manifold", &manifolds, a, b, poses, translations, py::arg("margin"), py::arg("feature_angle"),
             py::arg("four_at_most"), certify, threads);
}

}  // namespace vex::python
