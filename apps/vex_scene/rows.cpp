#include "apps/vex_scene/rows.h"

#include "apps/common/append_number.h"

namespace vex {
namespace {

bool has_verdicts(const Findings& found) { return found.n_undecided.value_or(0) > 0; }

std::string_view verdict_of(SceneQuery query, const FoundPair& found) {
  if (found.is_undecided) return "undecided";
  return query == SceneQuery::within ? "within" : "overlap";
}

void append_csv_pair(std::string& text, SceneQuery query, const Findings& found, const FoundPair& row) {
  append_integer(text, row.pair.a);
  text += ',';
  append_integer(text, row.pair.b);
  for (const int offset : row.pair.image) {
    text += ',';
    append_integer(text, offset);
  }
  if (query == SceneQuery::within) {
    text += ',';
    if (!row.is_undecided) append_number(text, row.distance, "");
  }
  if (has_verdicts(found)) {
    text += ',';
    text += verdict_of(query, row);
  }
}

void append_json_pair(std::string& text, SceneQuery query, const FoundPair& row) {
  text += "{\"a\":";
  append_integer(text, row.pair.a);
  text += ",\"b\":";
  append_integer(text, row.pair.b);
  text += ",\"image\":[";
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0) text += ',';
    append_integer(text, row.pair.image[k]);
  }
  text += ']';
  if (query == SceneQuery::within) {
    text += ",\"distance\":";
    append_number(text, row.is_undecided ? HUGE_VAL : row.distance, "null");
  }
  text += ",\"verdict\":\"";
  text += verdict_of(query, row);
  text += "\"}";
}

}  // namespace

std::size_t n_rows(SceneQuery query, const Findings& found) {
  switch (query) {
    case SceneQuery::pairs:
    case SceneQuery::within: return found.pairs.size();
    case SceneQuery::any: return 1;
    case SceneQuery::clusters: return found.labels.size();
    case SceneQuery::counts: break;
  }
  return 0;
}

std::string row_header(SceneQuery query, RowFormat format, const Findings& found) {
  if (format == RowFormat::jsonl || query == SceneQuery::counts) return "";
  if (query == SceneQuery::any) return "verdict\n";
  if (query == SceneQuery::clusters) return "body,cluster\n";
  return std::string("a,b,image_x,image_y,image_z") + (query == SceneQuery::within ? ",distance" : "") +
         (has_verdicts(found) ? ",verdict\n" : "\n");
}

void append_row(std::string& text, SceneQuery query, RowFormat format, const Findings& found, std::size_t k) {
  const bool is_json = format == RowFormat::jsonl;
  if (query == SceneQuery::any) {
    text += is_json ? "{\"verdict\":\"" : "";
    text += name_of(found.answer.outcome);
    text += is_json ? "\"}" : "";
  } else if (query == SceneQuery::clusters) {
    text += is_json ? "{\"body\":" : "";
    append_integer(text, k);
    text += is_json ? ",\"cluster\":" : ",";
    append_integer(text, found.labels[k]);
    text += is_json ? "}" : "";
  } else if (is_json) {
    append_json_pair(text, query, found.pairs[k]);
  } else {
    append_csv_pair(text, query, found, found.pairs[k]);
  }
  text += '\n';
}

void write_rows(SceneQuery query, RowFormat format, const Findings& found,
                const std::function<bool(std::string_view)>& write) {
  std::string text = row_header(query, format, found), row;
  const std::size_t n = n_rows(query, found);
  for (std::size_t k = 0; k < n; ++k) {
    row.clear();
    append_row(row, query, format, found, k);
    if (text.size() + row.size() > kMostBytesAtOnce) {
      if (!write(text)) return;
      text.clear();
    }
    text += row;
  }
  write(text);
}

}  // namespace vex
