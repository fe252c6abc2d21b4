// A program's options, declared a line each. CLI11 is behind it: including that takes a compiler ten seconds a file.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vex {

/// What --help says of an option beside its description, and whether it must be given.
class DeclaredOption {
 public:
  explicit DeclaredOption(CLI::Option* option) : option_(option) {}

  /// Of its value.
  DeclaredOption type_name(const std::string& name) const;
  /// The heading that it stands below.
  DeclaredOption group(const std::string& heading) const;
  DeclaredOption required() const;

 private:
  CLI::Option* option_;
};

/// What is declared here must outlive it: parsing writes there.
class OptionParser {
 public:
  OptionParser(const std::string& purpose, const std::string& program);
  ~OptionParser();
  OptionParser(const OptionParser&) = delete;
  OptionParser& operator=(const OptionParser&) = delete;

  /// "--name", or a positional one without the dashes.
  DeclaredOption add_option(const std::string& name, std::string& word, const std::string& description);
  /// One value each time; may be given several times.
  DeclaredOption add_option(const std::string& name, std::vector<std::string>& words, const std::string& description);
  DeclaredOption add_flag(const std::string& name, bool& is_given, const std::string& description);
  /// The text that ends --help.
  void footer(const std::string& text);

  CLI::App& app() { return *app_; }

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace vex
