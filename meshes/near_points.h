// Points that are nearly one: which of them are to become one vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/weld.h"

namespace vex {

/// Two points that are not farther apart than the distance are of one cluster, and so are those that others connect.
struct NearPoints {
  std::vector<std::uint32_t> joined_to;  // for each point the first one of its cluster
  std::size_t n_joined = 0;              // points that are not the first of theirs
  double largest_move = 0.0;             // from a point to the first of its cluster
  double widest = 0.0;                   // the largest diagonal of a cluster's bounding box
  Vec3d in_widest;                       // the first point of that cluster
};

/// Eight last places, as doubles, of the largest coordinate: below that, arithmetic cannot tell distances.
double least_weld_distance(std::span<const Vec3d> points);

/// `points`: each once, in lexicographic order, so the clusters and their first points do not depend on any other
/// order; finite. `distance`: not below least_weld_distance. Near-linear in time where a ball of that radius holds few
/// points; nothing where it holds so many, of several clusters, that the distance cannot be meant.
std::optional<NearPoints> near_points(std::span<const Vec3d> points, double distance);

/// A cluster wider than this many distances is a chain of points that were never one.
inline constexpr double kMostWeldDistances = 8.0;

/// The surface with points joined that are not farther apart than `distance`, in chains too, each cluster at its
/// lexicographically first point. Nothing, and the surface as it was, where a cluster is wider than kMostWeldDistances
/// times the distance; `chain` then says where.
struct NearWeld {
  std::optional<WeldedSurface> welded;
  std::size_t n_joined = 0;
  Vec3d chain;
};
NearWeld joined_within(const WeldedSurface& exact, double distance, UnusedPoints unused);

}  // namespace vex
