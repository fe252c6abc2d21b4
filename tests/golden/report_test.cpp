// The page of --report: whole, of the same numbers as the document, and harmless whatever the bodies are called. What a
// browser makes of it: tests/report.
#include <csignal>
#include <regex>
#include <thread>

#include "tests/golden/program.h"
#include "tests/golden/sample_files.h"

namespace vex::golden {
namespace {

using nlohmann::json;

class Report : public ProgramTest {
 protected:
  /// The document within the page.
  static json document_of(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"result\">";
    const std::size_t at = page.find(begin);
    if (at == std::string::npos) return nullptr;
    const std::size_t end = page.find("</script>", at);
    return json::parse(page.substr(at + begin.size(), end - at - begin.size()), nullptr, false);
  }

  static void expect_numbers_of(const json& document, const std::string& page, std::size_t fewest = 6) {
    static const std::regex number("<data value=\"([^\"]*)\" data-path=\"([^\"]*)\">");
    std::size_t n = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), number), end; it != end; ++it, ++n) {
      EXPECT_EQ((*it)[1], document.at(json::json_pointer((*it)[2])).dump()) << (*it)[2];
    }
    EXPECT_GE(n, fewest);
  }
};

TEST_F(Report, HoldsTheDocumentAndChangesNoResult) {
  const Words run = {"box:1,2,3", "capsule:1,0.5", "--estimator", "hit-or-miss", "--trials", "1e5", "--quiet"};
  Words with_report = run;
  with_report.insert(with_report.end(), {"--report", "page.html", "--json", "with.json"});
  ASSERT_EQ(this->run(with_report).exit_code, 0);
  const json plain = json_of(run);
  json with = json::parse(read_file("with.json"));
  const std::string page = read_file("page.html");
  EXPECT_EQ(document_of(page), with);
  expect_numbers_of(with, page);
  for (const char* const same : {"excluded_volume", "std_error", "trials", "hits", "decided_by"})
    EXPECT_EQ(with["estimate"][same], plain["estimate"][same]) << same;
  EXPECT_EQ(with["z"], plain["z"]);
  EXPECT_EQ(files(), (std::vector<std::string>{"page.html", "with.json"}));
}

TEST_F(Report, IsWrittenForEveryKindOfBodyAndLaw) {
  const std::vector<Words> runs = {{"sphere:1"},
                                   {"needle:1"},
                                   {"plate:1,2", "needle:1"},
                                   {"disc:1", "cone:1,1"},
                                   {"rounded:0.1,tetrahedron:1", "hemisphere:1"},
                                   {"box:1,1,1e-9"},
                                   {"box:1e-30,1e-30,1e-30"},
                                   {"box:1,1,1", "--orientations", "aligned"},
                                   {"plate:1,1", "--orientations", "aligned"},
                                   {"cylinder:5,0.5", "--orientations", "onsager:5"},
                                   {"cylinder:5,0.5", "--orientations", "fixed:1,2,3,4"},
                                   {"box:1,1,1", "--trials", "1"}};
  for (Words words : runs) {
    const std::string name = testing::PrintToString(words);
    if (std::ranges::find(words, "--trials") == words.end()) words.insert(words.end(), {"--trials", "4096"});
    words.insert(words.end(), {"--report", "page.html", "--quiet"});
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, 0) << name << finished.err;
    const std::string page = read_file("page.html");
    EXPECT_TRUE(document_of(page).is_object()) << name;
    EXPECT_EQ(page.substr(page.size() - 8), "</html>\n") << name;
    // Beside what is packed, which may hold any letters.
    const std::string before = page.substr(0, page.find("id=\"viewer-data\"")),
                      after = page.substr(page.find("</figure>"));
    for (const std::string& part : {before, after.substr(0, after.find("id=\"result\""))}) {
      for (const char* const none : {">nan", ">inf", "nan(", "\"nan", " nan", "NaN"})
        EXPECT_EQ(part.find(none), std::string::npos) << name << none;
    }
    EXPECT_LT(page.size(), 1'200'000u) << name;
  }
}

