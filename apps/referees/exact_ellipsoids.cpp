#include "apps/referees/exact_ellipsoids.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <span>
#include <vector>

namespace vex::exact {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Matrix = std::array<std::array<Integer, 4>, 4>;
using Polynomial = std::vector<Integer>;  // coefficient k of l^k; the last is not 0

// Doubles as whole numbers, all times the same power of two.
std::vector<Integer> whole_numbers(std::span<const double> values, int& exponent) {
  exponent = 0;
  bool found = false;
  for (const double x : values) {
    if (x == 0.0) continue;
    const int of_last_bit = std::ilogb(x) - 52;
    exponent = found ? std::min(exponent, of_last_bit) : of_last_bit;
    found = true;
  }
  std::vector<Integer> result;
  for (const double x : values) {
    const int own = x == 0.0 ? exponent : std::ilogb(x) - 52;
    result.emplace_back(static_cast<long long>(std::scalbn(x, -own)));
    result.back() <<= own - exponent;
  }
  return result;
}

// diag(1/a^2, 1/b^2, 1/c^2, -1) times (a b c)^2.
std::array<Integer, 4> quadric(const Integer& a, const Integer& b, const Integer& c) {
  const Integer aa = a * a, bb = b * b, cc = c * c;
  return {bb * cc, aa * cc, aa * bb, -(aa * bb * cc)};
}

Integer minor(const Matrix& m, std::span<const std::size_t> rows, std::span<const std::size_t> columns) {
  if (rows.empty()) return 1;
  Integer sum = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<std::size_t> rest(columns.begin(), columns.end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    const Integer term = m[rows[0]][columns[k]] * minor(m, rows.subspan(1), rest);
    sum += k % 2 == 0 ? term : Integer(-term);
  }
  return sum;
}

// det(l P + Q), Q diagonal: the coefficient of l^k is the sum over the principal minors of P of size k, each times the
// entries of Q that it leaves.
Polynomial characteristic(const Matrix& p, const std::array<Integer, 4>& q) {
  Polynomial result(5);
  for (unsigned subset = 0; subset < 16; ++subset) {
    std::vector<std::size_t> inside;
    Integer rest = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      if (((subset >> i) & 1u) != 0) {
        inside.push_back(i);
      } else {
        rest *= q[i];
      }
    }
    result[inside.size()] += rest * minor(p, inside, inside);
  }
  return result;
}

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  Integer common = 0;
  for (const Integer& c : p) common = gcd(common, c);
  if (common > 1) {
    for (Integer& c : p) c /= common;
  }
}

// -(f mod g) times a positive number.
Polynomial next_of_chain(Polynomial f, const Polynomial& g) {
  const Integer lead = abs(g.back());
  const bool negative = g.back() < 0;
  while (f.size() >= g.size()) {
    const Integer factor = negative ? Integer(-f.back()) : f.back();
    const std::size_t shift = f.size() - g.size();
    for (Integer& c : f) c *= lead;
    for (std::size_t k = 0; k < g.size(); ++k) f[k + shift] -= factor * g[k];
    while (!f.empty() && f.back() == 0) f.pop_back();
  }
  trim(f);
  for (Integer& c : f) c = -c;
  return f;
}

int sign_changes(const std::vector<int>& signs) {
  int changes = 0, last = 0;
  for (const int s : signs) {
    if (s == 0) continue;
    if (last != 0 && s != last) ++changes;
    last = s;
  }
  return changes;
}

// Distinct roots above 0, a multiple one counted once (Sturm); f(0) is not 0.
int n_positive_roots(Polynomial f) {
  trim(f);
  std::vector<Polynomial> chain = {f, {}};
  for (std::size_t k = 1; k < f.size(); ++k) chain[1].push_back(f[k] * static_cast<unsigned>(k));
  trim(chain[1]);
  while (chain.back().size() > 1) {
    Polynomial next = next_of_chain(chain[chain.size() - 2], chain.back());
    if (next.empty()) break;
    chain.push_back(std::move(next));
  }
  std::vector<int> at_zero, at_infinity;
  for (const Polynomial& p : chain) {
    at_zero.push_back(p.front().sign());
    at_infinity.push_back(p.back().sign());
  }
  return sign_changes(at_zero) - sign_changes(at_infinity);
}

}  // namespace

bool ellipsoids_overlap(const Vec3d& semi_axes_a, const Vec3d& semi_axes_b, const Transformd& a_from_b) {
  const Vec3d &x = a_from_b.row_x, &y = a_from_b.row_y, &z = a_from_b.row_z, &t = a_from_b.translation;
  const std::array lengths = {
      semi_axes_a.x, semi_axes_a.y, semi_axes_a.z, semi_axes_b.x, semi_axes_b.y, semi_axes_b.z, t.x, t.y, t.z};
  const std::array turns = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, 1.0};
  int length_exponent = 0, turn_exponent = 0;  // the unit of length is free; R's goes into the homogeneous coordinate
  const std::vector<Integer> length = whole_numbers(lengths, length_exponent);
  const std::vector<Integer> turn = whole_numbers(turns, turn_exponent);
  const Integer& one = turn[9];

  Matrix s;  // homogeneous coordinates of B to those of A
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) s[i][j] = turn[3 * i + j];
    s[i][3] = length[6 + i] * one;
    s[3][i] = 0;
  }
  s[3][3] = one;
  const std::array<Integer, 4> a = quadric(length[0], length[1], length[2]);
  Matrix p;  // S^T A S
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      p[i][j] = 0;
      for (std::size_t k = 0; k < 4; ++k) p[i][j] += s[k][i] * a[k] * s[k][j];
    }
  }
  return n_positive_roots(characteristic(p, quadric(length[3], length[4], length[5]))) < 2;
}

}  // namespace vex::exact
