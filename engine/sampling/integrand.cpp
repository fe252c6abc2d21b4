#include "engine/sampling/integrand.h"

namespace vex {

Integrand::~Integrand() = default;

}  // namespace vex
