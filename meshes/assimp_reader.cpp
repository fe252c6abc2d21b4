#include "meshes/assimp_reader.h"

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/mesh.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <clocale>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/assimp_files.h"
#include "meshes/formats/content_kind.h"
#include "meshes/formats/coordinate_text.h"
#include "meshes/length_unit.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

/// assimp reads some numbers by strtof, which heeds the locale: this thread's is C as long as this lives.
class CLocale {
 public:
  CLocale() : locale_(::newlocale(LC_ALL_MASK, "C", nullptr)) {
    if (locale_ == nullptr) throw std::bad_alloc();
    before_ = ::uselocale(locale_);
  }
  CLocale(const CLocale&) = delete;
  CLocale& operator=(const CLocale&) = delete;
  ~CLocale() {
    ::uselocale(before_);
    ::freelocale(locale_);
  }

 private:
  ::locale_t locale_ = nullptr, before_ = nullptr;
};

/// The first three rows of a 4x4 matrix in double; the fourth is 0, 0, 0, 1.
using Affine = std::array<double, 12>;
constexpr Affine kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// With bounds on what the rounding of its numbers to floats has changed: nothing where they are 0, 1 or -1.
struct Placement {
  Affine matrix = kIdentity;
  Affine rounding{};
};

double last_place_of(double number) {
  const bool is_exact = number == 0.0 || std::fabs(number) == 1.0;
  return is_exact ? 0.0 : float_digits(std::fabs(number)).last_place;
}

/// A fourth row that is not 0, 0, 0, 1 would divide the coordinates.
void check_last_row(const aiMatrix4x4& m) {
  constexpr float kTolerance = 0x1p-21F;  // of importers that multiply floats
  const auto is_near = [](float number, float wanted) { return std::fabs(number - wanted) <= kTolerance; };
  if (is_near(m.d1, 0.0F) && is_near(m.d2, 0.0F) && is_near(m.d3, 0.0F) && is_near(m.d4, 1.0F)) return;
  throw InputError(
      "a node's matrix has the last row " + number_text(double{m.d1}) + ", " + number_text(double{m.d2}) + ", " +
      number_text(double{m.d3}) + ", " + number_text(double{m.d4}) +
      ", which is not read (only 0, 0, 0, 1 is) - mend the file, or export the mesh as .obj, .ply or .stl");
}

Placement from_assimp(const aiMatrix4x4& m) {
  check_last_row(m);
  Placement result{{double{m.a1}, double{m.a2}, double{m.a3}, double{m.a4}, double{m.b1}, double{m.b2}, double{m.b3},
                    double{m.b4}, double{m.c1}, double{m.c2}, double{m.c3}, double{m.c4}},
                   {}};
  std::ranges::transform(result.matrix, result.rounding.begin(), last_place_of);
  return result;
}

/// left * right, where the last row of `right` is 0, 0, 0, w.
Affine product(const Affine& left, const Affine& right, double w = 1.0) {
  Affine result{};
  for (std::size_t row = 0; row < 12; row += 4) {
    for (std::size_t column = 0; column < 4; ++column) {
      result[row + column] =
          (left[row] * right[column] + left[row + 1] * right[4 + column]) + left[row + 2] * right[8 + column];
    }
    result[row + 3] += left[row + 3] * w;
  }
  return result;
}

Affine magnitudes(Affine matrix) {
  for (double& number : matrix) number = std::fabs(number);
  return matrix;
}

/// Of the roundings, the terms of first order.
Placement operator*(const Placement& left, const Placement& right) {
  Placement result{product(left.matrix, right.matrix), product(left.rounding, magnitudes(right.matrix))};
  const Affine of_right = product(magnitudes(left.matrix), right.rounding, 0.0);
  std::ranges::transform(result.rounding, of_right, result.rounding.begin(), std::plus<>());
  return result;
}

Vec3d placed(const Affine& world_from_mesh, const aiVector3D& p) {
  const auto row = [&](std::size_t i) {
    return ((world_from_mesh[i] * double{p.x} + world_from_mesh[i + 1] * double{p.y}) +
            world_from_mesh[i + 2] * double{p.z}) +
           world_from_mesh[i + 3];
  };
  return {row(0), row(4), row(8)};
}

/// Of all meshes so far, how far the floats that were read may have moved placed points along an axis.
struct MovedBy {
  double within_meshes = 0.0;  // against other points of the same mesh
  double whole_meshes = 0.0;   // a mesh as a whole, which changes the shape of several meshes alone
};

