// Clusters of connected bodies in open space or a periodic box: union-find in which every body knows the offset of its
// image from its root's.
//
// M. E. J. Newman and R. M. Ziff, Phys. Rev. E 64, 016706 (2001); offsets after J. Machta et al., Phys. Rev. E 54, 1332
// (1996): a cluster wraps where a connection closes a loop whose offsets do not add up to 0.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/scene/periodic_box.h"
#include "engine/scene/scene_pair.h"

namespace vex {

/// The label of a number that no body has.
inline constexpr std::uint32_t kNoCluster = ~std::uint32_t{0};

/// A forest over the bodies 0 ... n - 1. Memory is kept from one `reset` to the next.
///
/// A scene that bodies were removed from has numbers that no body has. They are left out: `n_clusters` and `largest` do
/// not count them, their label is kNoCluster, their number of bodies is 0, and they wrap along nothing.
class Clusters {
 public:
  /// n bodies, each a cluster of its own.
  void reset(std::size_t n);
  /// How many numbers there are, those that are left out among them.
  std::size_t size() const { return nodes_.size(); }

  /// So many more bodies, the number of the first of which it tells.
  BodyId add(std::size_t n = 1);
  /// No body has this number, nor has it been joined with any other one.
  void leave_out(BodyId body);

  /// Body b's copy at `image` is connected with body a. What the connection changes:
  enum class Joined : std::uint8_t {
    united,
    closed,
    wrapped
  };  // two clusters became one; no news; a loop around the box
  /// Throws UsageError where one of them is left out.
  Joined join(BodyId a, BodyId b, const ImageOffset& image = {});
  /// Whether that connection would be no news: one cluster already, with this offset.
  bool knows(BodyId a, BodyId b, const ImageOffset& image);

  /// Whether it would change something: join two clusters, or have one wrap along a lattice vector that it does not
  /// wrap along. That does not hang on the order in which the others were made.
  bool would_change(BodyId a, BodyId b, const ImageOffset& image);

  /// The number of a body that stands for the cluster.
  BodyId root(BodyId body);
  /// By how many lattice vectors the body's copy in the root's own component is away from the body's place.
  ImageOffset offset(BodyId body);
  std::uint32_t n_bodies(BodyId body) { return size_[root(body)]; }
  /// Whether the body's cluster wraps along the lattice vector a, b or c: some loop in it comes back displaced along
  /// it.
  std::array<bool, 3> wraps(BodyId body);

  /// Whether any cluster does.
  bool any_wraps() const { return any_wraps_; }

  std::size_t n_clusters() const { return n_clusters_; }
  std::uint32_t largest() const;
  /// Of each body the number of its cluster, from 0 on in the order of their lowest bodies; kNoCluster of what is left
  /// out.
  std::vector<std::uint32_t> labels();

  /// Makes each cluster's lowest body its root, whatever the order of the connections was. Offsets are the same then
  /// for every order, but in clusters that wrap: there they are those of one way through the cluster.
  void root_at_lowest();

  // Of the query that filled it: pairs of which it is not proven whether they overlap, and that would change
  // something; and what was counted.
  std::vector<ScenePair> undecided;
  SceneCounts counts;

 private:
  // The root; flattens the way: the offset is from the root afterwards.
  BodyId find(BodyId body) {
    const BodyId parent = nodes_[body].parent;
    return nodes_[parent].parent == parent ? parent : find_far(body);
  }
  BodyId find_far(BodyId body);
  // Where b's root is in the component of a's root, if b's copy at `image` is connected with a; once both are found.
  ImageOffset between(BodyId a, BodyId b, const ImageOffset& image) const {
    return image_difference(image_sum(nodes_[a].offset, image), nodes_[b].offset);
  }

  struct Node {
    BodyId parent = 0;
    ImageOffset offset{};  // from the parent's copy
  };
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> size_;    // of roots; 0 of numbers that are left out, each a root of its own
  std::vector<std::uint8_t> wraps_;    // of roots: a bit for each lattice vector
  std::vector<BodyId> path_, lowest_;  // of find; of root_at_lowest
  std::vector<ImageOffset> offset_of_lowest_;
  std::size_t n_clusters_ = 0;
  bool any_wraps_ = false;
};

}  // namespace vex
