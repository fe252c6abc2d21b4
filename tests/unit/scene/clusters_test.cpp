#include "engine/scene/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

namespace vex {
namespace {

struct Edge {
  BodyId a, b;
  ImageOffset image;
};

ImageOffset plus(const ImageOffset& a, const ImageOffset& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
ImageOffset minus(const ImageOffset& a, const ImageOffset& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// Breadth first over the bodies; each is given the image in which it is reached first. An edge between two bodies that
// have theirs closes a loop: the loop wraps where the images do not agree.
struct Referee {
  std::vector<std::uint32_t> labels;
  std::vector<ImageOffset> image;
  std::vector<std::array<bool, 3>> wraps;  // of labels

  Referee(std::size_t n, const std::vector<Edge>& edges) : labels(n, ~0u), image(n) {
    std::vector<std::vector<std::pair<BodyId, ImageOffset>>> neighbours(n);
    for (const Edge& edge : edges) {
      neighbours[edge.a].emplace_back(edge.b, edge.image);
      neighbours[edge.b].emplace_back(edge.a, minus({}, edge.image));
    }
    for (BodyId first = 0; first < n; ++first) {
      if (labels[first] != ~0u) continue;
      const auto label = static_cast<std::uint32_t>(wraps.size());
      wraps.push_back({});
      labels[first] = label;
      std::deque<BodyId> queue = {first};
      for (; !queue.empty(); queue.pop_front()) {
        const BodyId body = queue.front();
        for (const auto& [next, offset] : neighbours[body]) {
          const ImageOffset there = plus(image[body], offset);
          if (labels[next] == ~0u) {
            labels[next] = label;
            image[next] = there;
            queue.push_back(next);
          }
          for (std::size_t k = 0; k < 3; ++k) wraps[label][k] = wraps[label][k] || image[next][k] != there[k];
        }
      }
    }
  }
};

std::vector<Edge> random_edges(std::mt19937_64& random, std::size_t n, std::size_t n_edges, int reach) {
  std::uniform_int_distribution<int> component(-reach, reach);
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < n_edges; ++k) {
    edges.push_back({static_cast<BodyId>(random() % n),
                     static_cast<BodyId>(random() % n),
                     {component(random), component(random), component(random)}});
  }
  return edges;
}

// Edges of bodies that have places in open space, some of them beyond the box: no loop wraps.
std::vector<Edge> unwrapped_edges(std::mt19937_64& random, std::size_t n, std::size_t n_edges) {
  const std::vector<Edge> cells = random_edges(random, n, n, 3);
  std::vector<Edge> edges = random_edges(random, n, n_edges, 0);
  for (Edge& edge : edges) edge.image = minus(cells[edge.b].image, cells[edge.a].image);
  return edges;
}

void expect_same(Clusters& clusters, std::size_t n, const std::vector<Edge>& edges) {
  const Referee referee(n, edges);
  ASSERT_EQ(clusters.size(), n);
  ASSERT_EQ(clusters.labels(), referee.labels);
  ASSERT_EQ(clusters.n_clusters(), referee.wraps.size());
  std::vector<std::uint32_t> sizes(referee.wraps.size());
  for (const std::uint32_t label : referee.labels) ++sizes[label];
  std::uint32_t largest = 0;
  for (const std::uint32_t size : sizes) largest = std::max(largest, size);
  ASSERT_EQ(clusters.largest(), largest);
  std::vector<bool> wraps_at_all(referee.wraps.size());
  for (BodyId body = 0; body < n; ++body) {
    const std::uint32_t label = referee.labels[body];
    ASSERT_EQ(clusters.n_bodies(body), sizes[label]);
    ASSERT_EQ(referee.labels[clusters.root(body)], label);
    ASSERT_EQ(clusters.wraps(body), referee.wraps[label]);
    ASSERT_EQ(clusters.offset(clusters.root(body)), ImageOffset{});
    const std::array<bool, 3>& wraps = referee.wraps[label];
    if (!wraps[0] && !wraps[1] && !wraps[2]) {
      // Where nothing wraps, offsets are differences of images.
      ASSERT_EQ(clusters.offset(body), minus(referee.image[body], referee.image[clusters.root(body)]));
    }
  }
}

TEST(Clusters, OfRandomGraphsAreThoseOfASearchThroughThem) {
  std::mt19937_64 random(51);
  int n_wrapping = 0, n_plain = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t n = 1 + random() % 60, n_edges = random() % (2 * n);
    const std::vector<Edge> edges =
        round % 2 == 0 ? random_edges(random, n, n_edges, round % 3 == 0 ? 1 : 2) : unwrapped_edges(random, n, n_edges);
    Clusters clusters;
    clusters.reset(n);
    for (const Edge& edge : edges) {
      const bool is_known = clusters.knows(edge.a, edge.b, edge.image);
      const bool is_one = clusters.root(edge.a) == clusters.root(edge.b);
      const std::size_t n_before = clusters.n_clusters();
      const Clusters::Joined joined = clusters.join(edge.a, edge.b, edge.image);
      ASSERT_EQ(joined, !is_one    ? Clusters::Joined::united
                        : is_known ? Clusters::Joined::closed
                                   : Clusters::Joined::wrapped);
      ASSERT_EQ(clusters.n_clusters(), n_before - (is_one ? 0 : 1));
      ASSERT_TRUE(joined == Clusters::Joined::wrapped || clusters.knows(edge.a, edge.b, edge.image));
      (joined == Clusters::Joined::wrapped ? n_wrapping : n_plain) += 1;
    }
    ASSERT_NO_FATAL_FAILURE(expect_same(clusters, n, edges));
  }
  EXPECT_GT(n_wrapping, 500) << "the sample must hold both";
  EXPECT_GT(n_plain, 500);
}

TEST(Clusters, TakeBodiesOneAtATime) {
  std::mt19937_64 random(52);
  const std::vector<Edge> edges = random_edges(random, 200, 150, 1);
  Clusters clusters;
  clusters.reset(0);
  EXPECT_EQ(clusters.largest(), 0u);
  for (BodyId body = 0; body < 200; ++body) {
    ASSERT_EQ(clusters.add(), body);
    for (const Edge& edge : edges) {
      if (std::max(edge.a, edge.b) == body) clusters.join(edge.a, edge.b, edge.image);
    }
  }
  expect_same(clusters, 200, edges);
}

TEST(Clusters, ABodyThatMeetsItsOwnCopyWraps) {
  Clusters clusters;
  clusters.reset(2);
  EXPECT_EQ(clusters.join(0, 0, {0, 1, 0}), Clusters::Joined::wrapped);
  EXPECT_EQ(clusters.wraps(0), (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(clusters.wraps(1), (std::array<bool, 3>{false, false, false}));
  EXPECT_EQ(clusters.join(1, 0, {5, 0, 0}), Clusters::Joined::united);
  EXPECT_EQ(clusters.wraps(1), (std::array<bool, 3>{false, true, false}));
  clusters.reset(2);
  EXPECT_EQ(clusters.wraps(0), (std::array<bool, 3>{false, false, false}));
}

}  // namespace
}  // namespace vex
