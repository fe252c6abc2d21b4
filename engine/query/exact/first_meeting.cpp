#include "engine/query/exact/first_meeting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/scaled_bound.h"
#include "engine/query/exact/whole_points.h"

namespace vex {
namespace {

using whole::Integer;
using whole::Vector;

using Column = std::array<Integer, 4>;
using Matrix = std::array<Column, 4>;  // by rows

enum class Kind { slack, time, point };

struct Basic {
  Kind kind = Kind::slack;
  Column column;
  std::size_t a = 0, b = 0;  // of a point, the vertices it is of
};

// The inverse of the matrix whose columns these are, times its determinant, and the sign changed where that is
// negative: so it is a positive multiple of the inverse. By the minors of its upper and lower two rows.
Matrix positive_adjugate(const std::array<Basic, 4>& basis, Integer& determinant) {
  const auto at = [&basis](std::size_t row, std::size_t k) -> const Integer& { return basis[k].column[row]; };
  std::array<std::array<Integer, 4>, 4> upper, lower;  // of columns i < j: of rows 0 and 1, and of rows 2 and 3
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      upper[i][j] = at(0, i) * at(1, j) - at(1, i) * at(0, j);
      lower[i][j] = at(2, i) * at(3, j) - at(3, i) * at(2, j);
    }
  }
  determinant = upper[0][1] * lower[2][3] - upper[0][2] * lower[1][3] + upper[0][3] * lower[1][2] +
                upper[1][2] * lower[0][3] - upper[1][3] * lower[0][2] + upper[2][3] * lower[0][1];
  const bool is_negative = whole::sign(determinant) < 0;
  if (is_negative) determinant = -determinant;
  // Row i, column r: (-1)^(i + r) times the minor without column i and row r.
  Matrix adjugate;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<std::size_t, 3> rest{};
    for (std::size_t k = 0, n = 0; k < 4; ++k) {
      if (k != i) rest[n++] = k;
    }
    for (std::size_t r = 0; r < 4; ++r) {
      const std::size_t single = r ^ 1U;  // the other one of the two rows that r is of
      const auto& pairs = r < 2 ? lower : upper;
      Integer minor = at(single, rest[0]) * pairs[rest[1]][rest[2]] - at(single, rest[1]) * pairs[rest[0]][rest[2]] +
                      at(single, rest[2]) * pairs[rest[0]][rest[1]];
      // Expanded along the single row: above the pair or below it, past two rows, its sign is the same.
      const bool is_odd = ((i + r) & 1U) != 0;
      adjugate[i][r] = is_odd != is_negative ? Integer(-minor) : minor;
    }
  }
  return adjugate;
}

