#include "apps/vex_scan/html_report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/html/page.h"
#include "apps/common/html/plot.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_scan/curves.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string name_of_scan(const Scan& scan) {
  return scan.pairs.size() > 1               ? plural(scan.pairs.size(), "pair", "pairs") + " of bodies"
         : scan.pairs.front().second.empty() ? scan.pairs.front().first
                                             : scan.pairs.front().first + " and " + scan.pairs.front().second;
}

/// The row that is farthest from its reference; none where nothing has one.
const ScanRow* farthest_row(const ScanRun& run) {
  const ScanRow* farthest = nullptr;
  for (const ScanRow& row : run.rows) {
    if (std::isfinite(row.z) && (farthest == nullptr || std::fabs(row.z) > std::fabs(farthest->z))) farthest = &row;
  }
  return farthest;
}

void add_headline(HtmlPage& page, const ScanRun& run) {
  page.headline(plural(run.rows.size(), "case", "cases"));
  if (!run.complete) {
    page.verdict(Tone::wait, "Incomplete: the scan was interrupted, and " +
                                 plural(run.scan.n_cases() - run.rows.size(), "case is left", "cases are left"));
  }
  if (run.n_refused > 0) page.verdict(Tone::bad, plural(run.n_refused, "case was refused", "cases were refused"));
  if (const ScanRow* const row = farthest_row(run)) {
    page.verdict(run.has_disagreement ? Tone::bad : Tone::good,
                 std::string(run.has_disagreement ? "A case DISAGREES with" : "All that can be compared agree with") +
                     " the formula or the exact average: the farthest is " + short_number(std::fabs(row->z), 2) +
                     " standard errors off");
  } else {
    page.verdict(Tone::wait, "Nothing is compared: no case has both a run and a reference");
  }
  if (run.has_fault) page.verdict(Tone::bad, "A verdict could not be proven again");
}

/// Bodies, orientations and options of the first case that is not refused.
void add_first_pair(HtmlPage& page, const ScanRun& run) {
  for (std::size_t index = 0; index < run.rows.size(); ++index) {
    if (!run.rows[index].error.empty()) continue;
    try {
      const Options options = options_of(case_of(run.scan, index));
      const auto [a, b] = load_two_bodies(options.a, options.b, options.bodies);
      const PairView view = pair_view(a.shape, options.a, b.shape, options.a == options.b ? "" : options.b,
                                      options.settings.law, options.seed);
      page.begin_section("The bodies of the first case, and where the second one cannot be", true);
      page.pair(view);
    } catch (const Error&) {  // a file that is not there any more: the numbers are what counts
    }
    return;
  }
}

void add_curves(HtmlPage& page, const ScanRun& run) {
  const std::size_t along_x = variable_along_x(run.scan);
  const bool has_x = along_x != kNoVariable;
  Plot plot;
  plot.title =
      "The excluded volume of each case with its standard error, and what the formula or the exact average says.";
  const std::string name = has_x ? run.scan.variables[along_x].name : "";
  plot.x_label = has_x ? name + (name == kAngle ? " (degrees)" : "") : "number of the case, from 0";
  plot.y_label = "⟨Vₑₓ⟩";
  const Curves curves = curves_of(run, along_x);
  double low = HUGE_VAL, high = 0.0, low_x = HUGE_VAL, high_x = 0.0;
  for (const auto& [label, points] : curves) {
    PlotSeries found{label.empty() ? "Monte Carlo" : label, {}, false, true, false};
    PlotSeries exact{curves.size() == 1 ? "formula or exact average" : "", {}, true, false, false};
    for (const ScanPoint& point : points) {
      found.points.push_back({point.x, point.y, std::isfinite(point.std_error) ? point.std_error : 0.0});
      if (std::isfinite(point.reference)) exact.points.push_back({point.x, point.reference});
      low = std::min(low, point.y), high = std::max(high, point.y);
      low_x = std::min(low_x, point.x), high_x = std::max(high_x, point.x);
    }
    plot.series.push_back(std::move(found));
    if (has_x && !exact.points.empty()) plot.series.push_back(std::move(exact));
  }
  constexpr double kManyTimes = 50.0;  // from which on an axis is logarithmic
  plot.log_y = low > 0.0 && high > kManyTimes * low;
  plot.log_x = has_x && low_x > 0.0 && high_x > kManyTimes * low_x;
  page.begin_section("From case to case", false);
  page.figure(plot_svg(plot),
              "Points: Monte Carlo, one standard error to either side. Lines: the formula, or the exact average.",
              "No case was done.");
}

void add_distances(HtmlPage& page, const ScanRun& run) {
  Plot plot;
  plot.title = "How far each case is from its reference, in standard errors.";
  plot.x_label = "number of the case, from 0";
  plot.y_label = "z";
  PlotSeries distances{"(Monte Carlo − reference) / standard error", {}, false, true, false};
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    if (std::isfinite(run.rows[k].z)) distances.points.push_back({static_cast<double>(k), run.rows[k].z});
  }
  if (distances.points.empty()) return;
  plot.series.push_back(std::move(distances));
  plot.levels.push_back({"0", 0.0});
  page.begin_section("How far from the reference", false);
  page.figure(plot_svg(plot), "Two of three lie between −1 and 1; each case has random numbers of its own.");
}

void add_rows(HtmlPage& page, const ScanRun& run) {
  PageTable table;
  table.caption =
      "Volumes in the cube of the bodies’ unit. The digits in parentheses are one standard error; z is how far a case "
      "is "
      "from its reference, in standard errors.";
  table.columns = {"case"};
  for (const ScanVariable& variable : run.scan.variables) table.columns.push_back(variable.name);
  for (const char* const column : {"⟨V_ex⟩", "formula or exact", "z", "B₂", "⟨V_ex⟩ / √(V_A V_B)", "S", "seconds"}) {
    table.columns.push_back(column);
  }
  const auto shown = [](double value, int digits) {
    return std::isfinite(value) ? short_number(value, digits) : std::string("–");
  };
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const ScanRow& row = run.rows[k];
    const std::string here = "/rows/" + std::to_string(k) + "/";
    std::vector<std::string> cells = {row.a == row.b ? row.a : row.a + ", " + row.b}, paths = {""};
    cells.insert(cells.end(), row.values.begin(), row.values.end());
    paths.resize(cells.size());
    if (!row.error.empty()) {
      cells.push_back("refused: " + row.error);
    } else {
      const auto add = [&](const std::string& text, const char* key) {
        cells.push_back(text);
        paths.push_back(here + key);
      };
      add(with_error(row.excluded_volume, row.std_error), "excluded_volume");
      add(shown(row.reference, 10), "reference");
      add(shown(row.z, 3), "z");
      add(with_error(row.b2, 0.5 * row.std_error), "b2");
      add(shown(row.reduced, 8), "reduced");
      const auto s = row.more.find("order_parameter");
      add(s != row.more.end() && s->is_number() ? short_number(s->get<double>(), 6) : "–", "order_parameter");
      add(shown(row.seconds, 3), "seconds");
    }
    table.rows.push_back(std::move(cells));
    table.paths.push_back(std::move(paths));
  }
  page.begin_section("All cases", true);
  page.table(table);
}

}  // namespace

std::string html_report(const ScanRun& run, const std::string& document_text) {
  const std::string title = "Excluded volumes of " + name_of_scan(run.scan);
  HtmlPage page("vex: " + title, title, document_text);
  add_headline(page, run);
  add_curves(page, run);
  add_distances(page, run);
  add_rows(page, run);
  add_first_pair(page, run);
  return page.text(run.command);
}

}  // namespace vex
