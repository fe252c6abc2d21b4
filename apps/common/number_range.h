// Numbers as a range of decimals: FROM, FROM + STEP, ... up to TO.
#pragma once

#include <string>
#include <vector>

namespace vex {

/// No scan has more cases, and so no range more numbers.
inline constexpr std::size_t kMostCases = 100000;

/// Of the text FROM:TO:STEP, each number as a decimal: 0:1:0.1 is 0, 0.1, ... 1, exactly, since sums are made of whole
/// multiples of the last digit and nothing is rounded. TO is among them where a whole number of steps leads there. STEP
/// may be negative, and is not 0. Throws UsageError, with `option` in the message, where the text is no such range,
/// leads away from TO, has more than kMostCases numbers, or more than 17 digits from the largest to the smallest.
std::vector<std::string> numbers_of_range(const std::string& text, const std::string& option);

}  // namespace vex
