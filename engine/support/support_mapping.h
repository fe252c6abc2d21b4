// The support mapping: all that the engine knows of a body.
//
// A convex body K is given by s(d), a point of K farthest in the direction d; its support function is h(d) = d . s(d).
// A body is any class with the members below. Its `support` is a template over the lane type, so that the same source
// answers one direction or a packet of them.
#pragma once

#include <concepts>

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

}  // namespace vex
