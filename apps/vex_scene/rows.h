// Answers as rows of text: CSV, or an object of JSON a line.
#pragma once

#include <climits>
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

/// At most so many bytes are written at once: so many go into a pipe whole or not at all, whatever ends the program.
inline constexpr std::size_t kMostBytesAtOnce = PIPE_BUF;

/// Header and rows, in pieces of whole rows of at most kMostBytesAtOnce, until `write` says that it is to end.
void write_rows(SceneQuery query, RowFormat format, const Findings& found,
                const std::function<bool(std::string_view)>& write);

}  // namespace vex
