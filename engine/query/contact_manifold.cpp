#include "engine/query/contact_manifold.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/query/search/contact_choice.h"
#include "engine/query/search/contact_face.h"
#include "engine/query/search/difference.h"
#include "engine/query/search/planar_polygon.h"
#include "engine/query/search/probed_face.h"

namespace vex {

struct ManifoldMemory::Impl {
  // Opposite each other along the normal; on nearly parallel edges, a little beside each other too.
  struct OppositePlaces {
    PlanarPoint of_a, of_b;
  };

  PlanarMemory planar;
  ContactFace face_a, face_b;
  std::vector<Vec3d> vertices;                      // of one body after the other
  std::vector<NumberedPoint> corners_a, corners_b;  // of curved bodies
  std::vector<PlanarPoint> common, common_hull, places;
  std::vector<OppositePlaces> opposite;
  std::vector<std::size_t> candidates;
};

ManifoldMemory::ManifoldMemory() : impl_(std::make_unique<Impl>()) {}
ManifoldMemory::~ManifoldMemory() = default;
ManifoldMemory::ManifoldMemory(ManifoldMemory&&) noexcept = default;
ManifoldMemory& ManifoldMemory::operator=(ManifoldMemory&&) noexcept = default;

namespace {

using Memory = ManifoldMemory::Impl;

// Of two edges: where they cross, or, of nearly parallel ones, the two ends of what they have beside each other.
void find_common_places(const std::vector<PlanarPoint>& p, const std::vector<PlanarPoint>& q, double feature_angle,
                        double resolution, std::vector<Memory::OppositePlaces>& opposite) {
  const PlanarPoint along_p = p[1] - p[0], along_q = q[1] - q[0];
  const double length_p = std::hypot(along_p.x, along_p.y), length_q = std::hypot(along_q.x, along_q.y);
  const double sine = turn(along_p, along_q) / (length_p * length_q);
  if (std::fabs(sine) > std::fmax(std::sin(feature_angle), resolution / std::fmin(length_p, length_q))) {
    const double share_p = turn(q[0] - p[0], along_q) / turn(along_p, along_q);
    const double share_q = turn(q[0] - p[0], along_p) / turn(along_p, along_q);
    if (std::fabs(share_p - 0.5) * length_p > 0.5 * length_p + resolution) return;
    if (std::fabs(share_q - 0.5) * length_q > 0.5 * length_q + resolution) return;
    const PlanarPoint crossing = p[0] + share_p * along_p;
    opposite.push_back({crossing, crossing});
    return;
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
  if (from > to + resolution) return;
  opposite.push_back({on(p, from), on(q, from)});
  if (to > from + resolution) opposite.push_back({on(p, to), on(q, to)});
}

void find_common_places(Memory& memory, double feature_angle, double resolution) {
  const std::vector<PlanarPoint>&p = memory.face_a.outline(), &q = memory.face_b.outline();
  memory.opposite.clear();
  if (p.size() == 2 && q.size() == 2) {
    find_common_places(p, q, feature_angle, resolution, memory.opposite);
    return;
  }
  memory.common.clear();
  // The one of fewer sides clips the other.
  if (p.size() >= 3 && (q.size() < 3 || p.size() <= q.size())) {
    clipped(q, p, resolution, memory.planar, memory.common);
  } else if (q.size() >= 3) {
    clipped(p, q, resolution, memory.planar, memory.common);
  }
  if (memory.common.empty()) return;
  planar_hull(memory.common, resolution, memory.planar, memory.common_hull);
  for (const PlanarPoint& place : memory.common_hull) memory.opposite.push_back({place, place});
}

// Of neighbours that are no farther from each other than this the nearer contact; its place with it.
void merge(std::vector<ContactManifold::Contact>& contacts, std::vector<PlanarPoint>& places, double distance) {
  std::size_t n = 0;
  const auto take = [&](std::size_t kept, std::size_t other) {
    if (!(contacts[other].signed_distance < contacts[kept].signed_distance)) return;
    contacts[kept] = contacts[other];
    places[kept] = places[other];
  };
  const auto are_one = [&](const ContactManifold::Contact& p, const ContactManifold::Contact& q) {
    return norm(p.point_a - q.point_a) <= distance && norm(p.point_b - q.point_b) <= distance;
  };
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (n > 0 && are_one(contacts[n - 1], contacts[k])) {
      take(n - 1, k);
      continue;
    }
    contacts[n] = contacts[k];
    places[n] = places[k];
    ++n;
  }
  if (n > 1 && are_one(contacts[0], contacts[n - 1])) {
    take(0, n - 1);
    --n;
  }
  contacts.resize(n);
  places.resize(n);
}

// What is within a 64th of a side from its end is that vertex's, though it be made by sides that cross there: where two
// bodies' corners are nearly opposite each other it hangs on the last digits which of them is within the other. Two
// that would be named alike have each its own name.
void name_features(const Memory& memory, std::vector<ContactManifold::Contact>& contacts) {
  constexpr double kNear = 0x1p-6;
  constexpr std::size_t kMostCompared = 64;
  const bool are_few = contacts.size() <= kMostCompared;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ContactManifold::Contact& contact = contacts[k];
    const auto name = [&](double near) {
      contact.feature_a = memory.face_a.feature_at(memory.places[k], near);
      contact.feature_b = memory.face_b.feature_at(memory.places[k], near);
    };
    const auto is_taken = [&] {
      return std::any_of(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(k), [&](const auto& other) {
        return other.feature_a == contact.feature_a && other.feature_b == contact.feature_b;
      });
    };
    name(are_few ? kNear : 0.0);
    if (!are_few || !is_taken()) continue;
    name(0.0);
    // Corners that rounding alone parts.
    for (std::uint32_t other = 0; is_taken(); ++other) contact.feature_b = feature_of_edge(other, other);
  }
}

// Whether their squares are. A body whose vertices and radius have nothing to do with each other has no face that could
// be told.
bool are_numbers(const Vec3d& v) { return norm_1(v) < 0x1p200; }

// Faces about the witness of A, in units in which bodies are neither tiny nor huge: what is small is then compared with
// the bodies, not with how far they are from origins, and squares are numbers. B's vertices are what they are once
// placed and rounded, so all that is rounded here are differences, to within u of themselves.
struct ContactUnits {
  Vec3d origin;
  int exponent;