TEST_F(Report, OfScansVirialsAndPercolationHaveTheNumbersOfTheirDocuments) {
  const std::string folder = std::filesystem::path(VEX_SCAN_PROGRAM).parent_path().string();
  for (const char* const command :
       {"vex_scan 'box:1,1,{C}' rod:1 --for C=1:3:1 --trials 1024", "vex_scan sphere:1 --angle 0:0:1 --trials 64",
        "vex_virial box:1,1,2 --order 4 --samples 1e5", "vex_virial disc:1 --order 3 --samples 1e5",
        "vex_virial sphere:1 box:1,1,1 --samples 1e5", "vex_percolate sphere:0.5 --sizes 2,3 --realisations 60",
        "vex_percolate box:1,1,1 --sizes 2 --realisations 2"}) {
    SCOPED_TRACE(command);
    const Finished finished =
        shell("'" + folder + "'/" + command + " --threads 2 --quiet --report p.html --json p.json");
    EXPECT_TRUE(finished.exit_code == 0 || finished.exit_code == 3) << finished.err;
    const std::string page = read_file("p.html");
    const json document = json::parse(read_file("p.json"));
    EXPECT_EQ(document_of(page), document);
    expect_numbers_of(document, page, 3);
    const std::string after = page.substr(page.find("</figure>"));
    for (const char* const none : {">nan", ">inf", "nan(", " nan"}) {
      EXPECT_EQ(after.substr(0, after.find("id=\"result\"")).find(none), std::string::npos) << none;
    }
  }
}

/// The column said the contrary of each.
TEST_F(Report, SaysWhichEstimatorsUseTheFormulasGeometry) {
  ASSERT_EQ(run({"capsule:2,0.5", "--report", "page.html", "--quiet", "--trials", "4096"}).exit_code, 0);
  const std::string page = read_file("page.html");
  for (const auto& [estimator, answer] :
       {std::pair{"radial (this run)", "no"}, {"hit-or-miss", "no"}, {"mixed-volume", "yes"}, {"mean-width", "yes"}}) {
    const std::size_t begin = page.find(std::string(">") + estimator + ": ");
    ASSERT_NE(begin, std::string::npos) << estimator;
    const std::string row = page.substr(begin, page.find("</tr>", begin) - begin);
    EXPECT_NE(row.find(std::string(">") + answer + "<"), std::string::npos) << row;
  }
}

TEST_F(Report, EscapesNamesOfFilesAndTheCommand) {
  const std::string name = "<script>alert(1)<script>\"'&amp; x.off";
  write_file(name, "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  ASSERT_EQ(run({name, "--report", "page.html", "--quiet", "--trials", "100"}).exit_code, 0);
  const std::string page = read_file("page.html");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script>alert(1)&lt;script>&quot;'&amp;amp; x.off"), std::string::npos);
  EXPECT_EQ(document_of(page).at("bodies")[0].at("source"), name);
}

TEST_F(Report, OfAnInterruptedRunSaysSo) {
  const Finished finished = run_and_signal(
      {"box:1,1,1", "--report", "page.html", "--rel-error", "1e-12", "--threads", "2", "--estimator", "hit-or-miss"},
      SIGINT, [](pid_t process) {
        if (!has_worker_threads(process)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return true;
      });
  EXPECT_EQ(finished.exit_code, 130) << finished.err;
  const std::string page = read_file("page.html");
  EXPECT_NE(page.find("Incomplete: the run was interrupted"), std::string::npos);
  EXPECT_EQ(document_of(page).at("complete"), false);
  EXPECT_EQ(files(), std::vector<std::string>{"page.html"});
}

TEST_F(Report, CostsNoInputAndNoOtherOutput) {
  write_file("body.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  std::filesystem::create_symlink("body.off", folder() / "link.html");
  expect_refusal(run({"body.off", "--report", "link.html"}), 2, "would end in the extension of a mesh");
  expect_refusal(run({"body.off", "--report", "body.off"}), 2, "would end in the extension of a mesh");
  expect_refusal(run({"sphere:1", "--report", "x.html", "--json", "x.html"}), 2, "one file for two outputs");
  expect_refusal(run({"sphere:1", "--report", "none/x.html"}), 2, "folder does not exist");
  expect_refusal(run({"body.offf", "--report", "x.html"}), 3, "");
  EXPECT_EQ(files(), (std::vector<std::string>{"body.off", "link.html"}));
  const Finished on_standard_output = run({"sphere:1", "--report", "-"});
  EXPECT_EQ(on_standard_output.exit_code, 0);
  EXPECT_EQ(on_standard_output.out.substr(0, 15), "<!DOCTYPE html>");
  EXPECT_EQ(on_standard_output.out.substr(on_standard_output.out.size() - 8), "</html>\n");
}

}  // namespace
}  // namespace vex::golden
