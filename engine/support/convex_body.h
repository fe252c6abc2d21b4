// Any convex body, chosen at run time.
#pragma once

#include <concepts>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"
#include "engine/support/corner_table.h"
#include "engine/support/direction_table.h"
#include "engine/support/exact_form.h"
#include "engine/support/generators.h"
#include "engine/support/power_form.h"
#include "engine/support/profile_form.h"
#include "engine/support/support_mapping.h"

namespace vex {

// What a body may tell besides; of none of it is anybody asked who has a mapping of his own and inherits the rest
// (is_of_older_mapping).

/// A body with a ball about each of its points tells the ball apart from the rest, the core: balls stay balls under any
/// pose, and a query adds the two bodies' balls in one.
template <class S>
concept HasBallPart = requires(const S& body, const Vec3d& dir) {
  { body.core_support(dir) } -> std::same_as<Vec3d>;
  { body.core_support_error() } -> std::convertible_to<double>;
  { body.ball_radius() } -> std::convertible_to<double>;
}
&&!requires { requires is_of_older_mapping<S>(&S::template core_support<double>); };
/// A body that is another convex body with a ball of this radius about each of its points, under any rotation to within
/// 1e-6: its least radius of curvature, or less (W. Blaschke, Kreis und Kugel, section 24). Of a body with a ball part,
/// that of its core. Distance and depth are then asked of the smaller body, of which the origin is less often inside.
template <class S>
concept HasRollingRadius = requires(const S& body) {
  { body.rolling_radius() } -> std::convertible_to<double>;
}
&&!requires { requires is_of_older_mapping<S>(&S::rolling_radius); };
template <class S>
concept HasExactForm = requires(const S& body) {
  { body.exact_form() } -> std::convertible_to<std::optional<ExactForm>>;
}
&&!requires { requires is_of_older_mapping<S>(&S::exact_form); };
/// The body's core is a zonotope.
template <class S>
concept HasGenerators = requires(const S& body) {
  { body.generators() } -> std::convertible_to<std::optional<Generators>>;
}
&&!requires { requires is_of_older_mapping<S>(&S::generators); };
/// The body's core is told by powers.
template <class S>
concept HasPowerForm = requires(const S& body) {
  { body.power_form() } -> std::convertible_to<std::optional<PowerForm>>;
}
&&!requires { requires is_of_older_mapping<S>(&S::power_form); };
/// The body's core is one of revolution whose outline is arcs.
template <class S>
concept HasProfileForm = requires(const S& body) {
  { body.profile_form() } -> std::convertible_to<std::optional<ProfileForm>>;
}
&&!requires { requires is_of_older_mapping<S>(&S::profile_form); };
/// A polytope, or one with a ball, of many vertices has a table of directions: `direction_table` makes it, unless it is
/// there, and returns it. Safe from several threads at once.
template <class S>
concept HasDirectionTable = requires(const S& body) {
  { body.direction_table() } -> std::same_as<std::optional<DirectionTable>>;
}
&&!requires { requires is_of_older_mapping<S>(&S::direction_table); };
/// A body says yes whose `support` rounds as a mapping of its core that kernels have (packet_core.h), with its ball
/// added by `ball_support`: a box's corner by the signs of the direction, an ellipsoid's D (D d / |D d|), a vertex
/// whose computed product with the direction is the largest. A kernel then finds the bits of d . s(d).
template <class S>
concept MayRoundAsKernels = requires(const S& body) {
  { body.rounds_as_kernels() } -> std::same_as<bool>;
}
&&!requires { requires is_of_older_mapping<S>(&S::rounds_as_kernels); };

/// Holds any support mapping; itself one. Cheap to copy: copies share the shape, which never changes.
///
/// The one indirect call of a query is the support mapping's, a packet of directions at a time; each lane type that
/// kernels are compiled for is one more overload of Model::support.
class ConvexBody {
 public:
  /// Throws InputError where what the shape says of itself is not finite, negative, or out of range.
  template <SupportMapping Shape>
    requires(!std::same_as<Shape, ConvexBody>)
  ConvexBody(Shape shape)  // NOLINT(google-explicit-constructor): every shape is a convex body
      : centre_(shape.centre()),
        circumradius_(shape.circumradius()),
        inradius_(shape.inradius()),
        support_error_(shape.support_error()),
        core_support_error_(support_error_) {
    if constexpr (MayRoundAsKernels<Shape>) rounds_as_kernels_ = shape.rounds_as_kernels();
    if constexpr (HasBallPart<Shape>) {
      core_support_error_ = shape.core_support_error();
      ball_radius_ = shape.ball_radius();
    }
    if constexpr (HasRollingRadius<Shape>) rolling_radius_ = shape.rolling_radius();
    if constexpr (HasGenerators<Shape>) generators_ = shape.generators();
    std::optional<ExactForm> form;
    if constexpr (HasExactForm<Shape>) form = shape.exact_form();
    is_rounded_polytope_ = form && form->is_rounded_polytope();
    detail::check_claims(
        {centre_, circumradius_, inradius_, support_error_, core_support_error_, ball_radius_, rolling_radius_}, form,
        generators_);
    auto model = std::make_shared<ModelOf<Shape>>(std::move(shape));
    if (is_rounded_polytope_) model->vertices = std::move(form->points);
    model_ = std::move(model);
  }

