// Colours of bodies in a picture.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

namespace vex {

struct BodyColour {
  const char* name;
  std::array<double, 3> srgb;  // 0 to 1
};

/// Distinguishable with the usual colour blindnesses (M. Okabe, K. Ito, 2002).
inline constexpr BodyColour kBodyColours[] = {
    {"body", {0.56, 0.64, 0.72}},           {"stands out", {0.84, 0.37, 0.0}},
    {"undecided", {0.94, 0.89, 0.26}},      {"single", {0.83, 0.85, 0.88}},
    {"cluster, blue", {0.0, 0.45, 0.7}},    {"cluster, green", {0.0, 0.62, 0.45}},
    {"cluster, sky", {0.34, 0.71, 0.91}},   {"cluster, purple", {0.8, 0.47, 0.65}},
    {"cluster, violet", {0.42, 0.24, 0.6}}, {"cluster, olive", {0.5, 0.5, 0.2}},
};
inline constexpr std::uint8_t kPlain = 0, kStandsOut = 1, kUndecidedColour = 2, kSingle = 3, kFirstOfClusters = 4;
inline constexpr std::uint8_t kNBodyColours = std::size(kBodyColours);

}  // namespace vex
