#include "apps/vex_percolate/report.h"

#include <cmath>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "apps/common/scene_gltf.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string label_of(std::size_t k) {
  return k < 26 ? std::string(1, static_cast<char>('A' + k)) : std::to_string(k + 1);
}

std::string bodies_text(const PercolateRun& run) {
  std::string text;
  double sum = 0.0;
  for (const BodyFraction& body : run.options.bodies) sum += body.fraction;
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    text += body_text(run.bodies[k], label_of(k), run.options.dump_vertices);
    if (run.bodies.size() > 1) {
      text += "   " + short_number(100.0 * run.options.bodies[k].fraction / sum, 6) + " % of the bodies\n";
    }
  }
  return text;
}

std::string system_text(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  std::string text = "placed uniformly in a periodic cube, orientations " + options.law;
  if (options.shell > 0.0) text += "; connected where the gap is at most " + short_number(options.shell);
  if (options.backend) text += "; overlap decided by " + options.backend_name + ", without proof";
  text += "\nsizes in units of " + short_number(run.extent) + ", the largest body's extent";
  if (options.shell > 0.0) text += " with its shell";
  return text + "; seed " + std::to_string(options.seed) + "\n";
}

// Where each criterion has the R of the threshold, by one size: the columns behind the number of realisations.
std::vector<std::string> size_columns(const PercolateRun& run, std::size_t k) {
  const double unit = run.eta_unit(), volume = run.sizes[k].volume();
  std::vector<std::string> columns;
  if (run.crossing) {
    const Crossing::OfSize& of_size = run.crossing->sizes[k];
    columns.push_back(fixed_number(0, run.crossing->threshold.density * volume));
    for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
      columns.push_back(with_error(of_size.density[c] * unit, of_size.std_error[c] * unit));
    }
  } else if (k < run.thresholds.size()) {
    const SizedThreshold& threshold = run.thresholds[k];
    columns.push_back(fixed_number(0, threshold.density[0] * volume));
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      columns.push_back(with_error(threshold.density[c] * unit, std::sqrt(threshold.covariance[c][c]) * unit));
    }
  }
  return columns;
}

std::string sizes_text(const PercolateRun& run) {
  const std::string of = run.is_flat() ? "n by " : "eta by ";
  std::vector<std::vector<std::string>> lines = {{"size", "cube's edge", "realisations", "bodies"}};
  if (run.is_isotropic) {
    for (const char* const name : {"x", "any", "all"}) lines[0].push_back(of + name);
  } else {
    for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
      lines[0].push_back(of + std::string(name_of_crossing_criterion(c)));
    }
  }
  for (std::size_t k = 0; k < run.sizes.size(); ++k) {
    const SizeRun& size = run.sizes[k];
    std::vector<std::string> line = {short_number(size.size), short_number(size.edge, 6),
                                     std::to_string(size.found.size())};
    for (std::string& column : size_columns(run, k)) line.push_back(std::move(column));
    line.resize(lines[0].size(), "-");
    lines.push_back(line);
  }
  return table_text(lines);
}

std::string text_of(const Estimated& one) { return with_error(one.value, one.std_error); }

std::string quality_text(const Extrapolation& fit) {
  return "chi^2 " + short_number(fit.chi_square, 3) + " of " + std::to_string(fit.degrees_of_freedom) +
         " degrees of freedom (p = " + short_number(fit.p_value, 2) + ")\n";
}

std::string remainder_text(const Extrapolation& fit, double unit) {
  std::string text;
  if (fit.without_smallest) {
    text += "without the smallest size: " + short_number(*fit.without_smallest * unit, 8) + ", " +
            short_number((*fit.without_smallest - fit.density) / fit.std_error, 2) + " errors away\n";
  }
  if (fit.p_value < 1e-3)
    text += "The sizes do NOT fit this law: the smallest is too small for it. Give larger ones.\n";
  return text;
}

std::string crossing_text(const PercolateRun& run) {
  const Crossing& crossing = *run.crossing;
  const Extrapolation& fit = crossing.threshold;
  const double unit = run.eta_unit();
  std::string text =
      "Orientations " + run.options.law +
      " are not isotropic, and universal values of R do not hold. The threshold is where R of all sizes cross, but for "
      "a L^-y, y = " +
      with_error(fit.exponent, fit.exponent_std_error) + ", in one fit of all criteria and sizes: " + quality_text(fit);
  text += "R at the threshold:";
  for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
    text += (c == 0 ? " " : ", ") + std::string(name_of_crossing_criterion(c)) + " " +
            with_error(crossing.probability[c], crossing.probability_std_error[c]);
  }
  text += "\nerrors: scatter " + short_number(fit.scatter_error * unit, 2) + ", offset " +
          short_number(fit.offset_error * unit, 2) + "\n";
  return text + remainder_text(fit, unit);
}