  Vec3d operator()(const Vec3d& in_a) const { return times_power_of_two(in_a - origin, -exponent); }
  Vec3d point(const Vec3d& in_units) const { return origin + times_power_of_two(in_units, exponent); }
  double length(double of_bodies) const { return std::ldexp(of_bodies, -exponent); }
};

// How well points of a search are known, where a body is curved.
double searched_accuracy(const ConvexBody& a, const ConvexBody& b, const Separation& found) {
  if (a.is_rounded_polytope() && b.is_rounded_polytope()) return 0.0;
  const double size = a.circumradius() + b.circumradius() + std::fabs(found.signed_distance);
  return std::fmax(1e-9 * size, found.upper - found.lower);
}

// A curved body's points in the contact's frame; false where its face is a point.
template <class Place>
bool has_probed_face(const ConvexBody& body, const Vec3d& unit_dir, const Vec3d& nearest, double feature_angle,
                     std::vector<NumberedPoint>& corners, const Place& place) {
  probe_face(body, unit_dir, nearest, feature_angle, corners);
  for (NumberedPoint& corner : corners) corner.at = place(corner.at);
  return !corners.empty() && std::ranges::all_of(corners, [](const auto& corner) { return are_numbers(corner.at); });
}

// False where they are no numbers.
template <class Place>
bool take_vertices(const ConvexBody& body, const ContactFrame& frame, double outward, double feature_angle,
                   const ContactResolution& resolution, Memory& memory, ContactFace& face, const Place& place) {
  const std::span<const Vec3d> vertices = body.vertices_of_core();
  memory.vertices.resize(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) memory.vertices[k] = place(vertices[k]);
  if (memory.vertices.empty() || !std::ranges::all_of(memory.vertices, are_numbers)) return false;
  face.take_vertices(memory.vertices, frame, outward, feature_angle, resolution, memory.planar);
  return true;
}

// Of many places those of which four may be chosen: heights are asked of these alone.
void keep_outermost(Memory& memory) {
  find_outermost(memory.common_hull, memory.candidates);
  for (std::size_t k = 0; k < memory.candidates.size(); ++k) {
    memory.opposite[k] = memory.opposite[memory.candidates[k]];  // which is this one or a later one
  }
  memory.opposite.resize(memory.candidates.size());
}

// What a pair's contacts are found from, besides its faces.
struct ContactQuestion {
  const ConvexBody &a, &b;
  const Separation& found;
  const ManifoldSettings& asked;
  ContactUnits units;
  ContactFrame frame;
  ContactResolution resolution;
};

// The contacts of the two faces in the memory, in units.
void find_contacts_of_faces(const ContactQuestion& question, Memory& memory,
                            std::vector<ContactManifold::Contact>& contacts) {
  const auto& [a, b, found, asked, units, frame, resolution] = question;
  const double farthest = units.length(std::fmax(asked.margin, found.upper));
  const double ball_a = units.length(a.ball_radius()), ball_b = units.length(b.ball_radius());
  find_common_places(memory, asked.feature_angle, resolution.of_points);
  if (asked.four_at_most && memory.opposite.size() > kMostOutermost) keep_outermost(memory);
  contacts.clear();
  memory.places.clear();
  for (const auto& [of_a, of_b] : memory.opposite) {
    const double height_a = memory.face_a.height_at(of_a) + ball_a;
    const double height_b = -memory.face_b.height_at(of_b) - ball_b;
    if (height_b - height_a > farthest + resolution.of_points) continue;
    contacts.push_back({frame.point(of_a, height_a), frame.point(of_b, height_b), height_b - height_a, 0, 0});
    memory.places.push_back(of_a);
  }
  merge(contacts, memory.places, resolution.of_edges);
}

// What the feature angle makes of the bodies' size.
double slack_of(const ContactQuestion& question) {
  const double slope = std::sin(std::fmin(question.asked.feature_angle, 1.0));
  return slope * question.units.length(question.a.circumradius() + question.b.circumradius());
}

// Whether there is a contact about as deep as the separation.
bool have_the_deepest(const ContactQuestion& question, const std::vector<ContactManifold::Contact>& contacts) {
  if (contacts.empty()) return false;
  const double deepest = std::ranges::min(contacts, {}, &ContactManifold::Contact::signed_distance).signed_distance;
  return deepest <= question.units.length(question.found.signed_distance) + 0x1p-10 * slack_of(question);
}

// And the separation's point about between them.
bool have_the_nearest(const ContactQuestion& question, const Memory& memory,
                      const std::vector<ContactManifold::Contact>& contacts) {
  if (!have_the_deepest(question, contacts)) return false;
  // The separation's point is at the origin.
  return memory.common_hull.size() < 3 || distance_to(memory.common_hull, {}) <= slack_of(question);
}

// The contacts of two faces, if both bodies have one; in A's frame.
void find_contacts(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Separation& found,
                   const ManifoldSettings& asked, Memory& memory, std::vector<ContactManifold::Contact>& contacts) {
  const double size = a.circumradius() + b.circumradius();
  const ContactUnits units{found.point_a, size > 0.0 ? std::ilogb(size) : 0};
  const auto place_a = [&](const Vec3d& v) { return units(v); };
  const auto place_b = [&](const Vec3d& v) { return units(a_from_b(v)); };
  const double searched = searched_accuracy(a, b, found);
  if (searched > 1e-6 * (size + std::fabs(found.signed_distance))) return;
  // The curved ones first: most have no face, and then nothing else is asked.
  const Vec3d normal_b = unit_seen_from_b(a_from_b, found.normal);
  const Vec3d nearest_a = found.point_a - a.ball_radius() * found.normal,
              nearest_b = found.point_b_in_b + b.ball_radius() * normal_b;
  const double angle = asked.feature_angle;
  const bool is_probed_a = !a.is_rounded_polytope(), is_probed_b = !b.is_rounded_polytope();
  if (is_probed_a && !has_probed_face(a, found.normal, nearest_a, angle, memory.corners_a, place_a)) return;
  if (is_probed_b && !has_probed_face(b, -normal_b, nearest_b, angle, memory.corners_b, place_b)) return;
  const ContactFrame frame(found.normal);
  // Coordinates across the normal are rounded several times each. And flat is what was, before vertices were rounded to
  // coordinates in their own frames and in A's.
  const double reach = units.length(2.0 * size + std::fabs(found.signed_distance));
  const double coordinates = units.length(a.reach() + 2.0 * b.reach() + norm_1(a_from_b.translation));
  const ContactResolution rounded(64.0 * kUnitRoundoff * reach, 4.0 * kUnitRoundoff * coordinates);
  const ContactResolution resolution = searched > 0.0 ? rounded.known_to(units.length(searched)) : rounded;
  if (!std::isfinite(resolution.of_edges)) return;
  if (is_probed_a) {
    memory.face_a.take_corners(memory.corners_a, frame, 1.0, resolution, memory.planar);
  } else if (!take_vertices(a, frame, 1.0, angle, resolution, memory, memory.face_a, place_a)) {
    return;
  }
  if (is_probed_b) {
    memory.face_b.take_corners(memory.corners_b, frame, -1.0, resolution, memory.planar);
  } else if (!take_vertices(b, frame, -1.0, angle, resolution, memory, memory.face_b, place_b)) {
    return;
  }
  const ContactQuestion question{a, b, found, asked, units, frame, resolution};
  find_contacts_of_faces(question, memory, contacts);
  // Of a rim the deepest point is between two of its corners; it is added where it matters, for it does not persist.
  if ((is_probed_a || is_probed_b) && !have_the_nearest(question, memory, contacts)) {
    const auto add_nearest = [&](std::vector<NumberedPoint>& corners, ContactFace& face, double outward,
                                 const Vec3d& nearest) {
      if (corners.size() < 3) return;  // an edge has its ends
      corners.push_back({nearest, kNearestPoint});
      face.take_corners(corners, frame, outward, resolution, memory.planar);
    };
    if (is_probed_a) add_nearest(memory.corners_a, memory.face_a, 1.0, place_a(nearest_a));
    if (is_probed_b) add_nearest(memory.corners_b, memory.face_b, -1.0, place_b(nearest_b));
    find_contacts_of_faces(question, memory, contacts);
    // What bends so that its middle is the deepest has no polygon that is as deep: its contact is one.
    if (!have_the_deepest(question, contacts)) contacts.clear();
  }
  name_features(memory, contacts);
  if (asked.four_at_most) keep_four(contacts, memory.places, 0x1p-6 * std::sin(std::fmin(angle, 1.0)));
  for (ContactManifold::Contact& contact : contacts) {
    contact.point_a = units.point(contact.point_a);
    contact.point_b = units.point(contact.point_b);
    contact.signed_distance = std::ldexp(contact.signed_distance, units.exponent);
  }
}

}  // namespace

