#include "shapes/any_shape.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "shapes/antiprism.h"
#include "shapes/archimedean.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/closest_word.h"
#include "shapes/cone.h"
#include "shapes/cut_sphere.h"
#include "shapes/cylinder.h"
#include "shapes/disc.h"
#include "shapes/dodecahedron.h"
#include "shapes/egg.h"
#include "shapes/ellipsoid.h"
#include "shapes/frustum.h"
#include "shapes/hemisphere.h"
#include "shapes/icosahedron.h"
#include "shapes/lens.h"
#include "shapes/needle.h"
#include "shapes/octahedron.h"
#include "shapes/plate.h"
#include "shapes/prism.h"
#include "shapes/pyramid.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"
#include "shapes/spindle.h"
#include "shapes/superellipsoid.h"
#include "shapes/tetrahedron.h"

namespace vex {
namespace {

using Sizes = std::span<const double>;

struct Entry {
  NamedShape shape;
  std::string_view sorts;  // of its numbers, in their order: l a length, n how many sides, p an exponent
  Body (*make)(Sizes sizes);
};

int n_sides(double size) { return static_cast<int>(size); }

template <ArchimedeanKind kKind>
constexpr Entry archimedean(std::string_view name) {
  return {{name, "E", "edge"}, "l", [](Sizes s) -> Body { return ArchimedeanSolid(kKind, s[0]); }};
}

// The list: a new body is one line here.
constexpr std::array kShapes = {
    Entry{{"sphere", "R", "radius"}, "l", [](Sizes s) -> Body { return Sphere(s[0]); }},
    Entry{{"box", "A,B,C", "full edges along x, y, z"}, "lll", [](Sizes s) -> Body { return Box(s[0], s[1], s[2]); }},
    Entry{{"ellipsoid", "A,B,C", "semi-axes along x, y, z"},
          "lll",
          [](Sizes s) -> Body { return Ellipsoid(s[0], s[1], s[2]); }},
    Entry{{"capsule", "L,R", "length of the straight part along z, radius"},
          "ll",
          [](Sizes s) -> Body { return Capsule(s[0], s[1]); }},
    Entry{{"cylinder", "L,R", "length along z, radius"}, "ll", [](Sizes s) -> Body { return Cylinder(s[0], s[1]); }},
    Entry{{"cone", "H,R", "height along z, radius of the base at z = -H/2"},
          "ll",
          [](Sizes s) -> Body { return Cone(s[0], s[1]); }},
    Entry{{"frustum", "H,R1,R2", "height along z, radii at z = -H/2 and z = H/2"},
          "lll",
          [](Sizes s) -> Body { return Frustum(s[0], s[1], s[2]); }},
    Entry{{"hemisphere", "R", "radius; flat face in z = 0, dome towards +z"},
          "l",
          [](Sizes s) -> Body { return Hemisphere(s[0]); }},
    Entry{{"lens", "R,H", "radius of the rim in z = 0, thickness along z: what two equal balls share"},
          "ll",
          [](Sizes s) -> Body { return Lens(s[0], s[1]); }},
    Entry{{"cut-sphere", "R,B,T", "radius of the ball, flat faces at z = -B and z = T, none where that is R"},
          "lll",
          [](Sizes s) -> Body { return CutSphere(s[0], s[1], s[2]); }},
    Entry{
        {"spindle", "L,R", "length along z from tip to tip, radius at the equator; its profile is an arc of a circle"},
        "ll",
        [](Sizes s) -> Body { return Spindle(s[0], s[1]); }},
    Entry{{"egg", "R,B,T", "radius at the equator z = 0, heights below and above it: two half spheroids"},
          "lll",
          [](Sizes s) -> Body { return Egg(s[0], s[1], s[2]); }},
    Entry{{"superball", "P,R", "exponent from 0.5 up, half width: |x|^2P + |y|^2P + |z|^2P <= R^2P"},
          "pl",
          [](Sizes s) -> Body { return Superball(s[0], s[1]); }},
    Entry{{"superellipsoid", "A,B,C,P,Q",
           "semi-axes, exponents across and along z: (|x/A|^2P + |y/B|^2P)^(Q/P) + |z/C|^2Q <= 1"},
          "lllpp",
          [](Sizes s) -> Body { return Superellipsoid(s[0], s[1], s[2], s[3], s[4]); }},
    Entry{{"disc", "R", "radius; in z = 0, no thickness"}, "l", [](Sizes s) -> Body { return Disc(s[0]); }},
    Entry{{"plate", "A,B", "full edges along x, y; in z = 0, no thickness"},
          "ll",
          [](Sizes s) -> Body { return Plate(s[0], s[1]); }},
    Entry{{"needle", "L", "length along z, no thickness"}, "l", [](Sizes s) -> Body { return Needle(s[0]); }},
    Entry{{"tetrahedron", "E", "edge"}, "l", [](Sizes s) -> Body { return Tetrahedron(s[0]); }},
    Entry{{"octahedron", "E", "edge"}, "l", [](Sizes s) -> Body { return Octahedron(s[0]); }},
    Entry{{"dodecahedron", "E", "edge"}, "l", [](Sizes s) -> Body { return Dodecahedron(s[0]); }},
    Entry{{"icosahedron", "E", "edge"}, "l", [](Sizes s) -> Body { return Icosahedron(s[0]); }},
    Entry{{"prism", "N,A,H", "number of sides, edge of the polygon, height along z"},
          "nll",
          [](Sizes s) -> Body { return Prism(n_sides(s[0]), s[1], s[2]); }},
    Entry{{"antiprism", "N,A,H", "number of sides of each of the two polygons, their edge, height along z"},
          "nll",
          [](Sizes s) -> Body { return Antiprism(n_sides(s[0]), s[1], s[2]); }},
    Entry{{"pyramid", "N,A,H", "number of sides of the base at z = -H/2, its edge, height along z"},
          "nll",
          [](Sizes s) -> Body { return Pyramid(n_sides(s[0]), s[1], s[2]); }},
    archimedean<ArchimedeanKind::truncated_tetrahedron>("truncated-tetrahedron"),
    archimedean<ArchimedeanKind::cuboctahedron>("cuboctahedron"),
    archimedean<ArchimedeanKind::truncated_cube>("truncated-cube"),
    archimedean<ArchimedeanKind::truncated_octahedron>("truncated-octahedron"),
    archimedean<ArchimedeanKind::rhombicuboctahedron>("rhombicuboctahedron"),
    archimedean<ArchimedeanKind::truncated_cuboctahedron>("truncated-cuboctahedron"),
    archimedean<ArchimedeanKind::snub_cube>("snub-cube"),
    archimedean<ArchimedeanKind::icosidodecahedron>("icosidodecahedron"),
    archimedean<ArchimedeanKind::truncated_dodecahedron>("truncated-dodecahedron"),
    archimedean<ArchimedeanKind::truncated_icosahedron>("truncated-icosahedron"),
    archimedean<ArchimedeanKind::rhombicosidodecahedron>("rhombicosidodecahedron"),
    archimedean<ArchimedeanKind::truncated_icosidodecahedron>("truncated-icosidodecahedron"),
    archimedean<ArchimedeanKind::snub_dodecahedron>("snub-dodecahedron"),
};

// The one body that is made of another.
constexpr NamedShape kRounded{"rounded", "r,BODY",
                              "any body, a mesh file too, with a ball of radius r about each point"};

std::string_view name_part(std::string_view text) { return text.substr(0, text.find(':')); }

bool is_rounded(std::string_view text) {
  return name_part(text).size() < text.size() && name_part(text) == kRounded.name;
}

std::string usage_of(const NamedShape& shape) { return std::string(shape.name) + ":" + std::string(shape.parameters); }

std::string list_of_shapes() {
  std::string list;
  for (const NamedShape& shape : named_shapes()) {
    if (!list.empty()) list += ", ";
    list += usage_of(shape);
  }
  return list;
}

/// Other names that bodies of the list go by.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kOtherNames{{{"ball", "sphere"},
                                                                                     {"cube", "box"},
                                                                                     {"cuboid", "box"},
                                                                                     {"brick", "box"},
                                                                                     {"hexahedron", "box"},
                                                                                     {"spheroid", "ellipsoid"},
                                                                                     {"spherocylinder", "capsule"},
                                                                                     {"pill", "capsule"},
                                                                                     {"square", "plate"},
                                                                                     {"rectangle", "plate"},
                                                                                     {"segment", "needle"},
                                                                                     {"line", "needle"}}};

