// The convex hull of finitely many points.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/exact_form.h"
#include "engine/support/first_farthest.h"
#include "engine/support/lazy_direction_map.h"

namespace vex {

/// A convex polytope given by its vertices; what every mesh becomes.
///
/// The vertices are the body exactly: no vertex is moved, and a support point is one of them, bit for bit. They are
/// kept by coordinate, so that a packet scans them without shuffling. Of vertices that tie, the first one answers. A
/// body of many vertices that is asked often answers from a table of directions instead (direction_map.h): the same
/// vertex, bit for bit. Copies share the table.
class Polytope {
 public:
  /// `vertices`: at least one, all finite. `centre`: a point of the body. `inradius`: a ball of this radius about the
  /// centre lies in the body (0 claims nothing). Throws InputError where a vertex is not finite or there is none.
  Polytope(std::span<const Vec3d> vertices, const Vec3d& centre, double inradius);

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    if constexpr (std::same_as<L, double>) {
      if (map_ != nullptr) {
        const DirectionMap* const map = map_->for_call(x_, y_, z_);
        if (map != nullptr && map->takes(dir)) return map->support(dir);
      }
      return vertex(first_farthest(x_.size(), dir, [this](std::size_t k) { return vertex(k); }));
    } else {
      return scan(dir);
    }
  }

  bool rounds_as_kernels() const { return true; }
  /// The support point is a vertex, and its value is short of the largest by at most this times |dir| (E2).
  double support_error() const { return support_error_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

  std::size_t n_vertices() const { return x_.size(); }
  std::vector<Vec3d> vertices() const;
  ExactForm exact_form() const { return {vertices(), {}, 0.0}; }
  template <class L = double>
  Vec3<L> vertex(std::size_t i) const {
    return {L(x_[i]), L(y_[i]), L(z_[i])};
  }

  /// The table, or null while there is none.
  const DirectionMap* direction_map() const { return map_ == nullptr ? nullptr : map_->made(); }
  /// The table as kernels read it: made here and now where it is not there yet. None of a body of few vertices.
  std::optional<DirectionTable> direction_table() const {
    return map_ == nullptr ? std::nullopt : map_->made_now(x_, y_, z_).table();
  }

 private:
  template <class L>
  Vec3<L> scan(const Vec3<L>& dir) const {
    L best = dot(vertex<L>(0), dir);
    L best_index = L(0.0);
    for (std::size_t i = 1; i < x_.size(); ++i) {
      const L value = dot(vertex<L>(i), dir);
      const MaskOf<L> better = value > best;
      best = select(better, value, best);
      best_index = select(better, L(static_cast<double>(i)), best_index);
    }
    return {gather(x_.data(), best_index), gather(y_.data(), best_index), gather(z_.data(), best_index)};
  }

  std::vector<double> x_, y_, z_;
  Vec3d centre_;
  double circumradius_ = 0.0;  // rounded upwards
  double inradius_ = 0.0;
  double support_error_ = 0.0;
  std::shared_ptr<LazyDirectionMap> map_;  // null of a body of few vertices
};

}  // namespace vex
