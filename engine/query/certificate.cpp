// The checker: small, slow, and apart from the search. It sees the exact forms, the pose and the certificate, and
// shares with the search nothing but whole numbers.
#include "engine/query/certificate.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/numeric/whole.h"

namespace vex {
namespace {

using whole::Dyadic;
using whole::DyadicVector;
using whole::exactly;
using whole::Integer;
using whole::Vector;

// Square roots and quotients are taken to so many bits.
constexpr int kBits = 256;

// A bound from above of the root, within 2^-(kBits - 1) of it.
Dyadic root_from_above(const Dyadic& square) {
  if (whole::sign(square) == 0) return {};
  Integer mantissa = square.mantissa;
  int exponent = square.exponent;
  int raise = std::max(0, 2 * kBits - static_cast<int>(msb(mantissa)));
  if (((exponent - raise) & 1) != 0) ++raise;
  mantissa <<= static_cast<unsigned>(raise);
  return {whole::floor_of_root(mantissa) + 1, (exponent - raise) / 2};
}

// numerator / denominator, off by at most 2^-kBits of itself; denominator > 0.
Dyadic quotient(const Dyadic& numerator, const Dyadic& denominator) {
  if (whole::sign(numerator) == 0) return {};
  const Integer magnitude = abs(numerator.mantissa);
  const int raise =
      std::max(0, kBits + 2 + static_cast<int>(msb(denominator.mantissa)) - static_cast<int>(msb(magnitude)));
  const Integer rounded = (magnitude << static_cast<unsigned>(raise)) / denominator.mantissa;
  return {numerator.mantissa.sign() < 0 ? Integer(-rounded) : rounded,
          numerator.exponent - denominator.exponent - raise};
}

DyadicVector image_of(const ExactForm::Piece& piece, const DyadicVector& dir) {
  const bool is_rim = piece.is_dome && whole::sign(dir.z) < 0;
  return {Dyadic(piece.semi_axes.x) * dir.x, Dyadic(piece.semi_axes.y) * dir.y,
          is_rim ? Dyadic() : Dyadic(piece.semi_axes.z) * dir.z};
}

// --- disjoint: a bound from above of the support function

// Of points and pieces, without the ball.
Dyadic support_from_above(const ExactForm& form, std::span<const DyadicVector> points, const DyadicVector& dir) {
  Dyadic largest;
  bool is_any = false;
  const auto consider = [&](const Dyadic& value) {
    if (!is_any || largest < value) largest = value;
    is_any = true;
  };
  for (const DyadicVector& point : points) consider(dot(point, dir));
  for (const ExactForm::Piece& piece : form.pieces) {
    const DyadicVector image = image_of(piece, dir);
    consider(dot(exactly(piece.centre), dir) + root_from_above(dot(image, image)));
  }
  return largest;
}

std::vector<DyadicVector> exact_points(std::span<const Vec3d> points) {
  std::vector<DyadicVector> all;
  all.reserve(points.size());
  for (const Vec3d& p : points) all.push_back(exactly(p));
  return all;
}

// The two bodies as the proof needs them.
struct Scene {
  const ExactForm& a;
  const ExactForm& b;
  const Transformd& a_from_b;

  // A point of B that is one of its vertices, or on one of its pieces, in A's frame.
  DyadicVector placed(const DyadicVector& point) const { return whole::placed(a_from_b, point); }
  // A vertex: of a polytope rounded once, which is what the body is.
  DyadicVector placed_vertex(const Vec3d& vertex) const {
    return b.is_polytope() ? exactly(a_from_b(vertex)) : placed(exactly(vertex));
  }

