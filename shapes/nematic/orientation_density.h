// How the axes of hard bodies are distributed in a fluid that is as dense as this: L. Onsager's integral equation (Ann.
// N.Y. Acad. Sci. 51, 627, 1949), solved on a grid.
//
// Densities f(theta) are normalised over all directions, alike about the director, and alike for theta and pi - theta;
// of V_ex(gamma) then only even Legendre polynomials count.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vex {

/// V_ex(gamma) / <V_ex> = sum over even l of k_l P_l(cos gamma): k_0 = 1, k_2, k_4 ... <V_ex> is the isotropic average.
using EvenSeries = std::vector<double>;

/// A density and what the free energy needs of it.
struct OrientationDensity {
  EvenSeries moments;          // <P_l(cos theta)> of l = 0, 2, 4 ...
  double entropy = 0.0;        // sigma: the mean of ln(4 pi f); 0 of an isotropic one
  double interaction = 1.0;    // the mean of V_ex over pairs, over <V_ex>: sum of k_l <P_l>^2
  std::vector<double> values;  // 4 pi f at the grid's cosines
  bool converged = true;

  double order_parameter() const { return moments.size() > 1 ? moments[1] : 0.0; }
};

/// Gauss's nodes in cos theta from 0 to 1, and the polynomials at them.
class OrientationGrid {
 public:
  enum class Size { usual, doubled };

  /// 128 nodes and degrees up to 128, or twice as many of either. `series` may be shorter or longer.
  explicit OrientationGrid(const EvenSeries& series, Size size = Size::usual);

  const std::vector<double>& cosines() const { return cosines_; }

  /// The density that minimises sigma + C sum of k_l <P_l>^2, C = n <V_ex> / 2 in Onsager's theory: the fixed point of
  /// f ~ exp(-2 C sum of k_l <P_l> P_l), by iteration from the moments `start` (fixed_point.h), until no moment changes
  /// by more than 1e-14. `converged` is false where it has not by then.
  OrientationDensity equilibrium(double coupling, const EvenSeries& start) const;

  /// f ~ exp(sum of field_l P_l), l = 0, 2, 4 ...; the interaction is with itself, by the grid's series.
  OrientationDensity in_field(const EvenSeries& field) const;

  /// Onsager's trial function, f ~ cosh(alpha cos theta), and the C at which alpha makes that sum stationary.
  OrientationDensity trial(double alpha) const;
  double coupling_of_trial(double alpha) const;

 private:
  /// From ln f up to a constant.
  OrientationDensity density_of(Eigen::ArrayXd logarithms) const;

  EvenSeries series_;
  std::vector<double> cosines_;
  Eigen::ArrayXd weights_;       // of a mean over cos theta: their sum is 1
  Eigen::MatrixXd polynomials_;  // a row a degree, a column a node
};

}  // namespace vex
