#include "engine/query/packets/core_form.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

bool is_zero(const Vec3d& a) { return a.x == 0.0 && a.y == 0.0 && a.z == 0.0; }

// A sum of segments along the axes about the origin, which says so.
std::optional<CoreForm> box_form(const std::optional<Generators>& generators) {
  if (!generators || !is_zero(generators->centre)) return std::nullopt;
  Vec3d half;
  for (int k = 0; k < generators->n_vectors; ++k) {
    const Vec3d& along = generators->vectors[static_cast<std::size_t>(k)];
    int n_parts = 0;
    for (const auto part : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      if (along.*part == 0.0) continue;
      if (half.*part != 0.0) return std::nullopt;
      half.*part = std::fabs(along.*part);
      ++n_parts;
    }
    if (n_parts > 1) return std::nullopt;
  }
  CoreForm form;
  form.lower = -half;
  form.upper = half;
  return form;
}

// Whether the points are all those with each coordinate that of `lower` or of `upper`, once.
bool is_box(const std::vector<Vec3d>& points, const Vec3d& lower, const Vec3d& upper) {
  std::size_t n_corners = 1;
  for (const auto part : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    if (lower.*part < upper.*part) n_corners *= 2;
  }
  if (points.size() != n_corners) return false;
  unsigned corners = 0;
  for (const Vec3d& p : points) {
    unsigned corner = 0, bit = 1;
    for (const auto part : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      if (p.*part != lower.*part && p.*part != upper.*part) return false;
      if (lower.*part < upper.*part && p.*part == upper.*part) corner |= bit;
      bit *= 2;
    }
    corners |= 1u << corner;
  }
  return static_cast<std::size_t>(__builtin_popcount(corners)) == n_corners;
}

void extend(CoreForm& form, const Vec3d& lower, const Vec3d& upper) {
  form.lower = {std::min(form.lower.x, lower.x), std::min(form.lower.y, lower.y), std::min(form.lower.z, lower.z)};
  form.upper = {std::max(form.upper.x, upper.x), std::max(form.upper.y, upper.y), std::max(form.upper.z, upper.z)};
}

bool have_same_shape(const CoreForm::Piece& a, const CoreForm::Piece& b) {
  return a.semi_axes.x == b.semi_axes.x && a.semi_axes.y == b.semi_axes.y && a.semi_axes.z == b.semi_axes.z &&
         a.is_dome == b.is_dome;
}

// Those of the same shape side by side: their length along a direction is found once.
std::vector<CoreForm::Piece> core_pieces(const ExactForm& exact) {
  std::vector<CoreForm::Piece> given;
  for (const ExactForm::Piece& piece : exact.pieces) {
    given.push_back({piece.centre, piece.semi_axes, piece.is_dome && !is_zero(piece.semi_axes)});
  }
  for (const Vec3d& p : exact.points) given.push_back({p, {}});
  std::vector<CoreForm::Piece> pieces;
  while (!given.empty()) {
    const auto others = std::stable_partition(given.begin(), given.end(), [first = given.front()](const auto& piece) {
      return have_same_shape(piece, first);
    });
    for (auto piece = given.begin(); piece != others; ++piece) {
      piece->is_like_last = piece != given.begin();
      pieces.push_back(*piece);
    }
    given.erase(given.begin(), others);
  }
  return pieces;
}

// Along an axis the farthest point has the coordinate.
CoreForm form_with_bounds(const ConvexBody& body, CoreForm::Kind kind) {
  CoreForm form;
  form.kind = kind;
  form.upper = {body.core_support({1, 0, 0}).x, body.core_support({0, 1, 0}).y, body.core_support({0, 0, 1}).z};
  form.lower = {body.core_support({-1, 0, 0}).x, body.core_support({0, -1, 0}).y, body.core_support({0, 0, -1}).z};
  return form;
}

// A polytope with a table, whose vertices nobody has to copy.
CoreForm table_form(const ConvexBody& body, const DirectionTable& table) {
  CoreForm form = form_with_bounds(body, CoreForm::Kind::table);
  form.table = table;
  return form;
}

