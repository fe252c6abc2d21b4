// A body of one's own: |x/a|^p + |y/b|^p + |z/c|^p <= 1, and its excluded volume with itself.
//
//   superellipsoid A B C P SEED      prints <V_ex>, its standard error and the number of undecided trials
#include <vex/engine/numeric/rounding.h>
#include <vex/engine/support/support_mapping.h>
#include <vex/shapes/estimators/excluded_volume.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

struct Superellipsoid {
  double a, b, c, p;  // p >= 2

  // Where Hoelder's inequality is an equality: with w_i = |a_i d_i| and s_i = w_i^(1/(p-1)), the coordinates
  // sign(d_i) a_i s_i / (sum s^p)^(1/p). The w are divided by the largest, so that no power over- or underflows.
  vex::Vec3d support(const vex::Vec3d& d) const {
    const vex::Vec3d w{std::fabs(a * d.x), std::fabs(b * d.y), std::fabs(c * d.z)};
    const double largest = std::max({w.x, w.y, w.z});
    if (largest == 0.0) return centre();
    const auto power = [&](double w_i) { return std::pow(w_i / largest, 1.0 / (p - 1.0)); };
    const vex::Vec3d s{power(w.x), power(w.y), power(w.z)};
    const double gauge = std::pow(std::pow(s.x, p) + std::pow(s.y, p) + std::pow(s.z, p), 1.0 / p);
    return {std::copysign(a * s.x / gauge, d.x), std::copysign(b * s.y / gauge, d.y),
            std::copysign(c * s.z / gauge, d.z)};
  }
  // In units of u, with pow good to two: w / largest 3, s (at most 1) 3 + 2 + 1, the gauge (at least 1) as much for the
  // p-th root of p-th powers and 5 more for what is rounded there, product and quotient 2: 19 of each semi-axis.
  double support_error() const { return 32.0 * vex::kUnitRoundoff * (a + b + c); }
  vex::Vec3d centre() const { return {}; }
  // The largest (sum x_i^2)^(1/2) is the norm of (a, b, c) with the exponent 2p / (p - 2); for p = 2 the largest of
  // them.
  double circumradius() const {
    const double m = std::max({a, b, c}), n = 2.0 * p / (p - 2.0);
    return m * std::pow(std::pow(a / m, n) + std::pow(b / m, n) + std::pow(c / m, n), 1.0 / n) * (1.0 + 0x1p-48);
  }
  double inradius() const { return std::min({a, b, c}); }
};
static_assert(vex::SupportMapping<Superellipsoid>);

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  const Superellipsoid body{std::atof(argv[1]), std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
  const vex::ExcludedVolume r =
      vex::excluded_volume(body, body, {.rel_error = 1e-3, .seed = std::strtoull(argv[5], nullptr, 10)});
  std::printf("%.9g %.3g %llu\n", r.value, r.std_error, static_cast<unsigned long long>(r.record.tally.n_undecided));
}