  // Whether h_A(dir) + h_B(-dir) < 0, of B as it stands: everything of A is behind everything of B.
  bool separates(const DyadicVector& dir) const {
    const DyadicVector back = -dir;
    const Dyadic of_a = support_from_above(a, exact_points(a.points), dir);
    Dyadic of_b;
    if (b.is_polytope()) {
      std::vector<DyadicVector> vertices;
      for (const Vec3d& v : b.points) vertices.push_back(placed_vertex(v));
      of_b = support_from_above(b, vertices, back);
    } else {
      of_b = support_from_above(b, exact_points(b.points), whole::direction_to_b(a_from_b, back)) +
             dot(exactly(a_from_b.translation), back);
    }
    const Dyadic cores = of_a + of_b, radii = Dyadic(a.ball_radius) + Dyadic(b.ball_radius), dir_sq = dot(dir, dir);
    if (a.is_rounded_polytope() && b.is_rounded_polytope()) {
      return whole::sign(cores) < 0 && radii * radii * dir_sq < cores * cores;  // no root: however near they are
    }
    return whole::sign(cores + radii * root_from_above(dir_sq)) < 0;
  }
};

// --- overlap: a point of the difference for each witness

Dyadic square_of_distance(const DyadicVector& p, const DyadicVector& q) { return dot(p - q, p - q); }

// The point of the hull of `form` without its ball that the witness means: the vertex, or the support point of the
// piece in the direction `dir`, that is nearest to `near`. Whichever is taken is a point of the body. Approximate by
// 2^-kBits of the piece's size; vertices are exact.
DyadicVector meant_point(const ExactForm& form, const Vec3d& near, const DyadicVector& dir, const Vec3d*& vertex) {
  const DyadicVector target = exactly(near);
  vertex = nullptr;
  DyadicVector best;
  Dyadic best_sq;
  bool is_any = false;
  for (const ExactForm::Piece& piece : form.pieces) {
    const DyadicVector image = image_of(piece, dir);
    const Dyadic length = root_from_above(dot(image, image));
    DyadicVector point = exactly(piece.centre);
    if (whole::sign(length) > 0) {
      const DyadicVector along{quotient(image.x, length), quotient(image.y, length), quotient(image.z, length)};
      point = point + image_of(piece, along);
    }
    const Dyadic sq = square_of_distance(point, target);
    if (is_any && !(sq < best_sq)) continue;
    best = point;
    best_sq = sq;
    is_any = true;
  }
  if (form.points.empty()) return best;
  const auto distance = [&near](const Vec3d& p) {
    return std::fabs(p.x - near.x) + std::fabs(p.y - near.y) + std::fabs(p.z - near.z);
  };
  const Vec3d& nearest =
      *std::ranges::min_element(form.points, [&](const Vec3d& p, const Vec3d& q) { return distance(p) < distance(q); });
  if (is_any && !(square_of_distance(exactly(nearest), target) < best_sq)) return best;
  vertex = &nearest;
  return exactly(nearest);
}

DyadicVector direction_of(const Vec3d& high, const Vec3d& low) { return exactly(high) + exactly(low); }

// A point of A - B without the balls.
DyadicVector core_point(const Scene& scene, const Witness& witness, const DyadicVector& dir) {
  const Vec3d* vertex = nullptr;
  const DyadicVector of_a = meant_point(scene.a, witness.point_a, dir, vertex);
  const DyadicVector of_b =
      meant_point(scene.b, witness.point_b, direction_of(witness.dir_b, witness.dir_b_low), vertex);
  return of_a - (vertex != nullptr ? scene.placed_vertex(*vertex) : scene.placed(of_b));
}

// All coordinates in one unit.
std::vector<Vector> as_whole(const std::vector<DyadicVector>& points, int& unit) {
  unit = whole::lowest_exponent(0.0);
  for (const DyadicVector& p : points) {
    unit = std::min({unit, whole::lowest_exponent(p.x), whole::lowest_exponent(p.y), whole::lowest_exponent(p.z)});
  }
  std::vector<Vector> all;
  for (const DyadicVector& p : points) all.push_back(whole::in_units(p, unit));
  return all;
}

// The point of the affine hull of one to three points that is nearest to the origin: numerator / denominator, with the
// denominator positive. `is_inside`: whether it is in their convex hull. False where they are not independent.
struct Nearest {
  Vector numerator;
  Integer denominator;
  bool is_inside = false;
};

bool nearest_of_hull(const std::vector<Vector>& w, Nearest& nearest) {
  if (w.size() == 1) {
    nearest = {w[0], 1, true};
    return true;
  }
  if (w.size() == 2) {
    const Vector e = w[1] - w[0];
    const Integer first = dot(w[1], e), second = -dot(w[0], e);
    nearest = {first * w[0] + second * w[1], dot(e, e), first.sign() >= 0 && second.sign() >= 0};
    return nearest.denominator.sign() > 0;
  }
  const Vector normal = cross(w[1] - w[0], w[2] - w[0]);
  const Integer first = dot(cross(w[1], w[2]), normal), second = dot(cross(w[2], w[0]), normal),
                third = dot(cross(w[0], w[1]), normal);
  nearest = {dot(normal, w[0]) * normal, dot(normal, normal),
             first.sign() >= 0 && second.sign() >= 0 && third.sign() >= 0};
  return nearest.denominator.sign() > 0;
}

// The ball of radius `margin` about the origin lies in the hull of four or more points: the hull has a volume, and
// every facet has the origin behind it by more than that, or, where the margin is 0, does not have it in front. The
// plane of a facet is that of three of the points, with all others on one side.
bool holds_ball(const std::vector<Vector>& w, const Integer& margin) {
  bool has_volume = false;
  for (std::size_t i = 0; i < w.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Vector normal = cross(w[j] - w[i], w[k] - w[i]);
        if (whole::is_zero(normal)) continue;
        bool is_any_above = false, is_any_below = false;
        for (const Vector& p : w) {
          const int side = whole::sign(dot(normal, p - w[i]));
          is_any_above = is_any_above || side > 0;
          is_any_below = is_any_below || side < 0;
        }
        has_volume = has_volume || is_any_above || is_any_below;
        if (is_any_above == is_any_below) continue;  // through the inside; or all in one plane
        const Integer height = is_any_below ? dot(normal, w[i]) : Integer(-dot(normal, w[i]));
        if (height.sign() < 0) return false;
        if (margin.sign() > 0 && height * height <= margin * margin * dot(normal, normal)) return false;
      }
    }
  }
  return has_volume;
}

