#include "apps/referees/vertex_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/numeric/expect.h"

namespace vex {
namespace {

constexpr std::size_t kLeafSize = 8;
constexpr std::size_t kMaxDepth = 64;  // halving 2^64 points

}  // namespace

VertexTree::VertexTree(std::vector<Vec3d> points) : points_(std::move(points)) {
  VEX_EXPECT(!points_.empty());
  nodes_.reserve(points_.size() / (kLeafSize / 4) + 1);
  build(0, points_.size());
}

std::size_t VertexTree::build(std::size_t first, std::size_t last) {
  Vec3d low = points_[first], high = low;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3d& p = points_[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3d half_extent = 0.5 * (high - low);
  const std::size_t index = nodes_.size();
  nodes_.push_back({low + half_extent, half_extent, first, last, 0});
  if (last - first > kLeafSize) {
    const double widest = std::max({half_extent.x, half_extent.y, half_extent.z});
    double Vec3d::*const axis = half_extent.x == widest ? &Vec3d::x : (half_extent.y == widest ? &Vec3d::y : &Vec3d::z);
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last),
                     [axis](const Vec3d& p, const Vec3d& q) { return p.*axis < q.*axis; });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[index].right = right;
  }
  return index;
}

double VertexTree::height(const Vec3d& dir, const Vec3d& origin) const {
  const Vec3d size_of_dir{std::fabs(dir.x), std::fabs(dir.y), std::fabs(dir.z)};
  const auto bound = [&](const Node& node) {
    return dot(dir, node.middle - origin) + dot(size_of_dir, node.half_extent);
  };
  struct Open {
    std::size_t node;
    double bound;
  };
  std::array<Open, kMaxDepth + 1> stack;
  std::size_t n_open = 0;
  double best = -std::numeric_limits<double>::infinity();
  stack[n_open++] = {0, std::numeric_limits<double>::infinity()};
  while (n_open > 0) {
    const Open open = stack[--n_open];
    if (open.bound <= best) continue;
    const Node& node = nodes_[open.node];
    if (node.right == 0) {
      for (std::size_t i = node.first; i < node.last; ++i) best = std::max(best, dot(dir, points_[i] - origin));
      continue;
    }
    Open near{open.node + 1, bound(nodes_[open.node + 1])}, far{node.right, bound(nodes_[node.right])};
    if (near.bound < far.bound) std::swap(near, far);
    if (far.bound > best) stack[n_open++] = far;
    stack[n_open++] = near;
  }
  return best;
}

}  // namespace vex
