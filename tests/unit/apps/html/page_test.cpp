#include "apps/common/html/page.h"

#include <gtest/gtest.h>

#include "apps/common/html/assets.h"
#include "apps/common/html/packed.h"
#include "apps/common/html/plot.h"
#include "meshes/gunzip.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

const std::string kHostile = "<script>alert(1)</script>\"'&</pre><!-- \x1b[31m \xff";

std::string hostile_page() {
  const nlohmann::ordered_json document = {{"version", "1"}, {"name", "</script><script>alert(2)"}, {"value", 0.1}};
  HtmlPage page(kHostile, kHostile, document.dump());
  page.headline({kHostile, "/value", kHostile, kHostile});
  page.verdict(Tone::bad, kHostile);
  page.begin_section(kHostile, true);
  page.paragraph(kHostile);
  page.numbers(kHostile, {{kHostile, "/value", kHostile, kHostile}});
  page.table({kHostile, {kHostile, kHostile}, {{kHostile, kHostile}}});
  page.figure(
      plot_svg({kHostile, kHostile, kHostile, false, false, {{kHostile, {{1, 2, 0.5}, {2, 3}}}}, {{kHostile, 2.5}}}),
      kHostile);
  const Body box = parse_shape("box:1,2,3");
  page.pair(pair_view(box, kHostile, box, kHostile, OrientationLaw::aligned(), 1));
  return page.text(kHostile);
}

TEST(HtmlPage, EscapesWhatIsNotItsOwn) {
  const std::string page = hostile_page();
  // vex's own: two of the viewer, the document, and the script.
  EXPECT_EQ(count_of("<script", page), *kViewerCode != '\0' ? 4u : 3u);
  EXPECT_EQ(count_of("</script", page), *kViewerCode != '\0' ? 4u : 3u);
  EXPECT_EQ(count_of("alert(1)", page), count_of("&lt;script>alert(1)&lt;/script>", page));
  EXPECT_GT(count_of("alert(1)", page), 15u);
  EXPECT_EQ(count_of("</pre", page), 2u);
  EXPECT_EQ(count_of("\x1b", page), 0u);
  EXPECT_EQ(count_of("\xff", page), 0u);
}

TEST(HtmlPage, LetsNothingRunOrLoadButItsOwn) {
  const std::string page = hostile_page();
  const std::size_t begin = page.find("default-src 'none'; script-src 'sha256-");
  ASSERT_NE(begin, std::string::npos);
  const std::string policy = page.substr(begin, page.find('"', begin) - begin);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos) << policy;
  EXPECT_EQ(policy.find("http"), std::string::npos) << policy;
  EXPECT_LT(begin, page.find("<style>"));  // what stands before a policy is not held to it
  for (const char* const loads : {"src=", "href=", "@import", "url("}) EXPECT_EQ(count_of(loads, page), 0u) << loads;
}

TEST(HtmlPage, NumbersAreTheDocuments) {
  HtmlPage page("t", "o", R"({"a": {"b": 0.1234567890123456789}, "c": null})");
  page.begin_section("s", true);
  page.numbers("c", {{"n", "/a/b", "0.12"}, {"none", "/c", "unknown"}, {"missing", "/d", "-"}});
  const std::string text = page.text("");
  EXPECT_EQ(count_of("<data value=\"0.12345678901234568\" data-path=\"/a/b\">0.12</data>", text), 1u);
  EXPECT_EQ(count_of("<data ", text), 1u);
}

TEST(PackedText, IsWhatWasPacked) {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (const std::string& text : {std::string("a"), std::string("ab"), std::string(100'000, 'x') + "<&"}) {
    const std::string packed = packed_text(text);
    EXPECT_EQ(packed.size() % 4, 0u);
    std::string bytes;
    unsigned bits = 0, n_bits = 0;
    for (const char c : packed.substr(0, packed.find('='))) {
      bits = bits << 6 | static_cast<unsigned>(kAlphabet.find(c));
      n_bits += 6;
      if (n_bits >= 8) bytes += static_cast<char>(bits >> (n_bits -= 8) & 255u);
    }
    EXPECT_EQ(gunzip(bytes, "it").view(), text);
  }
}

TEST(PlotSvg, LeavesOutWhatIsNoPoint) {
  const double kNone = std::nan("");
  EXPECT_EQ(plot_svg({"t", "x", "y", false, false, {{"s", {{kNone, 1}, {1, kNone}}}}, {}}), "");
  EXPECT_EQ(plot_svg({"t", "x", "y", true, false, {{"s", {{0, 1}, {-1, 1}}}}, {}}), "");
  const std::string one = plot_svg({"t", "x", "y", true, true, {{"s", {{10, 1e-300, 1}, {10, kNone}}}}, {{"l", -1}}});
  EXPECT_EQ(count_of("<circle", one), 1u + 0u);
  EXPECT_EQ(count_of("nan", one) + count_of("inf", one), 0u) << one;
}

TEST(PairView, ShowsTheOrientationsOfTheLawByTheirVolumes) {
  const Body box = parse_shape("box:1,2,3"), capsule = parse_shape("capsule:2,0.5");
  const PairView view = pair_view(box, "a", capsule, "b", OrientationLaw::isotropic(), 1);
  EXPECT_GE(view.orientations.size(), 8u);
  double previous = 0.0, sum = 0.0;
  for (const OrientationView& one : view.orientations) {
    ASSERT_TRUE(one.excluded_volume);
    EXPECT_GE(*one.excluded_volume, previous);
    EXPECT_FALSE(one.surface.points.empty());
    previous = *one.excluded_volume;
    sum += previous;
  }
  const Measures &a = box.measures, &b = capsule.measures;
  const double mean = a.volume + b.volume +
                      (a.integrated_mean_curvature * b.surface_area + b.integrated_mean_curvature * a.surface_area) /
                          (4.0 * std::acos(-1.0));
  EXPECT_NEAR(sum / static_cast<double>(view.orientations.size()), mean, 0.05 * mean);
  EXPECT_EQ(pair_view(box, "a", box, "", OrientationLaw::aligned(), 1).orientations.size(), 1u);
}

TEST(PairView, HasTheEdgesOfACubeAndOfADisc) {
  EXPECT_EQ(sharp_edges(mesh_of(parse_shape("box:1,1,1").body, 32)).size(), 12u);
  EXPECT_EQ(sharp_edges(mesh_of(parse_shape("sphere:1").body, 32)).size(), 0u);
  EXPECT_EQ(sharp_edges(mesh_of(parse_shape("plate:1,1").body, 32)).size(), 4u);
}

// Of the least and the largest size that have a volume nothing is too small for a script's 32 bits.
TEST(PairView, HasNoUnit) {
  for (const char* const text : {"box:1e-40,1e-40,1e-40", "box:1e40,1e40,1e40", "needle:1e-30"}) {
    const Body body = parse_shape(text);
    const auto document = nlohmann::json::parse(viewer_document(pair_view(body, "a", body, "", {}, 1)));
    const double unit = document.at("a").at("unit");
    EXPECT_GT(unit, 1e-6) << text;
    EXPECT_LT(unit, 1.0) << text;
  }
}

}  // namespace
}  // namespace vex
