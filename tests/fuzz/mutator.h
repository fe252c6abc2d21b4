// Files changed as broken writers, disks and hands change them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace vex::tests {

/// A number from the environment, so that a test can be made a campaign.
inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// Changes a file in one to four places, each in a way that readers are known to mind.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string mutated(std::string bytes) {
    for (std::size_t n = 1 + below(2) * below(4); n > 0 && !bytes.empty(); --n) {
      mutate(&bytes);
    }
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % std::max<std::size_t>(n, 1)); }
  char byte() { return static_cast<char>(static_cast<unsigned char>(random_() & 0xFFU)); }

  void mutate(std::string* bytes) {
    const std::size_t at = below(bytes->size());
    switch (below(9)) {
      case 0:  // one bit
        (*bytes)[at] = static_cast<char>((*bytes)[at] ^ static_cast<char>(1U << below(8)));
        break;
      case 1:  // one byte
        (*bytes)[at] = byte();
        break;
      case 2:  // cut short
        bytes->resize(at);
        break;
      case 3:  // a piece out
        bytes->erase(at, 1 + below(40));
        break;
      case 4:  // a piece twice
        bytes->insert(at, bytes->substr(below(bytes->size()), 1 + below(200)));
        break;
      case 5:  // four bytes of a large or a special number
        for (std::size_t i = 0; i < 4 && at + i < bytes->size(); ++i) {
          (*bytes)[at + i] = static_cast<char>(below(2) == 0 ? 0xFF : 0x7F);
        }
        break;
      case 6:  // another number where there is one
        replace_number(at, bytes);
        break;
      case 7:  // another digit where there is one: most of these files read well, and say something else
        replace_digit(at, bytes);
        break;
      default:  // a run of one byte
        bytes->insert(at, std::string(below(300), byte()));
    }
  }

  void replace_digit(std::size_t from, std::string* bytes) {
    const std::size_t digit = bytes->find_first_of("0123456789", from);
    if (digit != std::string::npos) (*bytes)[digit] = static_cast<char>('0' + below(10));
  }

  void replace_number(std::size_t from, std::string* bytes) {
    static const std::vector<std::string> kNumbers{"0",     "-1",   "4294967295", "4294967296", "99999999999999999999",
                                                   "1e400", "nan",  "-inf",       "1e-400",     "2147483648",
                                                   "65536", "1.5e", "",           "0x10",       "1,5"};
    const std::size_t begin = bytes->find_first_of("0123456789", from);
    if (begin != std::string::npos) {
      const std::size_t end = bytes->find_first_not_of("0123456789.eE+-", begin);
      bytes->replace(begin, (end == std::string::npos ? bytes->size() : end) - begin, kNumbers[below(kNumbers.size())]);
    }
  }

  std::mt19937_64 random_;
};

}  // namespace vex::tests
