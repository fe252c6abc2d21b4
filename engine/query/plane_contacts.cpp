#include "engine/query/plane_contacts.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// Lower than the rest of a flat part that lies across the normal to within this no point is: the rim's stand for it.
constexpr double kLiesFlat = 0x1p-40;
// A point of the rim that is as near to the lowest one, relative to the part's size, is as low to the last place.
constexpr double kIsLowest = 0x1p-26;

Vec3d times_each(const Vec3d& a, const Vec3d& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

}  // namespace

PlaneContacts::PlaneContacts(const ConvexBody& b) : body_(b) {
  const std::optional<ExactForm> form = b.exact_form();
  has_form_ = form.has_value();
  if (!form) return;
  vertices_ = form->points;
  auto feature = static_cast<std::uint32_t>(vertices_.size());
  for (const ExactForm::Piece& piece : form->pieces) {
    const Vec3d& semi = piece.semi_axes;
    const bool is_flat = piece.is_dome || !(semi.x > 0.0) || !(semi.y > 0.0) || !(semi.z > 0.0);
    Part part{piece, {}, 0, feature};
    const Vec3d along[] = {{semi.x, 0.0, 0.0}, {0.0, semi.y, 0.0}, {0.0, 0.0, piece.is_dome ? 0.0 : semi.z}};
    for (const Vec3d& to_rim : along) {
      if (!is_flat || !(norm_1(to_rim) > 0.0)) continue;
      part.rim[static_cast<std::size_t>(part.n_rim++)] = piece.centre + to_rim;
      part.rim[static_cast<std::size_t>(part.n_rim++)] = piece.centre - to_rim;
    }
    feature += 1 + static_cast<std::uint32_t>(part.n_rim);
    parts_.push_back(part);
  }
}

void PlaneContacts::find(const HalfSpace& a, const Pose& a_from_b, double margin,
                         std::vector<PlaneContact>& out) const {
  if (std::isnan(margin)) throw UsageError("the margin of contacts is no number - give a length");
  out.clear();
  const Transformd& pose = a_from_b.a_from_b();
  const double radius = body_.ball_radius();
  const auto take = [&](const Vec3d& core_b, std::uint32_t feature) {
    const Vec3d core = pose(core_b);
    const double distance = (dot(a.dir_normal(), core) - a.offset()) / a.length() - radius;
    if (!(distance <= margin)) return;
    const Vec3d& n = a.unit_normal();
    const Vec3d point = radius > 0.0 ? core - radius * n : core;
    out.push_back({point - distance * n, point, distance, feature});
  };
  const Vec3d down = pose.direction_to_b(-a.dir_normal());
  if (!has_form_) {
    take(body_.core_support(down), 0);
    return;
  }
  for (std::size_t k = 0; k < vertices_.size(); ++k) take(vertices_[k], static_cast<std::uint32_t>(k));
  for (const Part& part : parts_) {
    const Vec3d& semi = part.piece.semi_axes;
    const Vec3d dir = part.piece.is_dome && down.z < 0.0 ? Vec3d{down.x, down.y, 0.0} : down;
    const double largest = std::max({semi.x, semi.y, semi.z});
    // D (D d) / |D d|, the semi-axes taken relative to the largest one.
    const Vec3d stretched = largest > 0.0 ? times_each((1.0 / largest) * semi, dir) : Vec3d{};
    const double length = norm(stretched);
    const bool has_lowest = part.n_rim == 0 || length > kLiesFlat * norm(down);
    const Vec3d lowest = part.piece.centre + (length > 0.0 ? times_each(semi, (1.0 / length) * stretched) : Vec3d{});
    if (has_lowest) take(lowest, part.feature);
    for (int k = 0; k < part.n_rim; ++k) {
      const Vec3d& rim = part.rim[static_cast<std::size_t>(k)];
      if (has_lowest && norm_1(rim - lowest) <= kIsLowest * largest) continue;
      take(rim, part.feature + 1 + static_cast<std::uint32_t>(k));
    }
  }
}

}  // namespace vex