/// The last place of the mesh's largest coordinate and of the transform's numbers, carried through the transform.
double placed_last_place(const Placement& world_from_mesh, double largest) {
  const double last_place = float_digits(largest).last_place;
  double most = 0.0;
  for (std::size_t row = 0; row < 12; row += 4) {
    double sum = 0.0;
    for (std::size_t k = row; k < row + 3; ++k) {
      sum += std::fabs(world_from_mesh.matrix[k]) * last_place + world_from_mesh.rounding[k] * largest;
    }
    most = std::max(most, sum);
  }
  return most;
}

constexpr std::size_t kMostOfSoup = std::size_t{1} << 30U;

void append_points(const aiMesh& mesh, const Placement& world_from_mesh, PolygonSoup* soup, MovedBy* moved) {
  const std::size_t first = soup->points.size();
  const std::size_t n_points = mesh.mVertices != nullptr ? mesh.mNumVertices : 0;
  if (first + n_points > kMostOfSoup) {
    throw InputError("the mesh is too large (more than 2^30 vertices) - simplify it");
  }
  const bool in_place = world_from_mesh.matrix == kIdentity;  // then not even a -0 changes
  double largest = 0.0, largest_placed = 0.0;
  if (first == 0) soup->points.reserve(n_points);
  for (std::size_t i = 0; i < n_points; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    soup->points.push_back(in_place ? Vec3d{double{p.x}, double{p.y}, double{p.z}} : placed(world_from_mesh.matrix, p));
    largest = std::max({largest, std::fabs(double{p.x}), std::fabs(double{p.y}), std::fabs(double{p.z})});
    const Vec3d& q = soup->points.back();
    largest_placed = std::max({largest_placed, std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
  }
  moved->within_meshes = std::max(
      {moved->within_meshes, placed_last_place(world_from_mesh, largest), double_digits(largest_placed).last_place});
  for (const std::size_t k : {std::size_t{3}, std::size_t{7}, std::size_t{11}}) {
    moved->whole_meshes = std::max(moved->whole_meshes, world_from_mesh.rounding[k]);
  }
}

void append_mesh(const aiMesh& mesh, const Placement& world_from_mesh, PolygonSoup* soup, MovedBy* moved) {
  const std::size_t first = soup->points.size();
  append_points(mesh, world_from_mesh, soup, moved);
  const std::size_t n_points = soup->points.size() - first;
  if (soup->face_sizes.empty()) {
    soup->face_sizes.reserve(mesh.mNumFaces);
    soup->corners.reserve(std::size_t{3} * mesh.mNumFaces);
  }
  for (unsigned int i = 0; i < mesh.mNumFaces && mesh.mFaces != nullptr; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3 || face.mIndices == nullptr) {
      ++soup->n_ignored_faces;
      continue;
    }
    if (soup->corners.size() + face.mNumIndices > kMostOfSoup) {
      throw InputError("the mesh is too large (more than 2^30 corners of faces) - simplify it");
    }
    for (unsigned int k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= n_points) {
        throw InputError("a face names a vertex that is not there (face " + std::to_string(i) + " names vertex " +
                         std::to_string(face.mIndices[k]) + " of " + std::to_string(n_points) +
                         ") - the file is damaged: write it again");
      }
      soup->corners.push_back(static_cast<std::uint32_t>(first + face.mIndices[k]));
    }
    soup->face_sizes.push_back(face.mNumIndices);
  }
  ++soup->n_parts;
}

/// Depth first, in the order of the file, with a stack of our own: a file may nest its nodes as deep as it likes.
PolygonSoup soup_of(const aiScene& scene) {
  PolygonSoup soup;
  soup.digits.kind = CoordinateDigits::Kind::floats;
  MovedBy moved;
  std::vector<std::pair<const aiNode*, Placement>> stack;
  if (scene.mRootNode != nullptr) {
    stack.emplace_back(scene.mRootNode, from_assimp(scene.mRootNode->mTransformation));
  }
  while (!stack.empty()) {
    const auto [node, world_from_node] = stack.back();
    stack.pop_back();
    for (unsigned int i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] < scene.mNumMeshes) {
        append_mesh(*scene.mMeshes[node->mMeshes[i]], world_from_node, &soup, &moved);
      }
    }
    for (unsigned int i = node->mNumChildren; i-- > 0;) {
      stack.emplace_back(node->mChildren[i], world_from_node * from_assimp(node->mChildren[i]->mTransformation));
    }
  }
  soup.digits.last_place = moved.within_meshes + (soup.n_parts > 1 ? moved.whole_meshes : 0.0);
  return soup;
}

/// What assimp says of a file, which may quote any part of it: one printable line that is not too long.
std::string short_line(std::string text) {
  constexpr std::size_t kMostShown = 200;
  if (text.size() > kMostShown) {
    text = text.substr(0, kMostShown) + " ...";
  }
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  for (std::size_t at = text.find(" - "); at != std::string::npos; at = text.find(" - ")) {
    text.replace(at, 3, "; ");  // which parts our advice from the problem
  }
  return text;
}