void check(const ManifoldSettings& settings) {
  if (!(settings.margin >= 0.0) ||
      !(settings.feature_angle >= 0.0 && settings.feature_angle <= 0.5 * std::numbers::pi)) {
    throw UsageError(
        "the margin or the angle of a contact manifold is negative or no number, or the angle above pi/2 - give a "
        "length from 0 up, and radians from 0 to pi/2");
  }
}

void contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ManifoldSettings& settings,
                      ManifoldMemory& memory, ContactManifold& manifold, WarmStart* warm_start) {
  check(settings);
  manifold.contacts.clear();
  manifold.separation = signed_distance(a, b, pose, {}, warm_start);
  const Separation& found = manifold.separation;
  if (found.lower > settings.margin || !found.has_witnesses) return;
  if (norm_1(found.normal) > 0.5) {
    find_contacts(a, b, pose.a_from_b(), found, settings, memory.impl(), manifold.contacts);
  }
  if (!manifold.contacts.empty()) return;
  // Witnesses of curved bodies are the distance apart to within its bounds: B's is moved along the normal by the rest.
  const double along = found.signed_distance + 0.0;  // not -0
  const double rest = along - dot(found.point_b - found.point_a, found.normal);
  constexpr FeatureId kAll = feature_of_face(kWholeBody);
  manifold.contacts.push_back({found.point_a, found.point_b + rest * found.normal, along, kAll, kAll});
}

ContactManifold contact_manifold(const ConvexBody& a, const ConvexBody& b, const Pose& pose, double margin,
                                 double feature_angle) {
  thread_local ManifoldMemory memory;
  ContactManifold manifold;
  manifold.contacts.reserve(8);
  contact_manifold(a, b, pose, {.margin = margin, .feature_angle = feature_angle}, memory, manifold);
  return manifold;
}

}  // namespace vex
