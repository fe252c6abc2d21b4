#include "apps/common/html/page.h"

#include "apps/common/html/assets.h"
#include "apps/common/html/packed.h"
#include "apps/common/html/pair_picture.h"
#include "apps/common/svg.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kLicence =
    "<!-- three.js, https://threejs.org: Copyright 2010-2019 three.js authors. Permission is hereby granted, free of "
    "charge, to any person obtaining a copy of this software and associated documentation files (the \"Software\"), to "
    "deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, "
    "publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software "
    "is "
    "furnished to do so, subject to the following conditions: The above copyright notice and this permission notice "
    "shall be included in all copies or substantial portions of the Software. THE SOFTWARE IS PROVIDED \"AS IS\", "
    "WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, "
    "FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE "
    "LIABLE "
    "FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT "
    "OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE. -->\n";

// Nothing is loaded, sent or framed, and no script or style but these runs, wherever in the page it stands.
std::string security_policy() {
  const auto hash = [](const char* value) {
    return std::string(value).empty() ? "" : " 'sha256-" + std::string(value) + "'";
  };
  return "default-src 'none'; script-src" + hash(kPageScriptHash) + hash(kViewerHash) + "; style-src" +
         hash(kPageStyleHash) + "; base-uri 'none'; form-action 'none'";
}

// No text of the document ends the element that it stands in.
std::string json_in_html(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string element(const std::string& name, const std::string& text, const std::string& attributes = "") {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + in_xml(text) + "</" + name + ">";
}

// vex's own words, with indices as such: V_ex, V_A.
std::string with_indices(const std::string& text) {
  std::string html = in_xml(text);
  for (const std::string index : {"ex", "A", "B"}) {
    const std::string plain = "_" + index, lowered = "<sub>" + index + "</sub>";
    for (std::size_t at = html.find(plain); at != std::string::npos; at = html.find(plain, at + lowered.size()))
      html.replace(at, plain.size(), lowered);
  }
  return html;
}

std::string own_words(const std::string& name, const std::string& text, const std::string& attributes) {
  return "<" + name + " " + attributes + ">" + with_indices(text) + "</" + name + ">";
}

bool is_a_number(const std::string& cell) { return !cell.empty() && (cell[0] >= '0' && cell[0] <= '9'); }

}  // namespace

HtmlPage::HtmlPage(const std::string& title, const std::string& over, const std::string& document_text)
    : title_(title), over_(over), document_text_(document_text), document_(Json::parse(document_text)) {}

// The number itself goes along, as the document has it.
std::string HtmlPage::number_html(const PageNumber& number) const {
  const Json::json_pointer pointer(number.path);
  if (number.path.empty() || !document_.contains(pointer) || !document_.at(pointer).is_number())
    return in_xml(number.shown);
  return "<data value=\"" + in_xml(document_.at(pointer).dump()) + "\" data-path=\"" + in_xml(number.path) + "\">" +
         in_xml(number.shown) + "</data>";
}

void HtmlPage::headline(const PageNumber& number) {
  header_ += "<h1>" + with_indices(number.name) + " = " + number_html(number) + "</h1>\n";
  if (!number.meaning.empty()) header_ += element("p", number.meaning, "class=\"remark\"") + "\n";
}

void HtmlPage::headline(const std::string& text) { header_ += element("h1", text) + "\n"; }

void HtmlPage::verdict(Tone tone, const std::string& text) {
  const char* const name = tone == Tone::good ? "good" : tone == Tone::bad ? "bad" : "wait";
  header_ += element("p", text, "class=\"verdict " + std::string(name) + "\"") + "\n";
}

void HtmlPage::begin_section(const std::string& heading, bool is_wide) {
  end_section();
  has_section_ = true;
  main_ += (is_wide ? "<section class=\"wide\">\n" : "<section>\n") + element("h2", heading) + "\n";
}

void HtmlPage::end_section() {
  if (has_section_) main_ += "</section>\n";
  has_section_ = false;
}

void HtmlPage::paragraph(const std::string& text) { main_ += element("p", text) + "\n"; }

void HtmlPage::numbers(const std::string& caption, const std::vector<PageNumber>& rows) {
  main_ += "<table class=\"meanings\">" + element("caption", caption) +
           "<thead><tr><th scope=\"col\">quantity</th><th scope=\"col\">value</th><th scope=\"col\">what it "
           "means</th></tr></thead>\n<tbody>\n";
  for (const PageNumber& row : rows) {
    main_ += "<tr>" + own_words("th", row.name, "scope=\"row\"") + "<td class=\"value\">" + number_html(row) + "</td>" +
             own_words("td", row.meaning, "class=\"meaning\"") + "</tr>\n";
  }
  main_ += "</tbody></table>\n";
}

void HtmlPage::table(const PageTable& table) {
  // A column of numbers is flush right, with its heading.
  std::vector<bool> is_number(table.columns.size(), false);
  for (const std::vector<std::string>& row : table.rows) {
    for (std::size_t k = 1; k < row.size() && k < is_number.size(); ++k)
      is_number[k] = is_number[k] || is_a_number(row[k]);
  }
  const auto flush = [&](std::size_t k) { return is_number[k] ? std::string("class=\"number\"") : std::string(); };
  // What is wider than a telephone is moved sideways, by keys too.
  main_ += "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + in_xml(table.caption) + "\"><table>" +
           element("caption", table.caption) + "<thead><tr>";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    main_ += element("th", table.columns[k], "scope=\"col\" " + flush(k));
  main_ += "</tr></thead>\n<tbody>\n";
  const auto cell = [&](std::size_t i, std::size_t k) {
    const std::string& text = table.rows[i][k];
    if (i >= table.paths.size() || k >= table.paths[i].size() || table.paths[i][k].empty()) {
      return element("td", text, flush(k));
    }
    return "<td " + flush(k) + ">" + number_html({"", table.paths[i][k], text}) + "</td>";
  };
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    main_ += "<tr>";
    for (std::size_t k = 0; k < table.rows[i].size() && k < is_number.size(); ++k)
      main_ += k == 0 ? element("th", table.rows[i][k], "scope=\"row\"") : cell(i, k);
    main_ += "</tr>\n";
  }
  main_ += "</tbody></table></div>\n";
}

