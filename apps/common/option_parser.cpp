#include "apps/common/option_parser.h"

#include <CLI/CLI.hpp>

namespace vex {

DeclaredOption DeclaredOption::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

DeclaredOption DeclaredOption::group(const std::string& heading) const {
  option_->group(heading);
  return *this;
}

DeclaredOption DeclaredOption::required() const {
  option_->required();
  return *this;
}

OptionParser::OptionParser(const std::string& purpose, const std::string& program)
    : app_(std::make_unique<CLI::App>(purpose, program)) {}

OptionParser::~OptionParser() = default;

DeclaredOption OptionParser::add_option(const std::string& name, std::string& word, const std::string& description) {
  return DeclaredOption(app_->add_option(name, word, description));
}

DeclaredOption OptionParser::add_option(const std::string& name, std::vector<std::string>& words,
                                        const std::string& description) {
  return DeclaredOption(
      app_->add_option(name, words, description)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

DeclaredOption OptionParser::add_flag(const std::string& name, bool& is_given, const std::string& description) {
  return DeclaredOption(app_->add_flag(name, is_given, description));
}

void OptionParser::footer(const std::string& text) { app_->footer(text); }

}  // namespace vex
