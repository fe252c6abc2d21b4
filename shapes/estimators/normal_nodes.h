// A surface area measure as weighted normals: those of one random orientation, on which the estimators and the exact
// average of mixed volumes sum another body's support values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/support/convex_body.h"
#include "shapes/normal_measure.h"

namespace vex {

/// Unit normals that stand in columns. `along[i]` is the weight of normal i; of the first `n_pairs` of them
/// `against[i]` is that of its opposite, which the measure has too.
struct NormalColumns {
  std::vector<double> x, y, z, along, against;
  std::size_t n_pairs = 0;

  std::size_t size() const { return x.size(); }
  void set(std::size_t i, const Vec3d& normal, double weight) {
    x[i] = normal.x;
    y[i] = normal.y;
    z[i] = normal.z;
    along[i] = weight;
  }
};

/// Where the coordinates of one body's normals are in a point of the unit cube: -1 for those that nothing hangs on.
struct NormalCoordinates {
  int pick = -1;  // which of many faces and edges
  int v = -1, w = -1;
};

/// Of one body. Never changes once it is made: copies of an estimator share it.
///
/// Up to kMostSummed faces all count at each point; of more, kPicks are picked, at even steps of one coordinate along a
/// Hilbert curve over the sphere of their normals: neighbours of the coordinate are neighbours on the sphere, and each
/// region has its share of the picks at each point. The same for edges. Curved parts, and single edges, are looked at
/// in some places that their coordinates move together, evenly spread: the mean over the coordinates is the integral
/// whatever the function, and for a smooth one it hardly depends on them.
class NormalNodes {
 public:
  static constexpr std::size_t kMostSummed = 64;
  static constexpr std::size_t kPicks = 32;
  static constexpr std::size_t kPlacesAlong = 16;   // of all parts together that one coordinate is enough for
  static constexpr std::size_t kPlacesAcross = 64;  // of those that take two

  /// `spins`: the orientations are such that an angle about the body's z axis is redundant.
  NormalNodes(const NormalMeasure& area, bool spins);

  /// Of the uniform measure on the sphere, which is in none of the nodes.
  double uniform_mass() const { return uniform_mass_; }
  /// Of all the rest.
  double mass() const { return mass_; }
  bool picks() const { return faces_.picks() || edges_.picks(); }
  /// Whether its normals take powers, as those of superellipsoids.
  bool has_powers() const;
  CoordinatesUsed coordinates() const { return coordinates_; }
  std::size_t n_components() const;

  /// The integral of f over the faces, which are no longer among the nodes: for the sum over all of them that serves
  /// every point where there is one orientation.
  double take_out_faces(const std::function<double(const Vec3d&)>& f);

  /// Half of the picks then go by mass times this function of the normal, where there are picks: a thin body's rim has
  /// next to no area, but may have most of the integral. The other half keep the weights bounded where the function
  /// misleads.
  void favour(const std::function<double(const Vec3d&)>& typical);

  /// As large as every point needs; what is the same at all of them is there.
  NormalColumns columns() const;
  /// The rest of one point, where there is a rest: for uniform coordinates, the mean of the sum of weight * f(normal)
  /// is the integral of f over the measure less its uniform part.
  void place(std::span<const double> point, const NormalCoordinates& at, NormalColumns& columns) const;

 private:
  /// Components of one sort: all of them, or some picked by mass.
  template <class Component>
  class Sort {
   public:
    Sort() = default;
    explicit Sort(std::vector<Component> components);

    bool picks() const { return !shares_.empty(); }
    std::size_t n_components() const { return components_.size(); }
    const std::vector<Component>& components() const { return components_; }
    void favour(const std::function<double(const Vec3d&)>& typical);
    /// kPicks of them.
    void place_picks(double pick, double v, double w, std::size_t first, NormalColumns& columns) const;

   private:
    void normalise_shares();

    std::vector<Component> components_;
    std::vector<double> shares_, share_up_to_;  // of the picks; empty where all are summed
    std::vector<std::uint32_t> first_of_step_;  // where the search begins, of each of the kPicks steps and at the end
  };

  struct Pair {
    Vec3d unit_normal;
    double along = 0.0, against = 0.0;
  };
  void pair_faces();
  static std::size_t n_places(bool is_across, std::size_t n_components);
  /// n evenly spread places of every component of a sort, from index `first`.
  template <class Component>
  static void place_all(const std::vector<Component>& components, std::size_t n, double v, double w, bool halved,
                        std::size_t first, NormalColumns& columns);

  double uniform_mass_ = 0.0, mass_ = 0.0;
  Sort<NormalAtom> faces_;
  Sort<NormalArc> edges_;
  std::vector<Pair> face_pairs_;                         // of faces that are all summed: those that have an opposite,
  std::vector<NormalAtom> single_faces_;                 // and those that have none
  std::vector<NormalMeasure::Component> even_, curved_;  // curved parts that look like their mirror image, and others
  std::size_t n_of_even_ = 1, n_of_curved_ = 1, n_of_edge_ = 1;  // places of each
  CoordinatesUsed coordinates_;
};

}  // namespace vex
