#include "apps/vex_scan/rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>

#include "apps/common/append_number.h"
#include "apps/common/case_seed.h"
#include "apps/common/csv_cells.h"
#include "apps/common/line_reader.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

struct NumberColumn {
  const char* name;
  double ScanRow::*value;
};
constexpr NumberColumn kNumbers[] = {{"excluded_volume", &ScanRow::excluded_volume},
                                     {"std_error", &ScanRow::std_error},
                                     {"reference", &ScanRow::reference},
                                     {"z", &ScanRow::z},
                                     {"b2", &ScanRow::b2},
                                     {"reduced", &ScanRow::reduced},
                                     {"seconds", &ScanRow::seconds}};

// Of a row of CSV, and the first members of an object of JSON.
std::vector<std::string> names_of_columns(const Scan& scan) {
  std::vector<std::string> names;
  for (const ScanVariable& variable : scan.variables) names.push_back(variable.name);
  std::ranges::copy(columns_of_results(), std::back_inserter(names));
  names.emplace_back("input");
  return names;
}

std::string csv_header(const Scan& scan) {
  std::string line;
  for (const std::string& name : names_of_columns(scan)) line += (line.empty() ? "" : ",") + name;
  return line;
}

void for_each_line(const std::string& path, const std::function<bool(std::string_view)>& use) {
  std::error_code error;
  if (path.empty() || path == "-" || !std::filesystem::is_regular_file(path, error)) return;
  try {
    LineReader lines(path, "rows");
    for (std::string_view line; lines.next(line);) {
      if (!use(line)) return;
    }
  } catch (const InputError&) {  // what cannot be read as lines has no rows
  }
}

std::optional<double> number_of_cell(std::string_view cell) {
  if (cell.empty()) return ScanRow::kNone;
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

std::optional<ScanRow> row_of_line(std::string_view line, const Scan& scan) {
  ScanRow row;
  CsvCells cells(line);
  const auto take = [&cells](std::string& text) {
    const std::optional<std::string_view> cell = cells.next();
    if (cell) text = *cell;
    return cell.has_value();
  };
  row.values.resize(scan.variables.size());
  for (std::string& value : row.values) {
    if (!take(value)) return std::nullopt;
  }
  if (!take(row.a) || !take(row.b)) return std::nullopt;
  for (const NumberColumn& column : kNumbers) {
    std::string cell;
    if (!take(cell)) return std::nullopt;
    const std::optional<double> number = number_of_cell(cell);
    if (!number) return std::nullopt;
    row.*column.value = *number;
  }
  if (!take(row.error) || !take(row.input) || cells.next()) return std::nullopt;
  return row;
}

std::optional<ScanRow> row_of_object(Json object, const Scan& scan) {
  if (!object.is_object()) return std::nullopt;
  ScanRow row;
  // Takes the key out: what is left are the further ones.
  const auto take = [&object](const std::string& key) {
    const auto found = object.find(key);
    if (found == object.end()) return Json();
    Json value = *found;
    object.erase(found);
    return value;
  };
  for (const ScanVariable& variable : scan.variables) {
    const Json value = take(variable.name);
    if (!value.is_number()) return std::nullopt;
    row.values.push_back(value.dump());
  }
  const Json a = take("a"), b = take("b"), error = take("error"), input = take("input");
  if (!a.is_string() || !b.is_string() || !error.is_null() || !input.is_string()) return std::nullopt;
  row.a = a;
  row.b = b;
  row.input = input;
  for (const NumberColumn& column : kNumbers) {
    const Json value = take(column.name);
    if (value.is_number()) row.*column.value = value;
  }
  row.more = std::move(object);
  return row;
}

}  // namespace

ScanRow row_of(const ScanCase& one, const MeshRun& run) {
  const ExcludedVolume& result = run.result;
  ScanRow row;
  row.values = one.values;
  row.a = one.a();
  row.b = one.b();
  row.excluded_volume = result.value;
  row.std_error = result.std_error;
  if (result.reference) row.reference = result.reference->value;
  if (result.z) row.z = *result.z;
  row.b2 = result.b2;
  row.reduced = result.reduced;
  row.seconds = result.record.seconds;
  const OrientationLaw& law = run.options.settings.law;
  row.more["seed"] = one.seed;
  row.more["orientations"] = law.name();
  row.more["order_parameter"] = law.order_parameter() ? Json(*law.order_parameter()) : Json(nullptr);
  row.more["reference_kind"] = result.reference ? Json(name_of(result.reference->kind)) : Json(nullptr);
  row.more["reference_error"] = result.reference ? number_or_null(result.reference->std_error) : Json(nullptr);
  row.more["estimator"] = result.estimator != nullptr ? Json(result.estimator->name) : Json(nullptr);
  row.more["trials"] = result.record.tally.n_trials;
  row.more["complete"] = result.record.complete;
  if (run.options.is_cross_check) row.more["disagreements"] = result.record.disagreements.n_all;
  if (run.options.settings.verify) row.more["unproven"] = result.record.unproven.n_all;
  return row;
}

ScanRow refused_row(const ScanCase& one, const std::string& error) {
  ScanRow row;
  row.values = one.values;
  row.a = one.a();
  row.b = one.b();
  row.error = error;
  return row;
}

