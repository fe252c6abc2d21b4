#include "meshes/formats/content_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "engine/numeric/errors.h"
#include "meshes/formats/gltf_json.h"

namespace vex {
namespace {

constexpr std::string_view kTessellate = "open it in a CAD program and export its surface as .stl or .obj";
constexpr std::string_view kFetchAgain = "fetch the mesh itself";
constexpr std::string_view kUnpack = "unpack it";
constexpr std::string_view kConvert = "convert it to .obj, .off, .ply or .stl";
constexpr std::string_view kRename = "give it that extension, or name it with --format";

constexpr ContentKind kStep{"STEP, which holds CAD bodies and no mesh", "", kTessellate};
constexpr ContentKind kIges{"IGES, which holds CAD bodies and no mesh", "", kTessellate};
constexpr ContentKind kMedit{"a Medit mesh", "", "convert it to .obj, .off, .ply, .stl or .msh"};
constexpr ContentKind kOldGltf{"glTF 1", "", "convert it to glTF 2, .obj, .ply or .stl"};
constexpr ContentKind kUsd{"USD", "", "export it as .obj, .stl, .ply or .glb"};

struct Beginning {
  std::string_view bytes;
  ContentKind kind;
};

constexpr std::array<Beginning, 26> kBeginnings{{
    {"ply\n", {"a PLY mesh", ".ply", kRename}},
    {"ply\r", {"a PLY mesh", ".ply", kRename}},
    {"# vtk DataFile", {"a legacy VTK file", ".vtk", kRename}},
    {"$MeshFormat", {"a Gmsh mesh", ".msh", kRename}},
    {"MeshVersionFormatted", kMedit},
    {"ISO-10303-21", kStep},
    {"Kaydara FBX Binary", {"an FBX file", ".fbx", kRename}},
    {"BLENDER", {"a Blender file", ".blend", kRename}},
    {"PXR-USDC", kUsd},
    {"#usda", kUsd},
    {"#VRML", {"VRML", "", kConvert}},
    {"#Inventor", {"an Open Inventor scene", "", kConvert}},
    {"\x1F\x8B", {"packed by gzip", ".gz", "add .gz to its name or to --format, or unpack it"}},
    {"BZh", {"packed by bzip2", "", kUnpack}},
    {"\xFD"
     "7zXZ",
     {"packed by xz", "", kUnpack}},
    {"\x28\xB5\x2F\xFD", {"packed by zstd", "", kUnpack}},
    {"7z\xBC\xAF", {"a 7-Zip archive", "", kUnpack}},
    {"Rar!", {"a RAR archive", "", kUnpack}},
    {"PK\x03\x04", {"a zip archive", ".zip", "unpack it (a .3mf file is one too: give it that extension)"}},
    {"version https://git-lfs",
     {"a pointer of Git LFS in the mesh's place", "", "fetch the mesh itself (git lfs pull)"}},
    {"%PDF", {"a PDF document", "", kFetchAgain}},
    {"\x89PNG", {"a picture (PNG)", "", kFetchAgain}},
    {"\xFF\xD8\xFF", {"a picture (JPEG)", "", kFetchAgain}},
    {"\x7F"
     "ELF",
     {"a program", "", kFetchAgain}},
    {"\xFF\xFE", {"text in UTF-16", "", "save it as UTF-8"}},
    {"\xFE\xFF", {"text in UTF-16", "", "save it as UTF-8"}},
}};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// The first word, of the first line that is not empty and no comment after '#'.
std::string_view first_word_of_content(std::string_view text) {
  while (!text.empty()) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size()));
    if (!text.starts_with('#')) break;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
  return text.substr(0, std::min(text.find_first_of(" \t\r\n\v\f"), text.size()));
}

bool is_iges(std::string_view text) {
  constexpr std::size_t kLine = 72;  // 72 columns, then the section's letter and a number in seven columns
  return text.size() > 80 && text.substr(kLine, 8) == "S      1";
}

