// Answers as rows of text: CSV, or an object of JSON a line.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "apps/vex_scene/findings.h"

namespace vex {

/// How many rows there are, the header not among them.
std::size_t n_rows(SceneQuery query, const Findings& found);

/// Of CSV, with its end of line; nothing of JSON lines. A column `verdict` stands there only where a pair is undecided.
std::string row_header(SceneQuery query, RowFormat format, const Findings& found);

/// Row k, with its end of line. Numbers read back as the same doubles.
void append_row(std::string& text, SceneQuery query, RowFormat format, const Findings& found, std::size_t k);

/// Header and rows, in blocks, until `write` says that nobody listens.
void write_rows(SceneQuery query, RowFormat format, const Findings& found,
                const std::function<bool(std::string_view)>& write);

}  // namespace vex
