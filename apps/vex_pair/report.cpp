#include "apps/vex_pair/report.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

std::string in_words(DecidedBy by) {
  switch (by) {
    case DecidedBy::outer_bound: return "the circumscribed balls, which do not meet";
    case DecidedBy::inner_bound: return "the inscribed balls, which meet";
    case DecidedBy::gjk: return "GJK in double precision, with its rounding errors bounded";
    case DecidedBy::double_double: return "GJK in twice the precision, with its rounding errors bounded";
    case DecidedBy::exact: return "exact arithmetic";
    case DecidedBy::peer: break;
  }
  return "another library";
}

std::string vector_text(const Vec3d& v) {
  return "(" + shortest_number(v.x) + ", " + shortest_number(v.y) + ", " + shortest_number(v.z) + ")";
}

std::string line(const std::string& name, const std::string& value) {
  return "   " + name + std::string(34 - name.size(), ' ') + value + "\n";
}

std::string certificate_text(const Answer& answer) {
  if (answer.verdict.outcome == Outcome::undecided) return line("certificate", "none: nothing is proven");
  const OverlapCertificate& certificate = answer.certificate;
  std::string text;
  if (answer.verdict.outcome == Outcome::disjoint) {
    text += line("separating direction", vector_text(certificate.separating_dir));
    text += line("   and what doubles left of it", vector_text(certificate.separating_dir_low));
  }
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    const Witness& witness = certificate.witnesses[static_cast<std::size_t>(k)];
    text += line("witness " + std::to_string(k) + ": direction", vector_text(witness.dir));
    text += line("   and what doubles left of it", vector_text(witness.dir_low));
    text += line("   point of A", vector_text(witness.point_a));
    text += line("   point of B, in B's frame", vector_text(witness.point_b));
  }
  if (answer.check) {
    text += line("proven again from these",
                 answer.check->is_proven ? "yes, in exact arithmetic" : "no: " + answer.check->fault);
  }
  return text;
}

std::string plural(std::uint64_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

std::string report_text(const PairRun& run) {
  const Answer& answer = *run.one;
  std::string text;
  if (run.options.dump_vertices) text += body_text(run.a, "A", true) + body_text(run.b, "B", true) + "\n";
  const std::string pair = "A " + printable(run.a.source) + " and B " + printable(run.b.source);
  switch (answer.verdict.outcome) {
    case Outcome::disjoint: text += pair + " are DISJOINT: they share no point\n"; break;
    case Outcome::overlap: text += pair + " OVERLAP: they share a point\n"; break;
    case Outcome::undecided: text += pair + ": UNDECIDED\n"; break;
  }
  if (answer.verdict.outcome == Outcome::undecided) {
    text +=
        line("because", answer.verdict.reason == UndecidedReason::rounding
                            ? "a move by no more than rounding would part them, or make them meet: neither is proven"
                            : "the search was given up");
    const auto bound = [](double value) { return std::isfinite(value) ? short_number(value, 6) : "unknown"; };
    text += line("gap (negative: depth), from below", bound(answer.certificate.gap_lower));
    text += line("   from above", bound(answer.certificate.gap_upper));
  } else {
    text += line("proven by", in_words(answer.verdict.by));
  }
  text += line("support calls", std::to_string(answer.certificate.n_support_calls));
  if (run.options.layout.with_certificate) text += certificate_text(answer);
  return text;
}

std::string summary_text(const PairRun& run) {
  const Counts& counts = run.found.counts;
  std::string text = plural(counts.n_rows, "pose", "poses") + ": " + std::to_string(counts.n_disjoint) + " disjoint, " +
                     std::to_string(counts.n_overlap) + " overlap, " + std::to_string(counts.n_undecided) +
                     " undecided";
  if (counts.n_refused > 0) text += ", " + std::to_string(counts.n_refused) + " refused";
  std::string by;
  for (std::size_t k = 0; k < counts.decided_by.size(); ++k) {
    if (counts.decided_by[k] == 0) continue;
    by += (by.empty() ? "; decided by " : ", ") + std::string(name_of(static_cast<DecidedBy>(k))) + " " +
          std::to_string(counts.decided_by[k]);
  }
  text += by;
  if (run.options.layout.with_certificate) {
    text += "; proven again " + std::to_string(counts.n_reproven) + ", not " + std::to_string(counts.n_not_reproven);
  }
  text += "; " + short_number(run.seconds, 3) + " s";
  if (run.found.interrupted) text += " - interrupted: this is what was done until then";
  return text + "\n";
}

std::string report_json(const PairRun& run) {
  Json json = document_head(run.command, run.options, !run.found.interrupted, run.seconds);
  json["bodies"] = {body_json(run.a, run.options.dump_vertices), body_json(run.b, run.options.dump_vertices)};
  json["query"] = "overlap";
  if (run.options.pose) {
    json["pose"] = twelve_numbers(*run.options.pose);
  } else {
    json["poses"] = run.options.poses;
  }
  const Counts& counts = run.found.counts;
  json["rows"] = counts.n_rows;
  json["verdicts"] = {
      {"disjoint", counts.n_disjoint}, {"overlap", counts.n_overlap}, {"undecided", counts.n_undecided}};
  json["refused"] = counts.n_refused;
  json["decided_by"] = Json::object();
  for (std::size_t k = 0; k < counts.decided_by.size(); ++k) {
    json["decided_by"][std::string(name_of(static_cast<DecidedBy>(k)))] = counts.decided_by[k];
  }
  if (run.options.layout.with_certificate) {
    json["certificates"] = {{"reproven", counts.n_reproven}, {"not_reproven", counts.n_not_reproven}};
  }
  json["results"] = nullptr;
  if (counts.n_rows > kMostListedRows) {
    json["results_reason"] = "more than " + std::to_string(kMostListedRows) + " rows: --jsonl writes them all";
  } else {
    json["results"] = Json::array();
    std::istringstream rows(run.found.first_rows);
    for (std::string row; std::getline(rows, row);) json["results"].push_back(Json::parse(row));
  }
  return document_text(json);
}

}  // namespace vex
