// A core of any form, for searches that are compiled once for all pairs of forms.
#pragma once

#include "engine/query/packets/packet_curved_core.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

/// Which form it has is looked at once for a packet.
class AnyCore {
 public:
  explicit AnyCore(const CoreForm& form)
      : kind_(form.kind),
        box_(form),
        ellipsoid_(form),
        vertices_(form),
        table_(form),
        pieces_(form),
        powers_(form),
        profile_(form) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    switch (kind_) {
      case CoreForm::Kind::box: return box_.support(dir);
      case CoreForm::Kind::ellipsoid: return ellipsoid_.support(dir);
      case CoreForm::Kind::table: return table_.support(dir);
      case CoreForm::Kind::pieces: return pieces_.support(dir);
      case CoreForm::Kind::powers: return powers_.support(dir);
      case CoreForm::Kind::profile: return profile_.support(dir);
      case CoreForm::Kind::vertices: break;
    }
    return vertices_.support(dir);
  }

  template <class L>
  Vec3<L> direction_to(const Vec3<L>& p) const {
    switch (kind_) {
      case CoreForm::Kind::box: return box_.direction_to(p);
      case CoreForm::Kind::ellipsoid: return ellipsoid_.direction_to(p);
      case CoreForm::Kind::vertices:
      case CoreForm::Kind::table:
      case CoreForm::Kind::pieces:
      case CoreForm::Kind::powers:
      case CoreForm::Kind::profile: break;  // alike for these
    }
    return vertices_.direction_to(p);
  }
  bool has_direction() const {
    switch (kind_) {
      case CoreForm::Kind::box: return box_.has_direction();
      case CoreForm::Kind::ellipsoid: return ellipsoid_.has_direction();
      case CoreForm::Kind::vertices:
      case CoreForm::Kind::table:
      case CoreForm::Kind::pieces:
      case CoreForm::Kind::powers:
      case CoreForm::Kind::profile: break;
    }
    return vertices_.has_direction();
  }

 private:
  CoreForm::Kind kind_;
  BoxCore box_;
  EllipsoidCore ellipsoid_;
  VerticesCore vertices_;
  TableCore table_;
  PiecesCore pieces_;
  PowersCore powers_;
  ProfileCore profile_;
};

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
