// X3D, NFF, IFC: assimp makes polyhedra of their balls, cylinders and other curved bodies, which are others.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/formats/scene_formats.h"
#include "meshes/formats/scene_parts.h"
#include "meshes/formats/text_scanner.h"
#include "meshes/formats/xml_tags.h"

namespace vex {
namespace {

[[noreturn]] void refuse_curved(const AssimpInput& input, const std::string& what) {
  refuse_scene(input, "the file holds a curved body, which would be read as a polyhedron", what,
               "name the body, such as sphere:R, or export it as .stl, .ply or .obj");
}

// --- X3D

constexpr std::array<std::string_view, 7> kCurvedShapes{"Sphere",     "Cylinder", "Cone",  "Arc2D",
                                                        "ArcClose2D", "Circle2D", "Disk2D"};
/// assimp passes over these, and what is in them.
constexpr std::array<std::string_view, 4> kPassedOver{"LOD", "ProtoInstance", "ProtoDeclare", "ExternProtoDeclare"};

/// The attributes that hold points, places or the corners of faces.
constexpr std::array<std::string_view, 16> kGeometry{
    "point", "translation", "rotation", "scale",    "scaleOrientation", "center", "size",   "coordIndex",
    "index", "height",      "xSpacing", "zSpacing", "crossSection",     "spine",  "radius", "orientation"};

/// assimp takes 0,5 and 1x as far as they are numbers. A comma may part numbers in X3D, and stands behind one here.
void check_x3d_numbers(const XmlTag& tag, const AssimpInput& input) {
  for (const std::string_view name : kGeometry) {
    std::string_view text = from_word(tag.attribute(name).value_or(""));
    for (; !text.empty(); text = from_word(text)) {
      std::string_view word = first_word(text);
      text.remove_prefix(word.size());
      if (word.size() > 1 && word.ends_with(',')) word.remove_suffix(1);
      if (is_decimal(word)) continue;
      refuse_scene(
          input, shown(word) + " is not " + kDecimal.name,
          std::string(name) + " of " + shown_name(tag.name) + ": expected decimal numbers with blanks between them",
          "mend the file, or export it as .stl, .ply or .obj");
    }
  }
}

}  // namespace

void look_into_x3d(AssimpInput* input) {
  XmlTags tags(input->bytes.view());
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->is_closing) continue;
    if (std::ranges::find(kCurvedShapes, tag->name) != kCurvedShapes.end()) refuse_curved(*input, shown_tag(*tag));
    if (tag->name.starts_with("Nurbs") || std::ranges::find(kPassedOver, tag->name) != kPassedOver.end()) {
      refuse_scene(*input, "the file holds parts that are not read", shown_name(tag->name),
                   "export it as .stl, .ply or .obj");
    }
    check_x3d_numbers(*tag, *input);
  }
}

void look_into_nff(AssimpInput* input) {
  TextScanner scanner(input->bytes.view(), input->path.string());
  while (scanner.next_line()) {
    const std::string_view word = scanner.next_word();
    if (word == "s" || word == "c") {
      refuse_curved(*input,
                    "line " + std::to_string(scanner.line_number()) + ": " + shown(word) + ", a ball or a cone");
    }
  }
}

void look_into_ifc(AssimpInput* input) {
  constexpr std::array<std::string_view, 8> kCurved{"IFCCIRCLE",  "IFCELLIPSE", "IFCREVOLVED",      "IFCSWEPTDISK",
                                                    "IFCBSPLINE", "IFCSPHERE",  "IFCRIGHTCIRCULAR", "IFCROUNDEDRECT"};
  for (const std::string_view word : kCurved) {
    if (input->bytes.view().find(word) != std::string_view::npos) refuse_curved(*input, std::string(word) + "...");
  }
}

}  // namespace vex
