#include "apps/vex_paper/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

struct MeanAndSpread {
  double mean = 0.0, spread = 0.0;
};

// The spread about 0, which is what z is expected to be about.
MeanAndSpread of_z(const std::vector<const Row*>& rows) {
  double sum = 0.0, sum_sq = 0.0;
  for (const Row* row : rows) {
    sum += row->z();
    sum_sq += row->z() * row->z();
  }
  const double n = static_cast<double>(rows.size());
  return {sum / n, std::sqrt(sum_sq / n)};
}

// --- screen

std::string printed_text(const paper::Printed& printed) {
  return with_error(printed.excluded_volume, printed.uncertainty);
}

std::string signed_number(int decimals, double value) {
  return (value < 0.0 ? "" : "+") + fixed_number(decimals, value);
}

std::string rows_text(const std::vector<Row>& rows, const std::string& first_column) {
  std::vector<std::vector<std::string>> lines = {
      {first_column, "exact", "this run", "z", "paper", "paper is off by", "trials for 0.1 %", "seconds"}};
  std::string remarks;
  for (const Row& row : rows) {
    const std::string exact =
        row.exact_error > 1e-9 * row.exact ? with_error(row.exact, row.exact_error) : short_number(row.exact, 10);
    std::string paper = "-", off = "-";
    if (row.what.printed) {
      paper = printed_text(*row.what.printed);
      off = signed_number(3, 100.0 * (row.what.printed->excluded_volume / row.exact - 1.0)) + " %";
    }
    lines.push_back({row.what.label, exact, with_error(row.found.excluded_volume, row.found.std_error),
                     signed_number(2, row.z()), paper, off,
                     row.record.tally.n_hits == 0 ? "-" : short_number(row.trials_for_a_thousandth(), 2),
                     fixed_number(1, row.record.seconds)});
    if (!row.what.remark.empty()) remarks += "  " + row.what.label + ": " + row.what.remark + "\n";
    if (row.record.tally.n_undecided > 0) {
      remarks += "  " + row.what.label + ": " + std::to_string(row.record.tally.n_undecided) + " trials undecided\n";
    }
  }
  return table_text(lines) + remarks;
}

const Row* row_of_ratio(const std::vector<Row>& rows, double ratio) {
  const auto found = std::ranges::find_if(rows, [ratio](const Row& row) { return row.what.aspect_ratio == ratio; });
  return found == rows.end() ? nullptr : &*found;
}

// What thin bodies cost beside the cube.
std::string cost_text(const std::vector<Row>& rows) {
  const Row* const cube = row_of_ratio(rows, 1.0);
  const Row* const needle = row_of_ratio(rows, 64.0);
  const Row* const plate = row_of_ratio(rows, 1e-6);
  if (cube == nullptr || needle == nullptr || plate == nullptr) return "";
  const double unit = cube->trials_for_a_thousandth();
  return "  For the same relative error the needle (64) needs " +
         short_number(needle->trials_for_a_thousandth() / unit, 2) + " times the cube's trials, the plate (1e-6) " +
         short_number(plate->trials_for_a_thousandth() / unit, 2) + " times.\n";
}

std::string erratum_text(const PaperRun& run) {
  std::vector<std::vector<std::string>> lines = {
      {"l1/l2", "exact", "one-sided test", "paper", "z", "deficit", "paper's deficit", "seconds"}};
  std::vector<std::vector<std::string>> others = {{"l1/l2"}};
  for (const ErratumRow& row : run.erratum) {
    const WrongValue& one_sided = row.values.front();
    const double percent = 100.0 / row.exact;
    const paper::Printed& printed = *row.what.printed;
    lines.push_back({row.what.label, short_number(row.exact, 10),
                     with_error(one_sided.excluded_volume, one_sided.std_error), printed_text(printed),
                     signed_number(2, row.z()),
                     with_error(percent * one_sided.deficit, percent * one_sided.std_error) + " %",
                     with_error(percent * (row.exact - printed.excluded_volume), percent * printed.uncertainty) + " %",
                     fixed_number(1, row.record.seconds)});
    others.push_back({row.what.label});
    for (std::size_t k = 1; k < row.values.size(); ++k) {
      if (others.front().size() <= k) others.front().push_back(row.values[k].name);
      others.back().push_back(with_error(row.values[k].excluded_volume, row.values[k].std_error));
    }
    others.back().push_back(printed_text(printed));
  }
  others.front().push_back("paper");
  std::string text = "\nErratum  Table 1 by the one-sided test: does an edge of B meet the solid A, not the reverse\n";
  text += table_text(lines);
  const ChiSquared all = chi_squared(run.erratum);
  text += "  chi^2 = " + fixed_number(1, all.value) + " for " + std::to_string(run.erratum.size()) +
          " rows, p = " + short_number(all.p, 2) + ". Identified numerically; not the authors' statement.\n";
  if (!run.erratum_orientations.empty()) {
    std::vector<std::vector<std::string>> fixed = {{"unit cubes", "exact", "one-sided test", "deficit"}};
    for (const ErratumRow& row : run.erratum_orientations) {
      const WrongValue& one_sided = row.values.front();
      const double percent = 100.0 / row.exact;
      fixed.push_back(
          {row.what.label, short_number(row.exact, 10), with_error(one_sided.excluded_volume, one_sided.std_error),
           one_sided.deficit == 0.0 ? "none found"
                                    : with_error(percent * one_sided.deficit, percent * one_sided.std_error) + " %"});
    }
    text += "\nThe one-sided test at fixed relative orientations\n" + table_text(fixed);
  }
  text += "\nOther wrong tests: what they give for <V_ex>\n" + table_text(others);
  return text;
}

