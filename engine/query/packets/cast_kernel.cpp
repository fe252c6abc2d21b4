// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: with what a
// search begins, and so the last digits of what it finds, is the same everywhere.
//
// Each lane has an edge between two points of K = A - B, and looks beyond it for a third one about the ray as it is
// seen along itself; then it has a triangle around the ray, a portal, and looks against the ray for a point beyond
// that. In either state a step is one support point, by whose shadow the lane goes on, so lanes in either take it
// together. A lane that is at its end keeps what it has.
#include <array>

#include "engine/numeric/frame.h"
#include "engine/numeric/packet_memory.h"
#include "engine/query/packets/any_core.h"
#include "engine/query/packets/cast_guess.h"
#include "engine/query/packets/packet_difference.h"

namespace vex {
namespace VEX_ISA {
namespace {

// Curved bodies come from their size to 2^-46 of it within some 60; what takes longer goes on by itself.
constexpr int kMostRounds = 96;
// The first point is taken a little aside of where symmetry has it: through that the ray would pass exactly.
constexpr double kTiltX = 0.1173, kTiltY = 0.0711;
// A shadow that is not beyond an edge by so much of its length is on it.
constexpr double kOnEdge = 0x1p-40;

template <int W, class Core>
class Portals {
 public:
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Vec = Vec3<L>;

  Portals(const PacketPairForms& forms, double gap) : pair_(forms), gap_(gap) {}

  void find(const PoseTable& poses, const double* motions, std::size_t k, CastGuesses& guesses) {
    const Transform<L> pose = Pair::pose_at(poses.columns, poses.stride, k);
    look_along({L::load(motions + k), L::load(motions + poses.stride + k), L::load(motions + 2 * poses.stride + k)});
    goes_on_ = Mask::first(poses.n - k);
    has_portal_ = passes_ = Mask(false);
    begin(pose);
    for (int round = 0; round < kMostRounds && any(goes_on_); ++round) take_in(pose);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec dir = (L(1.0) / norm(corners_[c].dir)) * corners_[c].dir;
      dir.x.store(guesses.dirs[c][0] + k);
      dir.y.store(guesses.dirs[c][1] + k);
      dir.z.store(guesses.dirs[c][2] + k);
    }
    select(has_portal_, L(3.0), select(passes_, L(1.0), L(0.0))).store(guesses.n_dirs + k);
  }

 private:
  using Pair = PacketDifference<W, Core>;

  struct Shadow {
    L x, y;
  };
  struct Corner {
    Vec w, dir;
    Shadow at;
  };

  static L turn(const Shadow& p, const Shadow& q) { return p.x * q.y - p.y * q.x; }
  static Corner chosen(const Mask& first, const Corner& p, const Corner& q) {
    return {vex::select<L>(first, p.w, q.w),
            vex::select<L>(first, p.dir, q.dir),
            {select(first, p.at.x, q.at.x), select(first, p.at.y, q.at.y)}};
  }

  void look_along(const Vec& motion) {
    const Frame<L> frame = frame_about((L(1.0) / norm(motion)) * motion);
    across_x_ = frame.across_1;
    across_y_ = frame.across_2;
    along_ = frame.axis;
  }

  Vec across(const L& x, const L& y) const { return x * across_x_ + y * across_y_; }

  Corner corner_along(const Transform<L>& pose, const Vec& dir) const {
    const Vec w = pair_.support(pose, dir);
    return {w, dir, {dot(w, across_x_), dot(w, across_y_)}};
  }

  // Two points, unless all of K is behind the ray's start: then the direction along it parts them.
  void begin(const Transform<L>& pose) {
    const Corner last = corner_along(pose, along_);
    passes_ = both(goes_on_, dot(last.w, along_) < L(0.0));
    const Corner first = corner_along(pose, across(L(kTiltX), L(kTiltY)) - along_);
    corners_[0] = chosen(passes_, last, first);
    corners_[1] =
        corner_along(pose, across(-first.at.x - L(kTiltX) * first.at.y, -first.at.y + L(kTiltX) * first.at.x));
    corners_[2] = corners_[1];
    end_where_passed(corners_[1]);
    goes_on_ = but_not(goes_on_, passes_);
  }

