// Any convex body, chosen at run time.
#pragma once

#include <memory>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/support/support_mapping.h"

namespace vex {

/// Holds any support mapping; itself one. Cheap to copy: copies share the shape, which never changes.
///
/// The one indirect call of a query is the support mapping's, a packet of directions at a time; each lane type that
/// kernels are compiled for is one more overload of Model::support.
class ConvexBody {
 public:
  template <SupportMapping Shape>
    requires(!std::same_as<Shape, ConvexBody>)
  ConvexBody(Shape shape)  // NOLINT(google-explicit-constructor): every shape is a convex body
      : centre_(shape.centre()),
        circumradius_(shape.circumradius()),
        inradius_(shape.inradius()),
        support_error_(shape.support_error()),
        model_(std::make_shared<const ModelOf<Shape>>(std::move(shape))) {}

  Vec3d support(const Vec3d& dir) const { return model_->support(dir); }
  double support_error() const { return support_error_; }
  Vec3d centre() const { return centre_; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

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
  };
  template <class Shape>
  struct ModelOf final : Model {
    explicit ModelOf(Shape s) : shape(std::move(s)) {}
    Vec3d support(const Vec3d& dir) const override { return shape.support(dir); }
    Shape shape;
  };

  Vec3d centre_;
  double circumradius_;
  double inradius_;
  double support_error_;
  std::shared_ptr<const Model> model_;
};

}  // namespace vex
