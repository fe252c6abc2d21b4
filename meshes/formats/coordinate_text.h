// Numbers in text files: read exactly, and how many digits they were written with.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "meshes/polygon_soup.h"

namespace vex {

/// The double nearest to the decimal number that `token` is, all of it: digits with an optional sign, point and
/// exponent (e or E). Nothing for any other text, for what is not finite ("nan", "inf"), and for what is too large for
/// a double. What is nearer to 0 than to any other double is 0. The same in every locale.
std::optional<double> parse_decimal(std::string_view token);

struct WrittenNumber;

/// Watches the coordinates of a text file go by, to say how finely they were written.
class WrittenDigits {
 public:
  /// parse_decimal(token), noted where it is a number.
  std::optional<double> parse(std::string_view token);
  /// A token that parse_decimal took, and its value.
  void note(std::string_view token, double value);

  /// Of all tokens so far. Files print numbers with a fixed number of decimals, or of significant digits, and may drop
  /// zeros at the end; the last place of the largest coordinate is the coarser of what the finest decimal and the
  /// longest number say; but numbers of three digits or fewer tell nothing by their length, unless ten different ones
  /// are as long. Text that is as fine as doubles, or all of whose numbers are doubles to the last digit (0.5, 12,
  /// 0.375: no sign of any rounding), counts as doubles; but where nearly all are whole numbers of as many digits, six
  /// or more, such as %g prints of 123456.7, they count as rounded. Text that is finer than floats, and all of whose
  /// numbers are floats to their last digit, counts as floats.
  CoordinateDigits digits() const;

 private:
  void note(const WrittenNumber& number, double value);
  void note_length(double size, int n_digits);
  void note_short(double size, int n_places);
  bool exactness_tells() const;

  // A writer that cuts numbers at six digits leaves decimals to those below 100000. Of numbers that have k decimals one
  // in 5^k is a double by chance: ten decimals of different numbers make that 1e-7.
  static constexpr int kManyDigits = 6;
  static constexpr int kTelling = 10;

  double largest_ = 0.0;       // of all magnitudes
  int largest_magnitude_ = 0;  // the power of ten that the first digit of the largest stands for
  int most_digits_ = 0;        // significant ones of a token, zeros at its end included
  int finest_place_ = 0;       // the least power of ten that a token's last digit stands for
  bool all_exact_ = true;      // every token is exactly a double, in nine digits or fewer, and not cut before the units
  bool all_floats_ = true;     // every token is nearer to a float than half a unit of its last place
  // Of the tokens so far, while all are exact: how many they are, and their digits without zeros at the end; different
  // magnitudes below 100000, and the decimals that these would have been left, until they are kTelling.
  std::int64_t n_exact_ = 0;
  std::int64_t n_exact_digits_ = 0;
  std::array<double, kTelling> longest_sizes_{};  // different magnitudes of numbers of most_digits_
  int n_longest_sizes_ = 0;
  std::array<double, kTelling> short_sizes_{};
  int n_short_sizes_ = 0;
  int n_decimals_if_cut_ = 0;
};

/// Of binary coordinates, the largest of which has this magnitude.
CoordinateDigits float_digits(double largest);
CoordinateDigits double_digits(double largest);

}  // namespace vex
