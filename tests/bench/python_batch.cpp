// The C++ library's own batch of the same poses, for tests/bench/python_bench.py: a module, so that both are timed in
// one process. Poses are made before the clock starts.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <ctime>
#include <vector>

#include "engine/numeric/quaternion.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/separation.h"
#include "shapes/any_shape.h"

namespace py = pybind11;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<vex::Pose> poses_of(const py::array_t<double, py::array::c_style>& rows) {
  std::vector<vex::Pose> poses;
  poses.reserve(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    const double* const row = rows.data(k);
    vex::Transformd pose = vex::rotation_from_quaternion(row[3], row[4], row[5], row[6]);
    pose.translation = {row[0], row[1], row[2]};
    poses.emplace_back(pose);
  }
  return poses;
}

/// Processor time of making poses from these rows, each checked.
double poses(const py::array_t<double, py::array::c_style>& rows) {
  const double start = processor_seconds();
  const std::vector<vex::Pose> made = poses_of(rows);
  return made.empty() ? 0.0 : processor_seconds() - start;
}

/// Processor time, and the number of overlaps.
py::tuple overlap(const std::string& a, const std::string& b, const py::array_t<double, py::array::c_style>& rows) {
  const vex::Body body_a = vex::parse_shape(a), body_b = vex::parse_shape(b);
  const std::vector<vex::Pose> poses = poses_of(rows);
  std::vector<vex::Verdict> verdicts(poses.size());
  const auto backend = vex::gjk_backend().make(body_a.body, body_b.body);
  const double start = processor_seconds();
  backend->decide(poses, verdicts);
  const double seconds = processor_seconds() - start;
  std::size_t n = 0;
  for (const vex::Verdict& verdict : verdicts) n += verdict.outcome == vex::Outcome::overlap ? 1 : 0;
  return py::make_tuple(seconds, n);
}

/// Processor time, and the sum of the distances.
py::tuple distance(const std::string& a, const std::string& b, const py::array_t<double, py::array::c_style>& rows) {
  const vex::Body body_a = vex::parse_shape(a), body_b = vex::parse_shape(b);
  const std::vector<vex::Pose> poses = poses_of(rows);
  std::vector<vex::Separation> found(poses.size());
  const double start = processor_seconds();
  for (std::size_t k = 0; k < poses.size(); ++k) found[k] = vex::distance(body_a.body, body_b.body, poses[k]);
  const double seconds = processor_seconds() - start;
  double sum = 0.0;
  for (const vex::Separation& each : found) sum += each.signed_distance;
  return py::make_tuple(seconds, sum);
}

}  // namespace

PYBIND11_MODULE(vex_python_batch, module) {
  module.def("poses", &poses);
  module.def("overlap", &overlap);
  module.def("distance", &distance);
}
