// Numbers of a body's vertices, edges and faces: what a contact is made by, the same from step to step.
#pragma once

#include <algorithm>
#include <cstdint>

namespace vex {

/// A vertex, an edge between two vertices, or a face (or what of it takes part), of which the least vertex is told:
/// below 2^53, so that any language's numbers hold it. Only equality means anything. Vertices are numbered as in the
/// body's exact form; those of a curved body as contact_manifold says. Numbers of vertices from 2^25 up are taken
/// modulo 2^25.
using FeatureId = std::uint64_t;

enum class FeatureKind : std::uint8_t { vertex, edge, face };

namespace detail {
inline constexpr int kFeatureBits = 25;
constexpr FeatureId feature_id(FeatureKind kind, std::uint32_t first, std::uint32_t second) {
  constexpr std::uint32_t kMask = (1U << kFeatureBits) - 1;
  return (static_cast<FeatureId>(kind) << (2 * kFeatureBits)) |
         (static_cast<FeatureId>(first & kMask) << kFeatureBits) | static_cast<FeatureId>(second & kMask);
}
}  // namespace detail

constexpr FeatureId feature_of_vertex(std::uint32_t vertex) {
  return detail::feature_id(FeatureKind::vertex, 0, vertex);
}
constexpr FeatureId feature_of_edge(std::uint32_t p, std::uint32_t q) {
  return detail::feature_id(FeatureKind::edge, std::max(p, q), std::min(p, q));
}
constexpr FeatureId feature_of_face(std::uint32_t least_vertex) {
  return detail::feature_id(FeatureKind::face, 0, least_vertex);
}
constexpr FeatureKind kind_of(FeatureId feature) {
  return static_cast<FeatureKind>(feature >> (2 * detail::kFeatureBits));
}

}  // namespace vex