CertificateCheck failed(std::string fault) { return {false, std::move(fault)}; }

// Both bodies are points and a ball: everything is rational.
CertificateCheck check_rounded_polytopes(const Scene& scene, Outcome claimed, const OverlapCertificate& certificate) {
  std::vector<DyadicVector> points;
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    points.push_back(core_point(scene, certificate.witnesses[static_cast<std::size_t>(k)], {}));
  }
  int unit = 0;
  const std::vector<Vector> w = as_whole(points, unit);
  Nearest nearest;
  if (claimed == Outcome::disjoint) {
    if (w.size() > 3 || !nearest_of_hull(w, nearest)) return failed("the witnesses define no direction");
    const Vector dir = -nearest.numerator;
    if (!scene.separates({Dyadic(dir.x, 0), Dyadic(dir.y, 0), Dyadic(dir.z, 0)})) {
      return failed("the direction of the witnesses does not separate the bodies");
    }
    return {true, {}};
  }
  if (w.size() == 4) {
    if (holds_ball(w, 0)) return {true, {}};
    return failed("the origin is not in the witnesses' hull");
  }
  if (!nearest_of_hull(w, nearest) || !nearest.is_inside) {
    return failed("the witnesses' nearest point to the origin is not within their hull");
  }
  const Dyadic radii = Dyadic(scene.a.ball_radius) + Dyadic(scene.b.ball_radius);
  const Dyadic distance_sq{dot(nearest.numerator, nearest.numerator), 2 * unit};
  const Dyadic allowed_sq = radii * radii * Dyadic(nearest.denominator * nearest.denominator, 0);
  if (allowed_sq < distance_sq) return failed("the witnesses do not come as near to the origin as the radii");
  return {true, {}};
}