// None of an egg so thin that squares might underflow. The mapping's own error is E2's; it is taken for several times
// that, as that of powers is, and for the same reason (E32).
std::optional<CoreForm> profile_form(const ConvexBody& body, const ProfileForm& profile) {
  if (const auto* const egg = std::get_if<EggProfile>(&profile)) {
    const double longest = std::max({egg->radius, egg->below, egg->above});
    if (!(std::min({egg->radius, egg->below, egg->above}) >= 0x1p-100 * longest)) return std::nullopt;
  }
  CoreForm form = form_with_bounds(body, CoreForm::Kind::profile);
  form.profile = profile;
  form.support_error = 4.0 * std::visit([](const auto& its) { return its.support_error(); }, profile);
  return form;
}

// None of numbers with which products or powers might lose their digits.
std::optional<CoreForm> power_form(const PowerForm& given) {
  const Vec3d& axes = given.semi_axes;
  const auto curve_of = [](double p) { return CoreForm::PowerCurve{1.0 / p, std::min(1.0 / (p - 1.0), 0x1p60)}; };
  const double shortest = std::min({axes.x, axes.y, axes.z});
  if (!(shortest >= 0x1p-100 && given.across >= 1.0 && given.along >= 1.0)) return std::nullopt;
  CoreForm form;
  form.kind = CoreForm::Kind::powers;
  form.semi_axes = form.upper = axes;
  form.lower = -axes;
  form.across = curve_of(given.across);
  form.along = curve_of(given.along);
  form.support_error = 1024.0 * kUnitRoundoff * (axes.x + axes.y + axes.z);  // E32
  return form;
}

}  // namespace

std::optional<CoreForm> core_form(const ConvexBody& body) {
  if (body.is_rounded_polytope() && body.may_have_direction_table()) {
    if (const std::optional<DirectionTable> table = body.direction_table()) return table_form(body, *table);
  }
  if (std::optional<CoreForm> box = box_form(body.generators())) return box;
  if (const std::optional<PowerForm> powers = body.power_form()) return power_form(*powers);
  if (const std::optional<ProfileForm> profile = body.profile_form()) return profile_form(body, *profile);
  const std::optional<ExactForm> exact = body.exact_form();
  if (!exact) return std::nullopt;
  CoreForm form;
  if (exact->points.empty() && exact->pieces.size() == 1 && !exact->pieces[0].is_dome) {
    const ExactForm::Piece& piece = exact->pieces[0];
    // Squares of the shortest with any direction that a packet takes are far from underflow (E18).
    const double shortest = std::min({piece.semi_axes.x, piece.semi_axes.y, piece.semi_axes.z});
    if (is_zero(piece.centre) && shortest >= 0x1p-100) {
      form.kind = CoreForm::Kind::ellipsoid;
      form.semi_axes = piece.semi_axes;
      return form;
    }
  }
  if (!exact->pieces.empty()) {
    if (exact->points.size() + exact->pieces.size() > CoreForm::kMostPieces) return std::nullopt;
    form.kind = CoreForm::Kind::pieces;
    form.pieces = core_pieces(*exact);
    form.lower = form.pieces[0].centre;
    form.upper = form.lower;
    for (const CoreForm::Piece& piece : form.pieces)
      extend(form, piece.centre - piece.semi_axes, piece.centre + piece.semi_axes);
    form.support_error = 20.0 * kUnitRoundoff * body.reach();  // E18
    return form;
  }
  if (exact->points.empty()) return std::nullopt;
  form.lower = form.upper = exact->points.front();
  for (const Vec3d& p : exact->points) extend(form, p, p);
  if (is_box(exact->points, form.lower, form.upper)) return form;
  if (exact->points.size() > kMostScannedVertices && body.may_have_direction_table()) {
    form.kind = CoreForm::Kind::table;  // a null one
    return form;
  }
  if (exact->points.size() > kMostScannedVertices) return std::nullopt;
  form.kind = CoreForm::Kind::vertices;
  for (const Vec3d& p : exact->points) {
    form.x.push_back(p.x);
    form.y.push_back(p.y);
    form.z.push_back(p.z);
  }
  return form;
}

}  // namespace vex
