#include "meshes/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

struct HeldBytes {
  FileBytes held;
};

/// A stream that keeps the bytes it is of.
class BytesStream : private HeldBytes, public Assimp::MemoryIOStream {
 public:
  explicit BytesStream(FileBytes bytes)
      : HeldBytes{std::move(bytes)},
        MemoryIOStream(reinterpret_cast<const std::uint8_t*>(held.data()), held.size(), false) {}
};

}  // namespace

bool AssimpFiles::Exists(const char* path) const {
  return path == shown_name_ || (input_->extension == ".gltf" && gltf_buffer_beside(input_->path, path));
}

Assimp::IOStream* AssimpFiles::Open(const char* path, const char* mode) {
  if (std::strpbrk(mode, "wa+") != nullptr) return nullptr;
  if (path == shown_name_) {
    const std::string_view bytes = input_->bytes.view();
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), false);
  }
  if (input_->extension != ".gltf") return nullptr;
  const std::optional<std::filesystem::path> buffer = gltf_buffer_beside(input_->path, path);
  if (!buffer) return nullptr;
  try {
    return new BytesStream(read_file_bytes(*buffer));
  } catch (const InputError&) {
    return nullptr;
  }
}

}  // namespace vex