[[noreturn]] void refuse_name(std::string_view name, std::string_view text) {
  std::vector<std::string> words;
  for (const NamedShape& shape : named_shapes()) words.emplace_back(shape.name);
  for (const auto& [other, same] : kOtherNames) words.emplace_back(other);
  std::string meant = closest_word(name, words);
  const auto* const other =
      std::ranges::find(kOtherNames, std::string_view(meant), [](const auto& o) { return o.first; });
  if (other != kOtherNames.end()) meant = other->second;
  std::string advice = "there are " + list_of_shapes();
  for (const NamedShape& shape : named_shapes()) {
    if (shape.name == meant) advice = "did you mean " + usage_of(shape) + "? There are " + list_of_shapes();
  }
  throw UsageError("no body of this name (" + std::string(text) + ") - " + advice);
}

[[noreturn]] void refuse_count(std::size_t n_sizes, std::string_view text, const NamedShape& shape) {
  throw UsageError("wrong number of sizes (" + std::to_string(n_sizes) + " in " + std::string(text) + ") - write " +
                   usage_of(shape) + " (" + std::string(shape.meaning) + ")");
}

// "between 1e-45 and 1e45"
std::string range_text(const SizeRange& range) {
  const auto power = [](double size) { return "1e" + std::to_string(static_cast<int>(std::lround(std::log10(size)))); };
  return "between " + power(range.smallest) + " and " + power(range.largest);
}

