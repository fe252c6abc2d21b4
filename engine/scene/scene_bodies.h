// The bodies of a scene: shapes, poses, and bounds that hold whatever the rotation (internal).
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/scene/large_vector.h"
#include "engine/scene/periodic_box.h"
#include "engine/scene/scene_kernel.h"
#include "engine/scene/scene_pair.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Added to radii, so that no square of a distance that matters is subnormal.
inline constexpr double kTrifle = 0x1p-500;

/// What a loop over bodies or pairs reads here and there in memory is asked for so many turns before.
inline constexpr std::size_t kAhead = 16;

/// Of a number that no body has.
inline constexpr ShapeId kNoShape = ~ShapeId{0};

/// What is known of a shape at any pose of a scene (E26).
struct ShapeBounds {
  Vec3d centre;
  Vec3d extents;        // of bodies that are not turned: the box about one is this long along each axis, and more
  double radius = 0.0;  // of a ball about the centre that holds the placed body, as seen from any other body's frame
  double inner_radius = 0.0;  // of one that the body holds, seen likewise; below 0 where none is known
  double turning = 0.0;  // by how much a turn of one radian changes how far the body reaches from the centre, at most
  // A cylinder about the centre, along a coordinate axis of the shape's frame.
  int axis = 0;
  double half_length = 0.0, axis_radius = 0.0;
  bool has_exact_form = false;

  /// What rounding takes off or adds where such a body's centre, its way to another one's, moved by a shift that is
  /// counted so, and squares of distances are computed: to be added to radii and half extents.
  double rounding_at(const Vec3d& place, double shift = 0.0) const {
    return 0x1p-46 * (norm_1(place) + norm_1(centre) + shift) + kTrifle;
  }
  bool is_long() const { return half_length > 2.0 * axis_radius; }
  bool is_flat() const { return axis_radius > 3.0 * half_length; }
};
ShapeBounds shape_bounds(const ConvexBody& body);

/// The same for two shapes, bodies of which are compared; `margin` is added to their distance.
CylinderPair cylinder_pair(const ShapeBounds& a, const ShapeBounds& b, double margin);

/// Bodies by number; a free number has kNoShape.
class SceneBodies {
 public:
  explicit SceneBodies(std::optional<PeriodicBox> box)
      : box_(std::move(box)), shape_of_(1, kNoShape), poses_(kNumbersABody) {}

  ShapeId add_shape(const ConvexBody& body);
  /// Of a periodic scene: the pose moved so that the centre is in the box, and by which image.
  Transformd wrapped(const Transformd& pose, const Vec3d& own_centre, ImageOffset* image) const;
  /// What scenes take, of bodies and of visitors. Throw InputError.
  static void check_size(const ConvexBody& body);
  static void check_rotation(const Transformd& pose);
  BodyId add(ShapeId shape, const Pose& pose, const ImageOffset& moved = {});
  /// Behind the last body. Where one is refused none is added.
  void append(ShapeId shape, std::span<const Pose> poses, const ImageOffset& moved);
  /// So that none of these is refused, nor lacks memory, when they are added one by one. Throws.
  void prepare_for(ShapeId shape, std::span<const Pose> poses);
  void remove(BodyId body);
  /// All of them. The shapes stay, and memory is kept.
  void clear();
  void set_pose(BodyId body, const Pose& pose) {
    expect_turns();
    set_poses(body, {&pose, 1});
  }
  /// To be called before set_poses.
  void expect_turns() { may_be_turned_ = true; }
  /// Of this body and those behind it, by several threads.
  void set_poses(BodyId first, std::span<const Pose> poses);

  const std::optional<PeriodicBox>& box() const { return box_; }
  const std::vector<ConvexBody>& shapes() const { return shapes_; }
  const ShapeBounds& bounds(ShapeId shape) const { return bounds_[shape]; }
  /// Where all bodies have one shape nothing is looked up here and there in memory.
  const ShapeBounds& bounds_of(BodyId body) const { return bounds_[bounds_.size() == 1 ? 0 : shape_of_[body]]; }
  std::size_t size() const { return n_; }
  BodyId end() const { return static_cast<BodyId>(shape_of_.size() - 1); }
  bool has(BodyId body) const { return body < end() && shape_of_[body] != kNoShape; }
  /// Behind the last body there is a place for a visitor, in the table of poses too.
  void set_visitor(ShapeId shape, const Transformd& pose);
  const LargeVector<ShapeId>& shape_of() const { return shape_of_; }
  /// Rows of four doubles, kRowsABody a body.
  const LargeVector<double>& poses() const { return poses_; }
  Transformd pose(BodyId body) const { return pose_at(poses_.data(), body); }
  const ImageOffset& image(BodyId body) const { return image_[body]; }
  /// The middle of the body's ball, in the scene's frame, rounded.
  const Vec3d& centre(BodyId body) const { return centres_[body]; }
  /// Of all bodies that are there: of their balls, and how far (in the 1-norm) their centres are from the origins of
  /// their frames.
  double largest_radius() const;
  double largest_offset() const;
  /// The same of all shapes, whether there are bodies of them or not.
  double largest_radius_of_shapes() const;
  double largest_offset_of_shapes() const;
  /// Of the balls about the points of their cores.
  double largest_ball() const;
  /// Of the centres themselves (in the 1-norm).
  double largest_distance() const;