  // The direction is across the ray, and K on its other side.
  void end_where_passed(const Corner& newest) {
    const Mask passes = but_not(both(goes_on_, dot(newest.dir, newest.w) < L(0.0)), has_portal_);
    corners_[0].dir = vex::select<L>(passes, newest.dir, corners_[0].dir);
    passes_ = either(passes_, passes);
  }

  void take_in(const Transform<L>& pose) {
    const Shadow from = corners_[0].at, to = corners_[1].at;
    const Shadow edge{to.x - from.x, to.y - from.y};
    const L side = select(turn(from, to) >= L(0.0), L(1.0), L(-1.0));
    const Vec face = cross(corners_[2].w - corners_[0].w, corners_[1].w - corners_[0].w);  // against the ray
    const Vec dir = vex::select<L>(has_portal_, face, across(-side * edge.y, side * edge.x));
    const Corner newest = corner_along(pose, dir);
    const L beyond = dot(dir, newest.w - corners_[0].w);
    end_where_passed(newest);
    goes_on_ = but_not(goes_on_, passes_);
    const Mask is_beyond = beyond > select(has_portal_, L(gap_) * norm(dir), L(kOnEdge) * dot(dir, dir));
    goes_on_ = both(goes_on_, is_beyond);
    const Mask refines = both(goes_on_, has_portal_), closes = but_not(goes_on_, has_portal_);
    narrow(newest, refines);
    close(newest, side, closes);
  }

  // Of the three parts of the portal the one that the ray passes: (k, k + 1, newest) has it where the shadow of
  // `newest` turns to the ones of k and k + 1 so. What no part has is lost to rounding.
  void narrow(const Corner& newest, const Mask& refines) {
    std::array<L, 3> turns;
    for (std::size_t c = 0; c < 3; ++c) turns[c] = turn(corners_[c].at, newest.at);
    Mask is_left = refines;
    for (std::size_t k = 0; k < 3; ++k) {
      const Mask is_here = both(is_left, both(turns[k] <= L(0.0), turns[(k + 1) % 3] >= L(0.0)));
      corners_[(k + 2) % 3] = chosen(is_here, newest, corners_[(k + 2) % 3]);
      is_left = but_not(is_left, is_here);
    }
    goes_on_ = but_not(goes_on_, is_left);
  }

  // The ray is between the newest point and the edge, or beyond one of the two new edges, which is the next one: of two
  // the one that it is beyond by more.
  void close(const Corner& newest, const L& side, const Mask& closes) {
    const Corner first = corners_[0], second = corners_[1];
    const L of_second = side * turn(second.at, newest.at), of_first = side * turn(newest.at, first.at);
    const Mask beyond_second = of_second < L(0.0), beyond_first = of_first < L(0.0);
    const Mask is_between = but_not(but_not(closes, beyond_second), beyond_first);
    const auto length = [&](const Corner& c) {
      const L x = newest.at.x - c.at.x, y = newest.at.y - c.at.y;
      return square_root(x * x + y * y);
    };
    const Mask more_of_second = of_second * length(first) < of_first * length(second);
    const Mask replaces_first =
        but_not(both(closes, both(beyond_second, either(negation(beyond_first), more_of_second))), is_between);
    const Mask replaces_second = but_not(but_not(closes, is_between), replaces_first);
    // Seen along the ray a portal turns counter-clockwise.
    const Mask is_turned = both(is_between, side < L(0.0));
    corners_[0] = chosen(replaces_first, newest, chosen(is_turned, second, first));
    corners_[1] = chosen(replaces_second, newest, chosen(is_turned, first, second));
    corners_[2] = chosen(is_between, newest, corners_[2]);
    has_portal_ = either(has_portal_, is_between);
  }

  Pair pair_;
  double gap_;
  Vec along_, across_x_, across_y_;
  std::array<Corner, 3> corners_;
  Mask goes_on_, has_portal_, passes_;
};

}  // namespace

void guess_casts(const PacketPairForms& forms, double gap, const PoseTable& poses, const double* motions,
                 CastGuesses& guesses) {
  Portals<kRegisterLanes, AnyCore> portals(forms, gap);
  for (std::size_t k = 0; k < poses.n; k += kRegisterLanes) portals.find(poses, motions, k, guesses);
}

}  // namespace VEX_ISA
}  // namespace vex
