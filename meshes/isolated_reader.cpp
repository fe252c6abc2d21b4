#include "meshes/isolated_reader.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <locale>
#include <new>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/assimp_reader.h"
#include "meshes/machine_memory.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30U;

/// A file that reads at all is read within a second for 10 MiB; a crafted one gets no longer than it has to. The clock
/// on the wall is for what takes no processor time, and has room for a machine that does much else.
ProcessLimits limits_for(std::uint64_t n_geometry_bytes) {
  const std::uint64_t size = std::min<std::uint64_t>(n_geometry_bytes, std::uint64_t{1} << 50U);
  ProcessLimits limits;
  limits.processor_seconds = 8 + size / kMiB;
  limits.wall_seconds = 10 + 4 * (size / kMiB);
  limits.bytes = std::min(kGiB + 100 * size, machine_memory() / 4 * 3);
  return limits;
}

enum class Outcome : std::uint64_t { soup, input_error, out_of_memory };

/// Opens every message; `magic` tells it from what a broken process may write.
struct Header {
  static constexpr std::uint64_t kMagic = 0x7665782D736F7570;
  std::uint64_t magic = kMagic;
  Outcome outcome = Outcome::soup;
  std::uint64_t n_points = 0, n_corners = 0, n_faces = 0, n_parts = 0, n_ignored_faces = 0;
  CoordinateDigits digits;
  double unit_metres = 0.0;
  std::uint64_t text_length = 0;  // of the error's message, or of the unit's name
};

// --- the reading process

void write_all(const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(kConfinedDescriptor, next, std::min<std::size_t>(size, kGiB));
    if (written < 0 && errno != EINTR) {
      ::_exit(2);
    }
    if (written > 0) {
      next += written;
      size -= static_cast<std::size_t>(written);
    }
  }
}

template <class T>
void write_array(const std::vector<T>& array) {
  write_all(array.data(), array.size() * sizeof(T));
}

[[noreturn]] void read_and_send(const AssimpInput& input) {
  Header header;
  std::string text;
  PolygonSoup soup;
  try {
    std::locale::global(std::locale::classic());
    soup = read_by_assimp(input, ImporterFate::left_alone);
    text = soup.unit;
  } catch (const std::bad_alloc&) {
    header.outcome = Outcome::out_of_memory;
  } catch (const std::exception& error) {
    header.outcome = Outcome::input_error;
    text = error.what();
  }
  header.n_points = soup.points.size();
  header.n_corners = soup.corners.size();
  header.n_faces = soup.face_sizes.size();
  header.n_parts = soup.n_parts;
  header.n_ignored_faces = soup.n_ignored_faces;
  header.digits = soup.digits;
  header.unit_metres = soup.unit_metres;
  text.resize(std::min<std::size_t>(text.size(), 2000));
  header.text_length = text.size();
  write_all(&header, sizeof header);
  write_all(text.data(), text.size());
  if (header.outcome == Outcome::soup) {
    write_array(soup.points);
    write_array(soup.corners);
    write_array(soup.face_sizes);
  }
  ::_exit(0);
}

// --- this process

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason, const std::string& advice) {
  throw InputError("the reader of " + path.string() + " failed (" + reason + ") - " + advice);
}

