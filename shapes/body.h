// A convex body and, beside it, its measures.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "engine/support/convex_body.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/polytope.h"
#include "shapes/solid_moments.h"

namespace vex {

/// A body as the sampler sees it and, never mixed with it, its measures as the formula sees them. Every query takes it
/// where it takes a ConvexBody.
struct Body {
  std::string kind = "body";  // sphere, box, ...; polyhedron for a mesh
  ConvexBody body;
  Measures measures = Measures::unknown();
  std::size_t n_faces = 0;   // of a polytope, sides of a plate; 0 for what has curved parts
  NormalMeasures normals{};  // none of a body that somebody made without
  std::optional<SolidMoments>
      moments{};  // of the named bodies with curved parts; those of a polytope are its vertices'

  /// Of a class that computes its measures these, and its measures on normals; of another support mapping, as a user's
  /// own, no measures are known. A class made of a shape, with a mapping of its own, does not inherit what the shape
  /// knows of the mapping that it had. Throws InputError as ConvexBody does.
  template <SupportMapping Shape>
    requires(!std::same_as<Shape, ConvexBody>)
  Body(const Shape& shape) : body(convex(shape)) {  // NOLINT(google-explicit-constructor): every shape is a body
    constexpr bool has_old_measures = requires { requires is_of_older_mapping<Shape>(&Shape::measures); };
    if constexpr (requires { Measures(shape.measures()); } && !has_old_measures) measures = shape.measures();
    constexpr bool has_old_faces = requires { requires is_of_older_mapping<Shape>(&Shape::n_faces); };
    if constexpr (requires { shape.n_faces(); } && !has_old_faces) n_faces = shape.n_faces();
    constexpr bool has_old_normals = requires { requires is_of_older_mapping<Shape>(&Shape::area_measure); }
    || requires { requires is_of_older_mapping<Shape>(&Shape::mean_curvature_measure); };
    if constexpr (HasNormalMeasures<Shape> && !has_old_normals) normals = normal_measures_of(shape);
    constexpr bool has_old_moments = requires { requires is_of_older_mapping<Shape>(&Shape::solid_moments); };
    if constexpr (requires { SolidMoments(shape.solid_moments()); } && !has_old_moments)
      moments = shape.solid_moments();
  }
  Body(ConvexBody convex) : body(std::move(convex)) {}  // NOLINT(google-explicit-constructor): likewise
  Body(std::string kind_of_body, ConvexBody convex, const Measures& of_body, std::size_t n_of_faces = 0,
       NormalMeasures on_normals = {})
      : kind(std::move(kind_of_body)),
        body(std::move(convex)),
        measures(of_body),
        n_faces(n_of_faces),
        normals(std::move(on_normals)) {}

  operator const ConvexBody&() const { return body; }  // NOLINT(google-explicit-constructor): it is one

 private:
  /// Of a class made of Polytope that gives none of its members another meaning: it is its vertices, as a regular
  /// polyhedron is.
  template <class Shape>
  static constexpr bool is_its_vertices() {
    return std::derived_from<Shape, Polytope> && requires {
      requires std::same_as<decltype(&Shape::template support<double>), decltype(&Polytope::template support<double>)>;
      requires std::same_as<decltype(&Shape::support_error), decltype(&Polytope::support_error)>;
      requires std::same_as<decltype(&Shape::centre), decltype(&Polytope::centre)>;
      requires std::same_as<decltype(&Shape::circumradius), decltype(&Polytope::circumradius)>;
      requires std::same_as<decltype(&Shape::inradius), decltype(&Polytope::inradius)>;
      requires std::same_as<decltype(&Shape::exact_form), decltype(&Polytope::exact_form)>;
    };
  }
  template <class Shape>
  static ConvexBody convex(const Shape& shape) {
    if constexpr (is_its_vertices<Shape>()) {
      return ConvexBody(Polytope(shape));
    } else {
      return ConvexBody(shape);
    }
  }
};

}  // namespace vex
