#include "apps/common/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "apps/common/patient_write.h"
#include "apps/common/replace_file.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
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

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

std::string name_of_input(const std::string& path) { return path == "-" ? "standard input" : path; }

// Whether the path leads to something that must be written where it is: a device, a pipe, or a file that has no name
// any more and is known by an open descriptor only (/dev/fd/3).
bool has_no_name_to_replace(const std::string& path, const fs::path& target) {
  const std::optional<FileIdentity> found = identity_of(path, STDOUT_FILENO);
  if (!found || found->mode == 0) return false;
  return !found->is_regular() || !(identity_of(target.string(), STDOUT_FILENO) == found);
}

}  // namespace

bool FileIdentity::is_regular() const { return S_ISREG(mode); }
bool FileIdentity::is_character_device() const { return S_ISCHR(mode); }

std::optional<FileIdentity> identity_of(const std::string& path, int stream) {
  struct stat found = {};
  if (path == "-") {
    if (fstat(stream, &found) != 0) return std::nullopt;
    return FileIdentity{found.st_dev, found.st_ino, "", found.st_mode};
  }
  if (stat(path.c_str(), &found) == 0) return FileIdentity{found.st_dev, found.st_ino, "", found.st_mode};
  const std::optional<fs::path> target = target_of(path);
  if (!target || stat(folder_of(*target).c_str(), &found) != 0) return std::nullopt;
  return FileIdentity{found.st_dev, found.st_ino, target->filename().string(), 0};
}

std::optional<std::string> input_that_is(const FileIdentity& output, std::span<const std::string> inputs) {
  if (!output.is_regular()) return std::nullopt;
  const auto found = std::ranges::find_if(inputs, [&output](const std::string& input) {
    const std::optional<FileIdentity> identity = identity_of(input, STDIN_FILENO);
    return identity && *identity == output;
  });
  if (found == inputs.end()) return std::nullopt;
  return *found;
}

OutputFile::OutputFile(std::string path, std::span<const std::string> inputs, std::string_view mesh_extension)
    : path_(std::move(path)) {
  const auto refuse = [&](const std::string& problem, const char* advice, const std::string& remark = "") {
    throw UsageError(problem + " (" + path_ + remark + ") - " + advice);
  };
  if (path_.empty()) refuse("the output file has no name", "give a path, or - for standard output");
  identity_ = identity_of(path_, STDOUT_FILENO);
  if (is_standard_output()) return;
  if (path_.front() == '-')
    refuse("an option stands where the output file's name is missing", "give FILE; ./-x is a file named -x");
  const std::optional<fs::path> target = target_of(path_);
  if (!target) refuse("the output file is a link that leads in a circle", "choose another name");
  target_ = *target;
  // What a user most likely meant as an input: overwriting it would cost the mesh.
  const auto looks_like_an_input = [mesh_extension](const fs::path& name) {
    return names_a_mesh_format(name) && (mesh_extension.empty() || lower_case(name.extension()) != mesh_extension);
  };
  if (looks_like_an_input(path_) || looks_like_an_input(target_)) {
    refuse("an output file would end in the extension of a mesh", "choose another name, such as result.json");
  }
  if (std::ranges::find(inputs, path_) != inputs.end()) refuse("the output file is an input", "choose another name");
  if (identity_) {
    if (const std::optional<std::string> input = input_that_is(*identity_, inputs)) {
      refuse("the output file is an input", "choose another name", ", which is " + name_of_input(*input));
    }
    // Also where this program does not read it: whoever called it, with a loop over a list perhaps, does.
    const std::string standard_input = "-";
    if (input_that_is(*identity_, {&standard_input, 1})) {
      refuse("the output file is an input", "choose another name", ", which is standard input");
    }
  }
  std::error_code error;
  if (fs::is_directory(path_, error)) refuse("the output file is a folder", "give the path of a file");
  if (has_no_name_to_replace(path_, target_)) return;
  if (fs::exists(path_, error) && access(path_.c_str(), W_OK) != 0) {
    refuse("the output file is write-protected", "choose another name");
  }
  const fs::path folder = folder_of(target_);
  const fs::file_status status = fs::status(target_, error);
  if (status.type() == fs::file_type::none) {
    refuse(("the output file cannot be there: " + error.message()).c_str(), "choose another name");
  }
  if (!fs::is_directory(folder, error)) refuse("the output file's folder does not exist", "make it first");
  if (access(folder.c_str(), W_OK) != 0) refuse("the output file's folder cannot be written", "choose another one");
}

bool OutputFile::may_wait_for_a_reader() const {
  return is_standard_output() || has_no_name_to_replace(path_, target_);
}

bool OutputFile::write(std::string_view text) const {
  VEX_EXPECT(!is_standard_output());
  try {
    if (has_no_name_to_replace(path_, target_)) return write_in_place(path_, text);
    replace_file(target_, text);
    return true;
  } catch (const std::system_error& error) {
    throw std::runtime_error("the output file cannot be written (" + path_ + ": " + error.code().message() +
                             ") - look whether its disk is full and its folder still there");
  }
}

}  // namespace vex
