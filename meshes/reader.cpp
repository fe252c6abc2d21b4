#include "meshes/reader.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/reader_quirks.h"

namespace vex {
namespace {

constexpr const char* kFormats = ".obj .stl .ply .off .gltf .glb .dae .3mf and whatever else assimp reads";

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Opens a regular file for reading; null, with errno set, for anything else. O_NONBLOCK: opening a pipe must not wait.
File open_regular(const char* path, std::uintmax_t* size) {
  const int descriptor = ::open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) {
    return nullptr;
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    const int reason = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    ::close(descriptor);
    errno = reason;
    return nullptr;
  }
  *size = static_cast<std::uintmax_t>(status.st_size);
  return File(::fdopen(descriptor, "rb"));
}

class RegularFileStream : public Assimp::IOStream {
 public:
  RegularFileStream(File file, std::uintmax_t size) : file_(std::move(file)), size_(static_cast<std::size_t>(size)) {}

  /// assimp's PLY reader asks for ever for the rest of a file that ends within a line: an exception, which assimp
  /// catches, ends that.
  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    const std::size_t n_read = size == 0 ? 0 : std::fread(buffer, size, count, file_.get());
    n_empty_reads_ = n_read > 0 ? 0 : n_empty_reads_ + 1;
    if (n_empty_reads_ > kMostEmptyReads) {
      throw std::runtime_error("the file ends too early");
    }
    return n_read;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return std::fseek(file_.get(), static_cast<long>(offset), whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
  }
  std::size_t Tell() const override { return static_cast<std::size_t>(std::ftell(file_.get())); }
  std::size_t FileSize() const override { return size_; }
  void Flush() override {}

 private:
  static constexpr int kMostEmptyReads = 1000;

  File file_;
  std::size_t size_;
  int n_empty_reads_ = 0;
};

struct HeldText {
  std::string held;
};

/// A stream that keeps the text it is of.
class TextStream : private HeldText, public Assimp::MemoryIOStream {
 public:
  explicit TextStream(std::string text)
      : HeldText{std::move(text)},
        MemoryIOStream(reinterpret_cast<const std::uint8_t*>(held.data()), held.size(), false) {}
};

/// Shows assimp one file, and for .gltf the .bin buffers in its folder or below: a material library or a texture that a
/// mesh names is never opened, wherever it points.
class GeometryFiles : public Assimp::IOSystem {
 public:
  explicit GeometryFiles(std::filesystem::path mesh) : mesh_(std::move(mesh)) {}

  bool Exists(const char* path) const override {
    std::uintmax_t size = 0;
    return allowed(path) && open_regular(path, &size) != nullptr;
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (std::strpbrk(mode, "wa+") != nullptr || !allowed(path)) {
      return nullptr;
    }
    std::uintmax_t size = 0;
    File file = open_regular(path, &size);
    if (!file) {
      return nullptr;
    }
    if (std::optional<ShownText> shown = text_for_assimp(lower_extension(path), file.get(), size)) {
      face_was_added_ = face_was_added_ || shown->face_was_added;
      return new TextStream(std::move(shown->text));
    }
    return new RegularFileStream(std::move(file), size);
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  bool face_was_added() const { return face_was_added_; }

 private:
  bool allowed(const std::filesystem::path& path) const {
    if (path == mesh_) {
      return true;
    }
    const std::filesystem::path beside = path.lexically_relative(mesh_.parent_path());
    return lower_extension(mesh_) == ".gltf" && lower_extension(path) == ".bin" && !beside.empty() &&
           *beside.begin() != "..";
  }
  static std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    return extension;
  }

