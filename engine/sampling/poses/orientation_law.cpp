#include "engine/sampling/poses/orientation_law.h"

#include <cmath>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

using Kind = OrientationLaw::Kind;

Kind kind_of_both(AxisLaw::Kind kind) {
  switch (kind) {
    case AxisLaw::Kind::isotropic: return Kind::isotropic;
    case AxisLaw::Kind::aligned: return Kind::aligned;
    case AxisLaw::Kind::cone: return Kind::cone;
    case AxisLaw::Kind::onsager: return Kind::onsager;
    case AxisLaw::Kind::maier_saupe: return Kind::maier_saupe;
    case AxisLaw::Kind::table: break;
  }
  return Kind::table;
}

/// A rotation that takes this direction to z; of x, y and z one that moves coordinates, without rounding.
Transformd rotation_to_z(const Vec3d& axis) {
  const double largest = std::fmax(std::fabs(axis.x), std::fmax(std::fabs(axis.y), std::fabs(axis.z)));
  if (!(largest > 0.0 && std::isfinite(largest))) {
    throw UsageError("a body's axis is no direction (" + shortest_number(axis.x) + "," + shortest_number(axis.y) + "," +
                     shortest_number(axis.z) + ") - give three finite numbers that are not all 0");
  }
  const Vec3d scaled{axis.x / largest, axis.y / largest, axis.z / largest};
  const double length = std::sqrt(dot(scaled, scaled));
  // What has length one stays what it is, to the last bit: so does the law that is made again from its axes.
  constexpr double kNormalised = 0x1p-50;
  const bool is_unit = std::fabs(dot(axis, axis) - 1.0) <= kNormalised;
  const Vec3d z = is_unit ? axis : Vec3d{scaled.x / length, scaled.y / length, scaled.z / length};
  // The coordinate axis that comes next to the largest part of z is far from it.
  const Vec3d next = std::fabs(scaled.z) == 1.0   ? Vec3d{1.0, 0.0, 0.0}
                     : std::fabs(scaled.x) == 1.0 ? Vec3d{0.0, 1.0, 0.0}
                                                  : Vec3d{0.0, 0.0, 1.0};
  const Vec3d across = cross(z, next);
  const double across_length = std::sqrt(dot(across, across));
  const Vec3d y{across.x / across_length, across.y / across_length, across.z / across_length};
  return {cross(y, z), y, z, {}};
}

std::string numbers_of(const Vec3d& v) {
  return shortest_number(v.x + 0.0) + "," + shortest_number(v.y + 0.0) + "," + shortest_number(v.z + 0.0);
}

}  // namespace

OrientationLaw OrientationLaw::aligned() { return both_by(AxisLaw::aligned()); }

OrientationLaw OrientationLaw::fixed(double w, double x, double y, double z) {
  OrientationLaw law;
  law.kind_ = Kind::fixed;
  law.quaternion_ = {w, x, y, z};
  law.fixed_ = rotation_from_quaternion(w, x, y, z);
  return law;
}

OrientationLaw OrientationLaw::angle(double degrees) {
  if (!(degrees >= 0.0 && degrees <= 180.0)) {
    throw UsageError("an angle between two axes is not from 0 to 180 degrees (" + shortest_number(degrees) +
                     ") - give one that is");
  }
  OrientationLaw law;
  law.kind_ = Kind::angle;
  law.degrees_ = degrees;
  law.between_ = sincospi(degrees / 180.0);
  return law;
}

OrientationLaw OrientationLaw::each(const AxisLaw& a, const AxisLaw& b) {
  OrientationLaw law;
  law.axis_ = {a, b};
  const bool is_any_isotropic = a.kind() == AxisLaw::Kind::isotropic || b.kind() == AxisLaw::Kind::isotropic;
  law.kind_ = is_any_isotropic ? Kind::isotropic : (a == b ? kind_of_both(a.kind()) : Kind::each);
  return law;
}

OrientationLaw OrientationLaw::about(const Vec3d& axis_a, const Vec3d& axis_b) const {
  if (kind_ == Kind::isotropic || kind_ == Kind::aligned || kind_ == Kind::fixed) {
    throw UsageError("nothing hangs on the bodies' axes (" + name() +
                     " orientations) - name none, or choose a law of axes, as cone:20");
  }
  OrientationLaw law = *this;
  law.z_from_body_ = {rotation_to_z(axis_a), rotation_to_z(axis_b)};
  const auto is_z = [](const Vec3d& axis) { return axis.x == 0.0 && axis.y == 0.0 && axis.z == 1.0; };
  law.has_axes_ = !is_z(law.axis_of(0)) || !is_z(law.axis_of(1));
  if (!law.has_axes_) law.z_from_body_ = {};
  return law;
}

std::string OrientationLaw::name() const {
  std::string text;
  if (kind_ == Kind::fixed) {
    text = "fixed:";
    for (std::size_t k = 0; k < 4; ++k) text += (k == 0 ? "" : ",") + shortest_number(quaternion_[k]);
  } else if (kind_ == Kind::angle) {
    text = "angle:" + shortest_number(degrees_);
  } else if (axis_[0] == axis_[1]) {
    text = axis_[0].name();
  } else {
    text = "A " + axis_[0].name() + ", B " + axis_[1].name();
  }
  if (!has_axes_) return text;
  const std::string a = numbers_of(axis_of(0)), b = numbers_of(axis_of(1));
  return text + " about " + (a == b ? a : a + " and " + b);
}

std::optional<double> OrientationLaw::order_parameter() const {
  if (kind_ == Kind::fixed || kind_ == Kind::angle || !(axis_[0] == axis_[1])) return std::nullopt;
  return axis_[0].order_parameter();
}

std::optional<std::array<double, 2>> OrientationLaw::order_parameters() const {
  if (kind_ == Kind::fixed || kind_ == Kind::angle) return std::nullopt;
  return std::array<double, 2>{axis_[0].order_parameter(), axis_[1].order_parameter()};
}

bool operator==(const OrientationLaw& x, const OrientationLaw& y) {
  if (x.kind_ != y.kind_ || x.degrees_ != y.degrees_ || x.quaternion_ != y.quaternion_ || x.axis_ != y.axis_) {
    return false;
  }
  const auto are_equal = [](const Vec3d& v, const Vec3d& w) { return v.x == w.x && v.y == w.y && v.z == w.z; };
  return x.has_axes_ == y.has_axes_ && are_equal(x.axis_of(0), y.axis_of(0)) && are_equal(x.axis_of(1), y.axis_of(1));
}

int OrientationLaw::dimension() const {
  switch (kind_) {
    case Kind::isotropic: return 3;
    case Kind::aligned:
    case Kind::fixed: return 0;
    case Kind::angle: return 2;
    default: break;
  }
  return kMaxDimension;
}

}  // namespace vex
