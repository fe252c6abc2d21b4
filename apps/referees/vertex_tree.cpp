#include "apps/referees/vertex_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/numeric/eigen.h"
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
  const auto n = static_cast<double>(last - first);
  Vec3d mean;
  for (std::size_t i = first; i < last; ++i) mean = mean + (1.0 / n) * points_[i];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    const Eigen::Vector3d d = to_eigen(points_[i] - mean);
    spread += d * d.transpose();
  }
  // Whatever the axes are, the box holds the points: that they fit is a matter of speed.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal;
  principal.computeDirect(spread / std::max(spread.trace(), std::numeric_limits<double>::min()));
  Node node{{}, {}, first, last, 0};
  std::array<Vec3d, 3> axes;
  std::size_t longest = 0;
  double longest_extent = -1.0;
  node.middle = mean;
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = from_eigen(Eigen::Vector3d(principal.eigenvectors().col(static_cast<Eigen::Index>(k))));
    double low = 0.0, high = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      const double along = dot(axes[k], points_[i] - mean);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    node.middle = node.middle + 0.5 * (low + high) * axes[k];
    node.half_edges[k] = 0.5 * (high - low) * axes[k];
    if (high - low > longest_extent) {
      longest_extent = high - low;
      longest = k;
    }
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back(node);
  if (last - first > kLeafSize) {
    const Vec3d axis = axes[longest];
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last),
                     [&axis](const Vec3d& p, const Vec3d& q) { return dot(axis, p) < dot(axis, q); });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[index].right = right;
  }
  return index;
}

double VertexTree::height(const Vec3d& dir, const Vec3d& origin) const {
  const auto bound = [&](const Node& node) {
    const auto& [x, y, z] = node.half_edges;
    return dot(dir, node.middle - origin) +
           ((std::fabs(dot(dir, x)) + std::fabs(dot(dir, y))) + std::fabs(dot(dir, z)));
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
