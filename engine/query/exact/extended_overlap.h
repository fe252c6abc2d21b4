// The search of portal_refinement.h in double-double arithmetic, on the bodies' exact forms, and where it stalls those
// of nearest_descent.h and expanding_polytope.h: for curved bodies that double precision leaves open, and for the
// witnesses of an overlap.
#pragma once

#include <functional>

#include "engine/query/certificate.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

/// Disjoint, overlap, or undecided.
OverlapAnswer extended_overlap(const PlacedForms& forms, int max_support_calls);

/// Witnesses around the origin, of bodies that are known to overlap; `is_proof` tells of six whether they prove it.
/// False, and no witnesses, where none are found. However few calls the verdict was allowed, this takes what it needs.
bool find_witnesses(const PlacedForms& forms, OverlapCertificate& certificate, const std::function<bool()>& is_proof);

}  // namespace vex
