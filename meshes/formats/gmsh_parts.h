// What Gmsh's files are put together from: sections, kinds of elements, and nodes with numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "meshes/formats/mixed_scanner.h"

namespace vex {

enum class GmshVersion : std::uint8_t { v2, v40, v41 };

/// The section $MeshFormat, and sections before it. Sets the scanner's encoding.
GmshVersion read_gmsh_format(MixedScanner* scanner);

/// The word `end`, $EndNodes say, must be the next.
void end_gmsh_section(MixedScanner* scanner, std::string_view end);

/// From behind the word `begin`, $Periodic say, to behind that section's end. A section of text cannot hold a line that
/// looks like its end; in a binary one that would be a strange accident, and what follows would be refused.
void skip_gmsh_section(MixedScanner* scanner, std::string_view begin);

struct GmshElement {
  int n_dimensions = 0;  // 0 for points, 3 for volumes
  int n_nodes = 0;       // 0 for a kind that is not known
  bool is_flat = true;   // no nodes but its corners
};

/// By the number that the format gives each kind.
GmshElement gmsh_element(std::int64_t type);

/// Nodes by their numbers, which come in any order and with gaps.
class GmshNodes {
 public:
  /// The next node, counted from 0.
  void add(std::int64_t number);
  /// After the last one was added, before find: a number that two nodes have.
  std::optional<std::int64_t> put_in_order();
  /// Which node it is.
  std::optional<std::uint32_t> find(std::int64_t number) const;

 private:
  struct Node {
    std::int64_t number = 0;
    std::uint32_t index = 0;
  };
  std::vector<Node> nodes_;
  bool is_sorted_ = true;
};

}  // namespace vex
