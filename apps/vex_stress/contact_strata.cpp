#include <array>
#include <cmath>

#include "apps/vex_stress/bodies.h"
#include "apps/vex_stress/strata.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {
namespace {

std::string distance_text(int digits) { return "d=1e-" + std::to_string(digits); }

StressPose place_anywhere(const StressPair& pair, Draw& draw) {
  const Transformd turn = draw.rotation();
  const double u = draw(), v = draw(), w = draw();
  StressPose pose{turn, {}};
  pose.a_from_b.translation = {};
  const Vec3d centre = pose.a_from_b(pair.b.centre());
  pose.a_from_b.translation = pair.a.centre() - centre + pair.size() * uniform_in_unit_ball(u, v, w);
  return pose;
}

StressPose place_at(double relative_distance, const StressPair& pair, Draw& draw) {
  const Transformd turn = draw.rotation();
  const Vec3d normal = draw.unit_direction();
  return beside_contact(pair, turn, normal, draw.sign() * relative_distance * pair.size());
}

// A direction across which A has a face, an end or nothing special: an axis of its frame.
Vec3d axis_of(Draw& draw) {
  const double sign = draw.sign();
  const std::size_t k = draw.below(3);
  return {k == 0 ? sign : 0.0, k == 1 ? sign : 0.0, k == 2 ? sign : 0.0};
}

// B's frame is A's, but for what a rotation there and back leaves of rounding; or not even that.
Transformd nearly_identity(Draw& draw) {
  if (draw() < 0.5) return {};
  const Transformd r = draw.rotation();
  const auto row = [&r](const Vec3d& x) {
    return r.direction_to_b({dot(r.row_x, x), dot(r.row_y, x), dot(r.row_z, x)});
  };
  return {row({1.0, 0.0, 0.0}), row({0.0, 1.0, 0.0}), row({0.0, 0.0, 1.0}), {}};
}

Vec3d tangential(const Vec3d& normal, Draw& draw) {
  const Vec3d d = draw.unit_direction();
  return d - dot(d, normal) * normal;
}

StressPose place_parallel(double relative_distance, const StressPair& pair, Draw& draw) {
  const Vec3d normal = axis_of(draw);
  StressPose pose = beside_contact(pair, nearly_identity(draw), normal, draw.sign() * relative_distance * pair.size());
  // A third of the poses stay flush; the others slide.
  if (draw() < 0.67) {
    Vec3d& t = pose.a_from_b.translation;
    t = t + (draw() * 0.5 * (pair.a.inradius() + pair.b.inradius())) * tangential(normal, draw);
  }
  return pose;
}

StressPose place_identical(const StressPair& pair, Draw& draw) {
  const Vec3d normal = draw() < 0.5 ? axis_of(draw) : draw.unit_direction();
  if (draw() < 0.05) return {Transformd{}, normal};  // the same place: they are one
  return beside_contact(pair, {}, normal, random_distance(pair, draw));
}

Vec3d mixed(const Vec3d& a, const Vec3d& b, double s) { return (1.0 - s) * a + s * b; }

Vec3d point_of(const Features::Face& face, Draw& draw) {
  const std::size_t n = face.vertices.size();
  const Vec3d edge_point = mixed(face.vertices[draw.below(n)], face.vertices[draw.below(n)], draw());
  return mixed(edge_point, face.vertices[draw.below(n)], draw());
}

Vec3d unit(const Vec3d& d) { return (1.0 / norm(d)) * d; }

// R such that R d = -n, and any turn about n before it.
Transformd facing(const Vec3d& d, const Vec3d& n, Draw& draw) {
  const auto frame = [](const Vec3d& z, double turn) {
    const Vec3d other = std::fabs(z.x) < 0.6 ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
    const Vec3d x = unit(cross(other, z)), y = cross(z, x);
    return std::array<Vec3d, 3>{std::cos(turn) * x + std::sin(turn) * y, std::cos(turn) * y - std::sin(turn) * x, z};
  };
  const auto from = frame(d, 0.0), to = frame(-n, draw.between(0.0, 6.283));
  const auto entry = [&](auto part_to, auto part_from) {
    return (part_to(to[0]) * part_from(from[0]) + part_to(to[1]) * part_from(from[1])) +
           part_to(to[2]) * part_from(from[2]);
  };
  const auto x = [](const Vec3d& v) { return v.x; };
  const auto y = [](const Vec3d& v) { return v.y; };
  const auto z = [](const Vec3d& v) { return v.z; };
  return {{entry(x, x), entry(x, y), entry(x, z)},
          {entry(y, x), entry(y, y), entry(y, z)},
          {entry(z, x), entry(z, y), entry(z, z)},
          {}};
}

StressPose place_face_on_face(const StressPair& pair, Draw& draw) {
  const auto &a = pair.features_a.faces[draw.below(pair.features_a.faces.size())],
             &b = pair.features_b.faces[draw.below(pair.features_b.faces.size())];
  const Vec3d p = point_of(a, draw), q = point_of(b, draw);
  return with_points_at(p, q, facing(b.unit_normal, a.unit_normal, draw), a.unit_normal, random_distance(pair, draw));
}

StressPose place_vertex_on_face(const StressPair& pair, Draw& draw) {
  const auto& face = pair.features_a.faces[draw.below(pair.features_a.faces.size())];
  const Transformd turn = draw.rotation();
  const Vec3d to_b = turn.direction_to_b(face.unit_normal);
  const auto& vertices = pair.features_b.vertices;
  Vec3d lowest = vertices[0];
  for (const Vec3d& v : vertices) lowest = dot(v, to_b) < dot(lowest, to_b) ? v : lowest;
  return with_points_at(point_of(face, draw), lowest, turn, face.unit_normal, random_distance(pair, draw));
}

StressPose place_vertex_on_edge(const StressPair& pair, Draw& draw) {
  const auto& edge = pair.features_a.edges[draw.below(pair.features_a.edges.size())];
  const Vec3d normal = unit(mixed(edge.unit_normals[0], edge.unit_normals[1], draw.between(0.1, 0.9)));
  const Transformd turn = draw.rotation();
  const Vec3d to_b = turn.direction_to_b(normal);
  const auto& vertices = pair.features_b.vertices;
  Vec3d lowest = vertices[0];
  for (const Vec3d& v : vertices) lowest = dot(v, to_b) < dot(lowest, to_b) ? v : lowest;
  return with_points_at(mixed(edge.from, edge.to, draw()), lowest, turn, normal, random_distance(pair, draw));
}

// B's vertex at A's, pushed apart along the line of the centres.
StressPose place_vertex_on_vertex(const StressPair& pair, Draw& draw) {
  const Vec3d p = pair.features_a.vertices[draw.below(pair.features_a.vertices.size())];
  const Vec3d q = pair.features_b.vertices[draw.below(pair.features_b.vertices.size())];
  const Vec3d normal = unit(p - pair.a.centre());
  return with_points_at(p, q, facing(unit(q - pair.b.centre()), normal, draw), normal, random_distance(pair, draw));
}

StressPose place_edge_on_edge(const StressPair& pair, Draw& draw) {
  const auto& a = pair.features_a.edges[draw.below(pair.features_a.edges.size())];
  const auto& b = pair.features_b.edges[draw.below(pair.features_b.edges.size())];
  // Between the edge's two faces, on both bodies: there the edges carry the contact, crossed at any angle.
  const Vec3d normal_a = unit(a.unit_normals[0] + a.unit_normals[1]);
  const Vec3d normal_b = unit(b.unit_normals[0] + b.unit_normals[1]);
  return with_points_at(mixed(a.from, a.to, draw()), mixed(b.from, b.to, draw()), facing(normal_b, normal_a, draw),
                        normal_a, random_distance(pair, draw));
}

}  // namespace

