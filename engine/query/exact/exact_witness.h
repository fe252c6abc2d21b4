// What is known as whole numbers and vertices, as certificates tell it.
#pragma once

#include <cstddef>

#include "engine/numeric/whole.h"
#include "engine/query/certificate.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

/// Piece by piece, each of 53 bits at most.
ExactVector exact_vector(whole::Vector vector);

/// A difference of two vertices.
inline Witness vertex_witness(const PlacedForms& forms, std::size_t of_a, std::size_t of_b) {
  return {{}, {}, {}, {}, forms.a.points[of_a], forms.b.points[of_b]};
}

}  // namespace vex
