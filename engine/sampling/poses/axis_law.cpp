#include "engine/sampling/poses/axis_law.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {

struct AxisPieces {
  AxisTable points;  // of a table, normalised
  double order_parameter = 0.0;
  std::size_t n = 0;
  double half_of_all = 0.0;
  std::vector<double> cumulated;
  std::vector<double> columns[7];

  /// Once all are there: what rounding leaves of the last one's end is drawn from it.
  void fill_up() {
    n = cumulated.size();
    const std::size_t all = std::bit_ceil(n);
    cumulated.resize(all, std::numeric_limits<double>::infinity());
    half_of_all = 0.5 * static_cast<double>(all);
  }
};

namespace {

// 1 - exp(-x) for x >= 0 by the series of expm1 and e -> e (2 + e) for a doubled argument: the same bits everywhere.
// Its error of some 10 u is an error of alpha, which nobody knows to 15 digits.
double complement_of_exp(double x) {
  if (x > 64.0) return 1.0;
  int n_doublings = 0;
  for (; x > 0.25; x *= 0.5) ++n_doublings;
  double e = 0.0;  // expm1(-x), Horner's scheme
  for (int k = 18; k >= 1; --k) e = -x / k * (1.0 + e);
  for (; n_doublings > 0; --n_doublings) e = e * (2.0 + e);
  return -e;
}

/// exp(-x) for 0 <= x <= 1/16: its series.
double exp_of_little(double x) {
  double e = 1.0;
  for (int k = 11; k >= 1; --k) e = 1.0 - x / k * e;
  return e;
}

/// With x the distance from where the density is largest (|cos| = 1 or 0), it is exp(-g(x)) where g(x) = a x (2 - x) or
/// a x^2, a = |3 A / 2|, up to a factor: cos^2 is (1 - x)^2 or x^2. Pieces are so short that g grows by at most 1/64 in
/// one; beyond g = 60 nothing is ever drawn.
std::shared_ptr<const AxisPieces> pieces_of_maier_saupe(double strength) {
  const double a = 1.5 * std::fabs(strength);
  const bool is_along = strength >= 0.0;
  constexpr double kNothing = 60.0;
  const auto n = static_cast<std::size_t>(std::max(128.0, std::ceil(128.0 * a)));
  const double h = 1.0 / static_cast<double>(n);
  const auto growth = [a, is_along](double from, double to) {  // g(to) - g(from)
    const double sum = to + from;
    return a * (to - from) * (is_along ? 2.0 - sum : sum);
  };
  const auto slope = [a, is_along](double x) { return 2.0 * a * (is_along ? 1.0 - x : x); };  // g'

  // Gauss and Legendre's five nodes in (0, 1): in a piece the density is a polynomial to far below rounding.
  constexpr double kNodes[5] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155, 0.953089922969332};
  constexpr double kWeights[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                  0.11846344252809454};
  struct Piece {
    double from, density_from, density_to, share;
  };
  std::vector<Piece> found;
  DoubleDouble all, second;  // of the density, and of it times cos^2
  double density = 1.0, g = 0.0;
  for (std::size_t k = 0; k < n && g < kNothing; ++k) {
    const double from = static_cast<double>(k) * h, to = static_cast<double>(k + 1) * h;
    double share = 0.0, share_of_second = 0.0;
    for (int i = 0; i < 5; ++i) {
      const double x = from + h * kNodes[i];
      const double here = h * kWeights[i] * (density * exp_of_little(growth(from, x)));
      const double cos = is_along ? 1.0 - x : x;
      share += here;
      share_of_second += here * (cos * cos);
    }
    const double step = growth(from, to);
    const double density_to = density * exp_of_little(step);
    found.push_back({from, density, density_to, share});
    all += DoubleDouble(share);
    second += DoubleDouble(share_of_second);
    density = density_to;
    g += step;
  }

  auto pieces = std::make_shared<AxisPieces>();
  pieces->order_parameter = 1.5 * (second / all).value() - 0.5;
  DoubleDouble so_far;
  for (const Piece& piece : found) {
    pieces->cumulated.push_back((so_far / all).value());
    so_far += DoubleDouble(piece.share);
    // x(t), t = (v - v_0) / share, by its values, slopes share / f and curvatures share^2 g' / f^2 at both ends.
    const double slope_0 = piece.share / piece.density_from, slope_1 = piece.share / piece.density_to;
    const double bend_0 = slope_0 * slope_0 * slope(piece.from), bend_1 = slope_1 * slope_1 * slope(piece.from + h);
    const double values[7] = {piece.from,
                              1.0 / (DoubleDouble(piece.share) / all).value(),
                              slope_0,
                              0.5 * bend_0,
                              10.0 * h - 6.0 * slope_0 - 4.0 * slope_1 - 1.5 * bend_0 + 0.5 * bend_1,
                              -15.0 * h + 8.0 * slope_0 + 7.0 * slope_1 + 1.5 * bend_0 - bend_1,
                              6.0 * h - 3.0 * slope_0 - 3.0 * slope_1 - 0.5 * bend_0 + 0.5 * bend_1};
    for (std::size_t c = 0; c < 7; ++c) pieces->columns[c].push_back(values[c]);
  }
  pieces->fill_up();
  return pieces;
}

