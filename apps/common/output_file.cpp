#include "apps/common/output_file.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "engine/numeric/errors.h"
#include "meshes/reader.h"

namespace vex {
namespace fs = std::filesystem;
namespace {

// The file that a path stands for, through links that may point to each other or to nothing; none for a circle of
// links.
std::optional<fs::path> target_of(fs::path path) {
  constexpr int kMostLinks = 40;  // as many as the system follows
  std::error_code error;
  for (int k = 0; k < kMostLinks; ++k) {
    if (!fs::is_symlink(path, error)) return path;
    const fs::path next = fs::read_symlink(path, error);
    if (error) return std::nullopt;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return std::nullopt;
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
  const std::optional<fs::path> target = target_of(path_);
  if (!target) refuse("the output file is a link that leads in a circle", "choose another name");
  target_ = *target;
  // What a user most likely meant as an input: overwriting it would cost the mesh.
  if (names_a_mesh_format(path_) || names_a_mesh_format(target_)) {
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
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
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
  fs::path written = target_;
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
  fs::rename(written, target_, error);
  if (error) {
    fs::remove(written, error);
    fail("the output file cannot be put in place");
  }
}

}  // namespace vex
