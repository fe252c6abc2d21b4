#include "apps/vex_stress/plot.h"

#include <algorithm>
#include <cmath>

#include "apps/common/numbers.h"

namespace vex {
namespace {

constexpr double kRowHeight = 15.0, kLabelWidth = 230.0, kCellWidth = 96.0, kTop = 96.0, kMargin = 16.0,
                 kFamilyGap = 6.0;

struct Colour {
  double r, g, b;
};

Colour mixed(const Colour& from, const Colour& to, double share) {
  return {from.r + share * (to.r - from.r), from.g + share * (to.g - from.g), from.b + share * (to.b - from.b)};
}

std::string text_of(const Colour& colour) {
  const auto part = [](double x) { return std::to_string(std::lround(x)); };
  return "rgb(" + part(colour.r) + "," + part(colour.g) + "," + part(colour.b) + ")";
}

// One pose in a million is as pale as it gets, all of them as dark.
double strength(double share) { return std::clamp(1.0 + std::log10(share) / 6.0, 0.15, 1.0); }

struct Cell {
  Colour colour;
  std::string text;
  bool is_dark = false;
};

constexpr Colour kRight{221, 241, 224}, kPale{253, 238, 214}, kUndecided{222, 150, 40}, kPaleWrong{250, 205, 200},
    kWrong{178, 24, 43};

std::string percent(double share) {
  const double value = 100.0 * share;
  return (value >= 9.95 ? fixed_number(0, value) : short_number(value, 2)) + " %";
}

Cell cell_of(const StressCounts& counts) {
  const double n = static_cast<double>(counts.n_pairs);
  if (counts.n_wrong() > 0) {
    const double share = static_cast<double>(counts.n_wrong()) / n, s = strength(share);
    return {mixed(kPaleWrong, kWrong, s), percent(share) + " wrong", s > 0.45};
  }
  if (counts.n_undecided > 0) {
    const double share = static_cast<double>(counts.n_undecided) / n;
    return {mixed(kPale, kUndecided, strength(share)), percent(share) + " open"};
  }
  return {kRight, ""};
}

std::string rectangle(double x, double y, double width, double height, const std::string& fill) {
  return "<rect x=\"" + short_number(x) + "\" y=\"" + short_number(y) + "\" width=\"" + short_number(width) +
         "\" height=\"" + short_number(height) + "\" fill=\"" + fill + "\"/>\n";
}

std::string words(double x, double y, const std::string& text, const std::string& more = "") {
  return "<text x=\"" + short_number(x) + "\" y=\"" + short_number(y) + "\"" + more + ">" + text + "</text>\n";
}

// What stands before the last part of the name.
std::string family_of(const StressRow& row) { return row.name.substr(0, row.name.rfind('/')); }

}  // namespace

std::string picture_of(const StressRun& run) {
  const std::size_t n_backends = run.options.backends.size();
  const double width = std::max(2.0 * kMargin + kLabelWidth + static_cast<double>(n_backends) * kCellWidth, 640.0);
  double height = kTop + static_cast<double>(run.rows.size()) * kRowHeight + kMargin;
  for (std::size_t i = 1; i < run.rows.size(); ++i) {
    if (family_of(run.rows[i]) != family_of(run.rows[i - 1])) height += kFamilyGap;
  }
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + short_number(width) + "\" height=\"" +
                    short_number(height) +
                    "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"10\">\n";
  svg += rectangle(0.0, 0.0, width, height, "white");
  svg += words(kMargin, 24.0, "vex_stress: answers against exact arithmetic", " font-size=\"15\" font-weight=\"bold\"");
  const auto key = [&svg](double x, const Colour& colour, const std::string& text) {
    svg += rectangle(x, 36.0, 14.0, 12.0, text_of(colour));
    svg += words(x + 19.0, 46.0, text);
  };
  key(kMargin, kRight, "all right");
  key(kMargin + 90.0, mixed(kPale, kUndecided, 0.8), "some undecided, none wrong");
  key(kMargin + 275.0, mixed(kPaleWrong, kWrong, 0.8), "some wrong (share of all poses)");
  key(kMargin + 480.0, {235, 235, 235}, "no such test");
  for (std::size_t k = 0; k < n_backends; ++k) {
    svg += words(kMargin + kLabelWidth + (static_cast<double>(k) + 0.5) * kCellWidth, kTop - 10.0,
                 run.options.backends[k].name, " text-anchor=\"middle\" font-size=\"12\" font-weight=\"bold\"");
  }
  double y = kTop;
  for (std::size_t i = 0; i < run.rows.size(); ++i, y += kRowHeight) {
    const StressRow& row = run.rows[i];
    if (i > 0 && family_of(row) != family_of(run.rows[i - 1])) y += kFamilyGap;
    svg += words(kMargin, y + 11.0, row.name);
    for (std::size_t k = 0; k < n_backends; ++k) {
      const double x = kMargin + kLabelWidth + static_cast<double>(k) * kCellWidth;
      const bool has_test = row.counts[k].n_pairs > 0;
      const Cell cell = has_test ? cell_of(row.counts[k]) : Cell{{235, 235, 235}, ""};
      svg += rectangle(x, y, kCellWidth - 2.0, kRowHeight - 1.0, text_of(cell.colour));
      if (cell.text.empty()) continue;
      svg += words(x + 0.5 * kCellWidth, y + 11.0, cell.text,
                   " text-anchor=\"middle\" fill=\"" + std::string(cell.is_dark ? "white" : "black") + "\"");
    }
  }
  return svg + "</svg>\n";
}

}  // namespace vex
