#include "meshes/formats/coordinate_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace vex {

/// What a decimal number says: (-1)^negative * digits * 10^place.
struct WrittenNumber {
  bool negative = false;
  bool digits_are_cut = false;  // there are others than 0 behind the first kMostDigits
  std::uint64_t digits = 0;     // from the first that is not 0 to the last, or the first kMostDigits of these
  std::int64_t n_digits = 0;    // from the first that is not 0 to the last, all of them
  std::int64_t place = 0;       // the power of ten that the last of all digits stands for
};

namespace {

constexpr int kMostDigits = 19;  // fit in 64 bits
constexpr std::uint64_t kMostExact = std::uint64_t{1} << 53U;
constexpr std::int64_t kFar = 5000;  // powers of ten beyond any number's

constexpr std::array<double, 23> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

double power_of_ten(int exponent) {
  const auto size = static_cast<std::size_t>(std::abs(exponent));
  if (size >= kPowersOfTen.size()) return std::pow(10.0, exponent);
  return exponent < 0 ? 1.0 / kPowersOfTen[size] : kPowersOfTen[size];
}

/// Numbers of more digits than 64 bits hold.
void read_long_digits(const char* at, const char* end, WrittenNumber* number) {
  int n_read = 0;
  number->digits = 0;
  for (; at != end && (is_digit(*at) || *at == '.'); ++at) {
    if (*at == '.' || (n_read == 0 && *at == '0')) continue;
    if (n_read < kMostDigits) {
      number->digits = 10 * number->digits + static_cast<std::uint64_t>(*at - '0');
      ++n_read;
    } else if (*at != '0') {
      number->digits_are_cut = true;
      return;
    }
  }
}

/// False where the text is no decimal number.
bool read_number(std::string_view token, WrittenNumber* number) {
  const char* at = token.data();
  const char* const end = at + token.size();
  if (at != end && (*at == '-' || *at == '+')) {
    number->negative = *at == '-';
    ++at;
  }
  const char* const begin = at;
  std::uint64_t digits = 0;
  const auto read_digits = [&] {
    for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
  };
  while (at != end && *at == '0') ++at;
  const char* first = at;  // of the digits that count
  read_digits();
  std::int64_t n_digits = at - first;
  std::int64_t n_decimals = 0;
  bool has_digits = at != begin;
  if (at != end && *at == '.') {
    const char* const decimals = ++at;
    if (n_digits == 0) {
      while (at != end && *at == '0') ++at;
    }
    first = at;
    read_digits();
    n_digits += at - first;
    n_decimals = at - decimals;
    has_digits = has_digits || n_decimals > 0;
  }
  if (!has_digits) return false;
  std::int64_t exponent = 0;
  if (at != end && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool is_negative = at != end && *at == '-';
    if (at != end && (*at == '-' || *at == '+')) ++at;
    if (at == end) return false;
    constexpr std::int64_t kHuge = std::int64_t{1} << 55U;  // no file has as many digits that it could outweigh this
    for (; at != end && is_digit(*at); ++at) exponent = std::min(kHuge, 10 * exponent + (*at - '0'));
    if (is_negative) exponent = -exponent;
  }
  if (at != end) return false;
  number->digits = digits;
  number->n_digits = n_digits;
  number->place = exponent - n_decimals;
  if (n_digits > kMostDigits) read_long_digits(begin, end, number);
  return true;
}

__extension__ typedef unsigned __int128 TwoWords;

/// The double nearest to digits / 10^n, for digits that are not 0 and n from 1 to 27, by whole numbers.
double quotient(std::uint64_t digits, int n) {
  static constexpr auto kPowersOfFive = [] {
    std::array<std::uint64_t, 28> powers{1};  // 5^27 < 2^63
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = 5 * powers[k - 1];
    return powers;
  }();
  // With both shifted up to their highest bit, the quotient has 63 or 64 bits: at least ten more than a double.
  const int shift = std::countl_zero(digits);
  const std::uint64_t power = kPowersOfFive[static_cast<std::size_t>(n)];
  const int power_shift = std::countl_zero(power);
  const TwoWords dividend = TwoWords{digits << shift} << 63U;
  const std::uint64_t divisor = power << power_shift;
  const auto whole = static_cast<std::uint64_t>(dividend / divisor);
  const bool has_rest = whole * TwoWords{divisor} != dividend;
  // The lowest bit is far below a double's last: set, it stands for the rest.
  const std::uint64_t sticky = whole | (has_rest ? 1U : 0U);
  const auto exponent = static_cast<std::uint64_t>(1023 + power_shift - shift - 63 - n);  // 852 at the least
  return static_cast<double>(sticky) * std::bit_cast<double>(exponent << 52U);
}

std::int64_t magnitude_of(const WrittenNumber& number) { return number.place + number.n_digits - 1; }

std::optional<double> value_of(const WrittenNumber& number, std::string_view token) {
  const double sign = number.negative ? -1.0 : 1.0;
  if (number.n_digits == 0) return sign * 0.0;
  if (number.n_digits <= kMostDigits) {
    if (number.digits <= kMostExact && std::abs(number.place) <= 22) {
      // Both factors are doubles, so the one rounding is that of the result.
      const double power = kPowersOfTen[static_cast<std::size_t>(std::abs(number.place))];
      const double digits = sign * static_cast<double>(number.digits);
      return number.place < 0 ? digits / power : digits * power;
    }
    if (number.place < 0 && number.place >= -27) return sign * quotient(number.digits, static_cast<int>(-number.place));
  }
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0.0;
  const char* const end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::result_out_of_range && magnitude_of(number) < -323) return sign * 0.0;
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Where the number is a double, and no more than nine digits say so, how many do; nothing otherwise. 1.235e+08 is one
/// too, but has the look of a number that was cut at so many digits.
std::optional<int> digits_of_short_double(const WrittenNumber& number) {
  if (number.digits_are_cut || (number.place > 0 && number.n_digits > 3)) return std::nullopt;
  std::uint64_t digits = number.digits;
  std::int64_t place = number.place + std::max<std::int64_t>(0, number.n_digits - kMostDigits);
  for (; digits % 10 == 0; digits /= 10) ++place;
  if (digits > 999'999'999 || place > 9) return std::nullopt;
  for (std::uint64_t rest = digits; place < 0; ++place, rest /= 5) {
    if (rest % 5 != 0) return std::nullopt;  // digits * 10^-k is a double if 5^k divides the digits
  }
  int n_digits = 0;
  for (; digits > 0; digits /= 10) ++n_digits;
  return n_digits;
}

double unit_in_last_place(double largest, int n_bits, int least_exponent) {
  return std::ldexp(1.0, largest > 0.0 ? std::max(std::ilogb(largest) - n_bits, least_exponent) : least_exponent);
}
double unit_in_last_place(double largest) { return unit_in_last_place(largest, 52, -1074); }
double unit_in_last_float_place(double largest) { return unit_in_last_place(largest, 23, -149); }

}  // namespace

