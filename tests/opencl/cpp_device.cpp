#include <thread>

#include "tests/opencl/device.h"
#include "tests/opencl/kernel_as_cpp.h"

namespace vex {
namespace {

class CppDevice final : public Device {
 public:
  explicit CppDevice(int n_threads) : n_threads_(n_threads) {}

  std::string name() const override { return "the kernels as C++, threads: " + std::to_string(n_threads_); }
  void set_pair(const VexPair& pair) override { pair_ = pair; }

  std::vector<double> poses(std::uint64_t seed, std::uint64_t first, std::uint32_t n) override {
    std::vector<double> columns(std::size_t{VEX_POSE_COLUMNS} * n);
    each_item(n, [&] { vex_kernel::poses(&pair_, seed, first, n, columns.data()); });
    return columns;
  }
  std::vector<int> answers(const std::vector<double>& columns, std::uint32_t n) override {
    std::vector<int> found(n);
    each_item(n, [&] { vex_kernel::answers(&pair_, n, columns.data(), found.data()); });
    return found;
  }

 protected:
  std::uint32_t most_trials() const override { return static_cast<std::uint32_t>(n_threads_) << 20; }

  Counts run_part(std::uint64_t seed, std::uint64_t first, std::uint32_t n, std::vector<std::uint32_t>& open) override {
    const auto n_threads = static_cast<std::uint32_t>(n_threads_);
    const std::uint32_t n_each = (n + n_threads - 1) / n_threads;
    std::vector<Part> parts(n_threads);
    std::vector<std::thread> threads;
    for (std::uint32_t t = 0; t < n_threads; ++t) {
      const std::uint32_t begin = t * n_each < n ? t * n_each : n, end = n - begin < n_each ? n : begin + n_each;
      threads.emplace_back(
          [this, seed, first, begin, end, &part = parts[t]] { run_on_thread(seed, first + begin, end - begin, part); });
    }
    for (std::thread& thread : threads) thread.join();
    Counts all;
    open.clear();
    for (std::uint32_t t = 0; t < n_threads; ++t) {
      all.hits += parts[t].counts[0];
      all.misses += parts[t].counts[1];
      all.open += parts[t].counts[3];
      for (std::uint32_t k = 0; k < parts[t].counts[3]; ++k) open.push_back(t * n_each + parts[t].open[k]);
    }
    return all;
  }

 private:
  static constexpr std::uint32_t kTrialsOfItem = VEX_MOST_IN_GROUP;

  struct Part {
    std::uint32_t counts[4] = {};
    std::vector<std::uint32_t> listed, open;
  };

  void run_on_thread(std::uint64_t seed, std::uint64_t first, std::uint32_t n, Part& part) const {
    part.listed.resize(n);
    part.open.resize(n);
    each_item((n + kTrialsOfItem - 1) / kTrialsOfItem,
              [&] { vex_kernel::draw(&pair_, seed, first, n, kTrialsOfItem, part.listed.data(), part.counts); });
    each_item(1, [&] { vex_kernel::decide(&pair_, seed, first, part.listed.data(), part.open.data(), part.counts); });
  }

  template <class Kernel>
  static void each_item(std::uint32_t n, const Kernel& kernel) {
    vex_kernel::work_item.n = n;
    for (std::uint32_t id = 0; id < n; ++id) {
      vex_kernel::work_item.id = id;
      kernel();
    }
  }

  VexPair pair_{};
  int n_threads_;
};

}  // namespace

std::unique_ptr<Device> cpp_device(int n_threads) { return std::make_unique<CppDevice>(n_threads); }

}  // namespace vex