void require_density(const AxisTable& table) {
  const auto refuse = [](const std::string& problem, const std::string& advice) {
    throw InputError("a table of a density of orientations: " + problem + " - " + advice);
  };
  const std::size_t n = table.cosines.size();
  if (n != table.densities.size()) {
    refuse("numbers of cosines and of densities that differ (" + std::to_string(n) + " and " +
               std::to_string(table.densities.size()) + ")",
           "give one density for each cosine");
  }
  if (n < 2) refuse("fewer than two points (" + std::to_string(n) + ")", "give two or more");
  if (n > AxisLaw::kMostPoints) {
    refuse("too many points (" + std::to_string(n) + ")", "give at most " + std::to_string(AxisLaw::kMostPoints));
  }
  bool is_zero = true;
  for (std::size_t k = 0; k < n; ++k) {
    const double cos = table.cosines[k], density = table.densities[k];
    const std::string where = "point " + std::to_string(k + 1) + ": ";
    if (!(cos >= -1.0 && cos <= 1.0)) {
      refuse(where + "a cosine that is not from -1 to 1 (" + shortest_number(cos) + ")", "correct it");
    }
    if (k > 0 && !(cos > table.cosines[k - 1])) {
      refuse(where + "cosines that do not ascend (" + shortest_number(cos) + " behind " +
                 shortest_number(table.cosines[k - 1]) + ")",
             "sort the points, and leave out those of equal cosines");
    }
    if (!(density >= 0.0 && std::isfinite(density))) {
      refuse(where + "a density that is negative or not finite (" + shortest_number(density) + ")", "correct it");
    }
    is_zero = is_zero && density == 0.0;
  }
  if (is_zero) refuse("a density that is 0 everywhere", "give one that is not");
}

/// From cos = 1 down, so that 1 - cos has all its digits where it is small.
std::shared_ptr<const AxisPieces> pieces_of_table(AxisTable table) {
  require_density(table);
  const int exponent = std::ilogb(std::ranges::max(table.densities));
  if (std::abs(exponent) > 300) {  // no overflow below; and no rounding
    for (double& density : table.densities) density = std::ldexp(density, -exponent);
  }
  const std::size_t n = table.cosines.size();
  DoubleDouble all;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    all +=
        DoubleDouble(0.5 * (table.cosines[k + 1] - table.cosines[k]) * (table.densities[k] + table.densities[k + 1]));
  }
  // Once normalised it stays what it is, to the last bit: so do its name and what is drawn.
  constexpr double kNormalised = 0x1p-50;
  if (!(std::fabs(all.value() - 1.0) <= kNormalised)) {
    for (double& density : table.densities) density /= all.value();
  }

  auto pieces = std::make_shared<AxisPieces>();
  DoubleDouble so_far, second;
  for (std::size_t k = n - 1; k > 0; --k) {
    const double above = table.cosines[k], below = table.cosines[k - 1], width = above - below;
    const double f = table.densities[k], f_end = table.densities[k - 1];
    const double share = 0.5 * width * (f + f_end);
    if (!(share > 0.0)) continue;  // nothing is drawn from it
    const double values[4] = {1.0 - above, width, f, 2.0 * ((f_end - f) / width)};
    pieces->cumulated.push_back(so_far.value());
    for (std::size_t c = 0; c < 4; ++c) pieces->columns[c].push_back(values[c]);
    so_far += DoubleDouble(share);
    const double middle = 0.5 * (above + below), off = 0.5 * width / std::sqrt(3.0);  // Gauss: exact for cubics
    for (const double side : {-off, off}) {
      const double cos = middle + side;
      const double here = 0.5 * (f + f_end) + (f - f_end) * (side / width);
      second += DoubleDouble(0.5 * width * here * (cos * cos));
    }
  }
  pieces->order_parameter = 1.5 * second.value() - 0.5;
  pieces->points = std::move(table);
  pieces->fill_up();
  return pieces;
}