std::vector<Stratum> contact_strata() {
  std::vector<Stratum> strata;
  strata.push_back({"random/cubes", "two unit cubes", [] { return named_pairs({"box:1,1,1"}); }, place_anywhere});
  strata.push_back({"random/polytopes", "polytopes of every kind", polytope_pairs, place_anywhere});
  strata.push_back({"random/rounded", "balls, capsules, rounded polytopes", rounded_pairs, place_anywhere});
  strata.push_back({"random/curved", "every curved kind", curved_pairs, place_anywhere});
  struct Family {
    const char *name, *bodies;
    std::vector<StressPair> (*pairs)();
  };
  for (const Family& family : {Family{"polytopes", "polytopes of every kind", polytope_pairs},
                               Family{"rounded", "balls, capsules, rounded polytopes", rounded_pairs},
                               Family{"curved", "every curved kind", curved_pairs}}) {
    for (int digits = 3; digits <= 16; ++digits) {
      const double distance = std::pow(10.0, -digits);
      strata.push_back(
          {"contact/" + std::string(family.name) + "/" + distance_text(digits), family.bodies, family.pairs,
           [distance](const StressPair& pair, Draw& draw) { return place_at(distance, pair, draw); }, distance});
    }
  }
  for (int digits : {3, 6, 9, 12, 14, 15, 16}) {
    const double distance = std::pow(10.0, -digits);
    strata.push_back(
        {"parallel/" + distance_text(digits), "faces, ends and sides flush, or slid along each other", parallel_pairs,
         [distance](const StressPair& pair, Draw& draw) { return place_parallel(distance, pair, draw); }, distance});
  }
  const std::string solids = "boxes and regular polyhedra";
  strata.push_back({"feature/vertex-vertex", solids, feature_pairs, place_vertex_on_vertex});
  strata.push_back({"feature/vertex-edge", solids, feature_pairs, place_vertex_on_edge});
  strata.push_back({"feature/vertex-face", solids, feature_pairs, place_vertex_on_face});
  strata.push_back({"feature/edge-edge", solids, feature_pairs, place_edge_on_edge});
  strata.push_back({"feature/face-face", solids, feature_pairs, place_face_on_face});
  strata.push_back(
      {"identical/polytopes", "a body and its copy, not turned", identical_polytope_pairs, place_identical});
  strata.push_back({"identical/curved", "a body and its copy, not turned", identical_curved_pairs, place_identical});
  return strata;
}

std::vector<Stratum> all_strata() {
  std::vector<Stratum> all = contact_strata();
  for (Stratum& s : symmetric_strata()) all.push_back(std::move(s));
  for (Stratum& s : extreme_strata()) all.push_back(std::move(s));
  for (Stratum& s : degenerate_strata()) all.push_back(std::move(s));
  return all;
}

}  // namespace vex
