#include "engine/scene/clusters.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"

namespace vex {

void Clusters::reset(std::size_t n) {
  nodes_.clear();
  size_.clear();
  wraps_.clear();
  n_clusters_ = 0;
  add(n);
  any_wraps_ = false;
  undecided.clear();
  counts = {};
}

BodyId Clusters::add(std::size_t n) {
  const BodyId first = static_cast<BodyId>(nodes_.size()), end = first + static_cast<BodyId>(n);
  nodes_.resize(end);
  for (BodyId body = first; body < end; ++body) nodes_[body].parent = body;
  size_.resize(end, 1);
  wraps_.resize(end, 0);
  n_clusters_ += n;
  return first;
}

void Clusters::leave_out(BodyId body) {
  VEX_EXPECT(find(body) == body && size_[body] <= 1);
  if (size_[body] == 0) return;
  size_[body] = 0;
  --n_clusters_;
}

BodyId Clusters::find_far(BodyId body) {
  path_.clear();
  while (nodes_[body].parent != body) {
    path_.push_back(body);
    body = nodes_[body].parent;
  }
  // From the root down: what was counted from a parent is counted from the root once the parent's is.
  for (std::size_t k = path_.size(); k-- > 1;) {
    Node& child = nodes_[path_[k - 1]];
    child = {body, image_sum(child.offset, nodes_[path_[k]].offset)};
  }
  return body;
}

BodyId Clusters::root(BodyId body) { return find(body); }

ImageOffset Clusters::offset(BodyId body) {
  find(body);
  return nodes_[body].offset;
}

Clusters::Joined Clusters::join(BodyId a, BodyId b, const ImageOffset& image) {
  BodyId root_a = find(a), root_b = find(b);
  // What is left out is connected with nothing, so that it has its root to itself.
  if ((root_a != root_b || a == b) && (size_[root_a] == 0 || size_[root_b] == 0)) {
    throw UsageError("clusters have no body " + std::to_string(size_[root_a] == 0 ? a : b) +
                     ", which was left out - join bodies that are there");
  }
  const ImageOffset between = this->between(a, b, image);
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
  nodes_[root_b] = {root_a, swaps ? image_difference({}, between) : between};
  size_[root_a] += size_[root_b];
  wraps_[root_a] = static_cast<std::uint8_t>(wraps_[root_a] | wraps_[root_b]);
  return Joined::united;
}

bool Clusters::knows(BodyId a, BodyId b, const ImageOffset& image) {
  return find(a) == find(b) && between(a, b, image) == ImageOffset{};
}

// Where a cluster does not wrap along a lattice vector all ways between two bodies have the same component along it.
bool Clusters::would_change(BodyId a, BodyId b, const ImageOffset& image) {
  if (find(a) != find(b)) return true;
  const ImageOffset between = this->between(a, b, image);
  const std::array<bool, 3> wraps = this->wraps(a);
  return (between[0] != 0 && !wraps[0]) || (between[1] != 0 && !wraps[1]) || (between[2] != 0 && !wraps[2]);
}

std::array<bool, 3> Clusters::wraps(BodyId body) {
  const unsigned bits = wraps_[find(body)];
  return {(bits & 1u) != 0, (bits & 2u) != 0, (bits & 4u) != 0};
}

void Clusters::root_at_lowest() {
  const std::size_t n = nodes_.size();
  for (std::size_t k = 0; k < n; ++k) find(static_cast<BodyId>(k));
  // The lowest body of each root comes first.
  lowest_.assign(n, kNoBody);
  offset_of_lowest_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const BodyId root = nodes_[k].parent;
    if (lowest_[root] == kNoBody) {
      lowest_[root] = static_cast<BodyId>(k);
      offset_of_lowest_[root] = nodes_[k].offset;
    }
    nodes_[k] = {lowest_[root], image_difference(nodes_[k].offset, offset_of_lowest_[root])};
  }
  for (std::size_t root = 0; root < n; ++root) {
    if (lowest_[root] == kNoBody || lowest_[root] == root) continue;
    size_[lowest_[root]] = size_[root];
    wraps_[lowest_[root]] = wraps_[root];
  }
}

std::uint32_t Clusters::largest() const {
  std::uint32_t largest = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].parent == k) largest = std::max(largest, size_[k]);
  }
  return largest;
}

std::vector<std::uint32_t> Clusters::labels() {
  std::vector<std::uint32_t> labels(nodes_.size(), kNoCluster), of_root(nodes_.size(), kNoCluster);
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const BodyId root = find(static_cast<BodyId>(k));
    if (size_[root] == 0) continue;
    std::uint32_t& label = of_root[root];
    if (label == kNoCluster) label = n++;
    labels[k] = label;
  }
  return labels;
}

}  // namespace vex