std::string fit_text(const PercolateRun& run) {
  if (run.crossing) return crossing_text(run);
  const Extrapolation& fit = *run.threshold;
  const double unit = run.eta_unit();
  if (!fit.is_extrapolated) {
    return "One size: not extrapolated, and the offset of its size is not in the errors. Give several --sizes.\n";
  }
  std::string text = "Extrapolated by a L^-theta + b L^-" + short_number(kNextSizeExponent) +
                     ", theta = " + with_error(fit.exponent, fit.exponent_std_error) +
                     ", in one fit of all criteria and sizes: " + quality_text(fit);
  text += "errors: scatter " + short_number(fit.scatter_error * unit, 2) + ", offset " +
          short_number(fit.offset_error * unit, 2) + ", universal values " +
          short_number(fit.universal_error * unit, 2) + "\n";
  return text + remainder_text(fit, unit);
}

std::string threshold_text(const PercolateRun& run) {
  const std::optional<CriticalValues> values = critical_values(run);
  if (!values) return "The threshold is not known: " + run.no_threshold_reason + ".\n";
  std::vector<std::vector<std::string>> lines;
  if (values->eta) lines.push_back({"eta_c", text_of(*values->eta), "n V"});
  if (values->phi) lines.push_back({"phi_c", text_of(*values->phi), "1 - exp(-eta)"});
  lines.push_back({"n_c", text_of(values->number_density), "bodies a volume"});
  if (values->b) lines.push_back({"B_c", text_of(*values->b), "n <V_ex>, neighbours a body"});
  std::string text;
  for (const std::vector<std::string>& line : lines) {
    std::string row = line[0] + "  " + line[1];
    row.resize(std::max<std::size_t>(row.size(), 26), ' ');
    text += row + "  " + line[2] + "\n";
  }
  if (!values->b) text += "B_c is not known: " + run.excluded_volume.reason + "\n";
  return text;
}

std::string counts_text(const PercolateRun& run) {
  const PercolationCounts counts = run.counts();
  const SceneCounts::Stage& bounds = counts.stages[SceneStage::bounds];
  const auto number = [](std::uint64_t n) { return short_count(static_cast<double>(n)); };
  std::string text = number(counts.n_bodies) + " bodies placed; of " + number(counts.n_seen()) +
                     " pairs whose bounds meet " + number(counts.n_skipped()) +
                     " were in one cluster already and not tested, " + number(counts.n_tested()) + " were";
  if (bounds.seen > 0) text += ", " + number(bounds.settled) + " of them decided by bounds";
  text += "; " + plural(counts.n_undecided, "pair is UNDECIDED", "pairs are undecided") + "\n";
  if (counts.n_undecided > 0) text += "Undecided pairs were taken for apart: they touch to within rounding.\n";
  const double seconds = run.seconds_before + run.seconds;
  text += short_number(seconds, 3) + " s on " +
          plural(static_cast<std::uint64_t>(run.options.n_threads), "thread", "threads");
  if (run.seconds_before > 0.0) text += ", " + short_number(run.seconds_before, 3) + " s of it before --resume";
  return text + " (" + processor() + ")\n";
}

}  // namespace

std::optional<CriticalValues> critical_values(const PercolateRun& run) {
  if (!run.threshold) return std::nullopt;
  CriticalValues values;
  const double n = run.threshold->density, error = run.threshold->std_error;
  values.number_density = {n, error};
  if (!run.is_flat()) {
    values.eta = Estimated{n * run.mean_volume, error * run.mean_volume};
    values.phi = Estimated{-std::expm1(-values.eta->value), std::exp(-values.eta->value) * values.eta->std_error};
  }
  const MeanExcludedVolume& forbidden = run.excluded_volume;
  if (forbidden.reason.empty()) {
    values.b = Estimated{n * forbidden.value, std::hypot(error * forbidden.value, n * forbidden.std_error)};
  }
  return values;
}

std::string report_text(const PercolateRun& run) {
  std::string text = bodies_text(run) + system_text(run) + "\n" + sizes_text(run) + "\n" + threshold_text(run);
  if (run.threshold) text += "\n" + fit_text(run);
  if (!run.stopped_because.empty()) text += "Ended before the error that was asked for: " + run.stopped_because + "\n";
  if (!run.complete) text += "INTERRUPTED: the run is not complete.\n";
  return text + counts_text(run);
}

std::string sample_gltf(const PercolateRun& run) {
  const SizeRun& smallest = run.sizes.front();
  if (smallest.found.empty())
    throw InputError("no realisation is there to be shown (--gltf) - let the run last longer");
  const std::uint32_t n = smallest.found.front().any();
  Realisation sample(*smallest.system);
  sample.place_and_join(run.first_realisation(), n);
  Clusters& clusters = sample.clusters();
  std::vector<std::uint8_t> colours(n, kPlain);
  for (BodyId body = 0; body < n; ++body) {
    const std::array<bool, 3> wraps = clusters.wraps(body);
    if (wraps[0] || wraps[1] || wraps[2]) {
      colours[body] = kStandsOut;
    } else if (clusters.n_bodies(body) == 1) {
      colours[body] = kSingle;
    }
  }
  std::vector<std::string> names(sample.scene().n_shapes());
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    for (ShapeId shape = 0; shape < names.size(); ++shape) {
      if (sample.scene().shape(shape).identity() == run.connecting[k].body.identity())
        names[shape] = run.bodies[k].source;
    }
  }
  return scene_gltf(sample.scene(), names, colours);
}

}  // namespace vex
