// The kernels through CUDA, for machines that have no OpenCL: the same source (kernel_as_cpp.h), no operation fused.
// Not part of the build, but made by hand, in this folder:
//   nvcc -O3 -std=c++17 -fmad=false -arch=native -Xcompiler -ffp-contract=off -DVEX_WITH_CUDA -I../..
//     cuda_device.cu cpp_device.cpp device.cpp device_hits.cpp -o FOLDER/vex_device_hits
#include <cuda_runtime.h>

#include <stdexcept>

#include "tests/opencl/device.h"
#include "tests/opencl/kernel_as_cpp.h"

namespace vex {
namespace {

void require(cudaError_t status, const char* what) {
  if (status != cudaSuccess)
    throw std::runtime_error(std::string("CUDA: ") + what + ": " + cudaGetErrorString(status));
}

/// `n` values of the device's memory.
template <class T>
class Buffer {
 public:
  explicit Buffer(std::size_t n) { require(cudaMalloc(&at_, n * sizeof(T)), "no memory"); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { cudaFree(at_); }

  T* at() const { return at_; }
  void write(const T* from, std::size_t n) const {
    require(cudaMemcpy(at_, from, n * sizeof(T), cudaMemcpyHostToDevice), "no write");
  }
  void read(T* to, std::size_t n) const {
    require(cudaMemcpy(to, at_, n * sizeof(T), cudaMemcpyDeviceToHost), "no read");
  }

 private:
  T* at_ = nullptr;
};

class CudaDevice final : public Device {
 public:
  std::string name() const override {
    cudaDeviceProp properties;
    require(cudaGetDeviceProperties(&properties, 0), "no properties");
    return std::string("CUDA on ") + properties.name;
  }

  void set_pair(const VexPair& pair) override { pair_.write(&pair, 1); }

  std::vector<double> poses(std::uint64_t seed, std::uint64_t first, std::uint32_t n) override {
    std::vector<double> columns(std::size_t{VEX_POSE_COLUMNS} * n);
    const Buffer<double> at(columns.size());
    vex_kernel::poses<<<groups_of(n, kGroup), kGroup>>>(pair_.at(), seed, first, n, at.at());
    require(cudaGetLastError(), "no start of poses");
    at.read(columns.data(), columns.size());
    return columns;
  }

  std::vector<int> answers(const std::vector<double>& columns, std::uint32_t n) override {
    std::vector<int> found(n);
    const Buffer<double> from(columns.size());
    const Buffer<int> at(n);
    from.write(columns.data(), columns.size());
    vex_kernel::answers<<<groups_of(n, kGroup), kGroup>>>(pair_.at(), n, from.at(), at.at());
    require(cudaGetLastError(), "no start of answers");
    at.read(found.data(), n);
    return found;
  }

 protected:
  std::uint32_t most_trials() const override { return kMostTrials; }

  Counts run_part(std::uint64_t seed, std::uint64_t first, std::uint32_t n, std::vector<std::uint32_t>& open) override {
    std::uint32_t counts[4] = {};
    counts_.write(counts, 4);
    vex_kernel::draw<<<groups_of(n, VEX_MOST_IN_GROUP), kGroup>>>(pair_.at(), seed, first, n,
                                                                  VEX_MOST_IN_GROUP / kGroup, listed_.at(),
                                                                  counts_.at());
    require(cudaGetLastError(), "no start of draw");
    vex_kernel::decide<<<kItems / kGroup, kGroup>>>(pair_.at(), seed, first, listed_.at(), open_.at(), counts_.at());
    require(cudaGetLastError(), "no start of decide");
    counts_.read(counts, 4);
    open.resize(counts[3]);
    if (!open.empty()) open_.read(open.data(), open.size());
    return {counts[0], counts[1], counts[2], counts[3]};
  }

 private:
  static constexpr std::uint32_t kGroup = 128, kMostTrials = 1u << 26, kItems = 1u << 20;

  static std::uint32_t groups_of(std::uint32_t n, std::uint32_t group) { return (n + group - 1) / group; }

  Buffer<VexPair> pair_{1};
  Buffer<std::uint32_t> counts_{4}, listed_{kMostTrials}, open_{kMostTrials};
};

}  // namespace

std::unique_ptr<Device> cuda_device() {
  int n_devices = 0;
  if (cudaGetDeviceCount(&n_devices) != cudaSuccess || n_devices == 0) return nullptr;
  return std::make_unique<CudaDevice>();
}

}  // namespace vex
