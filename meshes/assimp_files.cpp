#include "meshes/assimp_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <cstdint>
#include <cstring>

namespace vex {

const FileBytes* AssimpFiles::held(const std::string& path) const {
  if (path == shown_name_) return &input_->bytes;
  const auto buffer = input_->buffers.by_uri.find(path);
  return buffer != input_->buffers.by_uri.end() ? &input_->buffers.files[buffer->second] : nullptr;
}

bool AssimpFiles::Exists(const char* path) const { return held(path) != nullptr; }

Assimp::IOStream* AssimpFiles::Open(const char* path, const char* mode) {
  const FileBytes* const bytes = held(path);
  if (bytes == nullptr || std::strpbrk(mode, "wa+") != nullptr) return nullptr;
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes->view().data());
  return new Assimp::MemoryIOStream(data, bytes->size(), false);
}

}  // namespace vex
