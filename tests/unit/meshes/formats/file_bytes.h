// Mesh files put together in a test, and what was read from them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "meshes/polygon_soup.h"

namespace vex::tests {

/// A number as a binary file of this byte order stores it.
template <class T>
std::string stored(T value, std::endian order) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return bytes;
}

template <class T>
std::string stored_all(const std::vector<T>& values, std::endian order) {
  std::string bytes;
  for (const T& value : values) bytes += stored(value, order);
  return bytes;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

using Points = std::vector<std::array<double, 3>>;

inline Points points_of(const PolygonSoup& soup) {
  Points points;
  for (const Vec3d& p : soup.points) points.push_back({p.x, p.y, p.z});
  return points;
}

/// Of the body that the faces bound; fans from the origin, positive where they face outwards.
inline double soup_volume(const PolygonSoup& soup) {
  double sum = 0.0;
  std::size_t begin = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    const Vec3d& a = soup.points[soup.corners[begin]];
    for (std::size_t k = 1; k + 1 < size; ++k) {
      const Vec3d& b = soup.points[soup.corners[begin + k]];
      const Vec3d& c = soup.points[soup.corners[begin + k + 1]];
      sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    }
    begin += size;
  }
  return sum / 6.0;
}

}  // namespace vex::tests
