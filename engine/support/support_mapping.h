// The support mapping: all that the engine knows of a body.
//
// A convex body K is given by s(d), a point of K farthest in the direction d; its support function is h(d) = d . s(d).
// A body is any class with the members below. Its `support` is a template over the lane type, so that the same source
// answers one direction or a packet of them.
#pragma once

#include <concepts>
#include <type_traits>

#include "engine/numeric/vec3.h"

namespace vex {

/// `support(dir)`: for a direction of any length but zero. A zero direction may give any point of the body, not a NaN.
template <class S, class L>
concept SupportMappingOver = requires(const S& body, const Vec3<L>& dir) {
  { body.support(dir) } -> std::same_as<Vec3<L>>;
};

/// Whether a class means to be a body: it has something called `support`, whatever it takes.
template <class S>
concept HasSupportMember = requires {
  &S::support;
}
|| requires { &S::template support<double>; };

// What every body tells of itself, in its own frame. Lengths in the body's units.

/// e >= 0 such that the computed p = s(d) lies within e of the body, and h(d) <= d . p + e |d| for the true h. It
/// bounds the body's own roundings; what poses and differences add is counted by the query (E1).
template <class S>
concept HasSupportError = requires(const S& body) {
  { body.support_error() } -> std::convertible_to<double>;
};
/// A point of the body, up to e.
template <class S>
concept HasCentre = requires(const S& body) {
  { body.centre() } -> std::convertible_to<Vec3d>;
};
/// The body lies in the ball of this radius about the centre.
template <class S>
concept HasCircumradius = requires(const S& body) {
  { body.circumradius() } -> std::convertible_to<double>;
};
/// The ball of this radius about the centre lies in the body; 0 claims nothing.
template <class S>
concept HasInradius = requires(const S& body) {
  { body.inradius() } -> std::convertible_to<double>;
};

template <class S>
concept SupportMapping =
    SupportMappingOver<S, double> && HasSupportError<S> && HasCentre<S> && HasCircumradius<S> && HasInradius<S>;

namespace detail {

// A pointer to a member tells the class that it was declared in.
template <class Member, class Class>
constexpr std::type_identity<Class> declaring(Member Class::*) {
  return {};
}
template <class S>
constexpr auto declaring_support() {
  if constexpr (requires { declaring(&S::template support<double>); }) {
    return declaring(&S::template support<double>);
  } else if constexpr (requires { declaring(&S::support); }) {
    return declaring(&S::support);
  } else {
    return std::type_identity<S>();  // one of several of the name: the class's own
  }
}

}  // namespace detail

/// Whether a member was declared by a base of the class that declares `support`. What it tells, of a core, of exact
/// coordinates, of a volume, is then of the mapping that the base had, and nobody asks it: a body made of a shape, with
/// a mapping of its own, would be answered for the shape, and called proven.
template <class S, class Member, class Class>
constexpr bool is_of_older_mapping(Member Class::*) {
  using Mapping = typename decltype(detail::declaring_support<S>())::type;
  return std::is_base_of_v<Class, Mapping> && !std::same_as<Class, Mapping>;
}

}  // namespace vex
