// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: with what a
// search begins, and so the last digits of what it finds, is the same everywhere.
//
// The simplex of a descent is three corners at most, with weights that make its nearest point of them. Of a lane whose
// simplex has fewer the other places hold earlier corners, of weight 0: points of A - B like any others. A new corner
// takes the place of one of these. So all lanes take the same step: the nearest point of the new corner, its edges and
// its triangles with the three, whichever has one inside that is nearest. A lane that is at its end keeps what it has.
#include <array>

#include "engine/numeric/packet_memory.h"
#include "engine/query/packets/any_core.h"
#include "engine/query/packets/nearest_guess.h"
#include "engine/query/packets/packet_difference.h"

namespace vex {
namespace VEX_ISA {
namespace {

// Curved bodies halve the gap with every second support point or so: from the size to 2^-32 of it. What takes longer
// goes on by itself.
constexpr int kMostRounds = 48;
// Rounding alone makes a nearest point nearer by less than this.
constexpr double kProgress = 1.0 - 0x1p-44;

template <int W, class Core>
class Descents {
 public:
  using L = Packet<W>;
  using Mask = PacketMask<W>;
  using Vec = Vec3<L>;

  Descents(const PacketPairForms& forms, const NearestGoal& goal)
      : pair_(forms), centre_a_(forms.centre_a), goal_(goal) {
    pair_.ball_radius = 0.0;
  }

  void descend(const PoseTable& poses, std::size_t k, NearestGuesses& guesses) {
    const Transform<L> pose = Pair::pose_at(poses.columns, poses.stride, k);
    const Corner first = corner_along(pose, pose(broadcast<L>(pair_.centre_b)) - broadcast<L>(centre_a_));
    corners_ = {first, first, first};
    weights_ = {L(1.0), L(0.0), L(0.0)};
    at_ = first.w;
    square_ = dot(at_, at_);
    goes_on_ = Mask::first(poses.n - k);
    for (int round = 0; round < kMostRounds && any(goes_on_); ++round) take_in(corner_along(pose, -at_), round + 1);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec dir = corners_[c].dir;
      weights_[c].store(guesses.weights[c] + k);
      if (goal_.wants_points) {
        store(pair_.a.support(dir), guesses.corners[c], k);
        store(pair_.b.support(-pose.direction_to_b(dir)), guesses.corners[c] + 3, k);
      } else {
        store((L(1.0) / norm(dir)) * dir, guesses.corners[c], k);
      }
    }
  }

 private:
  using Pair = PacketDifference<W, Core>;

  struct Corner {
    Vec w, dir;
  };
  // The nearest point of the newest corner and some of the others, by its weights, and the square of its distance.
  struct Nearest {
    L square, of_newest;
    std::array<L, 3> of_old;
  };

  static void store(const Vec& v, double (*columns)[NearestGuesses::kStride], std::size_t k) {
    v.x.store(columns[0] + k);
    v.y.store(columns[1] + k);
    v.z.store(columns[2] + k);
  }

  Corner corner_along(const Transform<L>& pose, const Vec& dir) const { return {pair_.support(pose, dir), dir}; }

  // `n_known`: beyond so many places there is nothing yet but the first corner again.
  void take_in(const Corner& newest, int n_known) {
    const L length = square_root(square_), height = dot(at_, newest.w);
    const L gain = square_ - height;
    goes_on_ = both(goes_on_, gain > L(goal_.relative_gap) * (square_ + L(goal_.size) * length));
    goes_on_ = but_not(goes_on_, height > L(goal_.farthest) * length);
    const Nearest found = nearest_with(newest.w, n_known);
    goes_on_ = both(goes_on_, found.square < L(kProgress) * square_);
    // In the first place of no weight, of which there is one.
    const std::array<L, 3>& of_old = found.of_old;
    const Mask is_0 = both(goes_on_, of_old[0] <= L(0.0));
    const Mask is_1 = but_not(both(goes_on_, of_old[1] <= L(0.0)), is_0);
    const Mask is_2 = but_not(but_not(goes_on_, is_0), is_1);
    const std::array<Mask, 3> is_here = {is_0, is_1, is_2};
    Vec at;
    for (std::size_t c = 0; c < 3; ++c) {
      corners_[c].w = select<L>(is_here[c], newest.w, corners_[c].w);
      corners_[c].dir = select<L>(is_here[c], newest.dir, corners_[c].dir);
      const L weight = select(is_here[c], found.of_newest, of_old[c]);
      weights_[c] = select(goes_on_, weight, weights_[c]);
      at = at + weights_[c] * corners_[c].w;
    }
    at_ = at;
    square_ = dot(at, at);
  }

