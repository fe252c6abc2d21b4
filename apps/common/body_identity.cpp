#include "apps/common/body_identity.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>

#include "apps/common/numbers.h"

namespace vex {
namespace {

// FNV-1a: G. Fowler, L. C. Noll, P. Vo, IETF draft-eastlake-fnv.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) sum_ = (sum_ ^ (word >> shift & 255u)) * 0x100000001b3u;
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3d& v) {
    for (const double x : {v.x, v.y, v.z}) add(x);
  }
  std::string digits() const {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[sum_ >> shift & 15u];
    return text;
  }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

// A body without an exact form is known by how far it reaches in directions of no symmetry: others of the same V, S, M
// and radii, turned or mirrored, reach otherwise. Rounded, since mathematical libraries differ in the last digits.
void add_reach(const ConvexBody& body, Hash& hash) {
  constexpr int kDirections = 64;
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - 2.0 * (k + 0.37) / kDirections, across = std::sqrt(1.0 - z * z);
    const double azimuth = 2.399963 * k + 0.7;
    const Vec3d dir{across * std::cos(azimuth), across * std::sin(azimuth), z};
    hash.add(static_cast<std::uint64_t>(std::llround(0x1p36 * dot(dir, body.support(dir)) / body.reach())));
  }
}

}  // namespace

std::string body_identity(const Body& body) {
  Hash hash;
  if (const std::optional<ExactForm> form = body.body.exact_form()) {
    for (const Vec3d& point : form->points) hash.add(point);
    for (const ExactForm::Piece& piece : form->pieces) {
      hash.add(piece.centre);
      hash.add(piece.semi_axes);
      hash.add(std::uint64_t{piece.is_dome});
    }
    hash.add(form->ball_radius);
  } else {
    add_reach(body.body, hash);
  }
  hash.add(body.body.centre());
  hash.add(body.body.circumradius());
  hash.add(body.body.inradius());
  if (body.n_faces > 0 && body.normals.area) {
    const NormalMeasure faces = body.normals.area();
    for (const NormalMeasure::Component& face : faces.components()) hash.add(mass_of(face));
  }
  // In so many digits machines agree, whose mathematical libraries may differ in the last one.
  constexpr int kDigits = 12;
  const Measures& measures = body.measures;
  return body.kind + ", V " + short_number(measures.volume, kDigits) + ", S " +
         short_number(measures.surface_area, kDigits) + ", M " +
         short_number(measures.integrated_mean_curvature, kDigits) + ", geometry " + hash.digits();
}

}  // namespace vex
