#include "engine/sampling/radial_map.h"

#include <utility>

namespace vex {

RadialMap::RadialMap(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law)
    : law_(law), a_(radial_body(a)), b_(radial_body(b)) {
  using Form = RadialBody::Form;
  is_swapped_ = a_.form == Form::lump && b_.form != Form::lump;
  if (is_swapped_) std::swap(a_, b_);
  if (a_.form == Form::rod && b_.form == Form::rod) {
    long_body_ = LongBody::both;
  } else if (a_.form == Form::rod && b_.form == Form::slab) {
    long_body_ = LongBody::a;
  } else if (a_.form == Form::slab && b_.form == Form::rod) {
    long_body_ = LongBody::b;
  }
}

}  // namespace vex
