#include "apps/common/help_formatter.h"

#include <sstream>

namespace vex {
namespace {

constexpr std::size_t kScreenWidth = 80;
// help2man takes a line for the explanation of the tag above it only if it is indented by 20 or more.
constexpr std::size_t kExplanationColumn = 26;

/// Appends the words of `text`; `column` is where the last line ends, further lines begin at `indent`.
void append_wrapped(std::string& out, const std::string& text, std::size_t column, std::size_t indent) {
  std::istringstream words(text);
  bool line_begins = true;
  for (std::string word; words >> word; line_begins = false) {
    if (!line_begins && column + 1 + word.size() >= kScreenWidth) {
      out += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!line_begins) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
  }
  out += '\n';
}

std::string tagged(const std::string& tag, const std::string& explanation) {
  std::string out = "  " + tag;
  if (explanation.empty()) return out + '\n';
  if (out.size() + 2 > kExplanationColumn) {
    out += '\n' + std::string(kExplanationColumn, ' ');
  } else {
    out.resize(kExplanationColumn, ' ');
  }
  append_wrapped(out, explanation, kExplanationColumn, kExplanationColumn);
  return out;
}

}  // namespace

std::string HelpFormatter::make_description(const CLI::App* app) const {
  std::string out;
  append_wrapped(out, app->get_description(), 0, 0);
  return out;
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  return "\n" + CLI::Formatter::make_usage(app, std::move(name)) + "\n";
}

std::string HelpFormatter::make_option_usage(const CLI::Option* option) const {
  const std::string usage = CLI::Formatter::make_option_usage(option);
  return option->get_type_name() == "..." ? usage + " ..." : usage;
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  std::string out = group + ":\n";
  for (const CLI::Option* option : options) out += make_option(option, is_positional);
  return is_positional ? out + '\n' : out;  // between the others CLI11 puts an empty line itself
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string tag = option->get_name(is_positional, !is_positional);
  for (std::size_t at = tag.find(','); at != std::string::npos; at = tag.find(',', at + 2)) tag.insert(at + 1, " ");
  if (option->get_type_size() != 0 && !option->get_type_name().empty()) tag += ' ' + option->get_type_name();
  return tagged(tag, option->get_description());
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string out;
  std::istringstream lines(app->get_footer());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t gap = line.find("  ", 2);
    if (line.rfind("  ", 0) == 0 && gap != std::string::npos) {
      out += tagged(line.substr(2, gap - 2), line.substr(gap));
    } else {
      append_wrapped(out, line, 0, 0);
    }
  }
  return out;
}

}  // namespace vex
