#include "apps/vex_bench/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "apps/common/text.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.insert(0, width - text.size(), ' ');
  return text;
}
std::string padded_right(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

constexpr double kForever = 1e7;  // seconds: some months

std::string time_text(const TimeToError& time) {
  if (!std::isfinite(time.seconds)) return "-";
  if (time.seconds > kForever) return "never";
  return (time.is_extrapolated ? "~" : "") + short_number(time.seconds, 2);
}

// Of the peers, the one that is first at this error; nothing without any.
std::optional<double> fastest_peer(const BodyCurves& body, double error) {
  std::optional<double> least;
  for (const ErrorCurve& curve : body.curves) {
    if (!curve.is_library) continue;
    const double seconds = curve.time_to(error).seconds;
    if (std::isfinite(seconds) && (!least || seconds < *least)) least = seconds;
  }
  return least;
}

// How many times as fast as the fastest peer at 1e-4; nothing for what is none.
std::optional<double> ratio_to_peers(const BodyCurves& body, const ErrorCurve& curve) {
  constexpr double kAt = 1e-4;
  const std::optional<double> peer = fastest_peer(body, kAt);
  const double seconds = curve.time_to(kAt).seconds;
  if (!peer || !std::isfinite(seconds)) return std::nullopt;
  return *peer / seconds;
}

std::string body_table(const BodyCurves& body) {
  std::string text =
      body.body.name +
      (body.body.source.empty() || body.body.source == body.body.name ? ""
                                                                      : "  (" + printable(body.body.source) + ")") +
      ", <V_ex> = " + short_number(body.exact, 10) + "\n";
  text += padded_right("   estimator, points, backend", 34);
  for (const char* const head : {"ns", "error", "true", "slope", "FOM", "to 1e-3", "to 1e-4", "to 1e-5", "ratio"}) {
    text += padded(head, 9);
  }
  text += "\n";
  for (const ErrorCurve& curve : body.curves) {
    const Rung& last = curve.rungs.back();
    text += padded_right("   " + curve.name(), 34);
    text += padded(short_number(1e9 * last.seconds / static_cast<double>(last.n_trials), 3), 9);
    const auto error_text = [](double error) { return error < 1.0 ? short_number(error, 2) : std::string("none"); };
    text += padded(error_text(last.relative_error), 9) + padded(error_text(last.true_relative_error), 9);
    text += padded(curve.slope() ? fixed_number(2, *curve.slope()) : "-", 9);
    text += padded(short_number(curve.figure_of_merit(), 2), 9);
    for (const double error : kErrorsAskedFor) text += padded(time_text(curve.time_to(error)), 9);
    const std::optional<double> ratio = ratio_to_peers(body, curve);
    text += padded(ratio ? short_number(*ratio, 3) : "-", 9) + "\n";
  }
  return text;
}

}  // namespace

std::string report_text(const BenchRun& run) {
  std::string text = "Run time against error, " + processor() + ", " + std::to_string(run.options.n_threads) +
                     (run.options.n_threads == 1 ? " thread" : " threads") + "\n\n";
  for (const BodyCurves& body : run.bodies) text += body_table(body) + "\n";
  text +=
      "ns: of a trial or value, of the longest runs. error: relative standard error of these; true: against the "
      "formula.\n"
      "slope: of log error over log trials. FOM: 1 / (variance x seconds). to 1e-3 ...: seconds; ~ is extrapolated.\n"
      "ratio: seconds to 1e-4 of the fastest peer (libccd, FCL; hit or miss) over those of the row.\n"
      "mixed-volume and mean-width run no GJK: they share the formula's geometry.\n";
  if (!run.complete) text += "Interrupted: this is what was measured until then.\n";
  return text;
}

std::string report_json(const BenchRun& run) {
  Json json = document_head(run.command, run.options, run.complete, run.seconds);
  json["processor"] = processor();
  json["bodies"] = Json::array();
  for (const BodyCurves& body : run.bodies) {
    Json of_body{{"name", body.body.name}, {"source", body.body.source}, {"excluded_volume", body.exact}};
    of_body["curves"] = Json::array();
    for (const ErrorCurve& curve : body.curves) {
      Json of_curve{{"estimator", curve.estimator->name},
                    {"sequence", name_of(curve.sequence)},
                    {"backend", curve.estimator->runs_gjk ? Json(curve.backend) : Json(nullptr)},
                    {"slope", number_or_null(curve.slope())},
                    {"figure_of_merit", number_or_null(curve.figure_of_merit())},
                    {"ratio_to_peers_at_1e-4", number_or_null(ratio_to_peers(body, curve))}};
      for (const double error : kErrorsAskedFor) {
        const TimeToError time = curve.time_to(error);
        of_curve["seconds_to"].push_back({{"relative_error", error},
                                          {"seconds", number_or_null(time.seconds)},
                                          {"extrapolated", time.is_extrapolated}});
      }
      of_curve["points"] = Json::array();
      for (const Rung& rung : curve.rungs) {
        of_curve["points"].push_back({{"trials", rung.n_trials},
                                      {"runs", rung.n_runs},
                                      {"seconds", rung.seconds},
                                      {"relative_error", number_or_null(rung.relative_error)},
                                      {"true_relative_error", number_or_null(rung.true_relative_error)},
                                      {"largest_z", number_or_null(rung.largest_z)}});
      }
      of_body["curves"].push_back(std::move(of_curve));
    }
    json["bodies"].push_back(std::move(of_body));
  }
  return document_text(json);
}

std::string report_csv(const BenchRun& run) {
  std::string text =
      "body,source,estimator,sequence,backend,trials,runs,seconds,relative_error,true_relative_error,figure_of_merit\n";
  const auto quoted = [](const std::string& word) {
    std::string escaped;
    for (const char c : word) escaped += c == '"' ? std::string("\"\"") : std::string(1, c);
    return "\"" + escaped + "\"";
  };
  for (const BodyCurves& body : run.bodies) {
    for (const ErrorCurve& curve : body.curves) {
      for (const Rung& rung : curve.rungs) {
        text += quoted(body.body.name) + "," + quoted(body.body.source) + "," + std::string(curve.estimator->name) +
                "," + std::string(name_of(curve.sequence)) + "," + curve.backend + "," + std::to_string(rung.n_trials) +
                "," + std::to_string(rung.n_runs) + "," + shortest_number(rung.seconds) + "," +
                shortest_number(rung.relative_error) + "," + shortest_number(rung.true_relative_error) + "," +
                shortest_number(1.0 / (rung.relative_error * rung.relative_error * rung.seconds)) + "\n";
      }
    }
  }
  return text;
}

}  // namespace vex