Integer product(const Column& a, const Column& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
Vector direction_of(const Column& a) { return {a[0], a[1], a[2]}; }

// Of the points farthest along `first` the one farthest along `second`.
struct Farthest {
  Vector at;
  std::size_t index;
};
template <class PointOf>
Farthest farthest(const VertexSet& points, const Vector& first, const Vector& second, const PointOf& point_of) {
  const bool has_first = !whole::is_zero(first);
  const std::vector<std::size_t>& open = points.farthest(whole::rounded_direction(has_first ? first : second));
  Farthest best{point_of(open.front()), open.front()};
  if (open.size() == 1) return best;
  Integer along_first = whole::dot(best.at, first), along_second = whole::dot(best.at, second);
  for (std::size_t k = 1; k < open.size(); ++k) {
    Vector next = point_of(open[k]);
    Integer next_first = whole::dot(next, first);
    if (next_first < along_first) continue;
    Integer next_second = whole::dot(next, second);
    if (next_first == along_first && next_second <= along_second) continue;
    best = {std::move(next), open[k]};
    along_first = std::move(next_first);
    along_second = std::move(next_second);
  }
  return best;
}

// numerator / denominator times a power of two, below or above it.
double quotient(const Integer& numerator, const Integer& denominator, int exponent, double direction) {
  const whole::Dyadic n{numerator, 0}, d{denominator, 0};
  const int e_n = whole::exponent_of(n), e_d = whole::exponent_of(d);
  const double ratio = whole::rounded(n, e_n).high / whole::rounded(d, e_d).high;  // 1/2 to 2, within 3 u
  const double widened = ratio * (1.0 + direction * 8.0 * kUnitRoundoff);
  const int e = e_n - e_d + exponent;
  return direction < 0.0 ? scaled_down(widened, e) : scaled_up(widened, e);
}

class Programme {
 public:
  Programme(const PlacedForms& forms, const Vec3d& motion) : forms_(forms), points_(forms) {
    exponent_of_motion_ = whole::lowest_exponent(whole::lowest_exponent(0.0), motion);
    const Vector m = whole::in_units(motion, exponent_of_motion_);
    time_ = {-m.x, -m.y, -m.z, 0};
    for (std::size_t k = 0; k < 4; ++k) basis_[k].column[k] = 1;
  }

  // Costs are pairs, of which the first counts more than any of the second: what the slacks hold, and the time. Rows of
  // the inverse decide between rows that reach 0 at once, so no basis comes again (G. Dantzig, A. Orden, P. Wolfe,
  // Pacific J. Math. 5, 183, 1955), and the search ends.
  FirstMeeting solve(FirstMeetingProof* proof, double until) {
    FirstMeeting result;
    while (true) {
      Integer determinant;
      const Matrix inverse = positive_adjugate(basis_, determinant);
      Column of_slacks{}, of_time{};  // dual values, times the determinant
      for (std::size_t k = 0; k < 4; ++k) {
        Column* const dual = basis_[k].kind == Kind::slack  ? &of_slacks
                             : basis_[k].kind == Kind::time ? &of_time
                                                            : nullptr;
        for (std::size_t r = 0; dual != nullptr && r < 4; ++r) (*dual)[r] += inverse[k][r];
      }
      std::optional<Basic> entering = better_time(of_slacks, of_time, determinant);
      if (!entering) {
        ++result.n_support_calls;
        entering = better_point(of_slacks, of_time);
      }
      if (!entering) {
        conclude(inverse, determinant, until, result);
        if (proof != nullptr) {
          // No point and no time gains: y . w + y_4 <= 0 for all w of K, with y_4 the least sum of slacks, or the time;
          // and y . m >= 0, or >= -1.
          proof->dir = direction_of(result.is_hit ? of_time : of_slacks);
          for (std::size_t k = 0; k < 4; ++k) {
            const bool carries = basis_[k].kind == Kind::point && whole::sign(inverse[k][3]) > 0;
            if (result.is_hit && carries) proof->carriers.emplace_back(basis_[k].a, basis_[k].b);
          }
        }
        return result;
      }
      replace(inverse, *entering);
    }
  }

 private:
  std::optional<Basic> better_time(const Column& of_slacks, const Column& of_time, const Integer& determinant) const {
    const int first = whole::sign(product(of_slacks, time_));
    if (first < 0 || (first == 0 && product(of_time, time_) <= determinant)) return std::nullopt;
    for (const Basic& basic : basis_) {
      if (basic.kind == Kind::time) return std::nullopt;
    }
    return Basic{Kind::time, time_, 0, 0};
  }

  std::optional<Basic> better_point(const Column& of_slacks, const Column& of_time) const {
    const Vector first = direction_of(of_slacks), second = direction_of(of_time);
    const auto of_a = [this](std::size_t i) { return points_.a(i); };
    const auto of_b = [this](std::size_t i) { return points_.b(i); };
    const Farthest a = farthest(forms_.points_a, first, second, of_a);
    const Farthest b = farthest(forms_.points_b, -first, -second, of_b);
    const Vector w = a.at - b.at;
    const Column column{w.x, w.y, w.z, 1};
    const int gain = whole::sign(product(of_slacks, column));
    if (gain < 0 || (gain == 0 && product(of_time, column) <= 0)) return std::nullopt;
    return Basic{Kind::point, column, a.index, b.index};
  }

  void replace(const Matrix& inverse, const Basic& entering) {
    std::array<Integer, 4> falls;
    for (std::size_t k = 0; k < 4; ++k) falls[k] = product(inverse[k], entering.column);
    std::size_t leaving = 4;
    for (std::size_t k = 0; k < 4; ++k) {
      if (whole::sign(falls[k]) <= 0) continue;
      if (leaving == 4 || is_first(inverse, falls, k, leaving)) leaving = k;
    }
    VEX_EXPECT(leaving < 4);  // no cost falls for ever: none is negative
    basis_[leaving] = entering;
  }

  // Whether basic variable i reaches 0 before j does: values are the inverse's last column.
  static bool is_first(const Matrix& inverse, const std::array<Integer, 4>& falls, std::size_t i, std::size_t j) {
    for (const std::size_t r : {3U, 0U, 1U, 2U}) {
      const Integer of_i = inverse[i][r] * falls[j], of_j = inverse[j][r] * falls[i];
      if (of_i != of_j) return of_i < of_j;
    }
    return false;
  }

  void conclude(const Matrix& inverse, const Integer& determinant, double until, FirstMeeting& result) const {
    result.is_hit = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const Integer& value = inverse[k][3];
      if (whole::sign(value) == 0) continue;
      if (basis_[k].kind == Kind::slack) result.is_hit = false;
      if (basis_[k].kind != Kind::time) continue;
      const int exponent = points_.unit() - exponent_of_motion_;
      result.lower = quotient(value, determinant, exponent, -1.0);
      result.upper = quotient(value, determinant, exponent, 1.0);
      if (until == HUGE_VAL) continue;
      result.is_late = whole::Dyadic(until) * whole::Dyadic(determinant, 0) < whole::Dyadic(value, exponent);
      if (!result.is_late) result.upper = std::fmin(result.upper, until);
    }
  }

  const PlacedForms& forms_;
  WholePoints points_;
  int exponent_of_motion_;
  Column time_;
  std::array<Basic, 4> basis_;
};

}  // namespace

FirstMeeting first_meeting(const PlacedForms& forms, const Vec3d& motion, FirstMeetingProof* proof, double until) {
  VEX_EXPECT(forms.a.is_polytope() && forms.b.is_polytope());
  return Programme(forms, motion).solve(proof, until);
}

}  // namespace vex
