#include "program_fuzz.h"

#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

#include "apps/common/bodies.h"
#include "apps/common/common_options.h"
#include "apps/vex_merge/documents.h"
#include "apps/vex_pair/pose_file.h"
#include "apps/vex_percolate/options.h"
#include "apps/vex_percolate/realisations_file.h"
#include "apps/vex_scene/scene_file.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/pose.h"
#include "engine/sampling/poses/axis_law.h"
#include "engine/sampling/poses/axis_table_text.h"
#include "shapes/any_shape.h"

namespace vex::tests {
namespace {

/// A file in memory, which whoever wants a path opens anew from its beginning.
class MemoryFile {
 public:
  MemoryFile() : number_(memfd_create("fuzz", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(number_)) {
    if (number_ < 0) throw std::runtime_error("no file in memory");
  }
  ~MemoryFile() { close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& holding(std::string_view data) {
    if (ftruncate(number_, 0) != 0 || pwrite(number_, data.data(), data.size(), 0) != static_cast<ssize_t>(data.size()))
      throw std::runtime_error("a file in memory cannot be written");
    return path_;
  }

 private:
  int number_;
  std::string path_;
};

const std::string& file_of(std::string_view data) {
  static MemoryFile file;
  return file.holding(data);
}

void check_advice(const std::string& message) {
  demand(message.find(" - ") != std::string::npos, "the message ends in an advice");
  demand(message.size() < 100'000, "the message is bounded");
}

/// What is refused is refused as promised.
template <class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    check_advice(error.what());
  } catch (const UsageError& error) {
    check_advice(error.what());
  }
}

void check_pose(const Transformd& pose) {
  demand(is_rotation(pose) && is_finite(pose.translation), "a pose that was read is one");
  static_cast<void>(Pose(pose));
}

void read_poses(std::string_view data) {
  static const std::atomic<int> kNoInterrupt{0};
  PoseFile file(file_of(data), kNoInterrupt);
  file.read_header();
  RowBlock block;
  std::uint64_t n_rows = 0;
  do {
    file.read_rows(7, block);
    demand(block.first_index == n_rows && block.rows.size() <= 7, "rows are counted");
    for (const RowBlock::Row& row : block.rows) {
      demand(row.begin + row.size <= block.text.size() && row.line > n_rows + 1, "a row is of the block");
      read_or_refuse([&] {
        demand(!row.is_too_long || row.size == 0, "what is too long is not kept");
        check_pose(pose_of_row(block.text_of(row), file.format()));
      });
    }
    n_rows += block.rows.size();
    demand(n_rows <= data.size(), "no more rows than bytes");
  } while (!block.rows.empty());
}

void read_shape(std::string_view text) {
  const Body body = parse_shape(text);
  demand(body.measures.volume >= 0.0 && std::isfinite(body.measures.volume), "a volume");
  demand(body.measures.surface_area >= 0.0 && body.measures.integrated_mean_curvature > 0.0, "measures");
  for (const Vec3d& dir : {Vec3d{1, 0, 0}, Vec3d{-0.3, 0.7, -0.2}, Vec3d{0, 0, -1}, Vec3d{}}) {
    demand(is_finite(body.body.support(dir)), "support points are finite");
  }
}

void read_scene(std::string_view data) {
  const std::map<std::string, std::string, std::less<>> named = {{"unit", "box:1,1,1"}};
  const SceneInput scene = read_scene_file(file_of(data), named);
  demand(scene.n_bodies() == scene.poses.size() && scene.n_bodies() <= data.size(), "no more bodies than bytes");
  for (const std::uint32_t shape : scene.shapes_of_bodies) demand(shape < scene.shapes().size(), "shapes are there");
  for (const Transformd& pose : scene.poses) check_pose(pose);
  for (const std::string& text : scene.texts()) {
    read_or_refuse([&] {
      if (text.find('\0') == std::string::npos && !names_a_mesh(text)) read_shape(text);
    });
  }
  // Written and read again it is the same, bit for bit; but for names, which are written as what they name.
  const std::string text = scene_file_text(scene);
  const SceneInput again = read_scene_file(file_of(text), {});
  demand(again.n_bodies() == scene.n_bodies() && scene_file_text(again) == text, "a scene comes back");
}

PercolateRun small_system() {
  PercolateCommandLine words;
  words.bodies = {"box:1,1,1"};
  words.sizes = "2,3";
  words.realisations = "5";
  words.threads = "1";
  return prepare(interpret(words), "vex_percolate box:1,1,1");
}

void resume(std::string_view data) {
  static const PercolateRun kFresh = small_system();
  PercolateRun run = kFresh;
  resume_from(file_of(data), run);
  std::size_t n = 0;
  for (const SizeRun& size : run.sizes) {
    n += size.found.size();
    for (const WrappingNumbers& numbers : size.found) demand(numbers.any() >= 1, "a cluster needs a body");
  }
  demand(n <= data.size() && run.seconds_before >= 0.0, "no more realisations than bytes");
  // What was read is what is written.
  PercolateRun again = kFresh;
  const std::string text = realisations_text(run);
  resume_from(file_of(text), again);
  demand(realisations_text(again) == text, "realisations come back");
}

void read_realisations(std::string_view data) {
  read_or_refuse([&] { resume(data); });
  // Mutations hardly ever have the right sum: here each does.
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(data);
  if (!text.empty() && text.back() != '\n') text += '\n';
  const uLong sum =
      ::crc32(::crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  text += "# end, crc32 ";
  for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[(sum >> shift) & 15u];
  resume(text + "\n");
}

void read_body(std::string_view data) {
  // As a command line can have it: without zero bytes, at which messages end, too.
  const std::string text(data.substr(0, std::min<std::size_t>(data.find('\0'), 4096)));
  read_or_refuse([&] { static_cast<void>(body_and_fraction(text)); });
  read_or_refuse([&] { static_cast<void>(parse_rounded(text)); });
  if (!names_a_mesh(text)) read_shape(text);
}

void read_table(std::string_view data) {
  const AxisLaw law = AxisLaw::table(parse_axis_table(data, "fuzz.csv"));
  demand(std::fabs(law.order_parameter()) <= 1.0, "an order parameter");
}

MergedReport merged(const std::vector<Document>& documents) {
  MergeOptions options;
  options.is_part = true;
  switch (documents.front().kind) {
    case DocumentKind::virial: return merged_virial(documents, options);
    case DocumentKind::percolation: return merged_percolation(documents, options);
    case DocumentKind::estimate: break;
  }
  return merged_estimate(documents, options);
}

void read_merged_document(std::string_view data) {
  try {
    const std::string text = document_text(merged({read_document(file_of(data))}).document);
    demand(text.size() <= 64 * data.size() + 65536, "a document is at most a multiple of its parts");
  } catch (const nlohmann::json::exception&) {
    // Which vex_merge refuses in its own words.
  }
}

FuzzFormat format(const std::string& name, void (*read)(std::string_view)) {
  return {name, [read](std::string_view data) { read_or_refuse([&] { read(data); }); }};
}

}  // namespace

std::vector<FuzzFormat> program_formats() {
  return {format("poses", read_poses), format("scene", read_scene), format("realisations", read_realisations),
          format("body", read_body),   format("table", read_table), format("document", read_merged_document)};
}

}  // namespace vex::tests
