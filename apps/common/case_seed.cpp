#include "apps/common/case_seed.h"

namespace vex {

std::uint64_t fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::uint64_t seed_of_text(std::uint64_t seed, const std::string& text) {
  // splitmix64 (S. Vigna) spreads what differs little.
  const auto mixed = [](std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  };
  return mixed(mixed(seed) ^ fingerprint(text)) >> 11;
}

}  // namespace vex
