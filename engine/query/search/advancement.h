// Conservative advancement (B. Mirtich, 1996) by what a sweep proves of intervals of time (rigid_sweep.h).
#pragma once

#include <vector>

#include "engine/numeric/transform.h"
#include "engine/query/certificate.h"
#include "engine/query/first_contact.h"
#include "engine/query/search/impact_record.h"
#include "engine/query/search/rigid_sweep.h"

namespace vex {

/// Of bodies that are not proven to meet at the start; speeds neither tiny nor huge. `start`: what `overlap_answer`
/// says of the bodies then. `ends`: the velocity is known well enough for the sweep's window to be one. Nothing after
/// `last` is looked at. `record`: null, or what receives the steps.
FirstContact advance_to_contact(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                const RelativeMotion& motion, const OverlapAnswer& start, bool ends, double last,
                                std::vector<ApartDuring>* record);

}  // namespace vex