[[noreturn]] void refuse_for_end(const std::filesystem::path& path, const ProcessEnd& end,
                                 const ProcessLimits& limits) {
  const char* const unreadable =
      "the file may be damaged, or hold something that assimp cannot read: convert it to .obj, .off, .ply or .stl";
  const std::string processor_time =
      "assimp took more than " + std::to_string(limits.processor_seconds) + " s of processor time";
  if (end.was_too_slow) {
    refuse(
        path,
        "it took more than " + std::to_string(limits.wall_seconds) + " s, " +
            number_text(std::floor(10.0 * end.processor_seconds) / 10.0) + " s of them on a processor",
        "the file may be damaged, the machine busy, or the reader stopped: start again, or convert the file to .obj, "
        ".off, .ply or .stl");
  }
  if (end.was_killed_here) refuse(path, "it sent what no reader sends, and did not end", unreadable);
  if (end.status >= 0 && WIFSIGNALED(end.status)) {
    const int signal = WTERMSIG(end.status);
    if (signal == SIGXCPU) refuse(path, processor_time, unreadable);
    if (signal == SIGKILL) {
      // Beyond the hard limit on its time the kernel kills, too.
      if (end.processor_seconds >= static_cast<double>(limits.processor_seconds)) {
        refuse(path, processor_time, unreadable);
      }
      refuse(path, "it was killed from outside, by signal 9, and nothing says that the file is to blame",
             "this is what a container or a batch job does when its memory runs out: give it more, or convert the file "
             "to .ply or .stl");
    }
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGQUIT) {
      refuse(path, "interrupted by signal " + std::to_string(signal), "start again");
    }
    refuse(path, "assimp crashed with signal " + std::to_string(signal), unreadable);
  }
  refuse(path, "it ended early, with exit status " + std::to_string(end.status >= 0 ? WEXITSTATUS(end.status) : -1),
         unreadable);
}

/// Before the process looks at a byte of the file.
void check_barriers(const std::filesystem::path& path, const ProcessLimits& limits, Confining confining,
                    ConfinedProcess* child) {
  if (!child->has_barriers()) refuse_for_end(path, child->end(), limits);
  const Barriers& barriers = child->barriers();
  const char* const convert = "convert the file to .obj, .off, .ply or .stl, which need no such reader";
  if (barriers.limits != 0) refuse(path, barriers.problem(), convert);
  if (confining == Confining::required && !barriers.is_confined()) {
    refuse(path, "it cannot be confined, as was required; " + barriers.problem(), convert);
  }
}

PolygonSoup receive(const std::filesystem::path& path, const ProcessLimits& limits, ConfinedProcess* child) {
  Header header;
  if (child->read(&header, sizeof header) != sizeof header || header.magic != Header::kMagic) {
    refuse_for_end(path, child->end(), limits);
  }
  const std::string out_of_memory =
      "assimp asked for more than " + std::to_string(limits.bytes / kMiB) + " MiB of memory";
  if (header.outcome == Outcome::out_of_memory) {
    refuse(path, out_of_memory, "the file may be damaged, or too large for this machine: convert it to .ply or .stl");
  }
  std::vector<char> text;
  if (header.text_length > 4000 || !child->read_array(header.text_length, &text)) {
    refuse_for_end(path, child->end(), limits);
  }
  if (header.outcome == Outcome::input_error) {
    throw InputError(std::string(text.begin(), text.end()));
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 31U;
  if (header.n_points > kMost || header.n_corners > kMost || header.n_faces > kMost ||
      header.n_points * sizeof(Vec3d) + (header.n_corners + header.n_faces) * sizeof(std::uint32_t) > limits.bytes) {
    refuse(path, "it announced an impossible amount", "the file may be damaged: convert it to .ply or .stl");
  }
  PolygonSoup soup;
  soup.unconfined = child->barriers().problem();
  soup.n_parts = header.n_parts;
  soup.n_ignored_faces = header.n_ignored_faces;
  soup.digits = header.digits;
  soup.unit.assign(text.begin(), text.end());
  soup.unit_metres = header.unit_metres;
  if (!child->read_array(header.n_points, &soup.points) || !child->read_array(header.n_corners, &soup.corners) ||
      !child->read_array(header.n_faces, &soup.face_sizes)) {
    refuse_for_end(path, child->end(), limits);
  }
  return soup;
}

}  // namespace

PolygonSoup read_by_assimp_isolated(const AssimpInput& input, Confining confining) {
  const ProcessLimits limits = limits_for(input.n_geometry_bytes);
  ConfinedProcess child(limits, confining, [&input] { read_and_send(input); });
  check_barriers(input.path, limits, confining, &child);
  return receive(input.path, limits, &child);
}

}  // namespace vex
