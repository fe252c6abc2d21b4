#include "meshes/formats/gltf_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <system_error>
#include <utility>

#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

void append_utf8(std::uint32_t code, std::string* text) {
  const auto put = [text](std::uint32_t byte) { text->push_back(static_cast<char>(static_cast<unsigned char>(byte))); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0U | code >> 6U), put(0x80U | (code & 63U));
  } else if (code < 0x10000) {
    put(0xE0U | code >> 12U), put(0x80U | (code >> 6U & 63U)), put(0x80U | (code & 63U));
  } else {
    put(0xF0U | code >> 18U), put(0x80U | (code >> 12U & 63U)), put(0x80U | (code >> 6U & 63U));
    put(0x80U | (code & 63U));
  }
}

/// The text that a JSON string, without its quotes, stands for; an escape that is none stays as it is.
std::string unescaped(std::string_view raw) {
  std::string text;
  const auto code_at = [raw](std::size_t at) -> std::int64_t {  // of \uXXXX; -1 where there is none
    if (at + 6 > raw.size() || raw[at] != '\\' || raw[at + 1] != 'u') return -1;
    std::int64_t code = 0;
    for (std::size_t k = at + 2; k < at + 6; ++k) {
      if (hex_digit(raw[k]) < 0) return -1;
      code = 16 * code + hex_digit(raw[k]);
    }
    return code;
  };
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\' || i + 1 == raw.size()) {
      text += raw[i];
      continue;
    }
    if (const std::int64_t code = code_at(i); code >= 0) {
      const std::int64_t low = code_at(i + 6);
      const bool is_pair = code >= 0xD800 && code < 0xDC00 && low >= 0xDC00 && low < 0xE000;
      append_utf8(static_cast<std::uint32_t>(is_pair ? 0x10000 + (code - 0xD800) * 0x400 + (low - 0xDC00) : code),
                  &text);
      i += is_pair ? 11 : 5;
      continue;
    }
    constexpr std::string_view kEscapes = "bfnrt", kMeanings = "\b\f\n\r\t";
    const char c = raw[++i];
    const std::size_t k = kEscapes.find(c);
    text += k == std::string_view::npos ? c : kMeanings[k];
  }
  return text;
}

/// Goes through the document once; keeps, of what lies above the current value, the outer three levels.
class Walker {
 public:
  explicit Walker(std::string_view json) : json_(json) {}

  std::optional<GltfSummary> summary() {
    if (!walk()) return std::nullopt;
    if (has_old_buffers_ && summary_.version.empty()) summary_.version = "1.0";
    const auto misread = std::ranges::find_if(uses_, [this](const Use& use) { return !is_readable(use); });
    if (misread != uses_.end()) {
      summary_.misread_accessor =
          std::string(misread->is_positions ? "POSITION" : "indices") + ", accessor " + quoted(misread->accessor);
    }
    return std::move(summary_);
  }

 private:
  struct Level {
    bool is_object = false;
    std::string_view key;  // of the member at hand
  };
  static constexpr std::size_t kDeepest = 1000;
  // {"buffer":0,"byteLength":1} is the least part of a buffer that means anything.
  static constexpr std::size_t kLeastPart = 24, kMostExtensions = 1000;
  struct Accessor {
    std::string_view component_type, type;
    std::optional<std::uint64_t> count, byte_offset = 0, view;
  };
  struct View {
    std::optional<std::uint64_t> byte_length, byte_stride = 0;
  };
  struct Use {
    bool is_positions = false;
    std::string_view accessor;
  };

