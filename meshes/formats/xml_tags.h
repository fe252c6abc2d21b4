// The tags of an XML text, one after another: enough to find what a file says about itself. Nothing is copied.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace vex {

struct XmlTag {
  std::string_view name;
  std::string_view attributes;  // as written, between the name and the end of the tag
  bool is_closing = false;      // </name>
  bool is_empty = false;        // <name/>

  /// The value as written, entities unresolved, of the first attribute of that name.
  std::optional<std::string_view> attribute(std::string_view wanted) const;
};

class XmlTags {
 public:
  explicit XmlTags(std::string_view text) : text_(text) {}

  /// The next tag, comments, CDATA, declarations and processing instructions left out; nothing at the end, or where the
  /// text stops being XML.
  std::optional<XmlTag> next();
  /// What stands between the tag that next() gave last and the next "<".
  std::string_view text_behind() const;

 private:
  /// Goes behind the next `end`; false where there is none.
  bool skip_past(std::string_view end);

  std::string_view text_;
  std::size_t at_ = 0;
  unsigned n_tags_ = 0;
};

}  // namespace vex