std::string curve_text(const PaperRun& run) {
  std::vector<std::vector<std::string>> lines = {{"l1/l2", "exact"}};
  for (const ErratumRow& row : run.curve) {
    lines.push_back({row.what.label, short_number(row.exact, 10)});
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      if (lines.front().size() <= k + 2) lines.front().push_back(row.values[k].name);
      const double percent = 100.0 / row.exact;
      lines.back().push_back(with_error(percent * row.values[k].deficit, percent * row.values[k].std_error));
    }
  }
  return "\nCurve  what the wrong tests miss of <V_ex>, in percent (negative: what they invent)\n" + table_text(lines);
}

std::string referees_text(const PaperRun& run) {
  std::vector<std::vector<std::string>> lines = {{"bodies (unit volume)", "test", "poses", "differ", "GJK right",
                                                  "test right", "not judged", "GJK undecided", "test undecided",
                                                  "seconds"}};
  for (const RefereeRow& row : run.referees) {
    lines.push_back(
        {row.what.label, row.test, short_count(static_cast<double>(row.n_poses)), std::to_string(row.n_disagreements),
         std::to_string(row.n_engine_right), std::to_string(row.n_test_right), std::to_string(row.n_not_judged()),
         std::to_string(row.n_engine_undecided), std::to_string(row.n_test_undecided), fixed_number(1, row.seconds)});
  }
  return "\nReferees  GJK and the specialised tests on the same poses; where they differ exact arithmetic says who is "
         "right\n" +
         table_text(lines);
}

// --- JSON

void add_printed(Json& json, const Case& what) {
  const std::optional<paper::Printed>& printed = what.printed;
  json["paper"] = printed ? Json(printed->excluded_volume) : Json(nullptr);
  json["paper_uncertainty"] = printed ? Json(printed->uncertainty) : Json(nullptr);
  json["paper_calculated"] = printed ? number_or_null(printed->calculated) : Json(nullptr);
}

void add_record(Json& json, const RunRecord& record) {
  json["trials"] = record.tally.n_trials;
  json["hits"] = record.tally.n_hits;
  json["undecided"] = record.tally.n_undecided;
  json["complete"] = record.complete;
  json["seconds"] = record.seconds;
}

Json row_json(const Row& row) {
  Json json;
  json["label"] = row.what.label;
  json["aspect_ratio"] = number_or_null(row.what.aspect_ratio);
  json["bodies"] = {row.what.a, row.what.b};
  json["orientations"] = row.what.orientations;
  json["exact"] = row.exact;
  json["exact_error"] = row.exact_error;
  json["excluded_volume"] = row.found.excluded_volume;
  json["std_error"] = row.found.std_error;
  json["z"] = row.z();
  add_printed(json, row.what);
  json["remark"] = row.what.remark;
  json["trials_for_1e_3"] = number_or_null(row.trials_for_a_thousandth());
  add_record(json, row.record);
  json["command"] = row.command;
  return json;
}

Json row_json(const ErratumRow& row) {
  Json json;
  const WrongValue& one_sided = row.values.front();
  json["label"] = row.what.label;
  json["orientations"] = row.what.orientations;
  json["aspect_ratio"] = number_or_null(row.what.aspect_ratio);
  json["exact"] = row.exact;
  json["excluded_volume"] = one_sided.excluded_volume;
  json["std_error"] = one_sided.std_error;
  json["deficit"] = one_sided.deficit;
  json["z_of_exact_test"] = row.z_of_exact_test();
  if (row.what.printed) {
    json["z"] = row.z();
    add_printed(json, row.what);
  }
  for (const WrongValue& value : row.values) {
    json["tests"][value.name] = {{"excluded_volume", value.excluded_volume}, {"std_error", value.std_error}};
  }
  // A pose that the one-sided test misses: edges of A meet B, and no edge of B meets A.
  json["example"] = nullptr;
  for (const Disagreement& found : row.record.disagreements.kept) {
    if (found.outcomes[0] != Outcome::overlap || found.outcomes[1] != Outcome::disjoint) continue;
    json["example"] = twelve_numbers(found.a_from_b);
    break;
  }
  add_record(json, row.record);
  return json;
}