std::optional<ContentKind> kind_of_xml(std::string_view text) {
  if (has(text, "<COLLADA")) return ContentKind{"a COLLADA scene", ".dae", kRename};
  if (has(text, "<VTKFile")) return ContentKind{"a VTK file in XML", "", "save it as legacy .vtk, .ply or .stl"};
  if (has(text, "<amf")) return ContentKind{"an AMF mesh", ".amf", kRename};
  if (has(text, "<X3D")) return ContentKind{"an X3D scene", ".x3d", kRename};
  if (has(text, "<html") || has(text, "<HTML") || has(text, "<!DOCTYPE html") || has(text, "<!doctype html") ||
      has(text, "<!DOCTYPE HTML")) {
    return ContentKind{"a web page", "", kFetchAgain};
  }
  if (has(text, "<svg")) return ContentKind{"a drawing (SVG)", "", kFetchAgain};
  return std::nullopt;
}

std::optional<ContentKind> kind_of_words(std::string_view text) {
  std::string word(first_word_of_content(text).substr(0, 16));
  if (word.ends_with("OFF") && word.size() <= 8) return ContentKind{"an OFF mesh", ".off", kRename};
  std::ranges::transform(word, word.begin(), lower);
  if (word == "solid") {
    std::string all(text);
    std::ranges::transform(all, all.begin(), lower);
    if (has(all, "facet")) return ContentKind{"STL as text", ".stl", kRename};
  }
  if (word == "v" || word == "mtllib" || word == "vn" || word == "usemtl") {
    return ContentKind{"a Wavefront OBJ mesh", ".obj", kRename};
  }
  return std::nullopt;
}

}  // namespace

std::optional<ContentKind> content_kind(std::string_view bytes) {
  constexpr std::size_t kEnough = 4096;
  std::string_view text = bytes.substr(0, kEnough);
  for (const Beginning& beginning : kBeginnings) {
    if (text.starts_with(beginning.bytes)) return beginning.kind;
  }
  if (const std::optional<unsigned> version = glb_version(bytes)) {
    return *version == 1 ? kOldGltf : ContentKind{"a binary glTF scene", ".glb", kRename};
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find_first_not_of('\0') == std::string_view::npos) {
    return ContentKind{"nothing but zero bytes, as far as its beginning shows", "", kFetchAgain};
  }
  if (is_iges(text)) return kIges;
  const std::string_view trimmed = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (trimmed.starts_with('<')) return kind_of_xml(trimmed);
  if (trimmed.starts_with('{') && has(trimmed, "\"")) {
    const std::optional<GltfSummary> summary = gltf_summary(bytes);
    if (!summary || (summary->version.empty() && summary->buffer_uris.empty())) return std::nullopt;
    return summary->version.starts_with('1') ? kOldGltf : ContentKind{"a glTF scene", ".gltf", kRename};
  }
  return kind_of_words(text);
}

std::optional<ContentKind> unread_format(std::string_view extension) {
  struct Unread {
    std::string_view extensions;  // each between blanks
    ContentKind kind;
  };
  static constexpr std::array<Unread, 9> kUnread{{
      {" .step .stp .p21 ", kStep},
      {" .iges .igs ", kIges},
      {" .brep .brp .sldprt .sldasm .ipt .iam .catpart .x_t .x_b .xmt_txt .sat .sab .jt .f3d .fcstd .3dm .dwg ",
       {"a CAD model, which is no mesh", "", kTessellate}},
      {" .usd .usda .usdc .usdz ", kUsd},
      {" .vtu .vtp .vti .vts .vtr .vtm ", {"a VTK file in XML", "", "save it as legacy .vtk, .ply or .stl"}},
      {" .wrl .vrml .iv ", {"VRML or Open Inventor", "", kConvert}},
      {" .zae ", {"a packed COLLADA scene", "", "unpack it and name the .dae file in it"}},
      {" .meshb ", kMedit},
      {" .zip .ifczip .7z .rar .bz2 .xz .zst .tar .tgz ", {"a packed file", "", kUnpack}},
  }};
  if (extension.empty()) return std::nullopt;
  const std::string wanted = " " + std::string(extension) + " ";
  for (const Unread& unread : kUnread) {
    if (has(unread.extensions, wanted)) return unread.kind;
  }
  return std::nullopt;
}

void refuse_kind(const std::string& name, const ContentKind& kind, const std::string& extension) {
  const std::string what(kind.what);
  const std::string problem = kind.extension.empty()
                                  ? " cannot be read (it is " + what + ")"
                                  : " is not what its name says (it is " + what + ", not " + extension + ")";
  throw InputError(name + problem + " - " + std::string(kind.advice));
}

}  // namespace vex