std::optional<double> parse_decimal(std::string_view token) {
  WrittenNumber number;
  if (!read_number(token, &number)) return std::nullopt;
  return value_of(number, token);
}

std::optional<double> WrittenDigits::parse(std::string_view token) {
  WrittenNumber number;
  if (!read_number(token, &number)) return std::nullopt;
  const std::optional<double> value = value_of(number, token);
  if (value) note(number, *value);
  return value;
}

void WrittenDigits::note(std::string_view token, double value) {
  WrittenNumber number;
  if (read_number(token, &number)) note(number, value);
}

void WrittenDigits::note(const WrittenNumber& number, double value) {
  if (number.n_digits == 0) return;  // a zero tells nothing
  const double size = std::fabs(value);
  const auto within = [](std::int64_t power) { return static_cast<int>(std::clamp(power, -kFar, kFar)); };
  if (most_digits_ == 0 || size > largest_) {
    largest_ = size;
    largest_magnitude_ = within(magnitude_of(number));
  }
  const int place = within(number.place);
  note_length(size, within(number.n_digits));
  finest_place_ = std::min(finest_place_, place);
  if (all_exact_) {
    const std::optional<int> n_digits = digits_of_short_double(number);
    all_exact_ = n_digits.has_value();
    ++n_exact_;
    n_exact_digits_ += n_digits.value_or(0);
    if (n_decimals_if_cut_ < kTelling) note_short(size, within(magnitude_of(number)) + 1);
  }
  // Normal floats lie closer together than decimals of six digits.
  if (all_floats_ && !(number.n_digits <= 6 && size >= 1e-37 && size <= 1e38)) {
    const auto difference = [&] { return std::fabs(static_cast<double>(static_cast<float>(value)) - value); };
    all_floats_ = size <= 3.4e38 && difference() <= 0.5001 * power_of_ten(place);
  }
}

CoordinateDigits WrittenDigits::digits() const {
  if (most_digits_ == 0 || (all_exact_ && exactness_tells())) return double_digits(largest_);
  // Numbers of three digits or fewer (1, 0.1, 5e-17) were hardly cut at so few, unless many different ones are as long:
  // the decimals alone tell how fine they are.
  constexpr int kFewDigits = 4;
  const int by_length = largest_magnitude_ + 1 - most_digits_;
  const bool length_tells = most_digits_ >= kFewDigits || n_longest_sizes_ == kTelling;
  const int place = length_tells ? std::max(finest_place_, by_length) : finest_place_;
  const double last_place = power_of_ten(place);
  // Any number of a few digits is near a float: floats show in numbers that have all theirs.
  constexpr int kDigitsOfFloats = 8;
  if (all_floats_ && most_digits_ >= kDigitsOfFloats && last_place < unit_in_last_float_place(largest_))
    return float_digits(largest_);
  if (last_place <= unit_in_last_place(largest_) * 2.0) return double_digits(largest_);
  return {CoordinateDigits::Kind::decimals, std::max(1, largest_magnitude_ + 1 - place), last_place};
}

void WrittenDigits::note_length(double size, int n_digits) {
  if (n_digits > most_digits_) {
    most_digits_ = n_digits;
    n_longest_sizes_ = 0;
  }
  if (n_digits < most_digits_ || n_longest_sizes_ == kTelling) return;
  const auto end = longest_sizes_.begin() + n_longest_sizes_;
  if (std::find(longest_sizes_.begin(), end, size) != end) return;
  *end = size;
  ++n_longest_sizes_;
}
void WrittenDigits::note_short(double size, int n_places) {
  const auto end = short_sizes_.begin() + n_short_sizes_;
  if (n_places >= kManyDigits || std::find(short_sizes_.begin(), end, size) != end) return;
  *end = size;  // there is room: each adds one decimal or more
  ++n_short_sizes_;
  n_decimals_if_cut_ += kManyDigits - n_places;
}

bool WrittenDigits::exactness_tells() const {
  if (most_digits_ < kManyDigits || n_decimals_if_cut_ >= kTelling) return true;
  return n_exact_ * most_digits_ - n_exact_digits_ >= 3 * n_exact_;  // three zeros at the end of each
}

CoordinateDigits float_digits(double largest) {
  return {CoordinateDigits::Kind::floats, 0, unit_in_last_float_place(largest)};
}
CoordinateDigits double_digits(double largest) {
  return {CoordinateDigits::Kind::doubles, 0, unit_in_last_place(largest)};
}

}  // namespace vex
