// The kernels' part of beside_library.sh; knows nothing of the library:
//   vex_device_hits opencl|cuda|cpp PAIR SEED TRIALS OPEN
// runs the trials 0 ... TRIALS - 1 of the pair that vex_library_hits has stored, and lists in the file OPEN the numbers
// of those that are not decided. VEX_WITH_OPENCL and VEX_WITH_CUDA say which devices it was compiled with.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/opencl/device.h"

namespace {

std::unique_ptr<vex::Device> device_of(const std::string& kind) {
#ifdef VEX_WITH_OPENCL
  if (kind == "opencl") return vex::opencl_device();
#endif
#ifdef VEX_WITH_CUDA
  if (kind == "cuda") return vex::cuda_device();
#endif
  if (kind == "cpp") return vex::cpp_device(static_cast<int>(std::thread::hardware_concurrency()));
  return nullptr;
}

// What the device says must be what this processor says, to the last bit, of poses too: a device that fuses operations,
// or divides otherwise than it should, is refused.
class Comparison {
 public:
  Comparison(vex::Device& device, const VexPair& pair) : device_(device), plain_(vex::cpp_device()) {
    plain_->set_pair(pair);
  }

  void require_same_poses(std::uint64_t seed) {
    const std::vector<double> poses = device_.poses(seed, 0, kPoses), here = plain_->poses(seed, 0, kPoses);
    if (std::memcmp(poses.data(), here.data(), here.size() * sizeof(double)) != 0)
      throw std::runtime_error("the device draws other poses than this processor: it rounds otherwise");
  }

  // Of bodies that nearly touch, where what is left open and what is not depends on every rounding: B is moved along
  // the line to its place until the search no more finds them apart.
  void require_same_answers(std::uint64_t seed) {
    std::vector<double> poses = plain_->poses(seed, 0, kPoses);
    const std::vector<double> drawn = poses;
    std::vector<double> lower(kPoses, 0.0), upper(kPoses, 2.0);
    for (int step = 0; step < 56; ++step) {
      for (std::uint32_t k = 0; k < kPoses; ++k) {
        for (std::uint32_t c = 9; c < 12; ++c)
          poses[c * kPoses + k] = 0.5 * (lower[k] + upper[k]) * drawn[c * kPoses + k];
      }
      const std::vector<int> here = plain_->answers(poses, kPoses);
      if (device_.answers(poses, kPoses) != here)
        throw std::runtime_error("the device answers otherwise than this processor");
      for (std::uint32_t k = 0; k < kPoses; ++k)
        (here[k] == VEX_DISJOINT ? upper[k] : lower[k]) = 0.5 * (lower[k] + upper[k]);
    }
  }

 private:
  static constexpr std::uint32_t kPoses = 1u << 13;

  vex::Device& device_;
  std::unique_ptr<vex::Device> plain_;
};

int run_kernels(const std::vector<std::string>& words) {
  if (words.size() != 5) throw std::runtime_error("opencl|cuda|cpp PAIR SEED TRIALS OPEN");
  const std::unique_ptr<vex::Device> device = device_of(words[0]);
  if (device == nullptr) throw std::runtime_error("there is no device for " + words[0]);
  VexPair pair;
  std::ifstream stored(words[1], std::ios::binary);
  if (!stored.read(reinterpret_cast<char*>(&pair), sizeof pair)) throw std::runtime_error("no pair in " + words[1]);
  const std::uint64_t seed = std::strtoull(words[2].c_str(), nullptr, 10);
  const std::uint64_t n_trials = std::strtoull(words[3].c_str(), nullptr, 10);
  device->set_pair(pair);
  Comparison comparison(*device, pair);
  comparison.require_same_poses(seed);
  comparison.require_same_answers(seed);
  device->run(seed, 0, n_trials < 4096 ? n_trials : 4096);  // what is made when a kernel is first started
  const auto start = std::chrono::steady_clock::now();
  const vex::ProvenTrials found = device->run(seed, 0, n_trials);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::ofstream list(words[4]);
  for (const std::uint64_t trial : found.open) list << trial << '\n';
  if (!list.flush()) throw std::runtime_error("cannot write " + words[4]);
  std::printf("hits %llu misses %llu open %zu seconds %.6f on %s\n", static_cast<unsigned long long>(found.n_hits),
              static_cast<unsigned long long>(found.n_misses), found.open.size(), seconds, device->name().c_str());
  return 0;
}

}  // namespace

int main(int n_words, char** words) {
  try {
    return run_kernels(std::vector<std::string>(words + 1, words + n_words));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "vex_device_hits: %s\n", fault.what());
    return 1;
  }
}
