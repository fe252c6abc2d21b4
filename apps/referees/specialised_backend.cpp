#include "apps/referees/specialised_backend.h"

#include "apps/referees/box_box.h"
#include "apps/referees/capsule_capsule.h"
#include "apps/referees/ellipsoid_contact.h"
#include "apps/referees/sphere_box.h"
#include "apps/referees/sphere_capsule.h"
#include "apps/referees/sphere_sphere.h"
#include "apps/referees/test_backend.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

using Made = std::unique_ptr<OverlapBackend>;

CapsuleSize size_of(const Capsule& capsule) { return {0.5 * capsule.body().length(), capsule.radius()}; }
Vec3d axes_of(const Sphere& sphere) { return {sphere.circumradius(), sphere.circumradius(), sphere.circumradius()}; }

Made make(const Box& a, const Box& b) {
  return test_backend([pair = BoxPair(a, b)](const Transformd& pose) { return overlap_by_axes(pair, pose); });
}
Made make(const Ellipsoid& a, const Ellipsoid& b) {
  return test_backend(EllipsoidContact(a.semi_axes(), b.semi_axes()));
}
Made make(const Capsule& a, const Capsule& b) {
  return test_backend(
      [a = size_of(a), b = size_of(b)](const Transformd& pose) { return capsules_overlap(a, b, pose); });
}
Made make(const Sphere& a, const Sphere& b) {
  return test_backend(
      [a = a.circumradius(), b = b.circumradius()](const Transformd& pose) { return spheres_overlap(a, b, pose); });
}
Made make(const Sphere& a, const Box& b) {
  return test_backend([a = a.circumradius(), b](const Transformd& pose) { return sphere_and_box_overlap(a, b, pose); });
}
Made make(const Box& a, const Sphere& b) {
  return test_backend([a, b = b.circumradius()](const Transformd& pose) { return box_and_sphere_overlap(a, b, pose); });
}
Made make(const Sphere& a, const Capsule& b) {
  return test_backend([a = a.circumradius(), b = size_of(b)](const Transformd& pose) {
    return sphere_and_capsule_overlap(a, b, pose);
  });
}
Made make(const Capsule& a, const Sphere& b) {
  return test_backend([a = size_of(a), b = b.circumradius()](const Transformd& pose) {
    return capsule_and_sphere_overlap(a, b, pose);
  });
}
Made make(const Sphere& a, const Ellipsoid& b) { return test_backend(EllipsoidContact(axes_of(a), b.semi_axes())); }
Made make(const Ellipsoid& a, const Sphere& b) {
  // A ball stays a ball where R is not quite a rotation, so R is left out.
  return test_backend([test = EllipsoidContact(a.semi_axes(), axes_of(b))](const Transformd& pose) {
    Transformd shift;
    shift.translation = pose.translation;
    return test(shift);
  });
}

// A test of the pair, none where there is none.
template <class A, class B>
Made make_if(const ConvexBody& a, const ConvexBody& b) {
  const auto* const own_a = a.target<A>();
  const auto* const own_b = b.target<B>();
  return own_a != nullptr && own_b != nullptr ? make(*own_a, *own_b) : nullptr;
}

Made make(const ConvexBody& a, const ConvexBody& b) {
  constexpr Made (*kMakers[])(const ConvexBody&, const ConvexBody&) = {
      make_if<Box, Box>,          make_if<Ellipsoid, Ellipsoid>, make_if<Capsule, Capsule>, make_if<Sphere, Sphere>,
      make_if<Sphere, Box>,       make_if<Box, Sphere>,          make_if<Sphere, Capsule>,  make_if<Capsule, Sphere>,
      make_if<Sphere, Ellipsoid>, make_if<Ellipsoid, Sphere>};
  for (const auto maker : kMakers) {
    if (Made made = maker(a, b)) return made;
  }
  return nullptr;
}

}  // namespace

BackendKind specialised_backend() {
  return {"specialised", true,
          [](const ConvexBody& a, const ConvexBody& b) {
            Made made = make(a, b);
            VEX_EXPECT(made != nullptr);
            return made;
          },
          [](const ConvexBody& a, const ConvexBody& b) { return make(a, b) != nullptr; }};
}

BackendKind box_edges_backend() {
  return {"box-edges", true,
          [](const ConvexBody& a, const ConvexBody& b) {
            return test_backend([pair = BoxPair(*a.target<Box>(), *b.target<Box>())](const Transformd& pose) {
              return overlap_by_edges(pair, pose);
            });
          },
          [](const ConvexBody& a, const ConvexBody& b) {
            return a.target<Box>() != nullptr && b.target<Box>() != nullptr;
          }};
}

}  // namespace vex
