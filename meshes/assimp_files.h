// The only files that assimp gets to see.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <string>

#include "meshes/assimp_input.h"

namespace vex {

/// Shows assimp one file under a name of our own, and for .gltf the .bin buffers beside it, all of them from memory:
/// nothing is opened, whatever a file names and wherever it points. `input` must outlive this.
class AssimpFiles : public Assimp::IOSystem {
 public:
  explicit AssimpFiles(const AssimpInput& input) : input_(&input), shown_name_("mesh" + input.extension) {}

  const std::string& shown_name() const { return shown_name_; }

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  const FileBytes* held(const std::string& path) const;

  const AssimpInput* input_;
  std::string shown_name_;
};

}  // namespace vex
