// Lines of an SVG file: what the pictures need, and nothing more.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vex {

/// A point of the picture, in pixels: x to the right, y down.
struct Pixel {
  double x = 0.0, y = 0.0;
};

/// Two decimals, without zeros at their end; the same characters on every machine.
std::string svg_number(double value);

/// The commands of a path through the points, without those that are closer than a fraction of a pixel to a line
/// between others. Empty where fewer than two points are left.
std::string svg_path(const std::vector<Pixel>& points, bool closed);

/// The same for a closed path on the fine grid: a third of the characters.
std::string svg_fine_path(const std::vector<Pixel>& points);

/// Text of others, such as a file's name, as a label takes it.
std::string in_xml(std::string_view text);

class Svg {
 public:
  /// A file: a white card.
  Svg(int width, int height, std::string_view title);
  /// Part of a page, as wide as that wants it, on the page's own colour.
  static Svg in_page(int width, int height, std::string_view title);

  /// Everything until `end_group` moves by this, and has these attributes.
  void begin_group(const Pixel& shift, std::string_view attributes);
  /// Everything until `end_group` is a fine path.
  void begin_fine_grid();
  void end_group();
  void path(std::string_view commands, std::string_view attributes);
  void line(const Pixel& from, const Pixel& to, std::string_view attributes);
  void dot(const Pixel& centre, double radius, std::string_view attributes);
  /// Centred at the point.
  void label(const Pixel& at, std::string_view text, std::string_view attributes);
  /// It begins, or ends, at the point.
  void label_at_start(const Pixel& at, std::string_view text, std::string_view attributes);
  void label_at_end(const Pixel& at, std::string_view text, std::string_view attributes);

  /// The whole file.
  std::string text() const { return text_ + "</svg>\n"; }

 private:
  Svg() = default;
  void anchored_label(const char* anchor, const Pixel& at, std::string_view text, std::string_view attributes);

  std::string text_;
};

}  // namespace vex