  /// From now on moves are added up (E26).
  void track();
  bool is_tracked() const { return is_tracked_; }
  /// Since `track`, sums over the moves: by no more than `turned` has changed how far the body reaches from its centre
  /// along any direction; `travel` is the centre's way and that, and each move makes it larger.
  double travel(BodyId body) const { return travel_[body]; }
  /// `centre` is where the centre would be, had the body not been moved into the box again: `crossed` lattice vectors
  /// from where it is, where it is in another box than it was.
  struct alignas(32) Track {  // in one line of memory
    Vec3d centre;
    double turned = 0.0;
  };
  const Track& tracked(BodyId body) const { return tracks_[body]; }
  bool has_crossed(BodyId body) const { return has_crossed_[body] != 0; }
  ImageOffset crossed(BodyId body) const { return has_crossed(body) ? crossed_[body] : ImageOffset{}; }
  void prefetch_track(BodyId body) const { __builtin_prefetch(&tracks_[body]); }
  /// The most that any body's `travel` has grown since this was asked before, or since `track`.
  double largest_step();
  /// How far the centre that is farthest from where it was at `track` is, rounded, whichever way it went; with what its
  /// body has turned or without.
  double largest_displacement(bool with_turns) const;

  static Transformd pose_at(const double* poses, std::size_t place);
  static Vec3d centre_of(const Transformd& pose, const Vec3d& own_centre) {
    return own_centre.x == 0.0 && own_centre.y == 0.0 && own_centre.z == 0.0 ? pose.translation : pose(own_centre);
  }
  static void write_pose(double* poses, std::size_t place, const Transformd& pose);
  /// Its rotation is the identity, bit for bit but for the sign of zeros.
  static bool is_upright(const Transformd& pose);
  /// All bodies are alike and none is turned, no box is triclinic, and the boxes about the bodies, each as large as the
  /// other one's, meet in fewer places than their balls do.
  bool are_told_by_boxes() const;

  /// The pose as the scene keeps it, moved into the box. Throws InputError where it is none for a scene.
  Transformd checked(ShapeId shape, const Transformd& given, ImageOffset* image) const;

 private:
  // Of a box: what is surely inside is not wrapped.
  static constexpr double kInside = 0.999;
  // In open space.
  static constexpr double kFarthest = 1e100;
  // Whether check_rotation has nothing against it; NaN fails.
  static bool is_turned_well(const Transformd& pose);
  void require_shape(ShapeId shape) const;
  void place(BodyId body, const Transformd& pose);
  Transformd placed(ShapeId shape, const Transformd& given, ImageOffset* image) const;
  void set_any_pose(BodyId body, const Transformd& given);
  void add_to_track(BodyId body, const Vec3d& centre_from, const Vec3d& step, double turned);

  std::optional<PeriodicBox> box_;
  std::vector<ConvexBody> shapes_;
  std::unordered_map<const void*, ShapeId> shape_by_identity_;  // the shapes hold what these point to
  std::vector<ShapeBounds> bounds_;
  std::vector<std::size_t> n_of_shape_;
  LargeVector<ShapeId> shape_of_;
  LargeVector<double> poses_;
  LargeVector<Vec3d> centres_;
  LargeVector<ImageOffset> image_;
  bool is_tracked_ = false;  // of all bodies there are then:
  LargeVector<double> travel_, travel_before_;
  LargeVector<Track> tracks_;
  LargeVector<Vec3d> starts_;  // centres at `track`
  LargeVector<std::uint8_t> has_crossed_;
  LargeVector<ImageOffset> crossed_;  // of those that have
  std::vector<BodyId> free_;          // a heap, the lowest first
  std::size_t n_ = 0;
  bool may_be_turned_ = false;  // some body is not upright, or may not be
};

inline Transformd SceneBodies::pose_at(const double* poses, std::size_t place) {
  const double* p = poses + kNumbersABody * place;
  return {{p[0], p[1], p[2]}, {p[4], p[5], p[6]}, {p[8], p[9], p[10]}, {p[3], p[7], p[11]}};
}

inline bool SceneBodies::is_upright(const Transformd& pose) {
  const auto are = [](const Vec3d& row, double x, double y, double z) {
    return (row.x == x) & (row.y == y) & (row.z == z);
  };
  return are(pose.row_x, 1.0, 0.0, 0.0) & are(pose.row_y, 0.0, 1.0, 0.0) & are(pose.row_z, 0.0, 0.0, 1.0);
}

inline void SceneBodies::write_pose(double* poses, std::size_t place, const Transformd& pose) {
  double* p = poses + kNumbersABody * place;
  const Vec3d* const rows[] = {&pose.row_x, &pose.row_y, &pose.row_z};
  const double t[] = {pose.translation.x, pose.translation.y, pose.translation.z};
  for (int k = 0; k < 3; ++k) {
    p[4 * k] = rows[k]->x;
    p[4 * k + 1] = rows[k]->y;
    p[4 * k + 2] = rows[k]->z;
    p[4 * k + 3] = t[k];
  }
}

}  // namespace vex