double parse_size(std::string_view word, std::string_view text, const SizeRange& range) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw InputError("a size is out of range (\"" + std::string(word) + "\" in " + std::string(text) +
                     ") - use sizes " + range_text(range));
  }
  if (error != std::errc{} || end != word.data() + word.size()) {
    throw UsageError("not a number (\"" + std::string(word) + "\" in " + std::string(text) +
                     ") - sizes are written like 0.5 or 1e-3, with a comma between them");
  }
  if (!std::isfinite(value) || value <= 0.0) {
    throw InputError("a size is not positive and finite (" + std::string(word) + " in " + std::string(text) +
                     ") - every size of a body must be");
  }
  return value;
}

double size_in_range(double size, std::string_view text, const SizeRange& range) {
  if (!(size >= range.smallest && size <= range.largest)) {
    throw InputError("a size is out of range (" + std::string(text) + ") - use sizes " + range_text(range) +
                     ": choose another unit of length");
  }
  return size;
}

double parse_number(std::string_view word, char sort, std::string_view text, double scale, const SizeRange& range) {
  const double value = parse_size(word, text, range);
  if (sort == 'l') return size_in_range(value * scale, text, range);
  if (sort == 'p') return value;
  if (value != std::floor(value) || value < 3.0 || value > kMostSides) {
    throw InputError("not a number of sides (" + std::string(word) + " in " + std::string(text) +
                     ") - give a whole number from 3 to " + std::to_string(kMostSides));
  }
  return value;
}

/// Sizes that do not go together are refused where the body is made; here the text is known.
Body made_by(const Entry& entry, Sizes sizes, std::string_view text) {
  try {
    return entry.make(sizes);
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::size_t advice = message.find(" - ");
    message.insert(std::min(advice, message.size()), " (" + std::string(text) + ")");
    throw InputError(message);
  }
}

}  // namespace

