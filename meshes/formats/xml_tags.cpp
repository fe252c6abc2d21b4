#include "meshes/formats/xml_tags.h"

#include <algorithm>

#include "engine/numeric/interruption.h"

namespace vex {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string_view without_blanks_before(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && is_blank(text[n])) ++n;
  return text.substr(n);
}

/// What stands before the first blank.
std::string_view word_before_blank(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && !is_blank(text[n])) ++n;
  return text.substr(0, n);
}

}  // namespace

std::optional<std::string_view> XmlTag::attribute(std::string_view wanted) const {
  std::string_view rest = without_blanks_before(attributes);
  while (!rest.empty()) {
    const std::size_t equals = rest.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const std::string_view name_found = word_before_blank(rest.substr(0, equals));
    rest = without_blanks_before(rest.substr(equals + 1));
    if (rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return std::nullopt;
    const std::size_t end = rest.find(rest[0], 1);
    if (end == std::string_view::npos) return std::nullopt;
    if (name_found == wanted) return rest.substr(1, end - 1);
    rest = without_blanks_before(rest.substr(end + 1));
  }
  return std::nullopt;
}

bool XmlTags::skip_past(std::string_view end) {
  const std::size_t found = text_.find(end, at_);
  at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  return found != std::string_view::npos;
}

std::optional<XmlTag> XmlTags::next() {
  while (skip_past("<")) {
    if (++n_tags_ % 256 == 0) end_if_interrupted();
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("!--")) {
      at_ += 3;
      if (!skip_past("-->")) return std::nullopt;
    } else if (rest.starts_with("![CDATA[")) {
      if (!skip_past("]]>")) return std::nullopt;
    } else if (rest.starts_with("!")) {
      int depth = 1;  // a document type may hold declarations of its own
      while (depth > 0) {
        at_ = text_.find_first_of("<>", at_);
        if (at_ == std::string_view::npos) {
          at_ = text_.size();
          return std::nullopt;
        }
        depth += text_[at_++] == '<' ? 1 : -1;
      }
    } else if (rest.starts_with("?")) {
      if (!skip_past("?>")) return std::nullopt;
    } else {
      const std::size_t begin = at_;
      char quote = '\0';
      while (at_ < text_.size() && (quote != '\0' || text_[at_] != '>')) {
        const char c = text_[at_++];
        if (quote == '\0' && (c == '"' || c == '\'')) {
          quote = c;
        } else if (c == quote) {
          quote = '\0';
        }
      }
      if (at_ == text_.size()) return std::nullopt;
      XmlTag tag;
      std::string_view inside = text_.substr(begin, at_++ - begin);
      if (inside.starts_with('/')) {
        tag.is_closing = true;
        inside.remove_prefix(1);
      } else if (inside.ends_with('/')) {
        tag.is_empty = true;
        inside.remove_suffix(1);
      }
      tag.name = word_before_blank(inside);
      tag.attributes = inside.substr(tag.name.size());
      return tag;
    }
  }
  return std::nullopt;
}

std::string_view XmlTags::text_behind() const {
  return text_.substr(at_, std::min(text_.find('<', at_), text_.size()) - at_);
}

}  // namespace vex
