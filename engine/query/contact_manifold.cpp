#include "engine/query/contact_manifold.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/query/search/contact_face.h"
#include "engine/query/search/planar_polygon.h"

namespace vex {
namespace {

// Opposite each other along the normal; on nearly parallel edges, a little beside each other too.
struct OppositePlaces {
  PlanarPoint of_a, of_b;
};

// Of two edges: where they cross, or, of nearly parallel ones, the two ends of what they have beside each other.
std::vector<OppositePlaces> common_places(const std::vector<PlanarPoint>& p, const std::vector<PlanarPoint>& q,
                                          double feature_angle, double resolution) {
  const PlanarPoint along_p = p[1] - p[0], along_q = q[1] - q[0];
  const double length_p = std::hypot(along_p.x, along_p.y), length_q = std::hypot(along_q.x, along_q.y);
  const double sine = turn(along_p, along_q) / (length_p * length_q);
  if (std::fabs(sine) > std::fmax(std::sin(feature_angle), resolution / std::fmin(length_p, length_q))) {
    const double share_p = turn(q[0] - p[0], along_q) / turn(along_p, along_q);
    const double share_q = turn(q[0] - p[0], along_p) / turn(along_p, along_q);
    if (std::fabs(share_p - 0.5) * length_p > 0.5 * length_p + resolution) return {};
    if (std::fabs(share_q - 0.5) * length_q > 0.5 * length_q + resolution) return {};
    const PlanarPoint crossing = p[0] + share_p * along_p;
    return {{crossing, crossing}};
  }
  // From end to end along the mean of both directions; on each edge itself, since the other may be beside it.
  const double sign = dot(along_p, along_q) < 0.0 ? -1.0 : 1.0;
  const PlanarPoint both = (1.0 / length_p) * along_p + (sign / length_q) * along_q;
  const PlanarPoint axis = (1.0 / std::hypot(both.x, both.y)) * both;
  const PlanarPoint middle = 0.25 * ((p[0] + p[1]) + (q[0] + q[1]));
  const auto at = [&](const PlanarPoint& x) { return dot(axis, x - middle); };
  const auto on = [&](const std::vector<PlanarPoint>& edge, double along) {
    const double share = std::clamp((along - at(edge[0])) / (at(edge[1]) - at(edge[0])), 0.0, 1.0);
    return (1.0 - share) * edge[0] + share * edge[1];
  };
  const double from = std::fmax(std::fmin(at(p[0]), at(p[1])), std::fmin(at(q[0]), at(q[1])));
  const double to = std::fmin(std::fmax(at(p[0]), at(p[1])), std::fmax(at(q[0]), at(q[1])));
  if (from > to + resolution) return {};
  std::vector<OppositePlaces> ends{{on(p, from), on(q, from)}};
  if (to > from + resolution) ends.push_back({on(p, to), on(q, to)});
  return ends;
}

std::vector<OppositePlaces> common_places(const ContactFace& a, const ContactFace& b, double feature_angle,
                                          double resolution) {
  const std::vector<PlanarPoint>&p = a.outline(), &q = b.outline();
  std::vector<PlanarPoint> places;
  // The one of fewer sides clips the other.
  if (p.size() >= 3 && (q.size() < 3 || p.size() <= q.size())) {
    places = clipped(q, p, resolution);
  } else if (q.size() >= 3) {
    places = clipped(p, q, resolution);
  } else if (p.size() == 2 && q.size() == 2) {
    return common_places(p, q, feature_angle, resolution);
  }
  std::vector<OppositePlaces> opposite;
  if (places.empty()) return opposite;
  for (const PlanarPoint& place : planar_hull(places, resolution)) opposite.push_back({place, place});
  return opposite;
}

// Of neighbours that are no farther from each other than this the nearer contact.
void merge(std::vector<ContactManifold::Contact>& contacts, double distance) {
  std::vector<ContactManifold::Contact> merged;
  const auto take = [](ContactManifold::Contact& kept, const ContactManifold::Contact& other) {
    if (other.signed_distance < kept.signed_distance) kept = other;
  };
  const auto are_one = [&](const ContactManifold::Contact& p, const ContactManifold::Contact& q) {
    return norm(p.point_a - q.point_a) <= distance && norm(p.point_b - q.point_b) <= distance;
  };
  for (const ContactManifold::Contact& contact : contacts) {
    if (merged.empty() || !are_one(merged.back(), contact)) {
      merged.push_back(contact);
    } else {
      take(merged.back(), contact);
    }
  }
  if (merged.size() > 1 && are_one(merged.front(), merged.back())) {
    take(merged.front(), merged.back());
    merged.pop_back();
  }
  contacts = std::move(merged);
}

// None where a body is curved.
std::optional<std::vector<Vec3d>> vertices_of_core(const ConvexBody& body) {
  const std::optional<ExactForm> form = body.exact_form();
  if (!form || !form->is_rounded_polytope()) return std::nullopt;
  return form->points;
}

// Whether their squares are. A body whose vertices and radius have nothing to do with each other has no face that could
// be told.
bool are_numbers(const std::vector<Vec3d>& vertices) {
  return std::ranges::all_of(vertices, [](const Vec3d& v) { return norm_1(v) < 0x1p200; });
}

// Of vertices about the witness of A, in units of 2^unit, in which the contacts are then too.
std::vector<ContactManifold::Contact> contacts_of_faces(const ConvexBody& a, const ConvexBody& b,
                                                        const Transformd& a_from_b, const Separation& found,
                                                        const std::vector<Vec3d>& vertices_a,
                                                        const std::vector<Vec3d>& vertices_b, int unit, double margin,
                                                        double feature_angle) {
  std::vector<ContactManifold::Contact> contacts;
  const ContactFrame frame(found.normal);
  // Coordinates across the normal are rounded several times each. And flat is what was, before vertices were rounded to
  // coordinates in their own frames and in A's.
  const double reach =
      std::ldexp(2.0 * (a.circumradius() + b.circumradius()) + std::fabs(found.signed_distance), -unit);
  const double coordinates = std::ldexp(a.reach() + 2.0 * b.reach() + norm_1(a_from_b.translation), -unit);
  const ContactResolution resolution(64.0 * kUnitRoundoff * reach, 4.0 * kUnitRoundoff * coordinates);
  if (!std::isfinite(resolution.of_edges)) return contacts;
  const double farthest = std::ldexp(std::fmax(margin, found.upper), -unit);
  const double ball_a = std::ldexp(a.ball_radius(), -unit), ball_b = std::ldexp(b.ball_radius(), -unit);
  ContactFace face_a(vertices_a, frame, 1.0, feature_angle, resolution);
  ContactFace face_b(vertices_b, frame, -1.0, feature_angle, resolution);
  for (const auto& [of_a, of_b] : common_places(face_a, face_b, feature_angle, resolution.of_points)) {
    const double height_a = face_a.height_at(of_a) + ball_a;
    const double height_b = -face_b.height_at(of_b) - ball_b;
    if (height_b - height_a > farthest + resolution.of_points) continue;
    contacts.push_back({frame.point(of_a, height_a), frame.point(of_b, height_b), height_b - height_a});
  }
  merge(contacts, resolution.of_edges);
  return contacts;
}

}  // namespace

ContactManifold contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, double margin,
                                 double feature_angle) {
  const Transformd& a_from_b = pose.a_from_b();
  if (!(margin >= 0.0) || !(feature_angle >= 0.0)) {
    throw UsageError("the margin or the angle of a contact manifold is negative or no number - give one from 0 up");
  }
  ContactManifold manifold;
  manifold.separation = signed_distance(a, b, pose);
  const Separation& found = manifold.separation;
  if (found.lower > margin || !found.has_witnesses) return manifold;
  const std::optional<std::vector<Vec3d>> vertices_a = vertices_of_core(a);
  std::optional<std::vector<Vec3d>> vertices_b = vertices_of_core(b);
  if (vertices_a && vertices_b && norm_1(found.normal) > 0.5) {
    // About the witness of A: what is small is then compared with the bodies, not with how far they are from origins.
    // B's vertices are what they are once placed and rounded, so all that is rounded here are differences, to within u
    // of themselves. And in units in which bodies are neither tiny nor huge: squares are numbers then.
    const double size = a.circumradius() + b.circumradius();
    const int unit = size > 0.0 ? std::ilogb(size) : 0;
    std::vector<Vec3d> from_a = *vertices_a;
    const Vec3d origin = found.point_a;
    for (Vec3d& v : from_a) v = times_power_of_two(v - origin, -unit);
    for (Vec3d& v : *vertices_b) v = times_power_of_two(a_from_b(v) - origin, -unit);
    if (are_numbers(from_a) && are_numbers(*vertices_b)) {
      manifold.contacts = contacts_of_faces(a, b, a_from_b, found, from_a, *vertices_b, unit, margin, feature_angle);
    }
    for (ContactManifold::Contact& contact : manifold.contacts) {
      contact.point_a = origin + times_power_of_two(contact.point_a, unit);
      contact.point_b = origin + times_power_of_two(contact.point_b, unit);
      contact.signed_distance = std::ldexp(contact.signed_distance, unit);
    }
  }
  if (manifold.contacts.empty()) {
    // Witnesses of curved bodies are the distance apart to within its bounds: B's is moved along the normal by the
    // rest.
    const double along = found.signed_distance + 0.0;  // not -0
    const double rest = along - dot(found.point_b - found.point_a, found.normal);
    manifold.contacts.push_back({found.point_a, found.point_b + rest * found.normal, along});
  }
  return manifold;
}

}  // namespace vex
