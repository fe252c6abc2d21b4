#include "engine/sampling/integrand.h"

namespace vex {

Integrand::~Integrand() = default;

void Integrand::count(std::span<std::uint64_t> /*counted*/) {}

}  // namespace vex
