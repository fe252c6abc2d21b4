// Arrays of NumPy on their way to the engine and back, and loops over their rows.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/numeric/pose.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/scene/threads.h"

namespace vex::python {

namespace py = pybind11;

/// Calls what takes the GIL. While the interpreter ends no thread but the main one may have it, and one that asks for
/// it or waits for it is unwound through C++ by force, which ends the process with an error. Such a thread sleeps
/// instead, until the process has ended.
void take_gil(const std::function<void()>& take);

/// As py::gil_scoped_release, but for that.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;
  ~WithoutGil() {
    take_gil([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

/// As py::gil_scoped_acquire, but for that.
class WithGil {
 public:
  WithGil() {
    take_gil([this] { gil_.emplace(); });
  }

 private:
  std::optional<py::gil_scoped_acquire> gil_;
};

/// A verdict in arrays.
inline std::int8_t number_of(Outcome outcome) {
  return outcome == Outcome::overlap ? 1 : outcome == Outcome::disjoint ? 0 : -1;
}

/// The Python side has made them contiguous and checked what they are of.
using Floats = py::array_t<double, py::array::c_style>;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline Vec3d vec3_at(const double* row) { return {row[0], row[1], row[2]}; }
inline void put(double* to, const Vec3d& v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}
inline void put_nan(double* to) { put(to, {kNan, kNan, kNan}); }
/// Into a row that has a contact's points, distance and features.
template <class Row, class Contact>
void put_contact(Row& row, const Contact& contact) {
  put(row.point_a, contact.point_a);
  put(row.point_b, contact.point_b);
  row.distance = contact.signed_distance;
  row.feature_a = contact.feature_a;
  row.feature_b = contact.feature_b;
}

/// The rows of an array (N, 3). Refers to it.
class Rows3 {
 public:
  explicit Rows3(const Floats& array);
  std::size_t size() const { return n_; }
  Vec3d operator[](std::size_t k) const { return vec3_at(data_ + 3 * k); }

 private:
  const double* data_;
  std::size_t n_;
};

/// Poses of B in A's frame: an array (N, 7) of x, y, z, qw, qx, qy, qz; or rotations (N, 3, 3) and translations (N, 3).
/// Refers to the arrays.
class PoseRows {
 public:
  PoseRows(const Floats& rows, const std::optional<Floats>& translations);

  std::size_t size() const { return n_; }
  /// Throws InputError, which names the row.
  Pose operator[](std::size_t k) const;
  /// The rows first ... last - 1, at most PacketOverlap::kMostTrials, as the columns of a PoseTable of its stride.
  void set_columns(std::size_t first, std::size_t last, double* columns) const;
  /// Rows that will be read soon, as many of them as there are.
  void prefetch_rows(std::size_t first, std::size_t last) const;

 private:
  Transformd transform(std::size_t k) const;

  const double* rows_;
  const double* translations_ = nullptr;  // null where a row is a translation and a quaternion
  std::size_t n_ = 0;
};

/// R (3, 3) and t (3,).
py::tuple arrays_of(const Transformd& pose);

/// As many threads as there are cores where `threads` is 0. Throws UsageError where it is below 0 or far too many.
int number_of_threads(int threads);

/// Asks the interpreter for signals now and then. On other threads than Python's main one there are none.
class SignalWatch {
 public:
  /// Whether a signal's handler has thrown; then `rethrow` does. Asked without the GIL, which it takes, ten times a
  /// second at most.
  bool has_thrown();
  void rethrow() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr std::chrono::milliseconds kPause{100};

  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kPause;
  std::exception_ptr error_;
};

/// While one lives, this thread is in Python's code that a query of its has called: a support function or a signal's
/// handler.
class CallOfPython {
 public:
  CallOfPython();
  CallOfPython(const CallOfPython&) = delete;
  CallOfPython& operator=(const CallOfPython&) = delete;
  ~CallOfPython();
};
/// Whether this thread is.
bool is_called_by_a_query();

/// What work() gives, done without the GIL. What a signal's handler throws, as Ctrl-C does, ends the work where it asks
/// (engine/numeric/interruption.h), and is thrown again.
template <class Work>
auto interruptibly(const Work& work) {
  SignalWatch watch;
  const WithoutGil without_gil;
  const Interruption interruption([&watch] { return watch.has_thrown(); });
  try {
    return work();
  } catch (const Interrupted&) {
    watch.rethrow();
    throw;
  }
}

namespace detail {

/// work(first, last) of each block, on several threads, `make` having made one `work` for each. Called without the GIL.
template <class Make>
class BlockLoop {
 public:
  BlockLoop(std::size_t n, std::size_t block, const Make& make) : n_(n), block_(block), make_(make) {}

  void run(int n_threads);

 private:
  void work();
  void fail(std::size_t first) {
    const std::lock_guard lock(mutex_);
    if (first < failed_) {
      failed_ = first;
      failure_ = std::current_exception();
    }
    stop_ = true;
  }

  std::size_t n_, block_;
  const Make& make_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false}, is_interrupted_{false};
  std::mutex mutex_;
  std::size_t failed_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure_;
};

template <class Make>
void BlockLoop<Make>::work() {
  std::size_t first = 0;
  try {
    auto&& block = make_();
    // Blocks are taken in their order and one that was taken is finished, so what fails first is the same for any
    // number of threads.
    for (first = next_.fetch_add(block_); first < n_ && !stop_; first = next_.fetch_add(block_)) {
      block(first, std::min(first + block_, n_));
      end_if_interrupted();
    }
  } catch (const Interrupted&) {
    is_interrupted_ = true;
    stop_ = true;
  } catch (...) {
    fail(first);
  }
}

template <class Make>
void BlockLoop<Make>::run(int n_threads) {
  const std::size_t n_blocks = (n_ + block_ - 1) / block_;
  on_threads(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(n_threads), n_blocks)),
             [&](int) { work(); });
  if (failure_) std::rethrow_exception(failure_);
  if (is_interrupted_) throw Interrupted();
}

}  // namespace detail

/// work(first, last) for all rows in [0, n), by so many threads, without the GIL; `make()` makes one `work` for each
/// thread. Of what is thrown the first in the order of the rows is thrown again here; so is what a signal's handler
/// throws, as Ctrl-C does.
template <class Make>
void over_rows(std::size_t n, int threads, std::size_t block, const Make& make) {
  const int n_threads = number_of_threads(threads);
  if (n == 0) return;
  interruptibly([&] { detail::BlockLoop<Make>(n, block, make).run(n_threads); });
}

/// Of queries that take a tenth of a microsecond or more.
inline constexpr std::size_t kRowsABlock = 32;

/// work(k) for each row.
template <class Work>
void over_each_row(std::size_t n, int threads, const Work& work) {
  over_rows(n, threads, kRowsABlock, [&work] {
    return [&work](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) work(k);
    };
  });
}

/// work(k, pose) for each pose.
template <class Work>
void over_each_pose(const PoseRows& poses, int threads, const Work& work) {
  over_rows(poses.size(), threads, kRowsABlock, [&] {
    return [&](std::size_t first, std::size_t last) {
      alignas(64) double columns[kPoseColumns][PacketOverlap::kStride];
      poses.set_columns(first, last, columns[0]);
      const PoseTable table{columns[0], PacketOverlap::kStride, last - first};
      for (std::size_t k = first; k < last; ++k) work(k, Pose::unchecked(table.pose(k - first)));
    };
  });
}

}  // namespace vex::python
