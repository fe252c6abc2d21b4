#include "meshes/formats/gmsh_parts.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>
#include <string>

#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr const char* kWrite41 = "write it with Gmsh 4 as version 4.1, or as .ply or .stl";

}  // namespace

GmshElement gmsh_element(std::int64_t type) {
  // "MSH file format" of Gmsh's manual, where element types are numbered.
  static constexpr GmshElement kElements[] = {
      {},
      {1, 2, true},
      {2, 3, true},
      {2, 4, true},
      {3, 4, true},
      {3, 8, true},
      {3, 6, true},
      {3, 5, true},
      {1, 3, false},
      {2, 6, false},
      {2, 9, false},
      {3, 10, false},
      {3, 27, false},
      {3, 18, false},
      {3, 14, false},
      {0, 1, true},
      {2, 8, false},
      {3, 20, false},
      {3, 15, false},
      {3, 13, false},
      {2, 9, false},
      {2, 10, false},
      {2, 12, false},
      {2, 15, false},
      {2, 15, false},
      {2, 21, false},
      {1, 4, false},
      {1, 5, false},
      {1, 6, false},
      {3, 20, false},
      {3, 35, false},
      {3, 56, false},
  };
  if (type == 92) return {3, 64, false};
  if (type == 93) return {3, 125, false};
  return type >= 0 && type < std::ssize(kElements) ? kElements[static_cast<std::size_t>(type)] : GmshElement{};
}

void GmshNodes::add(std::int64_t number) {
  is_sorted_ = is_sorted_ && (nodes_.empty() || nodes_.back().number < number);
  nodes_.push_back({number, static_cast<std::uint32_t>(nodes_.size())});
}

std::optional<std::int64_t> GmshNodes::put_in_order() {
  if (is_sorted_) return std::nullopt;
  std::ranges::sort(nodes_, {}, &Node::number);
  const auto twice = std::ranges::adjacent_find(nodes_, {}, &Node::number);
  return twice == nodes_.end() ? std::nullopt : std::optional(twice->number);
}

std::optional<std::uint32_t> GmshNodes::find(std::int64_t number) const {
  if (nodes_.empty() || number < nodes_.front().number || number > nodes_.back().number) return std::nullopt;
  const auto from_first = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(nodes_.front().number);
  if (from_first < nodes_.size() && nodes_[from_first].number == number) return nodes_[from_first].index;  // no gaps
  const auto found = std::ranges::lower_bound(nodes_, number, {}, &Node::number);
  return found->number == number ? std::optional(found->index) : std::nullopt;
}

GmshVersion read_gmsh_format(MixedScanner* scanner) {
  GmshVersion version = GmshVersion::v41;
  std::string_view word = scanner->next_word();
  while (word.starts_with('$') && word != "$MeshFormat" && word != "$NOD") {  // $Comments may come first
    skip_gmsh_section(scanner, word);
    word = scanner->next_word();
  }
  if (word == "$NOD") scanner->refuse("this is version 1 of Gmsh's format", "version 2 or 4.1", kWrite41);
  if (word != "$MeshFormat") {
    scanner->refuse("it does not begin like a .msh file of Gmsh", "$MeshFormat",
                    "check that its extension names its format");
  }
  const std::string_view number = scanner->next_word();
  if (number == "2" || number == "2.0" || number == "2.1" || number == "2.2") {
    version = GmshVersion::v2;
  } else if (number == "4" || number == "4.0") {
    version = GmshVersion::v40;
  } else if (number == "4.1") {
    version = GmshVersion::v41;
  } else {
    scanner->refuse(quoted(number) + " is no version that is read", "2, 2.1, 2.2, 4, 4.0 or 4.1", kWrite41);
  }
  const bool is_binary = scanner->whole_word("0 for text or 1 for binary", 0, 1) == 1;
  const std::int64_t size = scanner->whole_word("the size of numbers, 8 bytes", 4, 8);
  if (is_binary) {
    if (size != 8) scanner->refuse("numbers of " + std::to_string(size) + " bytes", "8 bytes", kWrite41);
    scanner->end_line("the end of the line behind the size of numbers");
    scanner->set_encoding(Encoding::little_endian);
    const std::string_view one =
        scanner->take(1, size_of(ScalarType::int32), "the number 1, to show the order of bytes");
    if (load_whole(one.data(), ScalarType::int32, std::endian::native == std::endian::big) != 1) {
      scanner->set_encoding(Encoding::big_endian);
      if (load_whole(one.data(), ScalarType::int32, std::endian::native == std::endian::little) != 1) {
        scanner->refuse("the order of bytes cannot be told", "the number 1 in four bytes");
      }
    }
  }
  end_gmsh_section(scanner, "$EndMeshFormat");
  return version;
}

void end_gmsh_section(MixedScanner* scanner, std::string_view end) {
  const std::string_view word = scanner->next_word();
  if (word != end) {
    scanner->refuse((word.empty() ? "the file ends early" : quoted(word) + " is out of place"), quoted(end));
  }
}

void skip_gmsh_section(MixedScanner* scanner, std::string_view begin) {
  const std::string end = "\n$End" + std::string(begin.substr(1));
  const std::string_view rest = scanner->rest();
  const std::size_t at = rest.find(scanner->is_text() && rest.find('\n') == rest.npos ? '\r' + end.substr(1) : end);
  if (at == rest.npos) scanner->refuse("the section " + quoted(begin) + " does not end", vex::quoted(end.substr(1)));
  scanner->back_to(rest.substr(at));
  end_gmsh_section(scanner, std::string_view(end).substr(1));
}

}  // namespace vex
