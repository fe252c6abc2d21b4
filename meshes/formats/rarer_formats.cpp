// X3D, NFF, IFC: assimp makes polyhedra of their balls, cylinders and other curved bodies, which are others.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "meshes/formats/coordinate_text.h"
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
/// What assimp reads, or what adds nothing to a body. It passes over all else, with what is in it.
constexpr std::array<std::string_view, 62> kReadNodes{"X3D",
                                                      "head",
                                                      "meta",
                                                      "component",
                                                      "unit",
                                                      "Scene",
                                                      "Transform",
                                                      "Group",
                                                      "StaticGroup",
                                                      "Switch",
                                                      "Shape",
                                                      "Appearance",
                                                      "Material",
                                                      "TwoSidedMaterial",
                                                      "ImageTexture",
                                                      "PixelTexture",
                                                      "MovieTexture",
                                                      "MultiTexture",
                                                      "TextureTransform",
                                                      "TextureCoordinate",
                                                      "TextureCoordinateGenerator",
                                                      "TextureProperties",
                                                      "MultiTextureTransform",
                                                      "MultiTextureCoordinate",
                                                      "Color",
                                                      "ColorRGBA",
                                                      "Normal",
                                                      "Coordinate",
                                                      "FogCoordinate",
                                                      "Tangent",
                                                      "IndexedFaceSet",
                                                      "IndexedTriangleSet",
                                                      "IndexedTriangleFanSet",
                                                      "IndexedTriangleStripSet",
                                                      "TriangleSet",
                                                      "TriangleFanSet",
                                                      "TriangleStripSet",
                                                      "TriangleSet2D",
                                                      "Rectangle2D",
                                                      "IndexedLineSet",
                                                      "LineSet",
                                                      "PointSet",
                                                      "Polyline2D",
                                                      "Polypoint2D",
                                                      "Box",
                                                      "Extrusion",
                                                      "ElevationGrid",
                                                      "LineProperties",
                                                      "FillProperties",
                                                      "WorldInfo",
                                                      "NavigationInfo",
                                                      "Viewpoint",
                                                      "OrthoViewpoint",
                                                      "Background",
                                                      "TextureBackground",
                                                      "Fog",
                                                      "Sound",
                                                      "AudioClip",
                                                      "ROUTE",
                                                      "Script",
                                                      "field",
                                                      "fieldValue"};
constexpr std::array<std::string_view, 4> kReadEndings{"Interpolator", "Sensor", "Light", "Shader"};

bool is_read(std::string_view name) {
  return std::ranges::find(kReadNodes, name) != kReadNodes.end() || name.starts_with("Metadata") ||
         std::ranges::any_of(kReadEndings, [name](std::string_view end) { return name.ends_with(end); });
}

/// The attributes that hold points, places or the corners of faces.
constexpr std::array<std::string_view, 16> kGeometry{
    "point", "translation", "rotation", "scale",    "scaleOrientation", "center", "size",   "coordIndex",
    "index", "height",      "xSpacing", "zSpacing", "crossSection",     "spine",  "radius", "orientation"};

/// assimp takes 0,5 and 1x as far as they are numbers. A comma may part numbers in X3D, and stands behind one here.
void check_x3d_numbers(const XmlTag& tag, const AssimpInput& input) {
  for (const std::string_view name : kGeometry) {
    std::string_view text = tag.attribute(name).value_or("");
    for (std::string_view word; !(word = take_word(text)).empty();) {
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
    if (!is_read(tag->name)) {
      refuse_scene(*input, "the file holds parts that are not read", shown_name(tag->name),
                   "export it as .stl, .ply or .obj");
    }
    const std::string_view factor = tag->attribute("conversionFactor").value_or("1");
    if (tag->name == "unit" && parse_decimal(factor).value_or(0.0) != 1.0) {
      refuse_scene(*input, "the file states a unit, which is not read", shown_tag(*tag),
                   "export it as .stl, .ply or .obj");
    }
    check_x3d_numbers(*tag, *input);
    if (tag->name == "Transform" || tag->name == "Extrusion") {
      for (const char* const name : {"rotation", "scaleOrientation", "orientation"}) {
        check_axes(*input, tag->attribute(name).value_or(""), std::string(name) + " of " + shown_name(tag->name));
      }
    }
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
  // Its words may be in small letters, and blanks may stand in them.
  std::string text;
  text.reserve(input->bytes.view().size());
  for (const char c : input->bytes.view()) {
    if (kXmlBlanks.find(c) != std::string_view::npos) continue;
    text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  for (const std::string_view word : kCurved) {
    if (text.find(word) != std::string::npos) refuse_curved(*input, std::string(word) + "...");
  }
}

}  // namespace vex
