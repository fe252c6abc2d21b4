// Half-spaces and compounds over arrays of poses.
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "engine/query/half_space.h"
#include "engine/query/plane_contacts.h"
#include "engine/scene/compound.h"
#include "python/bindings/body.h"

namespace vex::python {
namespace {

struct PartRow {
  double value, lower, upper;
  double normal[3], point_a[3], point_b[3];
  std::int8_t verdict;
  std::int64_t part;  // of the compound; -1: none
};
struct PartContactRow {
  double time, lower, upper;
  double normal[3], point_a[3], point_b[3];
  std::int8_t verdict;
  std::int64_t part;
};
struct PlaneContactRow {
  double point_a[3], point_b[3], distance;
  std::uint32_t feature;
};

std::int64_t part_number(std::uint32_t part) {
  return part == Compound::kNoPart ? -1 : static_cast<std::int64_t>(part);
}

PartRow row_of(const Separation& found, std::uint32_t part) {
  PartRow row{};
  row.verdict = number_of(found.verdict.outcome);
  row.part = part_number(part);
  row.value = found.signed_distance;
  row.lower = found.lower;
  row.upper = found.upper;
  put_nan(row.normal);
  put_nan(row.point_a);
  put_nan(row.point_b);
  if (found.has_witnesses) {
    python::put(row.normal, found.normal);
    python::put(row.point_a, found.point_a);
    python::put(row.point_b, found.point_b);
  }
  return row;
}

PartContactRow contact_row_of(const FirstContact& found, std::uint32_t part) {
  PartContactRow row{};
  const Outcome outcome = found.verdict.outcome;
  row.verdict = number_of(outcome);
  row.time = outcome == Outcome::undecided ? kNan : found.time;
  row.lower = found.lower;
  row.upper = found.upper;
  row.part = part_number(part);
  put_nan(row.normal);
  put_nan(row.point_a);
  put_nan(row.point_b);
  if (outcome == Outcome::overlap) {
    python::put(row.normal, found.normal);
    python::put(row.point_a, found.point_a);
    python::put(row.point_b, found.point_b);
  }
  return row;
}
PartContactRow contact_row_of(const FirstContact& found) { return contact_row_of(found, Compound::kNoPart); }
PartContactRow contact_row_of(const CompoundContact& found) { return contact_row_of(found.contact, found.part_a); }

void require_rows(std::size_t n, std::size_t n_others, const char* what) {
  if (n == n_others) return;
  throw UsageError(std::string("not as many ") + what + " (" + std::to_string(n) + ") as poses or origins (" +
                   std::to_string(n_others) + ") - give one each");
}

/// Rays, casts and impacts against a world: a HalfSpace or a Compound.
template <class World>
py::object rays_into(const World& a, const Floats& origins, const Floats& dirs, double until, int threads) {
  const Rows3 from(origins), along(dirs);
  require_rows(along.size(), from.size(), "directions");
  py::array_t<PartContactRow> result(static_cast<py::ssize_t>(from.size()));
  PartContactRow* const to = result.mutable_data();
  over_each_row(from.size(), threads,
                [&](std::size_t k) { to[k] = contact_row_of(cast_ray(a, from[k], along[k], until)); });
  return result;
}
template <class World>
py::object casts_into(const World& a, const PyBody& b, const Floats& rows, const std::optional<Floats>& translations,
                      const Floats& motions, double until, int threads) {
  const PoseRows poses(rows, translations);
  const Rows3 by(motions);
  require_rows(by.size(), poses.size(), "motions");
  py::array_t<PartContactRow> result(static_cast<py::ssize_t>(poses.size()));
  PartContactRow* const to = result.mutable_data();
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    to[k] = contact_row_of(linear_cast(a, b.body.body, pose, by[k], until));
  });
  return result;
}

struct PyCompound {
  explicit PyCompound(std::vector<CompoundPart> parts) : compound(std::move(parts)) {}
  explicit PyCompound(Compound made) : compound(std::move(made)) {}

  Compound compound;
};