Json row_json(const RefereeRow& row) {
  return {{"bodies", {row.what.a, row.what.b}},
          {"test", row.test},
          {"poses", row.n_poses},
          {"disagreements", row.n_disagreements},
          {"engine_right", row.n_engine_right},
          {"test_right", row.n_test_right},
          {"not_judged", row.n_not_judged()},
          {"engine_undecided", row.n_engine_undecided},
          {"test_undecided", row.n_test_undecided},
          {"complete", row.complete},
          {"seconds", row.seconds}};
}

template <class AnyRow>
Json rows_json(const std::vector<AnyRow>& rows) {
  Json list = Json::array();
  for (const AnyRow& row : rows) list.push_back(row_json(row));
  return list;
}

}  // namespace

std::vector<const Row*> PaperRun::compared_rows() const {
  std::vector<const Row*> rows;
  for (const std::vector<Row>* part : {&table_1, &table_2, &text}) {
    for (const Row& row : *part) rows.push_back(&row);
  }
  return rows;
}

bool PaperRun::has_disagreement() const {
  const std::vector<const Row*> rows = compared_rows();
  const auto is_off = [this](double z) { return std::fabs(z) > options.max_z; };
  for (const std::vector<ErratumRow>* part : {&erratum, &erratum_orientations, &curve}) {
    if (std::ranges::any_of(*part, [&](const ErratumRow& row) { return is_off(row.z_of_exact_test()); })) return true;
  }
  return std::ranges::any_of(rows, [&](const Row* row) { return is_off(row->z()); }) ||
         std::ranges::any_of(referees, [](const RefereeRow& row) { return row.n_test_right > 0; });
}

std::string report_json(const PaperRun& run) {
  Json json = document_head(run.command, run.options, run.complete, run.seconds);
  json["trials"] = run.options.trials;
  json["table_1"] = rows_json(run.table_1);
  json["table_2"] = rows_json(run.table_2);
  json["text"] = rows_json(run.text);
  json["erratum"] = rows_json(run.erratum);
  json["erratum_orientations"] = rows_json(run.erratum_orientations);
  json["curve"] = rows_json(run.curve);
  json["referees"] = rows_json(run.referees);
  if (const std::vector<const Row*> rows = run.compared_rows(); !rows.empty()) {
    const MeanAndSpread z = of_z(rows);
    json["z"] = {{"rows", rows.size()}, {"mean", z.mean}, {"spread", z.spread}};
  }
  if (!run.erratum.empty()) {
    const ChiSquared all = chi_squared(run.erratum);
    json["erratum_chi_squared"] = {{"value", all.value}, {"rows", run.erratum.size()}, {"p", all.p}};
  }
  return document_text(json);
}

std::string report_text(const PaperRun& run) {
  std::string text =
      "Sreenivasan, Baker, Paul, Stanley, cond-mat/0207739: " + short_count(static_cast<double>(run.options.trials)) +
      " trials a row, seed " + std::to_string(run.options.seed) + "\n";
  if (!run.table_1.empty()) {
    text += "\nTable 1  boxes of unit volume, sides l1 and l2 = l3 (the paper's values: by its faulty code)\n" +
            rows_text(run.table_1, "l1/l2") + cost_text(run.table_1);
  }
  if (!run.table_2.empty()) {
    text += "\nTable 2  spheroids of unit volume, semi-axes a and b = c\n" + rows_text(run.table_2, "a/b");
  }
  if (!run.text.empty()) text += "\nText\n" + rows_text(run.text, "case");
  if (const std::vector<const Row*> rows = run.compared_rows(); !rows.empty()) {
    const MeanAndSpread z = of_z(rows);
    const double n = static_cast<double>(rows.size());
    text += "\nz over these " + std::to_string(rows.size()) + " rows: mean " + signed_number(2, z.mean) +
            " (expected 0 +- " + fixed_number(2, 1.0 / std::sqrt(n)) + "), spread " + fixed_number(2, z.spread) +
            " (expected 1 +- " + fixed_number(2, 1.0 / std::sqrt(2.0 * n)) + ")\n";
  }
  if (!run.erratum.empty()) text += erratum_text(run);
  if (!run.curve.empty()) text += curve_text(run);
  if (!run.referees.empty()) text += referees_text(run);
  if (!run.complete) text += "\nInterrupted: this is what was done until then.\n";
  return text + "\n" + fixed_number(1, run.seconds) + " s on " + std::to_string(run.options.n_threads) +
         (run.options.n_threads == 1 ? " thread\n" : " threads\n");
}

}  // namespace vex
