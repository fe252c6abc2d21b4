// The fitted sets of many trials at once, and the positions in them (fitted_domain.h): a step a loop. Heights along
// the axes, the two sets of the axes; then for each pair of axes that have a direction of their own the normals that
// are made of them, heights along these, and the two sets more.
#pragma once

#include "engine/query/packets/packet_core.h"
#include "engine/sampling/poses/pose_columns.h"

namespace vex {
namespace VEX_ISA {

/// h(n) and h(-n) of one body along each of n directions, as the body's own mapping gives them, bit for bit.
class HeightsKernel {
 public:
  using L = Packet<kRegisterLanes>;

  __attribute__((noinline, flatten)) static void find(const KernelHeights& heights, const ConvexBody::Columns& dirs,
                                                      std::size_t n, double* along, double* against) {
    const CoreForm* const core = heights.core();
    if (core == nullptr) {
      heights.of_body(dirs, n, along, against);
      return;
    }
    const double ball_radius = heights.ball_radius();
    const bool is_symmetric = heights.is_symmetric();
    switch (core->kind) {
      case CoreForm::Kind::box:
        if (is_symmetric) return of_points(SymmetricBox{core->upper}, ball_radius, true, dirs, n, along, against);
        return of_points(BoxCore(*core), ball_radius, false, dirs, n, along, against);
      case CoreForm::Kind::ellipsoid:
        return of_points(EllipsoidCore(*core), ball_radius, true, dirs, n, along, against);
      case CoreForm::Kind::table: return of_points(TableCore(*core), 0.0, false, dirs, n, along, against);
      case CoreForm::Kind::vertices: return of_vertices(VerticesCore(*core), dirs, n, along, against);
      case CoreForm::Kind::pieces:
      case CoreForm::Kind::powers:
      case CoreForm::Kind::profile: break;  // which the body itself answers
    }
  }

 private:
  // A BoxCore whose corners are found with half the work.
  struct SymmetricBox {
    Vec3<L> support(const Vec3<L>& dir) const {
      return {copy_sign(L(upper.x), dir.x), copy_sign(L(upper.y), dir.y), copy_sign(L(upper.z), dir.z)};
    }
    Vec3d upper;
  };

  static Vec3<L> load(const ConvexBody::Columns& dirs, std::size_t k) {
    return {L::load(dirs.x + k), L::load(dirs.y + k), L::load(dirs.z + k)};
  }

  // The ball as `ball_support` has it; no direction is zero but of lanes that nobody asked for.
  template <class Core>
  static L height(const Core& core, double ball_radius, const Vec3<L>& dir) {
    Vec3<L> point = core.support(dir);
    if (ball_radius > 0.0) point = point + (L(ball_radius) / norm(dir)) * dir;
    return dot(dir, point);
  }
  template <class Core>
  static void of_points(const Core core, double ball_radius, bool is_symmetric, const ConvexBody::Columns dirs,
                        std::size_t n, double* along, double* against) {
    for (std::size_t k = 0; k < n; k += kRegisterLanes) {
      const Vec3<L> dir = load(dirs, k);
      const L value = height(core, ball_radius, dir);
      value.store(along + k);
      (is_symmetric ? value : height(core, ball_radius, -dir)).store(against + k);
    }
  }

  // The largest of all products, and of their negatives: which vertices have them is not asked.
  static void of_vertices(const VerticesCore core, const ConvexBody::Columns dirs, std::size_t n, double* along,
                          double* against) {
    using Two = Packet<2 * kRegisterLanes>;  // that read each vertex once
    for (std::size_t k = 0; k < n; k += 2 * kRegisterLanes) {
      const Vec3<Two> dir{Two::load(dirs.x + k), Two::load(dirs.y + k), Two::load(dirs.z + k)};
      Two most = dot(Vec3<Two>{Two(core.x[0]), Two(core.y[0]), Two(core.z[0])}, dir), least = most;
      for (std::size_t i = 1; i < core.n; ++i) {
        const Two value = dot(Vec3<Two>{Two(core.x[i]), Two(core.y[i]), Two(core.z[i])}, dir);
        most = larger(value, most);
        least = smaller(value, least);
      }
      most.store(along + k);
      (-least).store(against + k);
    }
  }
};

class Fitting {
 public:
  using L = Packet<kRegisterLanes>;
  using Mask = PacketMask<kRegisterLanes>;

  Fitting(const FittedRecipe& recipe, PoseColumns& columns) : recipe_(recipe), columns_(columns) {}

  /// Translations and, in `share`, volumes, of these trials: at most kMostFitted.
  void fit(std::size_t first, std::size_t n) {
    first_ = first;
    n_ = n;
    for (std::size_t k = 0; k < 3; ++k) {
      find_heights(recipe_.heights_a, {pose_column(k), pose_column(k + 3), pose_column(k + 6)}, kAxesA + 2 * k);
      find_heights(recipe_.heights_b, {pose_column(3 * k), pose_column(3 * k + 1), pose_column(3 * k + 2)},
                   kAxesB + 2 * k);
    }
    sets_of_axes();
    const FittedPair& pair = *recipe_.pair;
    for (std::size_t i = 0; i < pair.n_axes_a; ++i) {
      for (std::size_t j = 0; j < pair.n_axes_b; ++j) sets_across(pair.axes_a[i], pair.axes_b[j]);
    }
  }

 private:
  static constexpr std::size_t W = kRegisterLanes;
  // Columns of heights, two a normal, along and against it, and of normals, three each.
  static constexpr std::size_t kAxesA = 0, kAxesB = 6, kAcrossA = 12, kAcrossB = 18, kNormals = 24, kNormalsOfB = 33;

