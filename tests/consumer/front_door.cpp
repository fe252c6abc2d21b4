// The average excluded volume of two bodies, held against the formula.
#include <vex/vex.h>

#include <cmath>

int main() {
  const vex::ExcludedVolume r = vex::excluded_volume(vex::Box(1, 2, 3), vex::Sphere(0.5), {.rel_error = 1e-4});
  return std::abs(r.value - r.reference->value) < 5 * r.std_error ? 0 : 1;
}
