// What is made of arrays of poses: products, inverses, what is between two, and one body's as another sees it.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>

#include "engine/numeric/pose_algebra.h"
#include "python/bindings/body.h"

namespace vex::python {
namespace {

/// make(k) for each row, in the order of rows by one thread; what it refuses is named by its row.
template <class Make>
void for_each_pose(std::size_t n, const Make& make) {
  over_each_row(n, 1, [&](std::size_t k) {
    try {
      make(k);
    } catch (const InputError& error) {
      const std::string message = error.what();
      throw InputError(message.starts_with("pose ") ? message : "pose " + std::to_string(k) + ": " + message);
    }
  });
}

/// Rotations (N, 3, 3) and translations (N, 3): make(k) for each row.
template <class Make>
py::tuple made_poses(std::size_t n, const Make& make) {
  const auto rows = static_cast<py::ssize_t>(n);
  Floats rotations({rows, py::ssize_t{3}, py::ssize_t{3}}), translations({rows, py::ssize_t{3}});
  double *const rotation = rotations.mutable_data(), *const translation = translations.mutable_data();
  for_each_pose(n, [&](std::size_t k) {
    const Pose made = make(k);
    const Transformd& pose = made.a_from_b();
    double* to = rotation + 9 * k;
    for (const Vec3d* const row : {&pose.row_x, &pose.row_y, &pose.row_z}) {
      put(to, *row);
      to += 3;
    }
    put(translation + 3 * k, pose.translation);
  });
  return py::make_tuple(rotations, translations);
}

void require_pairs(std::size_t n_first, std::size_t n_second) {
  if (n_first != n_second) {
    throw UsageError("not as many poses (" + std::to_string(n_first) + " and " + std::to_string(n_second) +
                     ") - give as many, or one");
  }
}

using Translations = std::optional<Floats>;

py::tuple placed(const Floats& rows, const Translations& translations) {
  const PoseRows poses(rows, translations);
  return made_poses(poses.size(), [&](std::size_t k) { return poses[k]; });
}

py::tuple products(const Floats& first_rows, const Translations& first_translations, const Floats& second_rows,
                   const Translations& second_translations) {
  const PoseRows first(first_rows, first_translations), second(second_rows, second_translations);
  require_pairs(first.size(), second.size());
  return made_poses(first.size(), [&](std::size_t k) { return first[k] * second[k]; });
}

py::tuple inverses(const Floats& rows, const Translations& translations) {
  const PoseRows poses(rows, translations);
  return made_poses(poses.size(), [&](std::size_t k) { return inverse(poses[k]); });
}

py::tuple interpolations(const Floats& first_rows, const Translations& first_translations, const Floats& second_rows,
                         const Translations& second_translations, const Floats& parts) {
  const PoseRows first(first_rows, first_translations), second(second_rows, second_translations);
  require_pairs(first.size(), second.size());
  require_pairs(first.size(), static_cast<std::size_t>(parts.size()));
  const double* const part = parts.data();
  return made_poses(first.size(), [&](std::size_t k) { return interpolated(first[k], second[k], part[k]); });
}

py::tuple relative_poses(const Floats& first_rows, const Translations& first_translations, const Floats& second_rows,
                         const Translations& second_translations) {
  const PoseRows first(first_rows, first_translations), second(second_rows, second_translations);
  require_pairs(first.size(), second.size());
  return made_poses(first.size(), [&](std::size_t k) { return relative_pose(first[k], second[k]); });
}

Floats relative_pose_errors(const Floats& first_rows, const Translations& first_translations, const Floats& second_rows,
                            const Translations& second_translations, double reach_b, double ball_radius_a) {
  const PoseRows first(first_rows, first_translations), second(second_rows, second_translations);
  require_pairs(first.size(), second.size());
  if (!(reach_b >= 0.0 && ball_radius_a >= 0.0)) throw UsageError("a reach or a radius is a length from 0 up");
  Floats errors(static_cast<py::ssize_t>(first.size()));
  double* const to = errors.mutable_data();
  for_each_pose(first.size(),
                [&](std::size_t k) { to[k] = relative_pose_error(first[k], second[k], reach_b, ball_radius_a); });
  return errors;
}

Floats quaternions(const Floats& rows, const Translations& translations) {
  const PoseRows poses(rows, translations);
  Floats result({static_cast<py::ssize_t>(poses.size()), py::ssize_t{4}});
  double* const to = result.mutable_data();
  for_each_pose(poses.size(), [&](std::size_t k) {
    const std::array<double, 4> q = quaternion_of(poses[k].a_from_b());
    std::copy(q.begin(), q.end(), to + 4 * k);
  });
  return result;
}

}  // namespace

void bind_poses(py::module_& module) {
  const auto poses = py::arg("poses"), first = py::arg("first"), second = py::arg("second");
  const auto translations = py::arg("translations").none(true);
  const auto first_translations = py::arg("first_translations").none(true);
  const auto second_translations = py::arg("second_translations").none(true);
  module.def("placed", &placed, poses, translations);
  module.def("product", &products, first, first_translations, second, second_translations);
  module.def("inverse", &inverses, poses, translations);
  module.def("interpolated", &interpolations, first, first_translations, second, second_translations, py::arg("parts"));
  module.def("relative_pose", &relative_poses, first, first_translations, second, second_translations);
  module.def("relative_pose_error", &relative_pose_errors, first, first_translations, second, second_translations,
             py::arg("reach_b"), py::arg("ball_radius_a"));
  module.def("quaternion_of", &quaternions, poses, translations);
}

}  // namespace vex::python
