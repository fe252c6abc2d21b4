#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/formats/scene_formats.h"
#include "meshes/formats/scene_parts.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/length_unit.h"

namespace vex {
namespace {

constexpr const char* kMendOrExport = "mend the file, or export it as .stl, .ply or .obj";

/// What an element must hold, once each.
struct Whole {
  std::string_view name;
  std::array<std::string_view, 3> parts;
  const NumberKind* kind = nullptr;  // of the parts' texts
};

/// assimp takes 0 for a coordinate that is not there, moves the numbers of the vertices behind one without coordinates,
/// and passes over a mesh's second volume.
constexpr std::array<Whole, 4> kWholes{{{"coordinates", {"x", "y", "z"}, &kDecimal},
                                        {"triangle", {"v1", "v2", "v3"}, &kIndex},
                                        {"vertex", {"coordinates", "", ""}},
                                        {"mesh", {"vertices", "volume", ""}}}};

/// What assimp passes over, or takes for something else.
struct Unread {
  std::string_view name, parent;
  const char* what;
};
constexpr std::array<Unread, 12> kUnread{{{"rx", "instance", "a turned instance"},  // read as a shift
                                          {"ry", "instance", "a turned instance"},
                                          {"rz", "instance", "a turned instance"},
                                          {"scale", "instance", "a scaled instance"},
                                          {"scalex", "instance", "a scaled instance"},
                                          {"scaley", "instance", "a scaled instance"},
                                          {"scalez", "instance", "a scaled instance"},
                                          {"mirrorx", "instance", "a mirrored instance"},
                                          {"mirrory", "instance", "a mirrored instance"},
                                          {"mirrorz", "instance", "a mirrored instance"},
                                          {"normal", "vertex", "a curved triangle"},
                                          {"edge", "vertices", "a curved triangle"}}};

/// Of a coordinate assimp takes the name in either case.
std::string_view in_lower_case(std::string_view name) {
  if (name == "X") return "x";
  if (name == "Y") return "y";
  return name == "Z" ? "z" : name;
}

/// The elements that a place in the file lies in.
class AmfCheck {
 public:
  explicit AmfCheck(const AssimpInput& input) : input_(input), text_(input.bytes.view()) {}

  void run() {
    XmlTags tags(text_);
    while (const std::optional<XmlTag> tag = tags.next()) {
      if (tag->is_closing) {
        close();
        continue;
      }
      look_at(*tag, tags.text_behind());
      if (open_.size() == kDeepest) {
        refuse_scene(input_, "elements lie more than " + std::to_string(kDeepest) + " deep in each other",
                     shown_name(tag->name), kMendOrExport);
      }
      open_.push_back({tag->name, whole_of(tag->name), {}});
      if (tag->is_empty) close();
    }
    check_ids();
  }

 private:
  static constexpr std::size_t kDeepest = 1000;
  struct Open {
    std::string_view name;
    const Whole* whole;
    std::array<std::size_t, 3> counts;
  };

  static const Whole* whole_of(std::string_view name) {
    const auto* const found = std::ranges::find(kWholes, name, &Whole::name);
    return found == kWholes.end() ? nullptr : found;
  }

  void look_at(const XmlTag& tag, std::string_view text_behind) {
    if (open_.empty()) return;
    Open& parent = open_.back();
    for (const Unread& unread : kUnread) {
      if (tag.name != unread.name || parent.name != unread.parent) continue;
      refuse_scene(input_, "the file holds " + std::string(unread.what) + ", which is not read",
                   shown_name(tag.name) + " in " + shown_name(parent.name), "export it as .stl, .ply or .obj");
    }
    if (open_.size() == 1 && (tag.name == "object" || tag.name == "constellation")) {
      ids_.push_back(tag.attribute("id").value_or(""));
    }
    if (parent.name == "instance" && tag.name.starts_with("delta")) check_number(tag, text_behind, kDecimal);
    if (parent.whole == nullptr) return;
    const auto& parts = parent.whole->parts;
    const auto* const part = std::ranges::find(parts, in_lower_case(tag.name));
    if (part == parts.end()) return;
    ++parent.counts[static_cast<std::size_t>(part - parts.begin())];
    if (parent.whole->kind != nullptr) check_number(tag, text_behind, *parent.whole->kind);
  }

  /// assimp takes half and nothing for 0, 1,5 for 1, and of 1<!-- -->5 the 1.
  void check_number(const XmlTag& tag, std::string_view text_behind, const NumberKind& kind) const {
    const std::string_view text = tag.is_empty ? "" : text_behind;
    const std::string_view word = from_word(text);
    const std::string_view number = word.substr(0, word.find_last_not_of(kXmlBlanks) + 1);
    const auto end = static_cast<std::size_t>(text_behind.data() + text_behind.size() - text_.data());
    if (kind.holds(number) && text_.substr(end).starts_with("</")) return;
    refuse_scene(input_, shown(number) + " is not " + kind.name,
                 shown_name(tag.name) + " in " + shown_name(open_.back().name) + ": expected " + kind.name + " alone",
                 "mend the file");
  }

  void close() {
    if (open_.empty()) return;
    const Open closed = open_.back();
    open_.pop_back();
    if (closed.whole == nullptr) return;
    for (std::size_t k = 0; k < closed.counts.size(); ++k) {
      const std::string_view part = closed.whole->parts[k];
      if (part.empty() || closed.counts[k] == 1) continue;
      refuse_scene(input_,
                   shown_name(closed.name) + " has " + std::to_string(closed.counts[k]) + " of " + shown_name(part),
                   "expected one", kMendOrExport);
    }
  }

  /// Of two objects or constellations of one name, assimp drops one.
  void check_ids() const {
    std::set<std::string_view> taken;
    for (const std::string_view id : ids_) {
      const bool is_new = taken.insert(id).second;
      if (ids_.size() == 1 || (is_new && !id.empty() && id.find('&') == std::string_view::npos)) continue;
      refuse_scene(input_, "the objects are not told apart by their names", "id=" + shown(id), "mend the file");
    }
  }

  const AssimpInput& input_;
  std::string_view text_;
  std::vector<Open> open_;
  std::vector<std::string_view> ids_;
};

}  // namespace

void look_into_amf(AssimpInput* input) {
  const std::optional<XmlTag> tag = first_tag(input->bytes.view());
  if (!tag || tag->name != "amf") {
    refuse_scene(*input, "the file is no AMF in UTF-8, or is damaged", "it does not begin with <amf>",
                 "fetch or export it again");
  }
  set_unit(parse_length_unit(tag->attribute("unit").value_or("millimeter")), input);
  AmfCheck(*input).run();
}

}  // namespace vex
