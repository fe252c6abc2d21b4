#include "tests/docs/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "shapes/any_shape.h"
#include "tests/docs/outline.h"
#include "tests/docs/sampled_hull.h"

namespace vex {
namespace {

constexpr int kWidth = 260, kHeight = 220;
constexpr double kBodyWidth = 160.0, kBodyHeight = 122.0;    // pixels
constexpr double kBeyondBody = 24.0, kBeyondOutline = 20.0;  // pixels of an axis, at least
constexpr int kTones = 44;
constexpr double kSharp = 0.94;         // cosine of the least angle at an edge of a body with curved parts
constexpr std::size_t kManyFaces = 60;  // of a polytope: then its edges are thin

constexpr std::string_view kOutline = "stroke=\"#2c4a73\" stroke-width=\"1.3\" stroke-linejoin=\"round\" fill=\"none\"";
constexpr std::string_view kEdge = "stroke=\"#2c4a73\" stroke-width=\".9\" stroke-linejoin=\"round\" fill=\"none\"";
constexpr std::string_view kThinEdge = "stroke=\"#2c4a73\" stroke-width=\".5\" opacity=\".45\" fill=\"none\"";
constexpr std::string_view kNeedle = "stroke=\"#7d9cc4\" stroke-width=\"4\" fill=\"none\"";
constexpr std::string_view kCore = "stroke=\"#2c4a73\" stroke-width=\".8\" stroke-dasharray=\"3 2.5\" fill=\"none\"";
constexpr std::string_view kAxis = "stroke=\"#30343b\" stroke-width=\"1.1\"";
constexpr std::string_view kHiddenAxis =
    "stroke=\"#30343b\" stroke-width=\".8\" stroke-dasharray=\"2.5 2.5\" opacity=\".55\"";
constexpr std::string_view kAxisLabel = "fill=\"#30343b\"";
constexpr std::string_view kDimension = "stroke=\"#b0401c\" stroke-width=\"1.1\"";
constexpr std::string_view kDimensionLabel =
    "fill=\"#b0401c\" font-style=\"italic\" font-weight=\"bold\" stroke=\"#fff\" stroke-width=\"3\" "
    "stroke-linejoin=\"round\" paint-order=\"stroke\"";

Pixel operator+(const Pixel& a, const Pixel& b) { return {a.x + b.x, a.y + b.y}; }
Pixel operator-(const Pixel& a, const Pixel& b) { return {a.x - b.x, a.y - b.y}; }
Pixel operator*(double s, const Pixel& a) { return {s * a.x, s * a.y}; }
double length(const Pixel& a) { return std::sqrt(a.x * a.x + a.y * a.y); }

// From above, a little to the left, from behind the eye's shoulder.
Vec3d unit_light() { return normalised(picture_view() + 0.75 * picture_up() - 0.45 * picture_right()); }

// From the shade to the light, 0 <= t <= 1.
std::string tone(double t) {
  constexpr std::array<std::array<double, 3>, 2> kRamp = {{{84, 121, 170}, {232, 241, 251}}};
  std::string text = "#";
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = static_cast<unsigned>(std::floor(kRamp[0][k] + t * (kRamp[1][k] - kRamp[0][k]) + 0.5));
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

class Drawing {
 public:
  explicit Drawing(const Subject& subject)
      : subject_(subject), hull_(sampled_hull(subject.body)), svg_(kWidth, kHeight, subject.title) {
    const auto extent = [&](const Vec3d& dir) {
      return dot(subject.body.support(dir), dir) + dot(subject.body.support(-dir), -dir);
    };
    scale_ = std::min(kBodyWidth / std::max(extent(picture_right()), 1e-3), kBodyHeight / extent(picture_up()));
    outline_ = pixels(silhouette(subject.body, picture_view(), step()));
    const std::array<Vec3d, 3> units = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    for (std::size_t k = 0; k < 3; ++k) tips_[k] = tip_of_axis(units[k]);
  }

  std::string text() {
    svg_.begin_group(shift_to_middle(), "stroke-linecap=\"round\"");
    body();
    core();
    axes();
    dimensions();
    svg_.end_group();
    return svg_.text();
  }

 private:
  // Relative to the body's origin.
  Pixel pixel(const Vec3d& p) const { return {scale_ * dot(p, picture_right()), -scale_ * dot(p, picture_up())}; }
  std::vector<Pixel> pixels(const std::vector<Vec3d>& points) const {
    std::vector<Pixel> line;
    for (const Vec3d& p : points) line.push_back(pixel(p));
    return line;
  }
  double step() const { return 1.0 / scale_; }  // about a pixel

  // Where the axis leaves the body, and a piece beyond.
  Vec3d tip_of_axis(const Vec3d& unit) const {
    double inside = dot(subject_.body.support(unit), unit);
    for (const HullFace& face : hull_.faces) {
      const double slope = dot(unit, face.unit_normal);
      if (slope > 0.0) inside = std::min(inside, dot(face.corners[0], face.unit_normal) / slope);
    }
    const double pixels_per_unit = length(pixel(unit));
    return std::max(inside + kBeyondBody / pixels_per_unit,
                    pixels_to_outline(pixel(unit)) / pixels_per_unit + kBeyondOutline / pixels_per_unit) *
           unit;
  }

  // From the origin along a direction of the picture.
  double pixels_to_outline(const Pixel& dir) const {
    double farthest = 0.0;
    Pixel previous = outline_.back();
    for (const Pixel& p : outline_) {
      // Where the ray t dir, t > 0, crosses the segment; NaN or infinite where they are parallel.
      const Pixel along = p - previous;
      const double denominator = dir.x * along.y - dir.y * along.x;
      const double t = (previous.x * along.y - previous.y * along.x) / denominator;
      const double s = (previous.x * dir.y - previous.y * dir.x) / denominator;
      if (std::isfinite(t) && t > farthest && s >= 0.0 && s <= 1.0) farthest = t;
      previous = p;
    }
    return farthest * length(dir);
  }

  // Everything in the middle of the card.
  Pixel shift_to_middle() const {
    Pixel least{1e9, 1e9}, largest{-1e9, -1e9};
    const auto include = [&](const Pixel& p, double margin) {
      least = {std::min(least.x, p.x - margin), std::min(least.y, p.y - margin)};
      largest = {std::max(largest.x, p.x + margin), std::max(largest.y, p.y + margin)};
    };
    for (const Pixel& p : outline_) include(p, 1.0);
    for (const Vec3d& tip : tips_) include(label_of_axis(tip), 7.0);
    for (const Dimension& d : subject_.dimensions) include(middle_of(d), 7.0);
    return {0.5 * (kWidth - least.x - largest.x), 0.5 * (kHeight - least.y - largest.y)};
  }

  void body() {
    const std::vector<Vec3d> vertices = vertices_of(subject_.body);
    if (vertices.size() == 2) return svg_.line(pixel(vertices[0]), pixel(vertices[1]), kNeedle);
    if (vertices.empty()) {
      smooth_surface();
    } else {
      plane_faces();
    }
    svg_.path(svg_path(outline_, true), kOutline);
    const bool is_polytope = !vertices.empty();
    sharp_edges(is_polytope ? 1.0 : kSharp, is_polytope && hull_.faces.size() > kManyFaces ? kThinEdge : kEdge);
  }

  // Tone by tone, each on top of the darker one.
  void smooth_surface() {
    const double least = least_brightness();
    svg_.begin_fine_grid();
    svg_.path(svg_fine_path(outline_), "fill=\"" + tone(0.5 / kTones) + "\"");
    for (int k = 1; k < kTones; ++k) {
      const double t = static_cast<double>(k) / kTones;
      const std::vector<Vec3d> region =
          lit_region(subject_.body, picture_view(), unit_light(), least + t * (1.0 - least), step());
      svg_.path(svg_fine_path(pixels(region)), "fill=\"" + tone(t + 0.5 / kTones) + "\"");
    }
    svg_.end_group();
  }

  void plane_faces() {
    if (hull_.faces.empty()) svg_.path(svg_path(outline_, true), "fill=\"" + tone_of({0.0, 0.0, 1.0}) + "\"");
    for (const HullFace& face : hull_.faces) {
      if (dot(face.unit_normal, picture_view()) <= 0.0) continue;
      const std::string colour = tone_of(face.unit_normal);
      std::string attributes = "fill=\"";
      // The stroke hides the seam between two faces.
      attributes.append(colour).append("\" stroke=\"").append(colour).append("\" stroke-width=\".6\"");
      svg_.path(svg_path(pixels(face.corners), true), attributes);
    }
  }

  double least_brightness() const {
    const double cosine = dot(unit_light(), picture_view());
    return -std::sqrt(1.0 - cosine * cosine);
  }

  std::string tone_of(const Vec3d& unit_normal) const {
    const double least = least_brightness();
    return tone((dot(unit_normal, unit_light()) - least) / (1.0 - least));
  }

  // Those that are seen, joined to long lines where one ends at the next one's start.
  void sharp_edges(double largest_cosine, std::string_view attributes) {
    std::vector<HullEdge> rest;
    for (const HullEdge& edge : hull_.edges) {
      const double left = dot(edge.unit_left, picture_view()), right = dot(edge.unit_right, picture_view());
      const bool is_outline = (left > 0.0) != (right > 0.0);
      if (is_outline || left <= 0.0 || dot(edge.unit_left, edge.unit_right) > largest_cosine) continue;
      rest.push_back(edge);
    }
    while (!rest.empty()) {
      std::deque<Vec3d> line = {rest.back().from, rest.back().to};
      rest.pop_back();
      for (bool grew = true; grew;) {
        grew = false;
        for (std::size_t i = 0; i < rest.size(); ++i) {
          if (!extend(line, rest[i].from, rest[i].to) && !extend(line, rest[i].to, rest[i].from)) continue;
          rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
          grew = true;
          break;
        }
      }
      svg_.path(svg_path(pixels({line.begin(), line.end()}), false), attributes);
    }
  }

  // Whether the edge continues the line, at either end.
  static bool extend(std::deque<Vec3d>& line, const Vec3d& a, const Vec3d& b) {
    if (norm(line.back() - a) == 0.0) {
      line.push_back(b);
      return true;
    }
    if (norm(line.front() - a) == 0.0) {
      line.push_front(b);
      return true;
    }
    return false;
  }

  void core() {
    if (!subject_.core) return;
    for (const HullEdge& edge : sampled_hull(*subject_.core).edges) {
      if (dot(edge.unit_left, picture_view()) <= 0.0 && dot(edge.unit_right, picture_view()) <= 0.0) continue;
      svg_.line(pixel(edge.from), pixel(edge.to), kCore);
    }
  }

  Pixel label_of_axis(const Vec3d& tip) const {
    const Pixel end = pixel(tip);
    return end + (8.0 / length(end)) * end;
  }

  void axes() {
    constexpr std::array kNames = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) {
      axis(tips_[k]);
      svg_.label(label_of_axis(tips_[k]), kNames[k], kAxisLabel);
    }
    svg_.dot({}, 1.8, "fill=\"#30343b\"");
    const Vec3d centre = subject_.body.centre();
    if (norm(centre) < 0.01 * subject_.body.circumradius()) return;
    svg_.dot(pixel(centre), 2.6, "fill=\"#fff\" stroke=\"#30343b\" stroke-width=\"1.1\"");
  }

  // Dashed where it is in the body or behind it.
  void axis(const Vec3d& tip) {
    constexpr int kPieces = 256;
    const auto at = [&](int i) { return (static_cast<double>(i) / kPieces) * tip; };
    const auto is_hidden = [&](int i) {
      return is_covered(hull_, 0.5 * (at(i) + at(i + 1)), picture_view(), subject_.body.circumradius());
    };
    for (int start = 0; start < kPieces;) {
      const bool hidden = is_hidden(start);
      int end = start + 1;
      while (end < kPieces && is_hidden(end) == hidden) ++end;
      svg_.line(pixel(at(start)), pixel(at(end)), hidden ? kHiddenAxis : kAxis);
      start = end;
    }
    const Pixel end = pixel(tip), along = (1.0 / length(end)) * end, across{-along.y, along.x};
    svg_.path(svg_path({end, end - 7.0 * along + 2.4 * across, end - 7.0 * along - 2.4 * across}, true),
              "fill=\"#30343b\"");
  }

  Pixel middle_of(const Dimension& d) const { return 0.5 * (pixel(d.from) + pixel(d.to)) + d.shift + d.label_shift; }

  void dimensions() {
    for (const Dimension& d : subject_.dimensions) {
      const Pixel from = pixel(d.from) + d.shift, to = pixel(d.to) + d.shift;
      const Pixel tick = (3.0 / length(to - from)) * Pixel{from.y - to.y, to.x - from.x};
      svg_.line(from, to, kDimension);
      svg_.line(from - tick, from + tick, kDimension);
      svg_.line(to - tick, to + tick, kDimension);
    }
    for (const Dimension& d : subject_.dimensions) svg_.label(middle_of(d), d.label, kDimensionLabel);
  }

  const Subject& subject_;
  SampledHull hull_;
  Svg svg_;
  double scale_ = 1.0;  // pixels for each unit of length
  std::vector<Pixel> outline_;
  std::array<Vec3d, 3> tips_{};
};

}  // namespace

Vec3d picture_view() { return normalised({0.86, 0.50, 0.355}); }
Vec3d picture_right() { return normalised(cross({0.0, 0.0, 1.0}, picture_view())); }
Vec3d picture_up() { return cross(picture_view(), picture_right()); }

std::string draw(const Subject& subject) { return Drawing(subject).text(); }

}  // namespace vex
