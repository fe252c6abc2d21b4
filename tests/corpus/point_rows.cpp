// .xyz, .csv and .txt: points, and the hull of them.
#include "corpus.h"
#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {
namespace {

void add_point_rows(const char* extension, const char* separator, std::vector<Row>* all) {
  Rows rows(extension);
  const Solid body = tetrahedron();  // four lines
  const std::string text = csv_text(body, separator);
  const std::string between = separator;
  const auto line = [&](const char* x, const char* y, const char* z) { return x + between + y + between + z; };
  rows.is("plain", text, body).hull();
  rows.is("a box", csv_text(box(), separator), box()).hull();
  rows.is("points inside and on faces", csv_text(cut_box(2), separator) + line("1", "0.25", "3") + "\n", box()).hull();
  rows.is("line ends of DOS", with_crlf(text), body).hull();
  rows.is("line ends of old Macs", with_cr(text), body).hull();
  rows.is("a byte-order mark", with_bom(text), body).hull();
  rows.is("no final newline", without_final_newline(text), body).hull();
  rows.is("blank lines", "\n" + with_line_behind_every(text, " "), body).hull();
  rows.is("comments", "# points\n" + with_line_behind_every(text, "# more"), body).hull();
  rows.is("exponents and signs", replaced_all(text, "0.25", "+2.5E-01"), body).hull();
  rows.is("the same point twice", text + text, body).hull();
  rows.is("the gzipped file", gzipped(text), body).named((std::string("body") + extension + ".gz").c_str()).hull();
  rows.no_body("three points", without_line(text, 4), {"plane"}).hull();
  rows.no_body("points without the hull", text, {"--hull"});
  rows.no_body("points of one plane", csv_text(flat_box(), separator), {"plane"}).hull();
  for (const char* token : {"1.0D+01", "1x", "0x1", "nan", "inf", "1e400"}) {
    rows.refused(std::string("the coordinate ") + token, with_line(text, 2, line("1.25", token, "1")),
                 {token, "line 2"})
        .hull();
  }
  rows.refused("two coordinates", with_line(text, 2, "1.25" + between + "-0.5"), {"line 2"}).hull();
  rows.refused("a word within", with_line(text, 2, "x" + between + "y" + between + "z"), {"line 2"}).hull();
  rows.refused("an empty file", "", {"is empty"}).hull();
  rows.refused("comments only", "# nothing\n").hull();
  rows.refused("a STEP file", step_text()).hull();
  rows.refused("a page of the web", html_text()).hull();
  all->insert(all->end(), rows.rows().begin(), rows.rows().end());
}

}  // namespace

std::vector<Row> point_rows() {
  std::vector<Row> all;
  add_point_rows(".xyz", " ", &all);
  add_point_rows(".csv", ",", &all);
  add_point_rows(".txt", "\t", &all);
  Rows rows(".csv", "csv in particular");
  const Solid body = box();
  rows.is("a heading", "x,y,z\n" + csv_text(body), body).hull();
  rows.is("a heading in quotes", "\"x\",\"y\",\"z\"\n" + csv_text(body), body).hull();
  rows.is("blanks behind commas", csv_text(body, ", "), body).hull();
  rows.is("semicolons", csv_text(body, ";"), body).hull();
  rows.is("more columns", "x,y,z,intensity\n" + with_at_every_line_end(csv_text(body), ",0.5"), body).hull();
  rows.refused("an empty field", replaced(csv_text(body), "0.5,-1,2", "0.5,,2"), {"line 1"}).hull();
  rows.refused("a heading only", "x,y,z\n").hull();
  rows.refused("decimal commas between semicolons", replaced_all(csv_text(body, ";"), "0.5", "0,5")).hull();
  all.insert(all.end(), rows.rows().begin(), rows.rows().end());
  Rows chemists(".xyz", "xyz of chemists");
  const std::string lines = with_at_every_line_start(csv_text(body, " "), "C ");
  chemists.is("a count, a comment, and symbols before numbers", "8\na body\n" + lines, body).hull();
  chemists.refused("more points announced than there are", "9\na body\n" + lines).hull();
  chemists.refused("fewer points announced than there are", "7\na body\n" + lines).hull();
  all.insert(all.end(), chemists.rows().begin(), chemists.rows().end());
  return all;
}

}  // namespace vex::tests
