// How --help is laid out: 80 columns, read alike by people and by help2man, which makes the man page of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vex {

/// Headings end in a colon, what stands below one is indented: a tag, and its explanation in a column of its own. In an
/// app's footer a line such as "  sphere:R  radius" is laid out likewise, any other as a paragraph.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  /// What takes several words has dots behind its name (its type name is "...").
  std::string make_option_usage(const CLI::Option* option) const override;
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace vex
