#include "engine/scene/periodic_box.h"

#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

void check_edge(double edge) {
  if (!(edge >= 1e-100 && edge <= 1e100)) {
    throw InputError("an edge of a periodic box is " + shortest_number(edge) +
                     " - give a length between 1e-100 and 1e100");
  }
}
void check_tilt(double tilt) {
  if (!(std::fabs(tilt) <= 100.0)) {
    throw InputError("a tilt of a periodic box is " + shortest_number(tilt) + " - give a number between -100 and 100");
  }
}

}  // namespace

PeriodicBox::PeriodicBox(double edge_x, double edge_y, double edge_z, double xy, double xz, double yz)
    : edges_{edge_x, edge_y, edge_z}, xy_(xy), xz_(xz), yz_(yz) {
  for (const double edge : {edge_x, edge_y, edge_z}) check_edge(edge);
  for (const double tilt : {xy, xz, yz}) check_tilt(tilt);
  const Vec3d faces = face_distances();
  const double least = std::fmin(faces.x, std::fmin(faces.y, faces.z));
  if (!(largest_coordinate() <= 1e9 * least)) {
    throw InputError("a periodic box is " + shortest_number(largest_coordinate()) + " long and has faces " +
                     shortest_number(least) + " apart - give one that is less than 10^9 times as long as it is wide");
  }
}

Vec3d PeriodicBox::shift(const ImageOffset& image) const {
  const double i = image[0], j = image[1], k = image[2];
  return {(i * edges_.x + j * (xy_ * edges_.y)) + k * (xz_ * edges_.z), j * edges_.y + k * (yz_ * edges_.z),
          k * edges_.z};
}

Vec3d PeriodicBox::fractional(const Vec3d& point) const {
  const double c = point.z / edges_.z;
  const double b = (point.y - c * (yz_ * edges_.z)) / edges_.y;
  const double a = ((point.x - b * (xy_ * edges_.y)) - c * (xz_ * edges_.z)) / edges_.x;
  return {a, b, c};
}

ImageOffset PeriodicBox::towards_origin(const Vec3d& point) const {
  const Vec3d f = fractional(point);
  return {-static_cast<int>(std::nearbyint(f.x)), -static_cast<int>(std::nearbyint(f.y)),
          -static_cast<int>(std::nearbyint(f.z))};
}

Vec3d PeriodicBox::wrapped(const Vec3d& point, ImageOffset* image) const {
  constexpr int kMostSteps = 4;  // the first leaves a rounding of where the point was, the next one of where it is
  Vec3d at = point;
  *image = {};
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3d f = fractional(at);
    ImageOffset by{};
    const std::array<double, 3> whole = {-std::floor(f.x + 0.5), -std::floor(f.y + 0.5), -std::floor(f.z + 0.5)};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(std::fabs(whole[k]) < 1e9)) {
        throw InputError("a body is more than 10^9 boxes away from its periodic box - give its place in the box");
      }
      by[k] = static_cast<int>(whole[k]);
    }
    if (by == ImageOffset{}) break;
    at = at + shift(by);
    *image = image_sum(*image, by);
  }
  return at;
}

double PeriodicBox::largest_coordinate() const {
  return edges_.x + (std::fabs(xy_) + 1.0) * edges_.y + ((std::fabs(xz_) + std::fabs(yz_)) + 1.0) * edges_.z;
}

Vec3d PeriodicBox::face_distances() const {
  // The volume by the areas of the faces b x c, c x a, a x b.
  const Vec3d a{edges_.x, 0.0, 0.0}, b{xy_ * edges_.y, edges_.y, 0.0};
  const Vec3d c{xz_ * edges_.z, yz_ * edges_.z, edges_.z};
  const auto area = [](const Vec3d& u, const Vec3d& v) { return safe_norm(cross(u, v)); };
  const double bc = area(b, c), ca = area(c, a), ab = area(a, b);
  return {edges_.x * (edges_.y * edges_.z / bc), edges_.y * (edges_.x * edges_.z / ca),
          edges_.z * (edges_.x * edges_.y / ab)};
}

}  // namespace vex
