#include "shapes/any_shape.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "engine/numeric/errors.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

using Sizes = std::span<const double>;

template <class Shape>
MeasuredBody measured(std::string_view kind, const Shape& shape) {
  return {std::string(kind), ConvexBody(shape), shape.measures()};
}

struct Entry {
  NamedShape shape;
  std::size_t n_sizes;
  MeasuredBody (*make)(std::string_view kind, Sizes sizes);
};

// The list: a new body is one line here.
constexpr std::array kShapes = {
    Entry{{"sphere", "R", "radius"}, 1, [](std::string_view kind, Sizes s) { return measured(kind, Sphere(s[0])); }},
    Entry{{"box", "A,B,C", "full edges along x, y, z"},
          3,
          [](std::string_view kind, Sizes s) { return measured(kind, Box(s[0], s[1], s[2])); }},
    Entry{{"ellipsoid", "A,B,C", "semi-axes along x, y, z"},
          3,
          [](std::string_view kind, Sizes s) { return measured(kind, Ellipsoid(s[0], s[1], s[2])); }},
    Entry{{"capsule", "L,R", "length of the straight part along z, radius"},
          2,
          [](std::string_view kind, Sizes s) { return measured(kind, Capsule(s[0], s[1])); }},
};

// Named in the documentation, and coming.
constexpr std::array<std::string_view, 12> kPlanned = {"cylinder",   "cone",         "frustum",     "hemisphere",
                                                       "disc",       "plate",        "needle",      "tetrahedron",
                                                       "octahedron", "dodecahedron", "icosahedron", "rounded"};

std::string_view name_part(std::string_view text) { return text.substr(0, text.find(':')); }

std::string list_of_shapes() {
  std::string list;
  for (const Entry& entry : kShapes) {
    if (!list.empty()) list += ", ";
    list += std::string(entry.shape.name) + ":" + std::string(entry.shape.parameters);
  }
  return list;
}

double parse_size(std::string_view word, std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw InputError("a size is out of range (\"" + std::string(word) + "\" in " + std::string(text) +
                     ") - use sizes between 1e-45 and 1e45");
  }
  if (error != std::errc{} || end != word.data() + word.size()) {
    throw UsageError("not a number (\"" + std::string(word) + "\" in " + std::string(text) +
                     ") - sizes are written like 0.5 or 1e-3, with a comma between them");
  }
  if (!std::isfinite(value) || value <= 0.0) {
    throw InputError("a size is not positive and finite (" + std::string(word) + " in " + std::string(text) +
                     ") - every size of a body must be");
  }
  if (value < kSmallestSize || value > kLargestSize) {
    throw InputError("a size is out of range (" + std::string(word) + " in " + std::string(text) +
                     ") - use sizes between 1e-45 and 1e45: choose another unit of length");
  }
  return value;
}

}  // namespace

std::vector<NamedShape> named_shapes() {
  std::vector<NamedShape> shapes;
  for (const Entry& entry : kShapes) shapes.push_back(entry.shape);
  return shapes;
}

bool names_a_shape(std::string_view text) {
  const std::string_view name = name_part(text);
  return name.size() < text.size() &&
         (std::ranges::any_of(kShapes, [&](const Entry& entry) { return entry.shape.name == name; }) ||
          std::ranges::find(kPlanned, name) != kPlanned.end());
}

MeasuredBody parse_shape(std::string_view text) {
  const std::string_view name = name_part(text);
  const auto* const entry =
      std::ranges::find_if(kShapes, [&](const Entry& candidate) { return candidate.shape.name == name; });
  if (entry == kShapes.end()) {
    const bool planned = std::ranges::find(kPlanned, name) != kPlanned.end();
    throw UsageError((planned ? "this body is not built yet (" : "no body of this name (") + std::string(text) +
                     ") - there are " + list_of_shapes());
  }
  std::vector<double> sizes;
  std::string_view rest = text.substr(std::min(name.size() + 1, text.size()));
  while (true) {
    const std::size_t comma = rest.find(',');
    sizes.push_back(parse_size(rest.substr(0, comma), text));
    if (comma == std::string_view::npos) break;
    rest = rest.substr(comma + 1);
  }
  if (sizes.size() != entry->n_sizes) {
    throw UsageError("wrong number of sizes (" + std::to_string(sizes.size()) + " in " + std::string(text) +
                     ") - write " + std::string(name) + ":" + std::string(entry->shape.parameters) + " (" +
                     std::string(entry->shape.meaning) + ")");
  }
  MeasuredBody made = entry->make(entry->shape.name, sizes);
  require_size_in_range(made.body, made.measures, text);
  return made;
}

void require_size_in_range(const ConvexBody& body, const Measures& measures, std::string_view source) {
  const bool too_large = body.reach() > 2.0 * kLargestSize || !std::isfinite(measures.volume);
  const bool too_small = body.circumradius() < 0.5 * kSmallestSize;
  if (too_large || too_small) {
    throw InputError(std::string("a body is too ") + (too_large ? "large" : "small") + " (" + std::string(source) +
                     ") - use sizes and coordinates between 1e-45 and 1e45: choose another unit of length");
  }
}

}  // namespace vex
