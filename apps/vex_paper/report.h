// What vex_paper says: tables on the screen, and JSON.
#pragma once

#include <string>
#include <vector>

#include "apps/vex_paper/options.h"
#include "apps/vex_paper/rows.h"

namespace vex {

/// All that is reported. Of a part that was not asked for there are no rows.
struct PaperRun {
  std::string command;
  PaperOptions options;
  std::vector<Row> table_1{}, table_2{}, text{};
  std::vector<ErratumRow> erratum{}, erratum_orientations{}, curve{};
  std::vector<RefereeRow> referees{};
  bool complete = true;
  double seconds = 0.0;

  /// The rows of both tables and of the text.
  std::vector<const Row*> compared_rows() const;
  /// A row's |z| is above --max-z, or exact arithmetic contradicts the engine.
  bool has_disagreement() const;
};

/// The document of --json.
std::string report_json(const PaperRun& run);
std::string report_text(const PaperRun& run);

}  // namespace vex
