#include "apps/common/svg.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "apps/common/text.h"

namespace vex {
namespace {

constexpr double kTolerance = 0.05;  // pixels
constexpr double kFineGrid = 0.05;   // pixels

double distance_to_line(const Pixel& p, const Pixel& a, const Pixel& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, ex = p.x - a.x, ey = p.y - a.y;
  const double length_sq = dx * dx + dy * dy;
  const double along = length_sq > 0.0 ? (ex * dx + ey * dy) / length_sq : 0.0;
  const double t = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
  const double fx = ex - t * dx, fy = ey - t * dy;
  return std::sqrt(fx * fx + fy * fy);
}

// Douglas and Peucker: the farthest point stays, and so on between it and the ends.
void keep_between(const std::vector<Pixel>& points, std::size_t first, std::size_t last, std::vector<bool>& keep) {
  double farthest = kTolerance;
  std::size_t at = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = distance_to_line(points[i], points[first], points[last]);
    if (distance > farthest) farthest = distance, at = i;
  }
  if (at == first) return;
  keep[at] = true;
  keep_between(points, first, at, keep);
  keep_between(points, at, last, keep);
}

std::vector<Pixel> corners_of(const std::vector<Pixel>& points, bool closed) {
  if (points.size() < 2) return {};
  std::vector<Pixel> line = points;
  if (closed) line.push_back(points.front());
  std::vector<bool> keep(line.size(), false);
  keep.front() = true;
  keep.back() = !closed;
  keep_between(line, 0, line.size() - 1, keep);
  std::vector<Pixel> corners;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) corners.push_back(line[i]);
  }
  return corners;
}

}  // namespace

std::string svg_number(double value) {
  std::array<char, 64> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 2);
  std::string text(buffer.data(), end);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string svg_path(const std::vector<Pixel>& points, bool closed) {
  std::string path, previous;
  std::size_t n_kept = 0;
  for (const Pixel& p : corners_of(points, closed)) {
    const std::string here = svg_number(p.x) + "," + svg_number(p.y);
    if (here == previous) continue;
    path += (n_kept == 0 ? "M" : n_kept == 1 ? "L" : " ") + here;
    previous = here;
    ++n_kept;
  }
  if (n_kept < 2) return "";
  return path + (closed ? "Z" : "");
}

std::string svg_fine_path(const std::vector<Pixel>& points) {
  const auto to_grid = [](double value) { return std::floor(value / kFineGrid + 0.5); };
  const auto signed_number = [](double value) { return (value < 0.0 ? "" : " ") + svg_number(value); };
  std::string path;
  std::size_t n_kept = 0;
  Pixel previous;
  for (const Pixel& p : corners_of(points, true)) {
    const Pixel here{to_grid(p.x), to_grid(p.y)};
    const Pixel step{here.x - previous.x, here.y - previous.y};
    if (n_kept > 0 && step.x == 0.0 && step.y == 0.0) continue;
    path += (n_kept == 0 ? "M" : n_kept == 1 ? "l" : "") + signed_number(step.x) + signed_number(step.y);
    previous = here;
    ++n_kept;
  }
  return n_kept < 3 ? "" : path + "z";
}

std::string in_xml(std::string_view text) {
  std::string safe;
  for (const char c : printable(text))
    safe += c == '&' ? std::string("&amp;") : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return safe;
}

Svg::Svg(int width, int height, std::string_view title) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w +
          " " + h + "\" font-family=\"Helvetica,Arial,sans-serif\" font-size=\"13\">\n<title>" + std::string(title) +
          "</title>\n<rect x=\".5\" y=\".5\" width=\"" + std::to_string(width - 1) + "\" height=\"" +
          std::to_string(height - 1) + "\" rx=\"10\" fill=\"#fff\" stroke=\"#d5dbe3\"/>\n";
}

Svg Svg::in_page(int width, int height, std::string_view title) {
  Svg svg;
  svg.text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + std::to_string(width) + " " +
              std::to_string(height) + "\" role=\"img\" aria-label=\"" + std::string(title) + "\" font-size=\"13\">\n";
  return svg;
}

void Svg::begin_group(const Pixel& shift, std::string_view attributes) {
  text_ += "<g transform=\"translate(" + svg_number(shift.x) + "," + svg_number(shift.y) + ")\" " +
           std::string(attributes) + ">\n";
}

void Svg::begin_fine_grid() { text_ += "<g transform=\"scale(" + svg_number(kFineGrid) + ")\">\n"; }

void Svg::end_group() { text_ += "</g>\n"; }

void Svg::path(std::string_view commands, std::string_view attributes) {
  if (commands.empty()) return;
  text_ += "<path d=\"" + std::string(commands) + "\" " + std::string(attributes) + "/>\n";
}

void Svg::line(const Pixel& from, const Pixel& to, std::string_view attributes) {
  path("M" + svg_number(from.x) + "," + svg_number(from.y) + "L" + svg_number(to.x) + "," + svg_number(to.y),
       attributes);
}

void Svg::dot(const Pixel& centre, double radius, std::string_view attributes) {
  text_ += "<circle cx=\"" + svg_number(centre.x) + "\" cy=\"" + svg_number(centre.y) + "\" r=\"" + svg_number(radius) +
           "\" " + std::string(attributes) + "/>\n";
}

void Svg::label(const Pixel& at, std::string_view text, std::string_view attributes) {
  anchored_label("middle", at, text, attributes);
}

void Svg::label_at_start(const Pixel& at, std::string_view text, std::string_view attributes) {
  anchored_label("start", at, text, attributes);
}

void Svg::label_at_end(const Pixel& at, std::string_view text, std::string_view attributes) {
  anchored_label("end", at, text, attributes);
}

void Svg::anchored_label(const char* anchor, const Pixel& at, std::string_view text, std::string_view attributes) {
  text_ += "<text x=\"" + svg_number(at.x) + "\" y=\"" + svg_number(at.y) + "\" dy=\".35em\" text-anchor=\"" +
           std::string(anchor) + "\" " + std::string(attributes) + ">" + std::string(text) + "</text>\n";
}

}  // namespace vex
