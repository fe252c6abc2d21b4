// The page of --report.
#pragma once

#include <string>

#include "apps/vex_scan/scan_run.h"

namespace vex {

/// `document_text`: the text of --json. Takes some tenths of a second, for the bodies of the first case are loaded and
/// drawn.
std::string html_report(const ScanRun& run, const std::string& document_text);

}  // namespace vex