void HtmlPage::figure(const std::string& svg, const std::string& caption, const std::string& otherwise) {
  if (svg.empty()) return paragraph(otherwise);
  main_ += "<figure>\n" + svg + element("figcaption", caption) + "</figure>\n";
}

void HtmlPage::pair(const PairView& view) {
  constexpr int kWidth = 640, kHeight = 400;
  const std::size_t n = view.orientations.size();
  const OrientationView& shown = view.orientations[n / 2];
  const bool is_one_body = view.name_b.empty();
  const std::string name_b = is_one_body ? view.name_a + " again" : view.name_b;
  const std::string alt = "Body A (" + view.name_a + ", blue), body B (" + name_b +
                          ", orange) where it touches A, and around A " + view.surface_name + " (pale blue).";
  Svg svg = Svg::in_page(kWidth, kHeight, in_xml(alt));
  svg.begin_group({0.5 * kWidth, 0.5 * kHeight}, "");
  draw_pair(svg, view, shown, kWidth - 16.0, kHeight - 16.0);
  svg.end_group();

  main_ += "<figure class=\"pair\" id=\"pair\">\n<ul class=\"key\"><li class=\"of-a\">" + in_xml("A: " + view.name_a) +
           "</li><li>" + in_xml("B: " + name_b) + "</li><li class=\"of-s\">" + in_xml(view.surface_name) +
           "</li></ul>\n<div class=\"stage\" "
           "id=\"stage\"><div class=\"still\">" +
           svg.text() +
           "</div></div>\n<p class=\"remark\" id=\"still-remark\"></p>\n<div class=\"controls\" "
           "id=\"controls\" hidden>\n<label" +
           (n > 1 ? "" : " hidden") +
           ">Orientation of B, from the smallest excluded "
           "volume to the largest<input type=\"range\" id=\"orientation\" min=\"0\" max=\"" +
           std::to_string(n - 1) + "\" value=\"" + std::to_string(n / 2) +
           "\"></label>\n<label>Where B touches A<input type=\"range\" id=\"place\" min=\"0\" max=\"360\" step=\"0.2\" "
           "value=\"20\"></label>\n<div class=\"row\"><label><input type=\"checkbox\" id=\"surface\" checked> "
           "the surface</label><button type=\"button\" id=\"play\">Move B around A</button></div>\n</div>\n"
           "<p class=\"here\" id=\"here\" aria-live=\"polite\"></p>\n<figcaption><span id=\"pair-alt\">" +
           in_xml(alt) + "</span> The volume inside is the excluded volume at this orientation" +
           (n > 1 ? "; its mean over all orientations is ⟨V<sub>ex</sub>⟩" : "") + ". " +
           (shown.is_exact ? "The surface is exact: the convex hull of all differences of the bodies’ corners."
                           : "Curved surfaces, and those of bodies with very many corners, are drawn as the hull of "
                             "points of theirs: a picture, not what is computed with.") +
           (shown.excluded_volume ? " Volumes are those of the bodies, not of the drawing." : "") + "</figcaption>\n";
  main_ += "<script type=\"text/plain\" id=\"viewer-data\">" + packed_text(viewer_document(view)) + "</script>\n";
  has_viewer_ = *kViewerCode != '\0';
  if (has_viewer_) {
    main_ += kLicence;
    main_ += "<script type=\"text/plain\" id=\"viewer-code\">" + std::string(kViewerCode) + "</script>\n";
  }
  main_ += "</figure>\n";
}

std::string HtmlPage::text(const std::string& command) {
  begin_section("To repeat it", true);
  main_ += "<pre class=\"command\"><code>" + in_xml(command) + "</code></pre>\n";
  const auto field = [this](const char* key) {
    return document_.contains(key)
               ? (document_[key].is_string() ? document_[key].get<std::string>() : document_[key].dump())
               : std::string("unknown");
  };
  paragraph("vex " + field("version") + ", random stream " + field("stream_version") + ", seed " + field("seed") +
            ". The same command gives the same numbers on any number of threads; only times differ.");
  main_ +=
      "<details class=\"screen-only\"><summary>All numbers in full precision: the document of --json</summary>"
      "<pre id=\"all-numbers\" tabindex=\"0\"></pre></details>\n";
  end_section();

  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\""
         "Content-Security-Policy\" content=\"" +
         security_policy() +
         "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"referrer\" "
         "content=\"no-referrer\">\n<meta name=\"generator\" content=\"vex\">\n" +
         element("title", title_) + "\n<style>" + kPageStyle + "</style>\n</head>\n<body>\n<header>\n" +
         element("p", over_, "class=\"over\"") + "\n" + header_ + "</header>\n<main>\n" + main_ +
         "</main>\n<footer><p>Made by vex, which computes excluded volumes of convex bodies. This page is whole: it "
         "loads "
         "nothing and sends nothing.</p></footer>\n<script type=\"application/json\" id=\"result\">" +
         json_in_html(document_text_) + "</script>\n<script>" + kPageScript + "</script>\n</body>\n</html>\n";
}

}  // namespace vex