void set_properties(Assimp::Importer* importer) {
  for (const char* unwanted :
       {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_ALL_MATERIALS,
        AI_CONFIG_IMPORT_FBX_READ_TEXTURES, AI_CONFIG_IMPORT_FBX_READ_CAMERAS, AI_CONFIG_IMPORT_FBX_READ_LIGHTS,
        AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, AI_CONFIG_IMPORT_FBX_READ_WEIGHTS, AI_CONFIG_IMPORT_MD3_LOAD_SHADERS,
        AI_CONFIG_IMPORT_SMD_LOAD_ANIMATION_LIST, AI_CONFIG_IMPORT_MDL_HL1_READ_ANIMATIONS}) {
    importer->SetPropertyBool(unwanted, false);
  }
  importer->SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer->SetPropertyBool(AI_CONFIG_IMPORT_MD5_NO_ANIM_AUTOLOAD, true);
  importer->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // the file's coordinates, not turned
}

[[noreturn]] void refuse(const AssimpInput& input, const std::string& reason) {
  const std::optional<ContentKind> kind = content_kind(input.bytes.view());
  if (kind && kind->extension != input.extension && kind->extension != ".zip" && kind->extension != ".gz") {
    refuse_kind(input.path.string(), *kind, input.extension);
  }
  throw InputError("cannot read the mesh file " + input.path.string() + " (assimp: " + short_line(reason) +
                   ") - check that it is complete and that its extension names its format, or convert it to .obj, "
                   ".off, .ply or .stl");
}

/// Where no reader of that extension takes the file, assimp tries all others.
void check_importer(const Assimp::Importer& importer, const AssimpInput& input) {
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* const used = index >= 0 ? importer.GetImporterInfo(static_cast<std::size_t>(index)) : nullptr;
  const std::string extensions = used != nullptr ? " " + std::string(used->mFileExtensions) + " " : "";
  if (extensions.find(" " + input.extension.substr(1) + " ") == std::string::npos) {
    refuse(input, "no reader of that extension takes it");
  }
}

/// The roots of these formats are assimp's own: what they scale by is the unit of the file, or its master scale.
void check_root(const aiScene& scene, const AssimpInput& input) {
  if (scene.mRootNode == nullptr || (input.extension != ".3ds" && input.extension != ".prj" &&
                                     input.extension != ".ifc" && input.extension != ".ifczip")) {
    return;
  }
  const Affine root = from_assimp(scene.mRootNode->mTransformation).matrix;
  const double scale = std::sqrt((root[0] * root[0] + root[4] * root[4]) + root[8] * root[8]);
  if (!(std::fabs(scale - 1.0) < 1e-5)) {
    refuse(input, "it scales the file's coordinates, by " + number_text(scale));
  }
}

/// .fbx: centimetres times a factor.
void take_fbx_unit(const aiScene& scene, PolygonSoup* soup) {
  float factor = 0.0F;
  if (scene.mMetaData == nullptr || !scene.mMetaData->Get("UnitScaleFactor", factor)) return;
  if (const std::optional<LengthUnit> unit = stated_length_unit("", double{factor} / 100.0)) {
    soup->unit = unit->name;
    soup->unit_metres = unit->metres;
  }
}

}  // namespace

PolygonSoup read_by_assimp(const AssimpInput& input, ImporterFate fate) {
  const CLocale c_locale;
  auto importer = std::make_unique<Assimp::Importer>();
  Assimp::Importer& reader = *importer;
  auto* const files = new AssimpFiles(input);  // the importer deletes it
  reader.SetIOHandler(files);
  set_properties(&reader);
  if (fate == ImporterFate::left_alone) {
    static_cast<void>(importer.release());
  }
  const aiScene* scene = nullptr;
  try {
    // No post-processing: neither triangles made of polygons nor vertices joined within a tolerance are what was read.
    scene = reader.ReadFile(files->shown_name(), 0);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(input, error.what());
  }
  if (scene == nullptr) refuse(input, reader.GetErrorString());
  check_importer(reader, input);
  check_root(*scene, input);
  PolygonSoup soup = soup_of(*scene);
  soup.unit = input.unit;
  soup.unit_metres = input.unit_metres;
  if (input.extension == ".fbx") take_fbx_unit(*scene, &soup);
  return soup;
}

PolygonSoup read_by_assimp(const std::filesystem::path& path) {
  return read_by_assimp(prepare_for_assimp(path, lower_extension(path)));
}

}  // namespace vex