  Nearest nearest_with(const Vec& a, int n_known) const {
    Nearest best{dot(a, a), L(1.0), {L(0.0), L(0.0), L(0.0)}};
    std::array<Vec, 3> a_p;
    const auto offer = [&](std::size_t i) {
      a_p[i] = cross(a, corners_[i].w);
      offer_edge(best, a, a_p[i], i);
    };
    offer(0);
    if (n_known == 1) return best;
    offer(1);
    offer_triangle(best, a, a_p, 0, 1);
    if (n_known == 2) return best;
    offer(2);
    offer_triangle(best, a, a_p, 1, 2);
    offer_triangle(best, a, a_p, 2, 0);
    return best;
  }

  // |a x p| is twice the area of the triangle of the edge and the origin.
  void offer_edge(Nearest& best, const Vec& a, const Vec& a_p, std::size_t i) const {
    const Vec& p = corners_[i].w;
    const Vec edge = p - a;
    const L of_p = -dot(a, edge), of_a = dot(p, edge);
    const L inverse = L(1.0) / (of_a + of_p);
    const L square = dot(a_p, a_p) * inverse;
    const Mask is_better = both(both(of_p > L(0.0), of_a > L(0.0)), square < best.square);
    best.square = select(is_better, square, best.square);
    best.of_newest = select(is_better, of_a * inverse, best.of_newest);
    for (std::size_t c = 0; c < 3; ++c) {
      best.of_old[c] = select(is_better, c == i ? of_p * inverse : L(0.0), best.of_old[c]);
    }
  }

  // (p - a) x (q - a) = p x q - a x q + a x p; its products with the sides of the origin's pyramid are the weights, and
  // their sum its square.
  void offer_triangle(Nearest& best, const Vec& a, const std::array<Vec, 3>& a_p, std::size_t i, std::size_t j) const {
    const Vec p_q = cross(corners_[i].w, corners_[j].w);
    const Vec normal = (p_q + a_p[i]) - a_p[j];
    const L of_a = dot(p_q, normal), of_p = -dot(a_p[j], normal), of_q = dot(a_p[i], normal);
    const L inverse = L(1.0) / ((of_a + of_p) + of_q);
    const L height = dot(a, normal);
    const L square = (height * height) * inverse;
    const Mask is_better = both(both(of_a > L(0.0), of_p > L(0.0)), both(of_q > L(0.0), square < best.square));
    best.square = select(is_better, square, best.square);
    best.of_newest = select(is_better, of_a * inverse, best.of_newest);
    for (std::size_t c = 0; c < 3; ++c) {
      const L weight = c == i ? of_p * inverse : (c == j ? of_q * inverse : L(0.0));
      best.of_old[c] = select(is_better, weight, best.of_old[c]);
    }
  }

  Pair pair_;
  Vec3d centre_a_;
  NearestGoal goal_;
  std::array<Corner, 3> corners_;
  std::array<L, 3> weights_;
  Vec at_;
  L square_;
  Mask goes_on_;
};

template <class Core>
void guess_with(const PacketPairForms& forms, const NearestGoal& goal, const PoseTable& poses,
                NearestGuesses& guesses) {
  guesses.are_points = goal.wants_points;
  Descents<kRegisterLanes, Core> descents(forms, goal);
  for (std::size_t k = 0; k < poses.n; k += kRegisterLanes) descents.descend(poses, k, guesses);
}

}  // namespace

void guess_nearest(const PacketPairForms& forms, const NearestGoal& goal, const PoseTable& poses,
                   NearestGuesses& guesses) {
  guess_with<AnyCore>(forms, goal, poses, guesses);
}

}  // namespace VEX_ISA
}  // namespace vex