std::string input_of(const ScanCase& one, const MeshRun& prepared) {
  std::string text = "vex_scan " + version() + "\n" + std::to_string(kStreamVersion) + "\n";
  CommandLine words = one.words;
  words.isa.clear();  // which changes nothing but the time
  words.max_z.clear();
  for (const std::string* const word : words_of_run(words)) text += *word + "\n";
  for (const bool flag : {words.hull, words.unit_volume, words.no_quick_verdicts, words.cross_check, words.verify}) {
    text += flag ? "1" : "0";
  }
  text += "\n" + std::to_string(one.seed) + "\n";
  if (!files_of_laws(words).empty()) text += prepared.options.settings.law.name() + "\n";  // what the file holds
  std::vector<const LoadedBody*> bodies = {&prepared.a, &prepared.b};
  for (const LoadedBody& body : prepared.control_bodies) bodies.push_back(&body);
  for (const LoadedBody* const body : bodies) {
    const Measures& measures = body->shape.measures;
    text += body->source;
    for (const double number : {measures.volume, measures.surface_area, measures.integrated_mean_curvature,
                                body->shape.body.circumradius(), body->shape.body.reach()}) {
      text += " " + hex_number(number);
    }
    text += "\n";
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hexadecimal;
  for (int shift = 60; shift >= 0; shift -= 4) hexadecimal += kDigits[(fingerprint(text) >> shift) & 15u];
  return hexadecimal;
}

std::string csv_text(const Scan& scan, const std::vector<ScanRow>& rows) {
  std::string text = csv_header(scan) + "\n";
  for (const ScanRow& row : rows) {
    for (const std::string& value : row.values) text += value + ",";
    text += csv_cell(printable(row.a)) + "," + csv_cell(printable(row.b));
    for (const NumberColumn& column : kNumbers) {
      text += ",";
      append_number(text, row.*column.value, "");
    }
    text += "," + csv_cell(printable(row.error)) + "," + row.input + "\n";
  }
  return text;
}

Json row_json(const Scan& scan, const ScanRow& row) {
  Json json = Json::object();
  for (std::size_t k = 0; k < scan.variables.size(); ++k) {
    json[scan.variables[k].name] = parse_number(row.values[k], scan.variables[k].name);
  }
  json["a"] = row.a;
  json["b"] = row.b;
  for (const NumberColumn& column : kNumbers) json[column.name] = number_or_null(row.*column.value);
  json["error"] = row.error.empty() ? Json(nullptr) : Json(row.error);
  json["input"] = row.input.empty() ? Json(nullptr) : Json(row.input);
  for (const auto& [key, value] : row.more.items()) json[key] = value;
  return json;
}

std::string jsonl_text(const Scan& scan, const std::vector<ScanRow>& rows) {
  std::string text;
  for (const ScanRow& row : rows) {
    text += row_json(scan, row).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  return text;
}

void require_rows_or_nothing(const Scan& scan) {
  // Every line, for what is no row would be gone; but the last one of a run that was ended while it wrote.
  const auto look_at = [](const std::string& path, const char* option, const auto& is_first_line, const auto& is_row) {
    std::error_code error;
    if (path.empty() || path == "-" || !std::filesystem::is_regular_file(path, error)) return;
    if (std::filesystem::file_size(path, error) == 0) return;
    std::ifstream file(path, std::ios::binary);
    std::size_t n = 0;
    for (std::string line; std::getline(file, line);) {
      ++n;
      if (n == 1 ? is_first_line(line) : is_row(line)) continue;
      if (n > 1 && file.eof()) return;  // without an end of line
      n = 0;
      break;
    }
    if (n > 0) return;
    throw UsageError(
        "a file that is no table of a scan over these variables, or has more in it, which would take its "
        "place (" +
        path + " for " + option + ") - choose another name, or remove the file");
  };
  look_at(
      scan.words.csv, "--csv", [&](const std::string& line) { return line == csv_header(scan); },
      [&](const std::string& line) {
        try {
          return row_of_line(line, scan).has_value();
        } catch (const InputError&) {
          return false;
        }
      });
  const std::vector<std::string> names = names_of_columns(scan);
  const auto is_object = [&names](const std::string& line) {
    const Json row = Json::parse(line, nullptr, false);
    if (!row.is_object() || row.size() < names.size()) return false;
    auto member = row.begin();
    if (!std::ranges::all_of(names, [&member](const std::string& name) { return (member++).key() == name; }))
      return false;
    return row["a"].is_string() && std::ranges::all_of(kNumbers, [&row](const NumberColumn& column) {
             return row[column.name].is_number() || row[column.name].is_null();
           });
  };
  look_at(scan.words.jsonl, "--jsonl", is_object, is_object);
}

std::map<std::string, ScanRow> rows_of_csv(const std::string& path, const Scan& scan) {
  std::map<std::string, ScanRow> rows;
  bool is_first = true;
  for_each_line(path, [&](std::string_view line) {
    if (is_first) {
      is_first = false;
      return line == csv_header(scan);
    }
    try {
      std::optional<ScanRow> row = row_of_line(line, scan);
      if (row && !row->input.empty() && row->error.empty()) rows.emplace(row->input, std::move(*row));
    } catch (const InputError&) {  // a line that was cut off
    }
    return true;
  });
  return rows;
}

std::map<std::string, ScanRow> rows_of_jsonl(const std::string& path, const Scan& scan) {
  std::map<std::string, ScanRow> rows;
  for_each_line(path, [&](std::string_view line) {
    std::optional<ScanRow> row = row_of_object(Json::parse(line, nullptr, false), scan);
    if (row) rows.emplace(row->input, std::move(*row));
    return true;
  });
  return rows;
}

}  // namespace vex
