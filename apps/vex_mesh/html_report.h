// The page of --report.
#pragma once

#include "apps/vex_mesh/history.h"
#include "apps/vex_mesh/report.h"

namespace vex {

/// One page of HTML. `document_text`: what --json writes of the same run.
std::string html_report(const MeshRun& run, const std::vector<HistoryPoint>& history, const std::string& document_text);

}  // namespace vex
