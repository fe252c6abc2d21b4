// A report as one page that needs nothing else: no network, no other file. Its Content-Security-Policy lets run what
// vex itself wrote, by hash, and nothing else; it holds the document of --json, which every number is taken from.
//
// Text of every origin is given as it is: the page escapes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/common/html/pair_view.h"

namespace vex {

/// A number of the document, as people read it.
struct PageNumber {
  std::string name;
  std::string path;       // of the number in the document: a JSON pointer
  std::string shown;      // with its error, or rounded
  std::string meaning{};  // in plain words
};

struct PageTable {
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // the first cell names the row
  /// Of cells that are numbers of the document: where in it, a JSON pointer; empty, or short, where they are none.
  std::vector<std::vector<std::string>> paths{};
};

enum class Tone { good, bad, wait };  // agrees or is complete, disagrees, says nothing yet

class HtmlPage {
 public:
  /// `document_text`: the text of --json, whole; `over` stands above the headline.
  HtmlPage(const std::string& title, const std::string& over, const std::string& document_text);

  void headline(const PageNumber& number);
  void headline(const std::string& text);
  void verdict(Tone tone, const std::string& text);

  /// Everything until the next one. Two that are not wide stand beside each other where there is room.
  void begin_section(const std::string& heading, bool is_wide);
  void paragraph(const std::string& text);
  void numbers(const std::string& caption, const std::vector<PageNumber>& rows);
  void table(const PageTable& table);
  /// `svg`: of plot_svg or Svg; where it is empty `otherwise` is said instead.
  void figure(const std::string& svg, const std::string& caption, const std::string& otherwise = "");
  /// The bodies to turn, with the picture of one orientation for paper and for browsers without WebGL; once a page.
  void pair(const PairView& view);
  /// The command that repeats it, version and seed, and the document; ends the page.
  std::string text(const std::string& command);

 private:
  std::string number_html(const PageNumber& number) const;
  void end_section();

  std::string title_, over_, document_text_;
  nlohmann::ordered_json document_;
  std::string header_, main_;
  bool has_section_ = false, has_viewer_ = false;
};

}  // namespace vex
