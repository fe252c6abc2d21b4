// Binary glTF 2.0: a JSON document and the numbers that it names, in one file.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "engine/numeric/vec3.h"

namespace vex {

class GlbFile {
 public:
  /// No file is larger: viewers hold it in memory several times.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

  GlbFile();

  /// Everything but the numbers.
  nlohmann::ordered_json& document() { return document_; }
  /// Appends to the array `document()[key]`, and tells its place there.
  std::size_t add(const char* key, nlohmann::ordered_json entry);

  /// Accessors: 32-bit numbers, with the bounds that they have when rounded to these. Throws InputError where the file
  /// becomes too large.
  std::size_t add_vectors(std::span<const Vec3d> vectors, bool of_vertices);
  std::size_t add_quaternions(std::span<const std::array<double, 4>> xyzw);
  std::size_t add_indices(std::span<const std::uint32_t> indices, std::size_t n_points);

  /// The whole file.
  std::string text() const;

 private:
  std::size_t add_floats(std::span<const double> numbers, std::size_t n_columns, const char* type, bool of_vertices);
  std::size_t add_view(std::size_t begin, int target);
  void require_room(std::size_t n_bytes) const;

  nlohmann::ordered_json document_;
  std::string numbers_;
};

}  // namespace vex