std::unique_ptr<PyCompound> compound_of_parts(const std::vector<PyBody>& bodies, const Floats& rows,
                                              const std::optional<Floats>& translations) {
  const PoseRows poses(rows, translations);
  if (bodies.size() != poses.size()) throw UsageError("not a pose for each part of a compound - give one each");
  std::vector<CompoundPart> parts;
  for (std::size_t k = 0; k < bodies.size(); ++k) parts.push_back({bodies[k].body.body, poses[k]});
  return interruptibly([&] { return std::make_unique<PyCompound>(std::move(parts)); });
}

std::unique_ptr<PyCompound> compound_of_corners(const Floats& corners) {
  const Rows3 points(corners);
  std::vector<std::array<Vec3d, 3>> triangles;
  for (std::size_t k = 0; k + 3 <= points.size(); k += 3)
    triangles.push_back({points[k], points[k + 1], points[k + 2]});
  return interruptibly([&] { return std::make_unique<PyCompound>(compound_of_triangles(triangles)); });
}

py::tuple overlaps_of_compound(const PyCompound& a, const PyBody& b, const Floats& rows,
                               const std::optional<Floats>& translations, int threads) {
  const PoseRows poses(rows, translations);
  py::array_t<std::int8_t> verdicts(static_cast<py::ssize_t>(poses.size()));
  py::array_t<std::int64_t> parts(static_cast<py::ssize_t>(poses.size()));
  std::int8_t* const verdict = verdicts.mutable_data();
  std::int64_t* const part = parts.mutable_data();
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    const CompoundVerdict found = overlap(a.compound, b.body.body, pose);
    verdict[k] = number_of(found.verdict.outcome);
    part[k] = part_number(found.part_a);
  });
  return py::make_tuple(verdicts, parts);
}

py::object distances_of_compound(const PyCompound& a, const PyBody& b, const Floats& rows,
                                 const std::optional<Floats>& translations, double relative_gap, double max_distance,
                                 int threads) {
  const PoseRows poses(rows, translations);
  py::array_t<PartRow> result(static_cast<py::ssize_t>(poses.size()));
  PartRow* const to = result.mutable_data();
  SeparationSettings settings;
  settings.relative_gap = relative_gap;
  settings.max_distance = max_distance;
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    const CompoundSeparation found = distance(a.compound, b.body.body, pose, settings);
    to[k] = row_of(found.separation, found.part_a);
    to[k].lower = std::max(to[k].lower, 0.0);  // a distance is never below 0
  });
  return result;
}

py::object rays_into_compound(const PyCompound& a, const Floats& origins, const Floats& dirs, double until,
                              int threads) {
  return rays_into(a.compound, origins, dirs, until, threads);
}
py::object casts_into_compound(const PyCompound& a, const PyBody& b, const Floats& rows,
                               const std::optional<Floats>& translations, const Floats& motions, double until,
                               int threads) {
  return casts_into(a.compound, b, rows, translations, motions, until, threads);
}
// Motions of as many bodies as there are poses.
struct MotionRows {
  Rows3 velocities, angular_velocities;

  MotionRows(const Floats& v, const Floats& w, std::size_t n_poses) : velocities(v), angular_velocities(w) {
    require_rows(velocities.size(), n_poses, "velocities");
    require_rows(angular_velocities.size(), n_poses, "angular velocities");
  }
  RigidMotion operator[](std::size_t k) const { return {velocities[k], angular_velocities[k]}; }
};
py::object impacts_on_compound(const PyCompound& a, const PyBody& b, const Floats& rows,
                               const std::optional<Floats>& translations, const Floats& velocities,
                               const Floats& angular_velocities, const Floats& velocities_a,
                               const Floats& angular_velocities_a, double until, int threads) {
  const PoseRows poses(rows, translations);
  const MotionRows of_b(velocities, angular_velocities, poses.size());
  const MotionRows of_a(velocities_a, angular_velocities_a, poses.size());
  py::array_t<PartContactRow> result(static_cast<py::ssize_t>(poses.size()));
  PartContactRow* const to = result.mutable_data();
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    to[k] = contact_row_of(time_of_impact(a.compound, b.body.body, pose, of_a[k], of_b[k], until));
  });
  return result;
}
py::object impacts_on_half_space(const HalfSpace& a, const PyBody& b, const Floats& rows,
                                 const std::optional<Floats>& translations, const Floats& velocities,
                                 const Floats& angular_velocities, double until, int threads) {
  const PoseRows poses(rows, translations);
  const MotionRows motions(velocities, angular_velocities, poses.size());
  py::array_t<PartContactRow> result(static_cast<py::ssize_t>(poses.size()));
  PartContactRow* const to = result.mutable_data();
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    to[k] = contact_row_of(time_of_impact(a, b.body.body, pose, motions[k], until));
  });
  return result;
}

