// Files that a file names beside itself: looked for by where they are, and not by how they are written.
#pragma once

#include <filesystem>
#include <string>

#include "meshes/open_file.h"

namespace vex {

/// Opens `name` in `folder` or below it, for reading and without waiting for anything. Every step of the way is looked
/// at as it is taken: what leaves the folder, by "..", by an absolute name or by a symbolic link, is not opened, and
/// nobody can swap a folder for a link in between. A link that stays within is followed where the kernel watches the
/// way (openat2, Linux 5.6); elsewhere no link is, and no "..".
OpenFile open_beneath(const std::filesystem::path& folder, const std::string& name);

}  // namespace vex
