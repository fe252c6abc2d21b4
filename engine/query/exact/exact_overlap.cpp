#include "engine/query/exact/exact_overlap.h"

#include <algorithm>

#include "engine/numeric/expect.h"
#include "engine/numeric/whole.h"
#include "engine/query/exact/whole_points.h"

namespace vex {
namespace {

using whole::Integer;
using whole::Vector;

// The vertex that is farthest along `dir`, among those that double precision leaves open.
template <class Narrow, class PointOf>
std::size_t farthest(const VertexSet& points, const Vector& dir, const Narrow& narrow, const PointOf& point_of) {
  std::vector<std::size_t> open = points.farthest(whole::rounded_direction(dir));
  narrow(dir, open);
  std::size_t best = open.front();
  if (open.size() == 1) return best;
  Integer largest = whole::dot(point_of(best), dir);
  for (std::size_t k = 1; k < open.size(); ++k) {
    const Integer value = whole::dot(point_of(open[k]), dir);
    if (value > largest) {
      largest = value;
      best = open[k];
    }
  }
  return best;
}

struct SimplexPoint {
  Vector at;
  std::size_t a, b;
};

// The point of a simplex' hull that is nearest to the origin, as (sum of weight_i point_i) / (sum of weight_i), and the
// points that carry it. Johnson's determinants: of a set X and a point j outside of it
//   D_j(X + j) = sum over i in X of D_i(X) (y_i . y_k - y_i . y_j), any k in X, and D_i({i}) = 1.
// X carries the nearest point where D_i(X) > 0 for every i of X and D_j(X + j) <= 0 for every other j: one set does,
// and the newest point is in it, for without it nothing was nearer before. Only determinants that are asked for are
// worked out.
class Simplex {
 public:
  explicit Simplex(SimplexPoint first) { add(std::move(first)); }

  /// Of points that carry the nearest one, with one that is nearer: they are affinely independent.
  void add(SimplexPoint point) {
    points_.push_back(std::move(point));
    const std::size_t newest = points_.size() - 1;
    for (std::size_t i = 0; i <= newest; ++i) {
      inner_[i][newest] = inner_[newest][i] = whole::dot(points_[i].at, points_[newest].at);
    }
    known_.fill(0);
    for (unsigned set = 1u << newest; set < (2u << newest); ++set) {
      if (!carries(set)) continue;
      keep(set);
      return;
    }
    VEX_EXPECT(false);
  }

  const std::vector<SimplexPoint>& carriers() const { return points_; }
  const Vector& numerator() const { return numerator_; }
  const Integer& denominator() const { return denominator_; }

 private:
  const Integer& determinant(unsigned set, std::size_t j) {
    Integer& value = determinant_[set][j];
    const unsigned bit = 1u << j;
    if ((known_[set] & bit) != 0) return value;
    known_[set] |= bit;
    const unsigned rest = set & ~bit;
    value = rest == 0 ? 1 : 0;
    for (std::size_t i = 0, k = static_cast<std::size_t>(std::countr_zero(rest)); i < points_.size(); ++i) {
      if ((rest >> i) & 1u) value += determinant(rest, i) * (inner_[i][k] - inner_[i][j]);
    }
    return value;
  }

  bool carries(unsigned set) {
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const bool is_in = ((set >> j) & 1u) != 0;
      const int sign = whole::sign(determinant(set | (1u << j), j));
      if (is_in ? sign <= 0 : sign > 0) return false;
    }
    return true;
  }

  void keep(unsigned set) {
    std::vector<std::size_t> kept;
    denominator_ = 0;
    numerator_ = {};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (((set >> i) & 1u) == 0) continue;
      numerator_ = numerator_ + determinant(set, i) * points_[i].at;
      denominator_ += determinant(set, i);
      kept.push_back(i);
    }
    // To lower places, in their order.
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i] == i) continue;
      points_[i] = std::move(points_[kept[i]]);
      for (std::size_t j = 0; j <= i; ++j) inner_[i][j] = inner_[j][i] = inner_[kept[i]][kept[j]];
    }
    points_.resize(kept.size());
  }

  std::vector<SimplexPoint> points_;
  std::array<std::array<Integer, 4>, 4> inner_;
  std::array<std::array<Integer, 4>, 16> determinant_;
  std::array<unsigned, 16> known_{};  // of the determinants: by bits
  Vector numerator_;
  Integer denominator_;
};

// `nearest`: null, or what receives the direction to the nearest point; then the search goes on to that.
ExactOverlap descend(const PlacedForms& forms, Vector* nearest) {
  VEX_EXPECT(forms.are_rounded_polytopes());
  const WholePoints points(forms);
  const auto point_a = [&points](std::size_t i) { return points.a(i); };
  const auto point_b = [&points](std::size_t i) { return points.b(i); };
  const auto narrow_a = [&points](const Vector& dir, std::vector<std::size_t>& open) { points.narrow_a(dir, open); };
  const auto narrow_b = [&points](const Vector& dir, std::vector<std::size_t>& open) { points.narrow_b(dir, open); };
  const Integer radii = nearest == nullptr ? points.radii() : Integer(0);
  const Integer radii_sq = radii * radii;

  ExactOverlap result;
  Simplex simplex({points.a(0) - points.b(0), 0, 0});
  while (true) {
    // The nearest point is p = v / denominator.
    const Vector& v = simplex.numerator();
    const Integer& denominator = simplex.denominator();
    const Integer v_sq = whole::dot(v, v);
    if (v_sq <= radii_sq * denominator * denominator) {
      result.overlap = true;
      break;
    }
    const std::size_t a = farthest(forms.points_a, -v, narrow_a, point_a);
    const std::size_t b = farthest(forms.points_b, v, narrow_b, point_b);
    ++result.n_support_calls;
    const Vector w = points.a(a) - points.b(b);
    // All of the hull is at least w . v / |v| away along v: disjoint where that exceeds the radii. Where w is no nearer
    // than p, p is the nearest point of all, and farther than the radii.
    const Integer along = whole::dot(w, v);
    if (nearest != nullptr) *nearest = -v;
    if (nearest == nullptr && whole::sign(along) > 0 && along * along > radii_sq * v_sq) break;
    if (along * denominator >= v_sq) break;
    simplex.add({w, a, b});
  }
  for (const SimplexPoint& point : simplex.carriers()) {
    result.carriers_a[static_cast<std::size_t>(result.n_carriers)] = point.a;
    result.carriers_b[static_cast<std::size_t>(result.n_carriers)] = point.b;
    ++result.n_carriers;
  }
  return result;
}

}  // namespace

ExactOverlap exact_overlap(const PlacedForms& forms) { return descend(forms, nullptr); }

ExactOverlap exact_nearest(const PlacedForms& forms, whole::Vector& dir) { return descend(forms, &dir); }

}  // namespace vex
