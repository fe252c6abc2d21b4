#include "meshes/formats/ply_header.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr bool is_blank_of_header(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r'; }

struct PlyType {
  std::string_view name;
  ScalarType type;
};
constexpr PlyType kPlyTypes[] = {
    {"char", ScalarType::int8},       {"int8", ScalarType::int8},       {"uchar", ScalarType::uint8},
    {"uint8", ScalarType::uint8},     {"short", ScalarType::int16},     {"int16", ScalarType::int16},
    {"ushort", ScalarType::uint16},   {"uint16", ScalarType::uint16},   {"int", ScalarType::int32},
    {"int32", ScalarType::int32},     {"uint", ScalarType::uint32},     {"uint32", ScalarType::uint32},
    {"float", ScalarType::float32},   {"float32", ScalarType::float32}, {"double", ScalarType::float64},
    {"float64", ScalarType::float64},
};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {
    if (bytes_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    const std::size_t end = bytes_.find_first_of("\r\n", at_);
    if (end != std::string_view::npos && bytes_[end] == '\r' && !bytes_.substr(end).starts_with("\r\n")) {
      line_end_ = '\r';
    }
  }

  PlyHeader read() {
    next_line();
    if (line_ != "ply") refuse("it does not begin like a .ply file", "the word ply alone in the first line", kAdvice);
    next_line();
    PlyHeader header;
    header.encoding = format();
    while (next_line(), line_ != "end_header") {
      const std::string_view keyword = next_word();
      if (keyword == "element") {
        header.elements.push_back(element(header));
      } else if (keyword == "property") {
        if (header.elements.empty()) refuse("a property stands before any element", "an element");
        add_property(&header.elements.back());
      } else if (keyword == "format") {
        refuse("a second format", "one line that names it");
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        refuse(quoted(keyword) + " is no word of a .ply header", "element, property, comment, obj_info or end_header");
      }
    }
    for (const PlyElement& e : header.elements) {
      if (e.n > 0 && e.properties.empty()) refuse("the element " + quoted(e.name) + " has no property", "one at least");
    }
    header.n_bytes = at_;
    return header;
  }

 private:
  static constexpr const char* kAdvice = "check that its extension names its format";

  void next_line() {
    ++line_number_;
    const std::size_t end = bytes_.find(line_end_, at_);
    if (at_ >= bytes_.size() || end == std::string_view::npos) {
      line_ = {};
      refuse("the header does not end", "a line end_header", line_number_ == 1 ? kAdvice : "mend the file");
    }
    line_ = bytes_.substr(at_, end - at_);
    while (!line_.empty() && is_blank_of_header(line_.back())) line_.remove_suffix(1);
    while (!line_.empty() && is_blank_of_header(line_.front())) line_.remove_prefix(1);
    rest_ = line_;
    at_ = end + 1;
  }

  std::string_view next_word() {
    while (!rest_.empty() && is_blank_of_header(rest_.front())) rest_.remove_prefix(1);
    const auto end = std::find_if(rest_.begin(), rest_.end(), is_blank_of_header);
    const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(word.size());
    return word;
  }

  Encoding format() {
    while (line_.starts_with("comment") || line_.starts_with("obj_info")) next_line();
    constexpr const char* kExpected =
        "format ascii 1.0, format binary_little_endian 1.0 or format binary_big_endian 1.0";
    const std::string_view keyword = next_word();
    const std::string_view encoding = next_word();
    const std::string_view version = next_word();
    const bool is_text = encoding == "ascii";
    const bool is_little = encoding == "binary_little_endian";
    if (keyword != "format" || version != "1.0" || !next_word().empty() ||
        !(is_text || is_little || encoding == "binary_big_endian")) {
      refuse(quoted(line_) + " names no format that is known", kExpected);
    }
    if (is_text) return Encoding::text;
    return is_little ? Encoding::little_endian : Encoding::big_endian;
  }

  PlyElement element(const PlyHeader& header) {
    PlyElement result;
    result.name = next_word();
    const std::string_view count = next_word();
    const char* const end = count.data() + count.size();
    const auto [stop, error] = std::from_chars(count.data(), end, result.n);
    if (count.empty() || stop != end || error != std::errc{} || !next_word().empty()) {
      refuse(quoted(line_) + " names no element and its number", "element NAME NUMBER");
    }
    const bool is_known = result.name == "vertex" || result.name == "face" || result.name == "tristrips";
    if (is_known && header.element(result.name) != nullptr) {
      refuse("the element " + quoted(result.name) + " stands there twice", "each element once");
    }
    return result;
  }

  ScalarType type() {
    const std::string_view word = next_word();
    for (const PlyType& known : kPlyTypes) {
      if (word == known.name) return known.type;
    }
    refuse(quoted(word) + " is no type of a number", "char, uchar, short, ushort, int, uint, float or double");
  }

  void add_property(PlyElement* element) {
    PlyProperty result;
    const std::string_view before_type = rest_;
    if (next_word() == "list") {
      result.count_type = type();
      if (!is_whole(*result.count_type)) refuse("a list whose length is no whole number", "a type of whole numbers");
    } else {
      rest_ = before_type;
    }
    result.type = type();
    result.name = next_word();
    if (result.name.empty() || !next_word().empty()) refuse(quoted(line_) + " names no property", "one name");
    for (const std::string_view once : {"x", "y", "z", "vertex_indices", "vertex_index"}) {
      if (result.name == once && element->property(once) != nullptr) {
        refuse("the property " + quoted(once) + " stands there twice", "each property once");
      }
    }
    element->properties.push_back(result);
  }

  [[noreturn]] void refuse(const std::string& problem, const std::string& expected,
                           const std::string& advice = "mend the file") const {
    refuse_text(name_, line_number_, problem, expected, advice);
  }

  std::string_view bytes_;
  std::string name_;
  char line_end_ = '\n';
  std::size_t at_ = 0;  // the next line
  std::size_t line_number_ = 0;
  std::string_view line_;
  std::string_view rest_;  // of the line
};

template <class Named>
const Named* find_named(const std::vector<Named>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Named::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

const PlyProperty* PlyElement::property(std::string_view property_name) const {
  return find_named(properties, property_name);
}

bool PlyElement::has_list() const {
  return std::ranges::any_of(properties, [](const PlyProperty& p) { return p.count_type.has_value(); });
}

const PlyElement* PlyHeader::element(std::string_view element_name) const { return find_named(elements, element_name); }

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) { return HeaderReader(bytes, name).read(); }

}  // namespace vex
