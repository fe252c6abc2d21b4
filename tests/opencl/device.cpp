#include "tests/opencl/device.h"

#include <algorithm>
#include <stdexcept>

namespace vex {

ProvenTrials Device::run(std::uint64_t seed, std::uint64_t first, std::uint64_t n) {
  ProvenTrials found;
  std::vector<std::uint32_t> open;
  for (std::uint64_t done = 0; done < n;) {
    const auto n_part = static_cast<std::uint32_t>(std::min<std::uint64_t>(n - done, most_trials()));
    const Counts counts = run_part(seed, first + done, n_part, open);
    if (std::uint64_t{counts.hits} + counts.misses + counts.open != n_part || open.size() != counts.open) {
      throw std::runtime_error(name() + " has lost trials of those from " + std::to_string(first + done) + " on");
    }
    found.n_hits += counts.hits;
    found.n_misses += counts.misses;
    for (const std::uint32_t row : open) found.open.push_back(first + done + row);
    done += n_part;
  }
  std::sort(found.open.begin(), found.open.end());
  return found;
}

}  // namespace vex