  double* pose_column(std::size_t column) const { return columns_.poses[column] + first_; }
  static Vec3<L> load(const double* x, const double* y, const double* z, std::size_t k) {
    return {L::load(x + k), L::load(y + k), L::load(z + k)};
  }
  Vec3<L> axis_of_b(std::size_t axis, std::size_t k) const {
    return load(pose_column(axis), pose_column(axis + 3), pose_column(axis + 6), k);
  }
  Vec3<L> normal(std::size_t column, std::size_t k) const {
    return load(columns_.fitted[column], columns_.fitted[column + 1], columns_.fitted[column + 2], k);
  }
  Heights<L> heights(std::size_t column, std::size_t k) const {
    return {L::load(columns_.fitted[column] + k), L::load(columns_.fitted[column + 1] + k)};
  }
  void store(std::size_t column, std::size_t k, const Vec3<L>& v) const {
    v.x.store(columns_.fitted[column] + k);
    v.y.store(columns_.fitted[column + 1] + k);
    v.z.store(columns_.fitted[column + 2] + k);
  }
  void find_heights(const KernelHeights& body, const ConvexBody::Columns& dirs, std::size_t column) const {
    HeightsKernel::find(body, dirs, n_, columns_.fitted[column], columns_.fitted[column + 1]);
  }

  // Of the smallest set only the position in it is kept, and how large it is.
  struct Keep {
    L u, v, w;
    Vec3<L>* position;
    void operator()(const Mask& is_better, const ParallelepipedOf<L>& set) const {
      *position = vex::select<L>(is_better, set.position(u, v, w), *position);
    }
  };
  using Sets = FittedSets<L, Keep>;
  Keep keep(std::size_t k, Vec3<L>* position) const {
    const auto coordinate = [&](std::size_t number) { return L::load(columns_.coordinates[number] + first_ + k); };
    return {coordinate(0), coordinate(1), coordinate(2), position};
  }
  void store_best(std::size_t k, const L& volume, const Vec3<L>& position) const {
    position.x.store(pose_column(9) + k);
    position.y.store(pose_column(10) + k);
    position.z.store(pose_column(11) + k);
    volume.store(columns_.share + first_ + k);
  }

  void sets_of_axes() const {
    const FittedPair pair = *recipe_.pair;
    const std::size_t n = n_;
    for (std::size_t k = 0; k < n; k += W) {
      Vec3<L> position;
      Sets sets(pair, L(0.0), keep(k, &position));
      sets.consider_axes_of_a({sets.along_axis_of_a(0, heights(kAxesB, k)),
                               sets.along_axis_of_a(1, heights(kAxesB + 2, k)),
                               sets.along_axis_of_a(2, heights(kAxesB + 4, k))});
      sets.consider_axes_of_b(
          {axis_of_b(0, k), axis_of_b(1, k), axis_of_b(2, k)},
          {sets.along_axis_of_b(0, heights(kAxesA, k)), sets.along_axis_of_b(1, heights(kAxesA + 2, k)),
           sets.along_axis_of_b(2, heights(kAxesA + 4, k))});
      store_best(k, sets.best_volume(), position);
    }
  }

  void sets_across(std::size_t axis_a, std::size_t axis_b) const {
    const std::size_t n = n_;
    for (std::size_t k = 0; k < n; k += W) {
      const Transform<L> rotation{load(pose_column(0), pose_column(1), pose_column(2), k),
                                  load(pose_column(3), pose_column(4), pose_column(5), k),
                                  load(pose_column(6), pose_column(7), pose_column(8), k),
                                  {}};
      const Sets::Across across = Sets::Across::of(axis_a, axis_of_b(axis_b, k));
      store(kNormals, k, across.c);
      store(kNormals + 3, k, across.a);
      store(kNormals + 6, k, across.b);
      store(kNormalsOfB, k, rotation.direction_to_b(across.c));
      store(kNormalsOfB + 3, k, rotation.direction_to_b(across.a));
      store(kNormalsOfB + 6, k, rotation.direction_to_b(across.b));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto columns = [&](std::size_t first) -> ConvexBody::Columns {
        return {columns_.fitted[first + 3 * i], columns_.fitted[first + 3 * i + 1], columns_.fitted[first + 3 * i + 2]};
      };
      find_heights(recipe_.heights_a, columns(kNormals), kAcrossA + 2 * i);
      find_heights(recipe_.heights_b, columns(kNormalsOfB), kAcrossB + 2 * i);
    }
    const FittedPair pair = *recipe_.pair;
    for (std::size_t k = 0; k < n; k += W) {
      Vec3<L> position = load(pose_column(9), pose_column(10), pose_column(11), k);
      Sets sets(pair, L::load(columns_.share + first_ + k), keep(k, &position));
      const auto along = [&](std::size_t i) {
        return sets.along(heights(kAcrossA + 2 * i, k), heights(kAcrossB + 2 * i, k));
      };
      sets.consider_across(axis_a, axis_of_b(axis_b, k),
                           {normal(kNormals, k), normal(kNormals + 3, k), normal(kNormals + 6, k)},
                           sets.along_axis_of_a(axis_a, heights(kAxesB + 2 * axis_a, k)),
                           sets.along_axis_of_b(axis_b, heights(kAxesA + 2 * axis_b, k)), along(0), along(1), along(2));
      store_best(k, sets.best_volume(), position);
    }
  }

  const FittedRecipe& recipe_;
  PoseColumns& columns_;
  std::size_t first_ = 0, n_ = 0;
};

}  // namespace VEX_ISA
}  // namespace vex
