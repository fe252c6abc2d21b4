#include "engine/query/exact/exact_witness.h"

#include <algorithm>

namespace vex {

ExactVector exact_vector(whole::Vector v) {
  ExactVector sum;
  while (!whole::is_zero(v)) {
    const auto highest = [](const whole::Integer& x) {
      return x == 0 ? 0 : static_cast<int>(msb(whole::Integer(abs(x))));
    };
    const int exponent = std::max(0, std::max({highest(v.x), highest(v.y), highest(v.z)}) - 52);
    const auto take = [exponent](whole::Integer& x) {
      const whole::Integer magnitude = abs(x) >> static_cast<unsigned>(exponent);
      const whole::Integer part = x.sign() < 0 ? whole::Integer(-magnitude) : magnitude;
      x -= part << static_cast<unsigned>(exponent);
      return part.convert_to<double>();
    };
    const Vec3d value{take(v.x), take(v.y), take(v.z)};
    sum.parts.push_back({value, exponent});
  }
  return sum;
}

}  // namespace vex
