#include "python/bindings/arrays.h"

#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
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

// One copy for each instruction set, and the loader takes the processor's. What they answer may differ by rounding,
// where rows are looked at one by one then.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VEX_ANY_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define VEX_ANY_PROCESSOR
#endif

/// Whether all columns are of rotations, to within Pose::kRotationTolerance for sure. What is near the tolerance is
/// not.
///
/// With a = |x|^2 - 1, b = |y|^2 - 1 and c = x . y of the first two rows and d = z - x cross y of the third, the
/// entries of R R^T - 1 are a, b, c, x . d, y . d and, to first order, a + b + 2 w . d with w = x cross y. Its
/// Frobenius norm is at most 2 (|a| + |b| + |c|) + 2 |d|, and twice the sum that is looked at here; the largest entry
/// of R^T R - 1, which has the same eigenvalues, is no larger. The terms of second order are some 1e-12, those of
/// rounding 1e-15, and det R = |w|^2 + w . d is above 0.
VEX_ANY_PROCESSOR bool are_rotations(const double* columns, std::size_t stride, std::size_t n) {
  constexpr double kSure = 0.49 * Pose::kRotationTolerance;
  const auto column = [&](std::size_t i) { return columns + i * stride; };
  const double *xx = column(0), *xy = column(1), *xz = column(2), *yx = column(3), *yy = column(4), *yz = column(5);
  const double *zx = column(6), *zy = column(7), *zz = column(8);
  int n_unsure = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double sum =
        ((std::fabs(xx[k] * xx[k] + xy[k] * xy[k] + xz[k] * xz[k] - 1.0) +
          std::fabs(yx[k] * yx[k] + yy[k] * yy[k] + yz[k] * yz[k] - 1.0)) +
         (std::fabs(xx[k] * yx[k] + xy[k] * yy[k] + xz[k] * yz[k]) +
          std::fabs(xy[k] * yz[k] - xz[k] * yy[k] - zx[k]))) +
        (std::fabs(xz[k] * yx[k] - xx[k] * yz[k] - zy[k]) + std::fabs(xx[k] * yy[k] - xy[k] * yx[k] - zz[k]));
    n_unsure += sum <= kSure ? 0 : 1;  // NaN is not
  }
  return n_unsure == 0;
}

/// Rows of so many numbers, two at a time, as columns.
template <std::size_t width>
void transpose(const double* rows, std::size_t n, double* columns) {
  constexpr std::size_t kStride = PacketOverlap::kStride;
  std::size_t k = 0;
  for (; k + 2 <= n; k += 2) {
    for (std::size_t i = 0; i < width; ++i) {
      columns[i * kStride + k] = rows[width * k + i];
      columns[i * kStride + k + 1] = rows[width * (k + 1) + i];
    }
  }
  for (; k < n; ++k) {
    for (std::size_t i = 0; i < width; ++i) columns[i * kStride + k] = rows[width * k + i];
  }
}

VEX_ANY_PROCESSOR bool are_finite(const double* columns, std::size_t stride, std::size_t n) {
  const double *x = columns, *y = columns + stride, *z = columns + 2 * stride;
  int n_others = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double nothing = 0.0 * x[k] + 0.0 * y[k] + 0.0 * z[k];  // 0 times what is not finite is NaN
    n_others += nothing == 0.0 ? 0 : 1;
  }
  return n_others == 0;
}

void prefetch(const double* from, const double* to) {
  constexpr std::size_t kLine = 64 / sizeof(double);
  for (; from < to; from += kLine) __builtin_prefetch(from, 0, 2);
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
  double* const translations = columns + 9 * kStride;
  bool are_poses = true;
  if (translations_ != nullptr) {
    transpose<9>(rows_ + 9 * first, n, columns);
    transpose<3>(translations_ + 3 * first, n, translations);
    are_poses = are_rotations(columns, kStride, n) && are_finite(translations, kStride, n);
  } else {
    alignas(64) double row[7][kStride];
    transpose<7>(rows_ + 7 * first, n, row[0]);
    for (std::size_t i = 0; i < 3; ++i) std::copy(row[i], row[i] + n, translations + i * kStride);
    are_poses = are_finite(translations, kStride, n);
    try {
      // Of any quaternion these are rotations to some roundings: nothing else is to be checked.
      if (are_poses) rotations_from_quaternions({row[3], row[4], row[5], row[6]}, n, columns, kStride);
    } catch (const InputError&) {
      are_poses = false;
    }
  }
  if (are_poses) return;
  for (std::size_t k = first; k < last; ++k) (*this)[k];  // throws for one of them, and names the row
}

void PoseRows::prefetch_rows(std::size_t first, std::size_t last) const {
  last = std::min(last, n_);
  if (first >= last) return;
  const std::size_t width = translations_ != nullptr ? 9 : 7;
  prefetch(rows_ + width * first, rows_ + width * last);
  if (translations_ != nullptr) prefetch(translations_ + 3 * first, translations_ + 3 * last);
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

void take_gil(const std::function<void()>& take) {
  // The main thread itself ends the interpreter with the GIL; it comes here from destructors then.
  const auto is_ending = [] {
#if PY_VERSION_HEX >= 0x030d0000
    return Py_IsFinalizing() != 0 && PyGILState_Check() == 0;
#else
    return _Py_IsFinalizing() != 0 && PyGILState_Check() == 0;
#endif
  };
  // Once it has ended it says neither that it is ending nor who has the GIL.
  const auto has_ended = [] { return Py_IsInitialized() == 0 && ::gettid() != ::getpid(); };
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::hours(1)); };
  while (is_ending() || has_ended()) sleep();
  try {
    take();
  } catch (const abi::__forced_unwind&) {
    while (true) sleep();  // the end has begun while the thread waited
  }
}

namespace {
thread_local int depth_of_calls = 0;
}  // namespace

CallOfPython::CallOfPython() { ++depth_of_calls; }
CallOfPython::~CallOfPython() { --depth_of_calls; }
bool is_called_by_a_query() { return depth_of_calls > 0; }

bool SignalWatch::has_thrown() {
  if (error_) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + kPause;
  const WithGil with_gil;
  const CallOfPython call;
  if (PyErr_CheckSignals() == 0) return false;
  try {
    throw py::error_already_set();
  } catch (...) {
    error_ = std::current_exception();
  }
  return true;
}

}  // namespace vex::python