std::vector<NamedShape> named_shapes() {
  std::vector<NamedShape> shapes;
  for (const Entry& entry : kShapes) shapes.push_back(entry.shape);
  shapes.push_back(kRounded);
  return shapes;
}

bool names_a_shape(std::string_view text) {
  const std::string_view name = name_part(text);
  return is_rounded(text) || (name.size() < text.size() && std::ranges::any_of(kShapes, [&](const Entry& entry) {
                                return entry.shape.name == name;
                              }));
}

std::optional<RoundedText> parse_rounded(std::string_view text) {
  if (!is_rounded(text)) return std::nullopt;
  RoundedText parts{0.0, text};
  while (is_rounded(parts.body)) {
    const std::string_view sizes = parts.body.substr(kRounded.name.size() + 1);
    const std::size_t comma = sizes.find(',');
    parts.radius += parse_size(sizes.substr(0, comma), text, kMeasuredSizes);
    if (comma == std::string_view::npos || comma + 1 == sizes.size()) {
      throw UsageError("no body to round (" + std::string(text) +
                       ") - write rounded:r,BODY, as in rounded:0.1,box:1,2,3");
    }
    parts.body = sizes.substr(comma + 1);
  }
  return parts;
}

Body rounded(const Body& body, double radius, std::string_view source, const SizeRange& range) {
  const Rounded<ConvexBody> shape(body.body, body.measures, size_in_range(radius, source, range));
  Body made{std::string(kRounded.name), ConvexBody(shape), shape.measures()};
  if (body.normals.area && body.normals.mean_curvature) {
    made.normals = parallel_body_normal_measures(body.normals, radius);
  }
  require_size_in_range(made.body, made.measures, source, range);
  return made;
}

Body parse_shape(std::string_view text, double scale, const SizeRange& range) {
  if (const std::optional<RoundedText> parts = parse_rounded(text)) {
    return rounded(parse_shape(parts->body, scale, range), parts->radius * scale, text, range);
  }
  const std::string_view name = name_part(text);
  const auto* const entry =
      std::ranges::find_if(kShapes, [&](const Entry& candidate) { return candidate.shape.name == name; });
  if (entry == kShapes.end()) refuse_name(name, text);
  const std::string_view sorts = entry->sorts;
  std::vector<double> sizes;
  std::string_view rest = text.substr(std::min(name.size() + 1, text.size()));
  if (rest.empty()) refuse_count(0, text, entry->shape);
  while (true) {
    const std::size_t comma = rest.find(',');
    const char sort = sizes.size() < sorts.size() ? sorts[sizes.size()] : 'l';
    sizes.push_back(parse_number(rest.substr(0, comma), sort, text, scale, range));
    if (comma == std::string_view::npos) break;
    rest = rest.substr(comma + 1);
  }
  if (sizes.size() != sorts.size()) refuse_count(sizes.size(), text, entry->shape);
  Body made = made_by(*entry, sizes, text);
  made.kind = entry->shape.name;
  require_size_in_range(made.body, made.measures, text, range);
  return made;
}

std::vector<Vec3d> vertices_of(const ConvexBody& body) {
  std::optional<ExactForm> form = body.exact_form();
  return form && form->is_polytope() ? std::move(form->points) : std::vector<Vec3d>();
}

void require_size_in_range(const ConvexBody& body, const Measures& measures, std::string_view source,
                           const SizeRange& range) {
  const bool too_large =
      body.reach() > 2.0 * range.largest || (range.needs_measures && !std::isfinite(measures.volume));
  const bool too_small = body.circumradius() < 0.5 * range.smallest;
  if (too_large || too_small) {
    throw InputError(std::string("a body is too ") + (too_large ? "large" : "small") + " (" + std::string(source) +
                     ") - use sizes and coordinates " + range_text(range) + ": choose another unit of length");
  }
}

}  // namespace vex
