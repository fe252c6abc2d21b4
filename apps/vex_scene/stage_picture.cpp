#include "apps/vex_scene/stage_picture.h"

#include <algorithm>
#include <vector>

#include "apps/common/log_axis.h"
#include "apps/common/numbers.h"
#include "apps/common/svg.h"

namespace vex {
namespace {

constexpr double kLeft = 170.0, kBar = 470.0, kTop = 118.0, kRow = 44.0, kThick = 26.0, kRight = 330.0, kMargin = 24.0;
constexpr const char* kSettled = "#2f6db3";
constexpr const char* kLeftOver = "#f2b35e";
constexpr const char* kInk = "fill=\"#1f2933\"";
constexpr const char* kGrey = "fill=\"#5b6773\"";

// 17 300 000: digits in groups of three, by narrow blanks.
std::string grouped(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t k = text.size(); k > 3; k -= 3) text.insert(k - 3, "\u202f");
  return text;
}

void rectangle(Svg& svg, double x, double y, double width, double height, const char* colour) {
  svg.path("M" + svg_number(x) + "," + svg_number(y) + "h" + svg_number(width) + "v" + svg_number(height) + "h" +
               svg_number(-width) + "z",
           "fill=\"" + std::string(colour) + "\"");
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "";
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  // What is not all does not read so.
  if (part == whole) return "100 %";
  const std::string text = fixed_number(1, share);
  return text == "100.0" ? ">99.9 %" : text == "0.0" && part > 0 ? "<0.1 %" : text + " %";
}

std::string headline(const SceneRun& run) {
  std::string text = grouped(run.n_bodies) + (run.n_bodies == 1 ? " body: " : " bodies: ");
  const Findings& found = run.found;
  switch (run.options.query) {
    case SceneQuery::any: return text + "does any pair overlap? " + std::string(name_of(found.answer.outcome));
    case SceneQuery::clusters: return text + grouped(found.clusters.size()) + " clusters of those that overlap";
    case SceneQuery::within:
      return text + grouped(found.n_pairs) + " pairs within " + short_number(run.options.distance, 6);
    case SceneQuery::pairs:
    case SceneQuery::counts: break;
  }
  return text + grouped(found.n_pairs) + " pairs overlap";
}

void draw_row(Svg& svg, double y, const SceneCounts::Stage& count, std::string_view name, std::uint64_t most) {
  const double middle = y + 0.5 * kThick;
  const auto length = [most](std::uint64_t n) {
    constexpr double kLeast = 2.0;  // pixels, so that some are never none
    return n == 0 ? 0.0 : std::max(kLeast, kBar * static_cast<double>(n) / static_cast<double>(most));
  };
  svg.label({kLeft - 14.0, middle}, name, anchored("end", std::string("font-size=\"17\" ") + kInk));
  const double settled = length(count.settled), left = length(count.seen - count.settled);
  rectangle(svg, kLeft, y, settled, kThick, kSettled);
  rectangle(svg, kLeft + settled, y, left, kThick, kLeftOver);
  svg.label({kLeft + settled + left + 12.0, middle},
            grouped(count.seen) + " seen, " + percent(count.settled, count.seen) + " settled",
            anchored("start", std::string("font-size=\"15\" ") + kInk));
}

}  // namespace

std::string stage_picture(const SceneRun& run) {
  std::vector<SceneStage> stages;
  std::uint64_t most = 1;
  for (int k = 0; k < kNSceneStages; ++k) {
    const SceneStage stage = static_cast<SceneStage>(k);
    if (run.found.counts[stage].seen == 0) continue;
    stages.push_back(stage);
    most = std::max(most, run.found.counts[stage].seen);
  }
  const int width = static_cast<int>(kLeft + kBar + kRight);
  const int height =
      static_cast<int>(kTop + kRow * static_cast<double>(std::max<std::size_t>(stages.size(), 1)) + 16.0);
  Svg svg(width, height, "vex_scene: what each stage saw and settled");
  svg.label({kMargin, 36.0}, headline(run),
            anchored("start", std::string("font-size=\"22\" font-weight=\"bold\" ") + kInk));
  svg.label({kMargin, 64.0}, "Pairs that may be near each other go from stage to stage until one proves the answer",
            anchored("start", std::string("font-size=\"15\" ") + kGrey));
  rectangle(svg, kLeft, 84.0, 16.0, 14.0, kSettled);
  svg.label({kLeft + 22.0, 91.0}, "settled here", anchored("start", std::string("font-size=\"14\" ") + kInk));
  rectangle(svg, kLeft + 130.0, 84.0, 16.0, 14.0, kLeftOver);
  svg.label({kLeft + 152.0, 91.0}, "left for the next", anchored("start", std::string("font-size=\"14\" ") + kInk));
  if (stages.empty()) {
    svg.label({kLeft, kTop + 0.5 * kThick}, "no two bodies were near each other",
              anchored("start", std::string("font-size=\"15\" ") + kInk));
  }
  double y = kTop;
  for (const SceneStage stage : stages) {
    draw_row(svg, y, run.found.counts[stage], name_of(stage), most);
    y += kRow;
  }
  return svg.text();
}

}  // namespace vex
