#include "meshes/reader.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/assimp_input.h"
#include "meshes/assimp_reader.h"
#include "meshes/formats/content_kind.h"
#include "meshes/formats/gltf_json.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/gunzip.h"
#include "meshes/isolated_reader.h"

namespace vex {
namespace {

constexpr const char* kFormats =
    ".obj .stl .ply .off .vtk .msh .xyz .csv .txt (each also as .gz), .gltf .glb .dae .3mf and whatever else assimp "
    "reads";

/// What an extension says of a file.
struct NamedFormat {
  std::string extension;  // in lower case, with its point, without .gz
  bool is_packed = false;
};

NamedFormat format_of(const std::filesystem::path& name) {
  NamedFormat format{lower_extension(name)};
  if (format.extension == ".gz") {
    format = {lower_extension(name.stem()), true};
  }
  return format;
}

/// By the option, where there is one, and otherwise by the path.
NamedFormat format_of(const std::filesystem::path& path, const std::string& option) {
  if (option.empty()) return format_of(path);
  NamedFormat format = format_of("mesh" + std::string(option.starts_with('.') ? "" : ".") + option);
  if (strict_format(format.extension) == nullptr && (format.is_packed || !is_read_by_assimp(format.extension))) {
    throw UsageError("no such format is read (--format " + option + ") - the formats are " + kFormats);
  }
  return format;
}

bool holds_points_only(std::string_view extension) {
  return extension == ".xyz" || extension == ".csv" || extension == ".txt";
}

PolygonSoup read_strictly(const StrictFormat& format, std::string_view bytes, const std::string& name) {
  const std::string extension(format.extension);
  const std::optional<ContentKind> kind = content_kind(bytes);
  const bool is_another = kind && kind->extension != extension;
  // The points' reader would take the counts of a mesh for points.
  if (is_another && holds_points_only(extension)) refuse_kind(name, *kind, extension);
  try {
    PolygonSoup soup = format.read(bytes, name);
    if (is_another && soup.points.empty()) refuse_kind(name, *kind, extension);
    return soup;
  } catch (const InputError&) {
    if (is_another) refuse_kind(name, *kind, extension);
    throw;
  }
}

[[noreturn]] void refuse_format(const std::string& name, const NamedFormat& format) {
  if (format.is_packed && is_read_by_assimp(format.extension)) {
    throw InputError("the file " + name + " cannot be read packed (it names " + format.extension +
                     " behind .gz) - unpack it");
  }
  if (const std::optional<ContentKind> kind = unread_format(format.extension)) {
    throw InputError("the format of " + name + " is not read (" + format.extension + " is " + std::string(kind->what) +
                     ") - " + std::string(kind->advice));
  }
  throw InputError("the extension of " + name + " names no format that is read ('" + format.extension +
                   (format.is_packed ? ".gz" : "") + "') - the formats are " + kFormats + "; --format names one");
}

PolygonSoup read_standard_input_as(const std::string& option) {
  if (option.empty()) {
    throw UsageError("the format of standard input is not known (- as a mesh file) - name it with --format EXT");
  }
  const NamedFormat format = format_of("-", option);
  const StrictFormat* const strict = strict_format(format.extension);
  if (strict == nullptr) {
    throw UsageError("this format is not read from standard input (--format " + option + ") - name a file");
  }
  const std::string name = "standard input";
  FileBytes bytes = read_standard_input();
  if (format.is_packed) bytes = gunzip(bytes.view(), name);
  return read_strictly(*strict, bytes.view(), name);
}

PolygonSoup read_file(const std::filesystem::path& path, const ReadOptions& options) {
  const NamedFormat format = format_of(path, options.format);
  if (const StrictFormat* const strict = strict_format(format.extension)) {
    FileBytes bytes = read_file_bytes(path);
    if (format.is_packed) bytes = gunzip(bytes.view(), path.string());
    return read_strictly(*strict, bytes.view(), path.string());
  }
  checked_file_size(path);  // what is no file has no format
  if (format.is_packed || !is_read_by_assimp(format.extension)) refuse_format(path.string(), format);

  const AssimpInput input = prepare_for_assimp(path, format.extension);
  return options.isolated ? read_by_assimp_isolated(input, options.confining) : read_by_assimp(input);
}

}  // namespace

bool names_a_mesh_format(const std::filesystem::path& path) {
  const NamedFormat format = format_of(path);
  if (strict_format(format.extension) != nullptr) return !holds_points_only(format.extension);
  return !format.is_packed && is_read_by_assimp(format.extension);
}

PolygonSoup read_polygon_soup(const std::filesystem::path& path, const ReadOptions& options) {
  try {
    return path == "-" ? read_standard_input_as(options.format) : read_file(path, options);
  } catch (const std::bad_alloc&) {
    throw InputError("the mesh " + path.string() + " does not fit into the memory - simplify it");
  }
}

std::vector<std::filesystem::path> files_read_with(const std::filesystem::path& path, const std::string& format) {
  if (path == "-") return {};
  std::vector<std::filesystem::path> files{path};
  try {
    if (format_of(path, format).extension == ".gltf") {
      const FileBytes bytes = read_file_bytes(path);
      const std::optional<GltfSummary> summary = gltf_summary(bytes.view());
      for (const std::string& uri : summary ? summary->buffer_uris : std::vector<std::string>{}) {
        if (const std::optional<BufferFile> buffer = gltf_buffer_beside(path, uri)) files.push_back(buffer->path);
      }
    }
  } catch (const Error&) {  // reading it will say why
  }
  return files;
}

}  // namespace vex