  /// What has a support mapping and lacks a member is told which.
  template <class Shape>
    requires(!SupportMapping<Shape> && HasSupportMember<Shape>)
  ConvexBody(Shape) {  // NOLINT(google-explicit-constructor): as above
    static_assert(SupportMappingOver<Shape, double>,
                  "a convex body needs: Vec3d support(const Vec3d& dir) const, best a template over the lane");
    static_assert(HasSupportError<Shape>, "a convex body needs: double support_error() const");
    static_assert(HasCentre<Shape>, "a convex body needs: Vec3d centre() const");
    static_assert(HasCircumradius<Shape>, "a convex body needs: double circumradius() const");
    static_assert(HasInradius<Shape>, "a convex body needs: double inradius() const");
  }

  Vec3d support(const Vec3d& dir) const { return model_->support(dir); }
  double support_error() const { return support_error_; }

  /// Directions that stand in columns.
  struct Columns {
    const double *x, *y, *z;
  };
  /// d . s(d), and for -d, of n directions: the body asked 2 n times by one indirect call.
  void heights(const Columns& dirs, std::size_t n, double* along, double* against) const {
    model_->heights(dirs, n, along, against);
  }
  bool rounds_as_kernels() const { return rounds_as_kernels_; }

  /// The body is its core with a ball of this radius, 0 or more, about each point.
  double ball_radius() const { return ball_radius_; }
  Vec3d core_support(const Vec3d& dir) const { return model_->core_support(dir); }
  double core_support_error() const { return core_support_error_; }
  /// Of the core, 0 where none is known: HasRollingRadius.
  double rolling_radius() const { return rolling_radius_; }
  /// The core as a zonotope, if it says so.
  const std::optional<Generators>& generators() const { return generators_; }
  /// Whether the core is known to be the convex hull of finitely many points.
  bool is_rounded_polytope() const { return is_rounded_polytope_; }
  /// These points, those of `exact_form`, without a copy; none where the core is not known to be their hull. They live
  /// as long as the shape.
  std::span<const Vec3d> vertices_of_core() const { return model_->vertices; }

  /// What the body is exactly; none where its class does not tell. Copies the vertices of a polytope.
  std::optional<ExactForm> exact_form() const { return model_->exact_form(); }

  /// The core by its powers, if it says so.
  std::optional<PowerForm> power_form() const { return model_->power_form(); }
  /// The core by its outline, if it says so.
  std::optional<ProfileForm> profile_form() const { return model_->profile_form(); }

  /// The corners of a core that is known to be the convex hull of finitely many points, as its exact form has them,
  /// made when they are first asked for; empty of other bodies, and of more corners than such a table has. Safe from
  /// several threads at once.
  const CornerTable& corners() const { return model_->corners(); }