  std::filesystem::path mesh_;
  bool face_was_added_ = false;
};

/// The first three rows of a 4x4 matrix in double; the fourth is taken to be 0, 0, 0, 1.
using Affine = std::array<double, 12>;
constexpr Affine kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

Affine from_assimp(const aiMatrix4x4& m) {
  return {double{m.a1}, double{m.a2}, double{m.a3}, double{m.a4}, double{m.b1}, double{m.b2},
          double{m.b3}, double{m.b4}, double{m.c1}, double{m.c2}, double{m.c3}, double{m.c4}};
}

Affine operator*(const Affine& left, const Affine& right) {
  Affine product{};
  for (std::size_t row = 0; row < 12; row += 4) {
    for (std::size_t column = 0; column < 4; ++column) {
      product[row + column] =
          (left[row] * right[column] + left[row + 1] * right[4 + column]) + left[row + 2] * right[8 + column];
    }
    product[row + 3] += left[row + 3];
  }
  return product;
}

/// What assimp says of a file, which may quote any part of it: one printable line that is not too long.
std::string short_line(std::string text) {
  constexpr std::size_t kMost = 200;
  if (text.size() > kMost) {
    text = text.substr(0, kMost) + " ...";
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

SoupPoint placed(const Affine& world_from_mesh, const aiVector3D& p) {
  const auto row = [&](std::size_t i) {
    return static_cast<float>(((world_from_mesh[i] * double{p.x} + world_from_mesh[i + 1] * double{p.y}) +
                               world_from_mesh[i + 2] * double{p.z}) +
                              world_from_mesh[i + 3]);
  };
  return {row(0), row(4), row(8)};
}

void append_mesh(const aiMesh& mesh, const Affine& world_from_mesh, PolygonSoup* soup) {
  constexpr std::size_t kMost = std::size_t{1} << 30U;
  const std::size_t first = soup->points.size();
  if (first + mesh.mNumVertices > kMost) {
    throw InputError("the mesh is too large (more than 2^30 vertices) - simplify it");
  }
  const bool in_place = world_from_mesh == kIdentity;  // then not even a -0 changes
  soup->points.reserve(first + mesh.mNumVertices);
  for (unsigned int i = 0; i < mesh.mNumVertices && mesh.mVertices != nullptr; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    soup->points.push_back(in_place ? SoupPoint{p.x, p.y, p.z} : placed(world_from_mesh, p));
  }
  const std::size_t n_points = soup->points.size() - first;
  soup->face_sizes.reserve(soup->face_sizes.size() + mesh.mNumFaces);
  for (unsigned int i = 0; i < mesh.mNumFaces && mesh.mFaces != nullptr; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3 || face.mIndices == nullptr) {
      ++soup->n_ignored_faces;
      continue;
    }
    if (soup->corners.size() + face.mNumIndices > kMost) {
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
  std::vector<std::pair<const aiNode*, Affine>> stack;
  if (scene.mRootNode != nullptr) {
    stack.emplace_back(scene.mRootNode, from_assimp(scene.mRootNode->mTransformation));
  }
  while (!stack.empty()) {
    const auto [node, world_from_node] = stack.back();
    stack.pop_back();
    for (unsigned int i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] < scene.mNumMeshes) {
        append_mesh(*scene.mMeshes[node->mMeshes[i]], world_from_node, &soup);
      }
    }
    for (unsigned int i = node->mNumChildren; i-- > 0;) {
      stack.emplace_back(node->mChildren[i], world_from_node * from_assimp(node->mChildren[i]->mTransformation));
    }
  }
  return soup;
}

}  // namespace

std::uintmax_t checked_file_size(const std::filesystem::path& path) {
  std::uintmax_t size = 0;
  errno = 0;
  const File file = open_regular(path.c_str(), &size);
  if (!file) {
    const std::string reason = errno == EISDIR   ? "it is a folder"
                               : errno == EINVAL ? "it is a pipe, a device or a socket, not a file"
                                                 : std::strerror(errno);
    throw InputError("cannot read the mesh file " + path.string() + " (" + reason + ") - name a file that can be read");
  }
  if (size == 0) {
    throw InputError("the mesh file " + path.string() + " is empty (0 bytes) - name a file that holds a mesh");
  }
  return size;
}

bool names_a_mesh_format(const std::filesystem::path& path) {
  return path.has_extension() && Assimp::Importer().IsExtensionSupported(path.extension().string());
}

PolygonSoup read_polygon_soup(const std::filesystem::path& path) {
  checked_file_size(path);
  Assimp::Importer importer;
  if (!importer.IsExtensionSupported(path.extension().string())) {
    throw InputError("the extension of " + path.string() + " names no format that is read ('" +
                     path.extension().string() + "') - the formats are " + kFormats);
  }
  auto* const files = new GeometryFiles(path);  // the importer deletes it
  importer.SetIOHandler(files);
  for (const char* unwanted :
       {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_ALL_MATERIALS,
        AI_CONFIG_IMPORT_FBX_READ_TEXTURES, AI_CONFIG_IMPORT_FBX_READ_CAMERAS, AI_CONFIG_IMPORT_FBX_READ_LIGHTS,
        AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, AI_CONFIG_IMPORT_FBX_READ_WEIGHTS, AI_CONFIG_IMPORT_MD3_LOAD_SHADERS,
        AI_CONFIG_IMPORT_SMD_LOAD_ANIMATION_LIST, AI_CONFIG_IMPORT_MDL_HL1_READ_ANIMATIONS}) {
    importer.SetPropertyBool(unwanted, false);
  }
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_MD5_NO_ANIM_AUTOLOAD, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // the file's coordinates, not turned
  // No post-processing: neither triangles made of polygons nor vertices joined within a tolerance are what was read.
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr) {
    throw InputError("cannot read the mesh file " + path.string() + " (" + short_line(importer.GetErrorString()) +
                     ") - check that it is complete and that its extension names its format");
  }
  PolygonSoup soup = soup_of(*scene);
  if (files->face_was_added() && soup.n_ignored_faces > 0) {
    --soup.n_ignored_faces;
  }
  return soup;
}

}  // namespace vex