/// FNV-1a over the bits.
std::string checksum_of(const AxisTable& table) {
  std::uint64_t sum = 0xcbf29ce484222325u;
  const auto add = [&sum](double number) {
    for (int byte = 0; byte < 8; ++byte) {
      sum = (sum ^ (std::bit_cast<std::uint64_t>(number) >> (8 * byte) & 0xffu)) * 0x100000001b3u;
    }
  };
  for (const double cos : table.cosines) add(cos + 0.0);  // -0 is 0
  for (const double density : table.densities) add(density + 0.0);
  std::string digits;
  for (int digit = 15; digit >= 0; --digit) digits += "0123456789abcdef"[sum >> (4 * digit) & 0xfu];
  return digits;
}

}  // namespace

AxisLaw::AxisLaw() = default;

void AxisLaw::look_up_in(std::shared_ptr<const AxisPieces> pieces) {
  cumulated_ = pieces->cumulated.data();
  for (std::size_t c = 0; c < 7; ++c) column_[c] = pieces->columns[c].data();
  half_of_all_ = pieces->half_of_all;
  pieces_ = std::move(pieces);
}

AxisLaw AxisLaw::aligned() {
  AxisLaw law;
  law.kind_ = Kind::aligned;
  return law;
}

AxisLaw AxisLaw::cone(double degrees) {
  if (!(degrees >= 0.0 && degrees <= 90.0)) {
    throw UsageError("a cone's half angle is not from 0 to 90 degrees (" + shortest_number(degrees) +
                     ") - give one that is");
  }
  AxisLaw law;
  law.kind_ = Kind::cone;
  law.parameter_ = degrees;
  const double half_sine = sincospi(degrees / 360.0).sin;
  law.height_ = 2.0 * (half_sine * half_sine);
  return law;
}

AxisLaw AxisLaw::onsager(double alpha) {
  if (!(alpha >= 0.0 && std::isfinite(alpha))) {
    throw UsageError("alpha is negative or not finite (" + shortest_number(alpha) + ") - give a number from 0 up");
  }
  AxisLaw law;
  law.kind_ = Kind::onsager;
  law.parameter_ = alpha;
  law.height_ = complement_of_exp(2.0 * alpha);
  return law;
}

AxisLaw AxisLaw::maier_saupe(double strength) {
  if (!(std::fabs(strength) <= kLargestMaierSaupe)) {
    throw UsageError("a strength of Maier and Saupe's law is not from -1000 to 1000 (" + shortest_number(strength) +
                     ") - give one that is; bodies that are straighter are aligned, or a cone");
  }
  AxisLaw law;
  law.kind_ = Kind::maier_saupe;
  law.parameter_ = strength;
  law.look_up_in(pieces_of_maier_saupe(strength));
  return law;
}

AxisLaw AxisLaw::table(AxisTable table) {
  AxisLaw law;
  law.kind_ = Kind::table;
  law.look_up_in(pieces_of_table(std::move(table)));
  return law;
}

const AxisTable* AxisLaw::points() const { return kind_ == Kind::table ? &pieces_->points : nullptr; }

std::string AxisLaw::name() const {
  switch (kind_) {
    case Kind::isotropic: return "isotropic";
    case Kind::aligned: return "aligned";
    case Kind::cone: return "cone:" + shortest_number(parameter_);
    case Kind::onsager: return "onsager:" + shortest_number(parameter_);
    case Kind::maier_saupe: return "maier-saupe:" + shortest_number(parameter_);
    case Kind::table: break;
  }
  return "table:" + checksum_of(pieces_->points);
}

double AxisLaw::order_parameter() const {
  switch (kind_) {
    case Kind::isotropic: return 0.0;
    case Kind::aligned: return 1.0;
    case Kind::cone: {
      // cos(theta) is uniform on [c, 1]: the mean of its square is (1 + c + c^2) / 3.
      const double c = sincospi(parameter_ / 180.0).cos;
      return 0.5 * c * (1.0 + c);
    }
    case Kind::onsager: break;
    case Kind::maier_saupe:
    case Kind::table: return pieces_->order_parameter;
  }
  // 1 - 3 coth(alpha) / alpha + 3 / alpha^2 (L. Onsager, 1949). Below 1/8 its terms cancel: there it is the series
  // alpha^2 / 15 - 2 alpha^4 / 315 + alpha^6 / 1575 - 2 alpha^8 / 31185, good to 1e-11.
  const double alpha = parameter_, square = alpha * alpha;
  if (alpha < 0.125) {
    return square * (1.0 / 15.0 - square * (2.0 / 315.0 - square * (1.0 / 1575.0 - square * (2.0 / 31185.0))));
  }
  return 1.0 - 3.0 / (alpha * std::tanh(alpha)) + 3.0 / square;
}

bool operator==(const AxisLaw& x, const AxisLaw& y) {
  if (x.kind_ != y.kind_ || x.parameter_ != y.parameter_) return false;
  return x.kind_ != AxisLaw::Kind::table || x.pieces_ == y.pieces_ || x.pieces_->points == y.pieces_->points;
}

}  // namespace vex
