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

// The point of the simplex' hull that is nearest to the origin, as (sum of weight_i point_i) / (sum of weight_i); keeps
// the points that carry it. Johnson's determinants: of a set X and a point j outside of it
//   D_j(X + j) = sum over i in X of D_i(X) (y_i . y_k - y_i . y_j), any k in X, and D_i({i}) = 1.
// X carries the nearest point where D_i(X) > 0 for every i of X and D_j(X + j) <= 0 for every other j. The newest point
// is always among the carriers, for without it nothing was nearer before.
class Carrier {
 public:
  explicit Carrier(std::vector<SimplexPoint>& simplex) : simplex_(simplex) {
    const std::size_t n = simplex.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) inner_[i][j] = inner_[j][i] = whole::dot(simplex[i].at, simplex[j].at);
    }
    for (unsigned set = 1; set < (1u << n); ++set) {
      for (std::size_t j = 0; j < n; ++j) {
        if (((set >> j) & 1u) == 0) continue;
        const unsigned rest = set & ~(1u << j);
        if (rest == 0) {
          determinant_[set][j] = 1;
          continue;
        }
        const std::size_t k = static_cast<std::size_t>(std::countr_zero(rest));
        Integer sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
          if ((rest >> i) & 1u) sum += determinant_[rest][i] * (inner_[i][k] - inner_[i][j]);
        }
        determinant_[set][j] = sum;
      }
    }
    const unsigned newest = 1u << (n - 1);
    for (unsigned set = 1; set < (1u << n); ++set) {
      if ((set & newest) != 0 && carries(set, n)) {
        keep(set);
        return;
      }
    }
    VEX_EXPECT(false);  // the points are affinely independent, so one set does
  }

  const Vector& numerator() const { return numerator_; }
  const Integer& denominator() const { return denominator_; }

 private:
  bool carries(unsigned set, std::size_t n) const {
    for (std::size_t j = 0; j < n; ++j) {
      const bool is_in = ((set >> j) & 1u) != 0;
      const int sign = whole::sign(determinant_[set | (1u << j)][j]);
      if (is_in ? sign <= 0 : sign > 0) return false;
    }
    return true;
  }

  void keep(unsigned set) {
    std::vector<SimplexPoint> kept;
    denominator_ = 0;
    numerator_ = {};
    for (std::size_t i = 0; i < simplex_.size(); ++i) {
      if (((set >> i) & 1u) == 0) continue;
      numerator_ = numerator_ + determinant_[set][i] * simplex_[i].at;
      denominator_ += determinant_[set][i];
      kept.push_back(std::move(simplex_[i]));
    }
    simplex_ = std::move(kept);
  }

  std::vector<SimplexPoint>& simplex_;
  std::array<std::array<Integer, 4>, 4> inner_;
  std::array<std::array<Integer, 4>, 16> determinant_;
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
  std::vector<SimplexPoint> simplex = {{points.a(0) - points.b(0), 0, 0}};
  while (true) {
    // The nearest point is p = v / denominator.
    const Carrier carrier(simplex);
    const Vector& v = carrier.numerator();
    const Integer& denominator = carrier.denominator();
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
    simplex.push_back({w, a, b});
  }
  for (const SimplexPoint& point : simplex) {
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
