// What runs the kernels: a device of OpenCL, of CUDA, or this processor by the same source as C++. Knows nothing of
// the library, so that it can be compiled where there is none.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/opencl/pair.h"

namespace vex {

/// Of a range of trials: what the kernels have proven, and the numbers of the trials that they leave open, ascending.
struct ProvenTrials {
  std::uint64_t n_hits = 0, n_misses = 0;
  std::vector<std::uint64_t> open;
};

class Device {
 public:
  virtual ~Device() = default;
  virtual std::string name() const = 0;
  virtual void set_pair(const VexPair& pair) = 0;

  /// Of the pair's trials first ... first + n - 1.
  ProvenTrials run(std::uint64_t seed, std::uint64_t first, std::uint64_t n);

  /// The poses of trials, in VEX_POSE_COLUMNS columns of n numbers.
  virtual std::vector<double> poses(std::uint64_t seed, std::uint64_t first, std::uint32_t n) = 0;
  /// VEX_OPEN, VEX_DISJOINT or VEX_OVERLAP of each of n poses in such columns.
  virtual std::vector<int> answers(const std::vector<double>& columns, std::uint32_t n) = 0;

 protected:
  struct Counts {
    std::uint32_t hits = 0, misses = 0, listed = 0, open = 0;
  };
  /// Trials that one start of the kernels takes.
  virtual std::uint32_t most_trials() const = 0;
  /// Of n trials, at most so many; `open` has the open ones, less `first`.
  virtual Counts run_part(std::uint64_t seed, std::uint64_t first, std::uint32_t n,
                          std::vector<std::uint32_t>& open) = 0;
};

/// The first device with doubles, a GPU if there is one; null where there is none.
std::unique_ptr<Device> opencl_device();
std::unique_ptr<Device> cuda_device();
/// `n_threads` of this processor.
std::unique_ptr<Device> cpp_device(int n_threads = 1);

}  // namespace vex