// A bound of every length that is rounded: of the pieces about their centres, B's turned, and of the balls. Vertices,
// centres and the translation are exact.
Dyadic rounded_length(const Scene& scene) {
  const auto length = [](const Vec3d& v) {
    return Dyadic(std::fabs(v.x)) + Dyadic(std::fabs(v.y)) + Dyadic(std::fabs(v.z));
  };
  const auto of_pieces = [&length](const ExactForm& form) {
    Dyadic sum;
    for (const ExactForm::Piece& piece : form.pieces) sum = sum + length(piece.semi_axes);
    return sum;
  };
  const Transformd& pose = scene.a_from_b;
  return of_pieces(scene.a) + (length(pose.row_x) + length(pose.row_y) + length(pose.row_z)) * of_pieces(scene.b) +
         Dyadic(scene.a.ball_radius) + Dyadic(scene.b.ball_radius);
}

CertificateCheck check_hull(const Scene& scene, const OverlapCertificate& certificate) {
  if (certificate.n_witnesses < 4) return failed("an overlap of curved bodies needs four witnesses");
  const Dyadic balls = Dyadic(scene.a.ball_radius) + Dyadic(scene.b.ball_radius);
  // Every point below is off by less than this (E16).
  const Dyadic margin = rounded_length(scene) * Dyadic(1, 16 - kBits);
  std::vector<DyadicVector> points;
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    const Witness& witness = certificate.witnesses[static_cast<std::size_t>(k)];
    const DyadicVector dir = direction_of(witness.dir, witness.dir_low);
    DyadicVector point = core_point(scene, witness, dir);
    if (whole::sign(balls) > 0) {
      const Dyadic length = root_from_above(dot(dir, dir));
      if (whole::sign(length) == 0) return failed("a witness has no direction");
      point = point + DyadicVector{balls * quotient(dir.x, length), balls * quotient(dir.y, length),
                                   balls * quotient(dir.z, length)};
    }
    points.push_back(point);
  }
  // The margin's bits are below those of the points or not; the unit takes the finer.
  points.push_back({margin, {}, {}});
  int unit = 0;
  std::vector<Vector> w = as_whole(points, unit);
  const Integer whole_margin = w.back().x;
  w.pop_back();
  if (!holds_ball(w, whole_margin)) return failed("the origin is not proven to be in the witnesses' hull");
  return {true, {}};
}

}  // namespace

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                   Outcome claimed, const OverlapCertificate& certificate) {
  if (claimed == Outcome::undecided) return failed("an undecided verdict claims nothing");
  const std::optional<ExactForm> form_a = a.exact_form(), form_b = b.exact_form();
  if (!form_a || !form_b) return failed("a body has no exact form");
  if (!is_finite(a_from_b.translation)) return failed("the pose is not finite");
  if (!is_rotation(a_from_b)) return failed("the pose is no rotation");
  for (const Vec3d& p : form_b->points) {
    if (!is_finite(a_from_b(p))) return failed("a placed vertex is not finite");
  }
  const Scene scene{*form_a, *form_b, a_from_b};
  if (!is_finite(certificate.separating_dir) || !is_finite(certificate.separating_dir_low)) {
    return failed("the separating direction is not finite");
  }
  const DyadicVector dir = direction_of(certificate.separating_dir, certificate.separating_dir_low);
  const bool has_dir = whole::sign(dot(dir, dir)) > 0;
  if (claimed == Outcome::disjoint && has_dir) {
    if (scene.separates(dir)) return {true, {}};
    return failed("the direction does not separate the bodies");
  }
  if (certificate.n_witnesses < 1 || certificate.n_witnesses > 6) return failed("there are no witnesses");
  for (const Witness& witness : certificate.witnesses) {
    for (const Vec3d& v :
         {witness.dir, witness.dir_low, witness.dir_b, witness.dir_b_low, witness.point_a, witness.point_b}) {
      if (!is_finite(v)) return failed("a witness is not finite");
    }
  }
  if (form_a->is_rounded_polytope() && form_b->is_rounded_polytope()) {
    return check_rounded_polytopes(scene, claimed, certificate);
  }
  if (claimed == Outcome::disjoint) return failed("there is no separating direction");
  return check_hull(scene, certificate);
}

}  // namespace vex
