// Coordinates that were rounded: how much they tell, and what follows.
#include "corpus.h"
#include "writers.h"

namespace vex::tests {
namespace {

using Kind = CoordinateDigits::Kind;

void add_rounding_decimals(Rows* rows) {
  // Edges of 2, a size of 5.6: the largest coordinate is 2.618.
  for (const auto& [format, n_decimals] : {std::pair{"%.4f", 4}, std::pair{"%.6f", 6}, std::pair{"%.9f", 9}}) {
    const double place = std::pow(10.0, -n_decimals);
    const std::string name = std::string("a dodecahedron printed by ") + format;
    for (const Writer& writer : {Writer{"obj", ".obj", {}}, Writer{"off", ".off", {}}, Writer{"ply", ".ply", {}}}) {
      const Number number = as_printed(format);
      const std::string bytes = writer.name == "obj"   ? obj_text(dodecahedron(), number)
                                : writer.name == "off" ? off_text(dodecahedron(), number)
                                                       : ply_text(dodecahedron(), number);
      Row& row = rows->is(name + ", " + std::string(writer.name), bytes, dodecahedron());
      row.named(("body" + std::string(writer.extension)).c_str())
          .within(place, 2 * place)
          .has_digits(Kind::decimals, n_decimals + 1, place);
      if (n_decimals == 4) row.notes_that("4 decimals");
    }
  }
  rows->is("a dodecahedron printed by %.6g", obj_text(dodecahedron(), as_printed("%.6g")), dodecahedron())
      .within(1e-5, 2e-5)
      .has_digits(Kind::decimals, 6, 1e-5);
  rows->is("a dodecahedron printed by %g, with a wide tolerance", obj_text(dodecahedron(), as_printed("%.3g")),
           dodecahedron())
      .convex_within(1e-2)
      .within(1e-2, 2e-2);
  rows->is("an icosahedron printed by %.4f", obj_text(icosahedron(), as_printed("%.4f")), icosahedron())
      .within(1e-4, 2e-4)
      .has_digits(Kind::decimals, 5, 1e-4);
  rows->is("fault 8, a flat dodecahedron of twelve digits far off",
           obj_text(dodecahedron({100, 200, -100}), as_printed("%.12g")), dodecahedron({100, 200, -100}))
      .within(1e-9, 1e-9)
      .has_digits(Kind::decimals, 12, 1e-9);
  rows->no_body("a dent beyond the decimals", obj_text(dented_box(1e-3), as_printed("%.4f")), {"not convex"});
  rows->no_body("a dent of 2^-10", obj_text(dented_box(0x1p-10)), {"not convex"});
  rows->is("a dent of one decimal in three", obj_text(dented_box(1e-3)), box()).notes_that("3 decimals");
  rows->no_body("a dent of three decimals in three", obj_text(dented_box(3e-3)), {"not convex"});
  rows->is("a dent of 2^-10 within a wide tolerance", obj_text(dented_box(0x1p-10)), box()).convex_within(1e-2);
  rows->is("a dent of 1e-9", obj_text(dented_box(1e-9)), box()).notes_that("convex");
  rows->no_body("a dent of 1e-9 and no tolerance", obj_text(dented_box(1e-9)), {"not convex"}).convex_within(0);
  rows->is("a dent of one last decimal", obj_text(dented_box(0.01), as_printed("%.2f")), box()).convex_within(0.01);
}

void add_rounding_offsets(Rows* rows) {
  for (const double offset : {1e3, 1e4, 1e7}) {
    const std::string at = " at " + printed("%.0f", offset);
    const Solid body = icosahedron({offset, offset, offset});
    rows->is("fault 8, an icosahedron" + at + " in text", obj_text(body, as_printed("%.17g")), body)
        .within(0, 1e-15 * offset + 1e-12)
        .has_digits(Kind::doubles);
    rows->is("an icosahedron" + at + " in doubles", ply_doubles(body, Order::little), body)
        .named("body.ply")
        .within(0, 1e-15 * offset + 1e-12)
        .has_digits(Kind::doubles);
  }
  const Solid at_thousand = icosahedron({1000, 1000, 1000});
  rows->is("fault 8, an icosahedron at 1000 in floats is warned of", ply_binary(at_thousand, Order::little),
           at_thousand)
      .named("body.ply")
      .within(4e-5, 1e-4)
      .has_digits(Kind::floats)
      .notes_that("32-bit");
  rows->is("fault 8, an icosahedron at 10000 in floats is warned of", stl_binary(icosahedron({1e4, 1e4, 1e4})),
           icosahedron({1e4, 1e4, 1e4}))
      .named("body.stl")
      .within(6e-4, 2e-3)
      .has_digits(Kind::floats)
      .notes_that("32-bit");
  rows->is("a dodecahedron in floats", ply_binary(dodecahedron(), Order::big), dodecahedron())
      .named("body.ply")
      .within(2e-7, 5e-7)
      .has_digits(Kind::floats);
  rows->is("a dodecahedron at 100 in floats", ply_binary(dodecahedron({100, 200, -100}), Order::big),
           dodecahedron({100, 200, -100}))
      .named("body.ply")
      .within(1e-5, 5e-5)
      .has_digits(Kind::floats);
  rows->is("a dodecahedron's floats as text", obj_text(dodecahedron(), as_printed("%.9g")), dodecahedron())
      .within(1e-8, 1e-8);
  rows->is("small whole numbers are doubles", obj_text(whole_wedge()), whole_wedge()).has_digits(Kind::doubles);
}

void add_rounding_welding(Rows* rows) {
  Solid loose = with_own_corners(box());
  loose.points[5].x += 0x1p-20;  // of more digits than any rounding leaves
  rows->no_body("corners apart by 2^-20", obj_text(loose), {"not closed"});
  rows->is("corners apart by 2^-20, welded", obj_text(loose), box()).welded_within(1e-6).within(1e-6, 1e-6);
  Solid by_a_decimal = with_own_corners(box());
  by_a_decimal.points[5].x += 1e-7;
  rows->is("corners apart by one decimal", obj_text(by_a_decimal), box()).within(1.1e-7, 1e-6).notes_that("joined");
  // Numbers of one digit each are no sign of coordinates that were rounded to one digit.
  const Solid prism = one_digit_prism();
  rows->is("numbers of one digit", obj_text(prism), prism);
  rows->no_body("numbers of one digit, and a side is missing", obj_text(with_hole(prism)), {"not closed"});
  rows->is("noise beside numbers of one digit", replaced(stl_text(prism), "vertex 0 0 0.1", "vertex 5e-17 0 0.1"),
           prism)
      .named("body.stl")
      .within(1e-16, 1e-12);
  rows->no_body("a weld of a negative width", obj_text(box())).welded_within(-1);
  rows->no_body("a tolerance that is negative", obj_text(box())).convex_within(-1);
}

}  // namespace

std::vector<Row> rounding_rows() {
  Rows rows(".obj", "rounding");
  add_rounding_decimals(&rows);
  add_rounding_offsets(&rows);
  add_rounding_welding(&rows);
  return rows.rows();
}

}  // namespace vex::tests