  /// Whether there may be a table of directions; and the table, which is made where it is not there yet (1 to 4 us a
  /// vertex), or none where the body's numbers allow of none. It lives as long as the shape. Whether it is there
  /// changes no bit of `support`.
  bool may_have_direction_table() const { return model_->may_have_direction_table(); }
  std::optional<DirectionTable> direction_table() const { return model_->direction_table(); }

  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

  /// Copies of one body have the same; another body never has it while anybody holds it.
  std::shared_ptr<const void> identity() const { return model_; }
  bool is_same_as(const std::shared_ptr<const void>& identity) const { return identity.get() == model_.get(); }

  /// The shape itself, if it is a `Shape`: for adapters that hand bodies to another library. No query asks.
  template <class Shape>
  const Shape* target() const {
    const auto* const model = dynamic_cast<const ModelOf<Shape>*>(model_.get());
    return model == nullptr ? nullptr : &model->shape;
  }

  /// No point of the body is farther than this from the origin of its frame.
  double reach() const { return (norm_1(centre_) + circumradius_) * (1.0 + gamma(4)); }

 private:
  struct Model {
    virtual ~Model() = default;
    virtual Vec3d support(const Vec3d& dir) const = 0;
    virtual void heights(const Columns& dirs, std::size_t n, double* along, double* against) const = 0;
    virtual Vec3d core_support(const Vec3d& dir) const = 0;
    virtual std::optional<ExactForm> exact_form() const = 0;
    virtual std::optional<PowerForm> power_form() const = 0;
    virtual std::optional<ProfileForm> profile_form() const = 0;
    virtual bool may_have_direction_table() const = 0;
    virtual std::optional<DirectionTable> direction_table() const = 0;
    std::vector<Vec3d> vertices;  // of a rounded polytope's core

    const CornerTable& corners() const {
      std::call_once(corners_once_, [&] { corners_ = std::make_unique<const CornerTable>(vertices); });
      return *corners_;
    }

   private:
    mutable std::once_flag corners_once_;
    mutable std::unique_ptr<const CornerTable> corners_;
  };
  template <class Shape>
  struct ModelOf final : Model {
    explicit ModelOf(Shape s) : shape(std::move(s)) {}
    Vec3d support(const Vec3d& dir) const override { return shape.support(dir); }
    void heights(const Columns& dirs, std::size_t n, double* along, double* against) const override {
      for (std::size_t k = 0; k < n; ++k) {
        const Vec3d dir{dirs.x[k], dirs.y[k], dirs.z[k]};
        along[k] = dot(dir, shape.support(dir));
        against[k] = dot(-dir, shape.support(-dir));
      }
    }
    Vec3d core_support(const Vec3d& dir) const override {
      if constexpr (HasBallPart<Shape>) {
        return shape.core_support(dir);
      } else {
        return shape.support(dir);
      }
    }
    std::optional<ExactForm> exact_form() const override {
      if constexpr (HasExactForm<Shape>) {
        return shape.exact_form();
      } else {
        return std::nullopt;
      }
    }
    std::optional<PowerForm> power_form() const override {
      if constexpr (HasPowerForm<Shape>) {
        return shape.power_form();
      } else {
        return std::nullopt;
      }
    }
    std::optional<ProfileForm> profile_form() const override {
      if constexpr (HasProfileForm<Shape>) {
        return shape.profile_form();
      } else {
        return std::nullopt;
      }
    }
    bool may_have_direction_table() const override { return HasDirectionTable<Shape>; }
    std::optional<DirectionTable> direction_table() const override {
      if constexpr (HasDirectionTable<Shape>) {
        return shape.direction_table();
      } else {
        return std::nullopt;
      }
    }
    Shape shape;
  };

  Vec3d centre_;
  double circumradius_;
  double inradius_;
  double support_error_;
  double core_support_error_;
  double ball_radius_ = 0.0;
  double rolling_radius_ = 0.0;
  std::optional<Generators> generators_;
  bool is_rounded_polytope_ = false;
  bool rounds_as_kernels_ = false;
  std::shared_ptr<const Model> model_;
};

}  // namespace vex
