#include "python/bindings/arrays.h"

#include <array>
#include <cmath>
#include <thread>

#include "engine/numeric/quaternion.h"
#include "engine/sampling/monte_carlo.h"

namespace vex::python {
namespace {

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

/// Pose's own check of columns of rotations: whether all pass it. What is near the tolerance may fail here, by rounding
/// in another order, and is looked at one by one then.
bool are_rotations(const double* columns, std::size_t stride, std::size_t n) {
  constexpr double kSure = 0.5 * Pose::kRotationTolerance;
  const auto column = [&](std::size_t i) { return columns + i * stride; };
  const double *xx = column(0), *xy = column(1), *xz = column(2), *yx = column(3), *yy = column(4), *yz = column(5);
  const double *zx = column(6), *zy = column(7), *zz = column(8);
  int n_unsure = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto off = [k](const double* a0, const double* a1, const double* a2, const double* b0, const double* b1,
                         const double* b2,
                         double one) { return std::fabs((a0[k] * b0[k] + a1[k] * b1[k]) + a2[k] * b2[k] - one); };
    const double sum = (off(xx, yx, zx, xx, yx, zx, 1.0) + off(xy, yy, zy, xy, yy, zy, 1.0)) +
                       (off(xz, yz, zz, xz, yz, zz, 1.0) + off(xx, yx, zx, xy, yy, zy, 0.0)) +
                       (off(xx, yx, zx, xz, yz, zz, 0.0) + off(xy, yy, zy, xz, yz, zz, 0.0));
    const double determinant = ((xy[k] * yz[k] - xz[k] * yy[k]) * zx[k] + (xz[k] * yx[k] - xx[k] * yz[k]) * zy[k]) +
                               (xx[k] * yy[k] - xy[k] * yx[k]) * zz[k];
    n_unsure += sum <= kSure && determinant > 0.0 ? 0 : 1;
  }
  return n_unsure == 0;
}

}  // namespace

Rows3::Rows3(const Floats& array) : data_(array.data()), n_(0) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw UsageError("not an array of vectors (its shape is " + shape_text(array) + ") - give one of shape (N, 3)");
  }
  n_ = static_cast<std::size_t>(array.shape(0));
}

PoseRows::PoseRows(const Floats& rows, const std::optional<Floats>& translations) : rows_(rows.data()) {
  if (!translations) {
    if (rows.ndim() != 2 || rows.shape(1) != 7) {
      throw UsageError("not an array of poses (its shape is " + shape_text(rows) +
                       ") - give one of shape (N, 7), rows of x, y, z, qw, qx, qy, qz, or a pair of rotations (N, 3, "
                       "3) and translations (N, 3)");
    }
  } else {
    if (rows.ndim() != 3 || rows.shape(1) != 3 || rows.shape(2) != 3) {
      throw UsageError("not an array of rotations (its shape is " + shape_text(rows) +
                       ") - give one of shape (N, 3, 3)");
    }
    if (translations->ndim() != 2 || translations->shape(1) != 3 || translations->shape(0) != rows.shape(0)) {
      throw UsageError("not a translation for each rotation (shapes " + shape_text(*translations) + " and " +
                       shape_text(rows) + ") - give one of shape (N, 3)");
    }
    translations_ = translations->data();
  }
  n_ = static_cast<std::size_t>(rows.shape(0));
}

Transformd PoseRows::transform(std::size_t k) const {
  if (translations_ != nullptr) {
    const double* const r = rows_ + 9 * k;
    return {vec3_at(r), vec3_at(r + 3), vec3_at(r + 6), vec3_at(translations_ + 3 * k)};
  }
  const double* const row = rows_ + 7 * k;
  Transformd pose = rotation_from_quaternion(row[3], row[4], row[5], row[6]);
  pose.translation = vec3_at(row);
  return pose;
}

Pose PoseRows::operator[](std::size_t k) const {
  try {
    return Pose(transform(k));
  } catch (const InputError& error) {
    throw InputError("pose " + std::to_string(k) + ": " + error.what());
  }
}

void PoseRows::set_columns(std::size_t first, std::size_t last, double* columns) const {
  constexpr std::size_t kStride = PacketOverlap::kStride;
  const std::size_t n = last - first;
  bool are_poses = true;
  for (std::size_t k = 0; k < n; ++k) {
    const double* const t = translations_ != nullptr ? translations_ + 3 * (first + k) : rows_ + 7 * (first + k);
    for (std::size_t i = 0; i < 3; ++i) columns[(9 + i) * kStride + k] = t[i];
    are_poses &= is_finite(vec3_at(t));
  }
  if (translations_ != nullptr) {
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < 9; ++i) columns[i * kStride + k] = rows_[9 * (first + k) + i];
    }
    are_poses = are_poses && are_rotations(columns, kStride, n);
  } else if (are_poses) {
    std::array<std::array<double, kStride>, 4> quaternion;
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < 4; ++i) quaternion[i][k] = rows_[7 * (first + k) + 3 + i];
    }
    try {
      // Of any quaternion these are rotations to some roundings: nothing else is to be checked.
      rotations_from_quaternions(
          {quaternion[0].data(), quaternion[1].data(), quaternion[2].data(), quaternion[3].data()}, n, columns,
          kStride);
    } catch (const InputError&) {
      are_poses = false;
    }
  }
  if (are_poses) return;
  for (std::size_t k = first; k < last; ++k) (*this)[k];  // throws for one of them, and names the row
}

py::tuple arrays_of(const Transformd& pose) {
  Floats rotation({3, 3}), translation(3);
  double* to = rotation.mutable_data();
  for (const Vec3d* const row : {&pose.row_x, &pose.row_y, &pose.row_z}) {
    put(to, *row);
    to += 3;
  }
  put(translation.mutable_data(), pose.translation);
  return py::make_tuple(rotation, translation);
}

int number_of_threads(int threads) {
  if (threads < 0 || threads > kMostThreads) {
    throw UsageError("no number of threads (" + std::to_string(threads) + ") - give one from 1 to " +
                     std::to_string(kMostThreads) + ", or None for one a core");
  }
  if (threads > 0) return threads;
  const unsigned n_cores = std::thread::hardware_concurrency();
  return n_cores == 0 ? 1 : static_cast<int>(std::min<unsigned>(n_cores, kMostThreads));
}

void sleep_if_ending() {
#if PY_VERSION_HEX >= 0x030d0000
  const auto is_ending = [] { return Py_IsFinalizing() != 0; };
#else
  const auto is_ending = [] { return _Py_IsFinalizing() != 0; };
#endif
  // The main thread itself ends the interpreter with the GIL; it comes here from destructors then.
  while (is_ending() && PyGILState_Check() == 0) std::this_thread::sleep_for(std::chrono::hours(1));
}

SignalWatch::SignalWatch() {
  const py::object main_thread = py::module_::import("threading").attr("main_thread")();
  is_main_ = main_thread.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

bool SignalWatch::has_thrown() {
  if (!is_main_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds(100);
  const WithGil with_gil;
  if (PyErr_CheckSignals() == 0) return false;
  try {
    throw py::error_already_set();
  } catch (...) {
    error_ = std::current_exception();
  }
  return true;
}

}  // namespace vex::python