  static std::optional<std::uint64_t> whole_number(std::string_view text) {
    std::uint64_t number = 0;
    const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || last != text.data() + text.size()) return std::nullopt;
    return number;
  }

  /// assimp copies an element's bytes as if they were of the type that it expects, from wherever it is told to.
  bool is_readable(const Use& use) const {
    const std::optional<std::uint64_t> k = whole_number(use.accessor);
    if (!k || *k >= accessors_.size()) return false;
    const Accessor& accessor = accessors_[*k];
    const bool is_float = accessor.component_type == "5126", is_byte = accessor.component_type == "5121",
               is_short = accessor.component_type == "5123", is_int = accessor.component_type == "5125";
    if (use.is_positions ? !is_float || accessor.type != "VEC3"
                         : !(is_byte || is_short || is_int) || accessor.type != "SCALAR") {
      return false;
    }
    const std::uint64_t component = is_byte ? 1 : is_short ? 2 : 4;
    return !accessor.view || is_within_view(accessor, component, use.is_positions ? 3 * component : component);
  }

  bool is_within_view(const Accessor& accessor, std::uint64_t component, std::uint64_t element) const {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 40U;  // of each number: so that no sum overflows
    if (*accessor.view >= views_.size()) return false;
    const View& view = views_[*accessor.view];
    if (!accessor.count || !accessor.byte_offset || !view.byte_length || !view.byte_stride) return false;
    if (*accessor.count > kMost || *accessor.byte_offset > kMost || *view.byte_stride > 252) return false;
    const std::uint64_t stride = *view.byte_stride == 0 ? element : *view.byte_stride;
    if (stride < element || stride % component != 0 || *accessor.byte_offset % component != 0) return false;
    return *accessor.count == 0 ||
           *accessor.byte_offset + (*accessor.count - 1) * stride + element <= *view.byte_length;
  }

  bool walk() {
    bool has_value = false;  // the value before the next comma or end has been seen
    while (true) {
      at_ = json_.find_first_not_of(" \t\r\n", at_);
      if (at_ == std::string_view::npos) return levels_.empty() && has_value && !has_too_many_parts();
      const char c = json_[at_];
      if (c == '{' || c == '[') {
        if (has_value || levels_.size() == kDeepest || has_too_many_parts()) return false;
        has_old_buffers_ = has_old_buffers_ || (c == '{' && path_is("buffers") && levels_.size() == 1);
        if (c == '{' && path_is("accessors") && levels_.size() == 2) accessors_.emplace_back();
        if (c == '{' && path_is("bufferViews") && levels_.size() == 2) views_.emplace_back();
        if (c == '{' && path_is("nodes") && levels_.size() == 2) has_matrix_ = has_parts_ = false;
        if (levels_.size() == 3 && n_of_transform() > 0) transform_.clear();
        levels_.push_back({c == '{', {}});
        ++at_;
      } else if (c == '}' || c == ']') {
        if (levels_.empty() || levels_.back().is_object != (c == '}')) return false;
        if (levels_.size() == 4 && n_of_transform() > 0) check_transform();
        levels_.pop_back();
        has_value = true;
        ++at_;
      } else if (c == ',') {
        if (!has_value || levels_.empty()) return false;
        has_value = false;
        ++at_;
      } else if (c == '"') {
        std::string_view text;
        if (has_value || !read_string(&text)) return false;
        if (!levels_.empty() && levels_.back().is_object && is_followed_by_colon()) {
          levels_.back().key = meant_by(text);
          note_unread(levels_.back().key);
        } else {
          take(text, true);
          has_value = true;
        }
      } else {
        const std::size_t end = std::min(json_.find_first_of(",]} \t\r\n", at_), json_.size());
        if (has_value || end == at_) return false;
        take(json_.substr(at_, end - at_), false);
        has_value = true;
        at_ = end;
      }
    }
  }

  bool has_too_many_parts() const {
    return accessors_.size() + views_.size() > 1000 + at_ / kLeastPart ||
           summary_.required_extensions.size() > kMostExtensions;
  }

  bool read_string(std::string_view* text) {
    const std::size_t begin = at_ + 1;
    std::size_t end = at_;
    bool is_escaped = true;
    while (is_escaped) {  // by an odd number of backslashes before the quote
      end = json_.find('"', end + 1);
      if (end == std::string_view::npos) return false;
      const std::size_t before = json_.find_last_not_of('\\', end - 1);  // the opening quote at least
      is_escaped = (end - 1 - before) % 2 == 1;
    }
    *text = json_.substr(begin, end - begin);
    at_ = end + 1;
    return true;
  }

  /// A string without its escapes. It lives as long as this.
  std::string_view meant_by(std::string_view raw) {
    return raw.find('\\') == std::string_view::npos ? raw : kept_.emplace_back(unescaped(raw));
  }

  bool is_followed_by_colon() {
    const std::size_t next = json_.find_first_not_of(" \t\r\n", at_);
    if (next == std::string_view::npos || json_[next] != ':') return false;
    at_ = next + 1;
    return true;
  }

  /// How many numbers there must be in what is at hand: 0 where that is no transform of a node.
  std::size_t n_of_transform() const {
    if (levels_.size() < 3 || !path_is("nodes")) return 0;
    const std::string_view key = levels_[2].key;
    return key == "matrix" ? 16 : key == "rotation" ? 4 : key == "scale" || key == "translation" ? 3 : 0;
  }
  void take_of_transform(std::string_view raw) {
    double number = 0.0;
    const auto [last, error] = std::from_chars(raw.data(), raw.data() + raw.size(), number);
    transform_.push_back(error == std::errc() && last == raw.data() + raw.size() ? number : HUGE_VAL);
  }
  /// assimp passes over a list of another length, and makes of a quaternion whose length is not 1 a matrix that also
  /// stretches.
  void check_transform() {
    const auto is_number = [](double x) { return std::isfinite(x); };
    if (transform_.size() != n_of_transform() || !std::ranges::all_of(transform_, is_number)) {
      refuse_transform();
    } else if (levels_[2].key == "rotation") {
      double square = 0.0;
      for (const double x : transform_) square += x * x;
      constexpr double kTolerance = 4e-6;  // of floats in seven digits
      if (!(std::fabs(square - 1.0) <= kTolerance))
        summary_.unread = "a rotation by a quaternion whose length is not 1";
    }
  }
  void refuse_transform() {
    summary_.unread =
        "a node's " + std::string(levels_[2].key) + " that is not " + std::to_string(n_of_transform()) + " numbers";
  }

  bool path_is(std::string_view first) const { return !levels_.empty() && levels_[0].key == first; }

  void note_unread(std::string_view key) {
    if (levels_.size() == 3 && path_is("nodes") && key == "skin") summary_.unread = "skins";
    if (levels_.size() == 3 && n_of_transform() > 0) {
      (key == "matrix" ? has_matrix_ : has_parts_) = true;
      if (has_matrix_ && has_parts_) summary_.unread = "a node with a matrix and parts of one";
    }
    if (key == "EXT_mesh_gpu_instancing" && path_is("nodes")) summary_.unread = "instances on the graphics processor";
  }

  void take(std::string_view raw, bool is_string) {
    // Weights of morph targets: of a mesh, or of a node that shows it.
    if (levels_.size() == 4 && (path_is("nodes") || path_is("meshes")) && levels_[2].key == "weights" && !is_string &&
        raw.substr(0, raw.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos) {
      summary_.unread = "morph targets";
    }
    if (levels_.size() == 3 && path_is("accessors") && !accessors_.empty()) {
      Accessor& accessor = accessors_.back();
      if (levels_[2].key == "componentType" && !is_string) accessor.component_type = raw;
      if (levels_[2].key == "type" && is_string) accessor.type = meant_by(raw);
      if (levels_[2].key == "count") accessor.count = whole_number(raw);
      if (levels_[2].key == "byteOffset") accessor.byte_offset = whole_number(raw);
      if (levels_[2].key == "bufferView") accessor.view = whole_number(raw).value_or(views_.max_size());
    }
    if (levels_.size() == 3 && path_is("bufferViews") && !views_.empty()) {
      if (levels_[2].key == "byteLength") views_.back().byte_length = whole_number(raw);
      if (levels_[2].key == "byteStride") views_.back().byte_stride = whole_number(raw);
    }
    if (levels_.size() == 3 && n_of_transform() > 0) refuse_transform();
    if (levels_.size() == 4 && n_of_transform() > 0) take_of_transform(is_string ? "" : raw);
    if (path_is("meshes") && levels_.size() >= 5 && levels_[2].key == "primitives") {
      const bool is_positions = levels_.size() == 6 && levels_[4].key == "attributes" && levels_[5].key == "POSITION";
      if (is_positions || (levels_.size() == 5 && levels_[4].key == "indices")) uses_.push_back({is_positions, raw});
    }
    if (levels_.size() == 2 && path_is("asset") && levels_[1].key == "version") {
      summary_.version = is_string ? unescaped(raw) : std::string(raw);
    } else if (levels_.size() == 2 && path_is("extensionsRequired") && is_string) {
      if (!has_too_many_parts()) summary_.required_extensions.push_back(unescaped(raw));
    } else if (levels_.size() == 3 && path_is("buffers") && levels_[2].key == "uri" && is_string &&
               !raw.starts_with("data:")) {
      summary_.buffer_uris.push_back(unescaped(raw));
    }
  }

  std::string_view json_;
  std::size_t at_ = 0;
  std::vector<Level> levels_;
  GltfSummary summary_;
  std::deque<Accessor> accessors_;
  std::deque<View> views_;
  std::vector<double> transform_;  // a list of the node at hand, as far as it was read
  bool has_matrix_ = false;        // the node at hand
  bool has_parts_ = false;         // the same: a rotation, a scale or a translation
  std::vector<Use> uses_;          // by the meshes
  std::deque<std::string> kept_;   // words that stand with escapes in the document, as they are meant
  bool has_old_buffers_ = false;   // glTF 1 has objects by name where glTF 2 has arrays
};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  return value;
}

}  // namespace

std::optional<GltfSummary> gltf_summary(std::string_view json) {
  if (json.starts_with("\xEF\xBB\xBF")) json.remove_prefix(3);
  return Walker(json).summary();
}

std::optional<unsigned> glb_version(std::string_view bytes) {
  if (bytes.size() < 12 || !bytes.starts_with("glTF")) return std::nullopt;
  return number_at(bytes, 4);
}

std::optional<std::string_view> glb_document(std::string_view bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (glb_version(bytes) != 2U || bytes.size() < kHeader + kChunkHeader) return std::nullopt;
  const std::size_t size = number_at(bytes, kHeader);
  constexpr std::uint32_t kJson = 0x4E4F534A;
  if (number_at(bytes, kHeader + 4) != kJson || bytes.size() - kHeader - kChunkHeader < size) return std::nullopt;
  std::string_view document = bytes.substr(kHeader + kChunkHeader, size);
  const std::size_t end = document.find_last_not_of(std::string_view(" \0", 2));  // what pads it to four bytes
  return document.substr(0, end == std::string_view::npos ? 0 : end + 1);
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
      text += static_cast<char>(static_cast<unsigned char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace vex
