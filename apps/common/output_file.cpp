#include "apps/common/output_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "engine/numeric/errors.h"

namespace vex {
namespace fs = std::filesystem;
namespace {

// What users are most likely to have meant as an input; overwriting it would cost them their mesh.
constexpr std::array<std::string_view, 14> kMeshExtensions = {".obj", ".stl", ".ply", ".off", ".gltf",  ".glb", ".dae",
                                                              ".3mf", ".fbx", ".3ds", ".x3d", ".blend", ".dxf", ".stp"};

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

}  // namespace

OutputFile::OutputFile(std::string path, std::span<const std::string> inputs) : path_(std::move(path)) {
  if (is_standard_output()) return;
  const auto refuse = [&](const char* problem, const char* advice) {
    throw UsageError(std::string(problem) + " (" + path_ + ") - " + advice);
  };
  if (path_.empty()) refuse("the output file has no name", "give a path, or - for standard output");
  if (path_.front() == '-')
    refuse("an option stands where the output file's name is missing", "give FILE; ./-x is a file named -x");
  if (std::ranges::find(kMeshExtensions, lower_case(fs::path(path_).extension().string())) != kMeshExtensions.end()) {
    refuse("an output file would end in the extension of a mesh", "choose another name, such as result.json");
  }
  std::error_code error;
  for (const std::string& input : inputs) {
    if (path_ == input || fs::equivalent(path_, input, error))
      refuse("the output file is an input", "choose another name");
  }
  if (fs::is_directory(path_, error)) refuse("the output file is a folder", "give the path of a file");
  if (fs::exists(path_, error) && !fs::is_regular_file(path_, error))
    return;  // /dev/null and pipes are written directly
  if (fs::exists(path_, error) && access(path_.c_str(), W_OK) != 0) {
    refuse("the output file is write-protected", "choose another name");
  }
  const fs::path folder = fs::path(path_).has_parent_path() ? fs::path(path_).parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) refuse("the output file's folder does not exist", "make it first");
  if (access(folder.c_str(), W_OK) != 0) refuse("the output file's folder cannot be written", "choose another one");
}

void OutputFile::write(std::string_view text) const {
  const auto fail = [&](const char* problem) {
    throw std::runtime_error(std::string(problem) + " (" + path_ + ") - look whether its disk is full");
  };
  if (is_standard_output()) {
    std::cout << text << std::flush;
    if (!std::cout)
      throw std::runtime_error(
          "standard output cannot be written - look whether its disk is full or its reader has gone");
    return;
  }
  std::error_code error;
  const bool special = fs::exists(path_, error) && !fs::is_regular_file(path_, error);
  // Through a link, so that the file it points to is replaced, not the link.
  const fs::path target = fs::is_symlink(path_, error) ? fs::weakly_canonical(path_, error) : fs::path(path_);
  fs::path written = target;
  if (!special) written += ".tmp" + std::to_string(getpid());
  {
    std::ofstream file(written, std::ios::binary);
    file << text << std::flush;
    if (!file) {
      if (!special) fs::remove(written, error);
      fail("the output file cannot be written");
    }
  }
  if (special) return;
  fs::rename(written, target, error);
  if (error) {
    fs::remove(written, error);
    fail("the output file cannot be put in place");
  }
}

}  // namespace vex
