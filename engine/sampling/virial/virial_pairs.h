// What runs of a virial coefficient count besides their values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/sampling/tally.h"

namespace vex {

/// Pairs of bodies that are no neighbours of their chain or tree, or all of a triangle: asked are those by balls and by
/// a search.
struct VirialPairs {
  std::uint64_t n_all = 0;         // of all clusters
  std::uint64_t n_by_balls = 0;    // of these decided by circumscribed and inscribed balls
  std::uint64_t n_searched = 0;    // and by a search
  std::uint64_t n_undecided = 0;   // of those searched, and of the neighbours
  std::uint64_t n_candidates = 0;  // poses that neighbours were drawn from

  /// What a run of the integrand counted.
  static VirialPairs of(const Tally& tally) {
    const auto& n = tally.counted;
    return {n[0], n[1], n[2], n[3], n[4]};
  }
  void add_to(std::span<std::uint64_t> counted) const {
    std::size_t k = 0;
    for (const std::uint64_t n : {n_all, n_by_balls, n_searched, n_undecided, n_candidates}) counted[k++] += n;
  }
  /// Not asked, because the weight of the cluster was known to be 0.
  std::uint64_t n_skipped() const { return n_all - n_by_balls - n_searched; }
};

}  // namespace vex
