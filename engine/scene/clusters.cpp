#include "engine/scene/clusters.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"

namespace vex {

void Clusters::reset(std::size_t n) {
  parent_.resize(n);
  for (std::size_t k = 0; k < n; ++k) parent_[k] = static_cast<BodyId>(k);
  offset_.assign(n, {});
  size_.assign(n, 1);
  wraps_.assign(n, 0);
  n_clusters_ = n;
  any_wraps_ = false;
  undecided.clear();
  counts = {};
}

BodyId Clusters::add() {
  parent_.push_back(static_cast<BodyId>(parent_.size()));
  offset_.push_back({});
  size_.push_back(1);
  wraps_.push_back(0);
  ++n_clusters_;
  return parent_.back();
}

void Clusters::leave_out(BodyId body) {
  VEX_EXPECT(find(body) == body && size_[body] <= 1);
  if (size_[body] == 0) return;
  size_[body] = 0;
  --n_clusters_;
}

BodyId Clusters::find_far(BodyId body) {
  path_.clear();
  while (parent_[body] != body) {
    path_.push_back(body);
    body = parent_[body];
  }
  // From the root down: what was counted from a parent is counted from the root once the parent's is.
  for (std::size_t k = path_.size(); k-- > 1;) {
    const BodyId child = path_[k - 1];
    offset_[child] = image_sum(offset_[child], offset_[path_[k]]);
    parent_[child] = body;
  }
  return body;
}

BodyId Clusters::root(BodyId body) { return find(body); }

ImageOffset Clusters::offset(BodyId body) {
  find(body);
  return offset_[body];
}

Clusters::Joined Clusters::join(BodyId a, BodyId b, const ImageOffset& image) {
  BodyId root_a = find(a), root_b = find(b);
  if (size_[root_a] == 0 || size_[root_b] == 0) {
    throw UsageError("clusters have no body " + std::to_string(size_[root_a] == 0 ? a : b) +
                     ", which was left out - join bodies that are there");
  }
  // Where b's root is in the component of a's root, if b is where the connection has it.
  const ImageOffset between = image_difference(image_sum(offset_[a], image), offset_[b]);
  if (root_a == root_b) {
    if (between == ImageOffset{}) return Joined::closed;
    for (std::size_t k = 0; k < 3; ++k) {
      if (between[k] != 0) wraps_[root_a] = static_cast<std::uint8_t>(wraps_[root_a] | (1u << k));
    }
    any_wraps_ = true;
    return Joined::wrapped;
  }
  --n_clusters_;
  const bool swaps = size_[root_a] < size_[root_b];
  if (swaps) std::swap(root_a, root_b);
  parent_[root_b] = root_a;
  offset_[root_b] = swaps ? image_difference({}, between) : between;
  size_[root_a] += size_[root_b];
  wraps_[root_a] = static_cast<std::uint8_t>(wraps_[root_a] | wraps_[root_b]);
  return Joined::united;
}

bool Clusters::knows(BodyId a, BodyId b, const ImageOffset& image) {
  return find(a) == find(b) && image_difference(image_sum(offset_[a], image), offset_[b]) == ImageOffset{};
}

// Where a cluster does not wrap along a lattice vector all ways between two bodies have the same component along it.
bool Clusters::would_change(BodyId a, BodyId b, const ImageOffset& image) {
  if (find(a) != find(b)) return true;
  const ImageOffset between = image_difference(image_sum(offset_[a], image), offset_[b]);
  const std::array<bool, 3> wraps = this->wraps(a);
  return (between[0] != 0 && !wraps[0]) || (between[1] != 0 && !wraps[1]) || (between[2] != 0 && !wraps[2]);
}

std::array<bool, 3> Clusters::wraps(BodyId body) {
  const unsigned bits = wraps_[find(body)];
  return {(bits & 1u) != 0, (bits & 2u) != 0, (bits & 4u) != 0};
}

void Clusters::root_at_lowest() {
  const std::size_t n = parent_.size();
  for (std::size_t k = 0; k < n; ++k) find(static_cast<BodyId>(k));
  // The lowest body of each root comes first.
  lowest_.assign(n, kNoBody);
  offset_of_lowest_.resize(n);
  roots_ = parent_;
  for (std::size_t k = 0; k < n; ++k) {
    const BodyId root = roots_[k];
    if (lowest_[root] == kNoBody) {
      lowest_[root] = static_cast<BodyId>(k);
      offset_of_lowest_[root] = offset_[k];
    }
    parent_[k] = lowest_[root];
    offset_[k] = image_difference(offset_[k], offset_of_lowest_[root]);
  }
  for (std::size_t root = 0; root < n; ++root) {
    if (lowest_[root] == kNoBody || lowest_[root] == root) continue;
    size_[lowest_[root]] = size_[root];
    wraps_[lowest_[root]] = wraps_[root];
  }
}

std::uint32_t Clusters::largest() const {
  std::uint32_t largest = 0;
  for (std::size_t k = 0; k < parent_.size(); ++k) {
    if (parent_[k] == k) largest = std::max(largest, size_[k]);
  }
  return largest;
}

std::vector<std::uint32_t> Clusters::labels() {
  std::vector<std::uint32_t> labels(parent_.size(), kNoCluster), of_root(parent_.size(), kNoCluster);
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < parent_.size(); ++k) {
    const BodyId root = find(static_cast<BodyId>(k));
    if (size_[root] == 0) continue;
    std::uint32_t& label = of_root[root];
    if (label == kNoCluster) label = n++;
    labels[k] = label;
  }
  return labels;
}

}  // namespace vex