py::object distances_of_half_space(const HalfSpace& a, const PyBody& b, const Floats& rows,
                                   const std::optional<Floats>& translations, int threads) {
  const PoseRows poses(rows, translations);
  py::array_t<PartRow> result(static_cast<py::ssize_t>(poses.size()));
  PartRow* const to = result.mutable_data();
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    to[k] = row_of(signed_distance(a, b.body.body, pose), Compound::kNoPart);
  });
  return result;
}

py::object contacts_with_half_space(const HalfSpace& a, const PyBody& b, const Floats& rows,
                                    const std::optional<Floats>& translations, double margin) {
  const PoseRows poses(rows, translations);
  if (poses.size() != 1) throw UsageError("not one pose - give one");
  std::vector<PlaneContact> found;
  PlaneContacts(b.body.body).find(a, poses[0], margin, found);
  py::array_t<PlaneContactRow> result(static_cast<py::ssize_t>(found.size()));
  PlaneContactRow* to = result.mutable_data();
  for (const PlaneContact& contact : found) {
    python::put(to->point_a, contact.point_a);
    python::put(to->point_b, contact.point_b);
    to->distance = contact.signed_distance;
    to->feature = contact.feature;
    ++to;
  }
  return result;
}

}  // namespace

void bind_worlds(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(PartRow, value, lower, upper, normal, point_a, point_b, verdict, part);
  PYBIND11_NUMPY_DTYPE(PlaneContactRow, point_a, point_b, distance, feature);
  PYBIND11_NUMPY_DTYPE(PartContactRow, time, lower, upper, normal, point_a, point_b, verdict, part);
  const auto origins = py::arg("origins"), dirs = py::arg("directions"), motions = py::arg("motions"),
             until = py::arg("until");
  const auto body = py::arg("body"), poses = py::arg("poses"), threads = py::arg("threads");
  const auto translations = py::arg("translations").none(true);
  const auto velocities = py::arg("velocities"), angular_velocities = py::arg("angular_velocities");
  py::class_<HalfSpace>(module, "HalfSpace")
      .def(py::init([](const std::vector<double>& normal, double offset) {
             if (normal.size() != 3) throw UsageError("a normal has three numbers - give three");
             return HalfSpace({normal[0], normal[1], normal[2]}, offset);
           }),
           py::arg("normal"), py::arg("offset"))
      .def("signed_distance", &distances_of_half_space, body, poses, translations, threads)
      .def("ray_cast", &rays_into<HalfSpace>, origins, dirs, until, threads)
      .def("linear_cast", &casts_into<HalfSpace>, body, poses, translations, motions, until, threads)
      .def("time_of_impact", &impacts_on_half_space, body, poses, translations, velocities, angular_velocities, until,
           threads)
      .def("contacts", &contacts_with_half_space, body, poses, translations, py::arg("margin"));
  py::class_<PyCompound>(module, "Compound")
      .def(py::init(&compound_of_parts), py::arg("bodies"), poses, translations)
      .def("__len__", [](const PyCompound& self) { return self.compound.size(); })
      .def("overlap", &overlaps_of_compound, body, poses, translations, threads)
      .def("distance", &distances_of_compound, body, poses, translations, py::arg("relative_gap"),
           py::arg("max_distance"), threads)
      .def("ray_cast", &rays_into_compound, origins, dirs, until, threads)
      .def("linear_cast", &casts_into_compound, body, poses, translations, motions, until, threads)
      .def("time_of_impact", &impacts_on_compound, body, poses, translations, velocities, angular_velocities,
           py::arg("velocities_a"), py::arg("angular_velocities_a"), until, threads);
  module.def("compound_of_corners", &compound_of_corners, py::arg("corners"));
}

}  // namespace vex::python
