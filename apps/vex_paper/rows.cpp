#include "apps/vex_paper/rows.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "apps/common/bodies.h"
#include "apps/common/numbers.h"
#include "apps/referees/exact_referee.h"
#include "apps/referees/specialised_backend.h"
#include "apps/referees/wrong_tests.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "engine/sampling/poses/orientation_law_text.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/formula.h"

namespace vex {
namespace {

// Numbers of the cases of each part: 1 ..., 101 ...
enum FirstNumber : int {
  kTableOne = 1,
  kTableTwo = 101,
  kText = 201,
  kErratum = 301,
  kErratumOrientations = 351,
  kReferees = 401,
  kCurve = 501
};

std::string box_of(double ratio) { return "box:" + shortest_number(ratio) + ",1,1"; }
std::string spheroid_of(double ratio) { return "ellipsoid:" + shortest_number(ratio) + ",1,1"; }

// The printed digits of "Calculated" cannot tell smaller differences from rounding.
constexpr double kPrintedDigits = 6e-4;

std::string remark_on(const paper::TableRow& row, double exact) {
  std::string remark = row.remark;
  if (row.printed.calculated && std::fabs(*row.printed.calculated - exact) > kPrintedDigits) {
    if (!remark.empty()) remark += "; ";
    remark += "the paper's \"Calculated\" " + short_number(*row.printed.calculated) + " is a misprint for " +
              short_number(exact);
  }
  return remark;
}

struct LoadedPair {
  LoadedBody a, b;
  explicit LoadedPair(const Case& what)
      : a(load_body(what.a, options_of(what))), b(what.a == what.b ? a : load_body(what.b, options_of(what))) {}

  const ConvexBody& body_a() const { return a.shape.body; }
  const ConvexBody& body_b() const { return b.shape.body; }
  double formula() const { return average_excluded_volume(a.shape.measures, b.shape.measures); }

 private:
  static BodyOptions options_of(const Case& what) {
    BodyOptions options;
    options.unit_volume = what.unit_volume;
    return options;
  }
};

// The next case of a part, its bodies scaled to unit volume.
Case& add_case(std::vector<Case>& cases, int first_number, std::string label, std::string a, std::string b) {
  Case& one = cases.emplace_back();
  one.number = first_number + static_cast<int>(cases.size()) - 1;
  one.label = std::move(label);
  one.a = std::move(a);
  one.b = std::move(b);
  one.unit_volume = true;
  return one;
}

// Two equal bodies of this aspect ratio.
Case& add_ratio(std::vector<Case>& cases, int first_number, double ratio, std::string (*body)(double ratio)) {
  Case& one = add_case(cases, first_number, short_number(ratio), body(ratio), body(ratio));
  one.aspect_ratio = ratio;
  return one;
}

std::vector<Case> cases_of_table(std::span<const paper::TableRow> rows, int first_number,
                                 std::string (*body)(double ratio)) {
  std::vector<Case> cases;
  for (const paper::TableRow& row : rows) {
    Case& one = add_ratio(cases, first_number, row.aspect_ratio, body);
    one.printed = row.printed;
    one.remark = remark_on(row, LoadedPair(one).formula());
  }
  return cases;
}

MonteCarloSettings settings_for(const Case& what, const LoadedPair& pair, const Sampling& sampling) {
  MonteCarloSettings settings;
  settings.seed = sampling.seed_of(what);
  settings.n_threads = sampling.n_threads;
  settings.law = parse_orientation_law(what.orientations, "--orientations");
  settings.domain = what.domain == Domain::Kind::fitted ? fitted_domain(pair.body_a(), pair.body_b())
                                                        : box_domain(pair.body_a(), pair.body_b());
  settings.quick_verdicts = what.quick_verdicts;
  settings.stop.trials = sampling.n_trials;
  settings.stop.max_trials = sampling.n_trials;
  settings.interrupt = sampling.interrupt;
  settings.on_progress = sampling.on_progress;
  return settings;
}

// By the formula where it holds.
ExactAverage exact_value(const LoadedPair& pair, const MonteCarloSettings& settings) {
  if (settings.law.kind() == OrientationLaw::Kind::isotropic) return {pair.formula(), 0.0};
  ExactAverageSettings average;
  average.interrupt = settings.interrupt;
  return exact_average(pair.a.shape, pair.b.shape, settings.law, average);
}

std::string command_of(const Case& what, const Sampling& sampling) {
  std::string text = "vex_mesh " + what.a + (what.b == what.a ? "" : " " + what.b);
  if (what.unit_volume) text += " --unit-volume";
  if (what.orientations != "isotropic") text += " --orientations " + what.orientations;
  text += what.domain == Domain::Kind::fitted ? " --estimator hit-or-miss-fitted" : " --domain box";
  if (!what.quick_verdicts) text += " --no-quick-verdicts";
  return text + " --seed " + std::to_string(sampling.seed_of(what)) + " --trials " + std::to_string(sampling.n_trials);
}

}  // namespace

std::vector<Case> table_one() { return cases_of_table(paper::kTableOne, kTableOne, box_of); }

std::vector<Case> table_two() {
  std::vector<Case> cases = cases_of_table(paper::kTableTwo, kTableTwo, spheroid_of);
  for (Case& one : cases) {
    if (one.aspect_ratio != 1.0) continue;
    // Of spheres the balls about their centres decide everything: without them, in the box, the row is a test of GJK.
    one.domain = Domain::Kind::box;
    one.quick_verdicts = false;
  }
  return cases;
}

std::vector<Case> cases_of_the_text() {
  std::vector<Case> cases;
  const auto add = [&cases](std::string label, std::string a, std::string b, std::string orientations) -> Case& {
    Case& one = add_case(cases, kText, std::move(label), std::move(a), std::move(b));
    one.unit_volume = one.a.rfind("capsule", 0) != 0;
    one.orientations = std::move(orientations);
    return one;
  };
  const std::string capsule = "capsule:1,0.25", cube = "box:1,1,1", sphere = "sphere:1";
  add("capsules L = 1, R = 0.25", capsule, capsule, "isotropic").printed = paper::kCapsules;
  add("sphere and cube", sphere, cube, "isotropic").printed = paper::kSphereAndCube;
  Case& aligned = add("aligned cubes", cube, cube, "aligned");
  aligned.printed = paper::kAlignedCubes;
  aligned.domain = Domain::Kind::box;  // a fitted one is the excluded volume itself
  add("cubes, the paper's corrected code", cube, cube, "isotropic").printed = paper::kCorrectedCubes;
  // A number of fixed relative orientations: the paper gives no values.
  add("cubes, turned 45 degrees about an edge", cube, cube, "fixed:2.414213562373095,0,0,1");
  add("cubes, turned 60 degrees about a diagonal", cube, cube, "fixed:3,1,1,1");
  add("cubes, turned by 1 + 2i + 3j + 4k", cube, cube, "fixed:1,2,3,4");
  add("platelets l1/l2 = 0.01, turned by 1 + 2i + 3j + 4k", box_of(0.01), box_of(0.01), "fixed:1,2,3,4");
  add("prisms l1/l2 = 8, turned by 1 + 2i + 3j + 4k", box_of(8.0), box_of(8.0), "fixed:1,2,3,4");
  add("spheroids a/b = 4, turned by 1 + 2i + 3j + 4k", spheroid_of(4.0), spheroid_of(4.0), "fixed:1,2,3,4");
  // Random orientations in a specified angular interval about +-z.
  for (const char* const cone : {"cone:10", "cone:30", "cone:60"}) {
    add("capsules, within " + std::string(cone).substr(5) + " degrees of z", capsule, capsule, cone);
  }
  add("cubes, within 30 degrees of z", cube, cube, "cone:30");
  add("platelets 1 x 1 x 0.01, within 30 degrees of z", "box:1,1,0.01", "box:1,1,0.01", "cone:30");
  add("prisms 1 x 1 x 8, within 30 degrees of z", "box:1,1,8", "box:1,1,8", "cone:30");
  add("capsules, Onsager's trial function, alpha = 5", capsule, capsule, "onsager:5");
  add("prisms 1 x 1 x 8, Onsager's, alpha = 20", "box:1,1,8", "box:1,1,8", "onsager:20");
  return cases;
}

double Row::z() const { return (found.excluded_volume - exact) / std::hypot(found.std_error, exact_error); }

double Row::trials_for_a_thousandth() const {
  const double relative = found.relative_error() / 1e-3;
  return static_cast<double>(record.tally.n_trials) * relative * relative;
}

std::optional<Row> measure(const Case& what, const Sampling& sampling) {
  const LoadedPair pair(what);
  const MonteCarloSettings settings = settings_for(what, pair, sampling);
  Row row{what, command_of(what, sampling)};
  const ExactAverage exact = exact_value(pair, settings);
  row.exact = exact.excluded_volume;
  row.exact_error = exact.error;
  row.record = run_monte_carlo(pair.body_a(), pair.body_b(), settings);
  if (row.record.tally.n_trials == 0) return std::nullopt;
  row.found = volume_estimate(row.record.tally, settings.domain);
  return row;
}

double ErratumRow::z() const {
  return (values.front().excluded_volume - what.printed->excluded_volume) /
         std::hypot(values.front().std_error, what.printed->uncertainty);
}

std::vector<Case> erratum_cases() {
  std::vector<Case> cases = cases_of_table(paper::kTableOne, kErratum, box_of);
  for (Case& one : cases) one.remark.clear();  // about the column "Calculated", which is not looked at here
  return cases;
}

std::vector<Case> erratum_orientations() {
  std::vector<Case> cases;
  for (const auto& [label, orientations] :
       {std::pair{"aligned", "aligned"}, std::pair{"turned 30 degrees about an edge", "fixed:3.732050807568877,0,0,1"},
        std::pair{"turned 45 degrees about an edge", "fixed:2.414213562373095,0,0,1"},
        std::pair{"turned 60 degrees about a diagonal", "fixed:3,1,1,1"},
        std::pair{"turned by 1 + 2i + 3j + 4k", "fixed:1,2,3,4"}}) {
    Case& one = add_case(cases, kErratumOrientations, label, "box:1,1,1", "box:1,1,1");
    one.orientations = orientations;
    one.domain = Domain::Kind::box;
  }
  return cases;
}

std::vector<Case> curve_cases() {
  std::vector<Case> cases;
  for (const double ratio : {1e-6, 1e-5, 1e-4, 1e-3, 0.003, 0.01, 0.02, 0.04, 0.07, 0.1,  0.15, 0.2,  0.3,
                             0.4,  0.5,  0.6,  0.7,  0.8,   0.9,  1.0,  1.1,  1.25, 1.5,  1.75, 2.0,  2.5,
                             3.0,  4.0,  5.0,  6.0,  8.0,   11.0, 16.0, 22.0, 32.0, 45.0, 64.0, 100.0}) {
    add_ratio(cases, kCurve, ratio, box_of);
  }
  return cases;
}

std::optional<ErratumRow> measure_erratum(const Case& what, const Sampling& sampling) {
  const LoadedPair pair(what);
  MonteCarloSettings settings = settings_for(what, pair, sampling);
  ErratumRow row{what, exact_value(pair, settings).excluded_volume, {}, {}, {}};
  const auto run_with = [&](std::vector<BackendKind> tests) {
    settings.cross_check = std::move(tests);
    const RunRecord record = run_monte_carlo(pair.body_a(), pair.body_b(), settings);
    for (std::size_t k = 0; k < settings.cross_check.size() && record.tally.n_trials > 0; ++k) {
      const VolumeEstimate deficit = excess_over_other(record.tally, record.comparisons[k], settings.domain);
      row.values.push_back({settings.cross_check[k].name, row.exact - deficit.excluded_volume, deficit.std_error,
                            deficit.excluded_volume});
    }
    return record;
  };

  row.record = run_with({one_sided_backend(), edges_required_both_ways_backend(), vertices_either_way_backend(),
                         vertices_one_way_backend()});
  if (row.record.tally.n_trials == 0) return std::nullopt;
  row.found = volume_estimate(row.record.tally, settings.domain);
  // This test invents overlaps, outside of any domain that is fitted to true ones. All are in A's box, widened by B's
  // circumradius: along A's axes it is right.
  settings.domain = box_domain(pair.body_a(), pair.body_b());
  const RunRecord of_inventor = run_with({face_normals_only_backend()});
  row.record.complete = row.record.complete && of_inventor.complete;
  row.record.seconds += of_inventor.seconds;
  return row;
}

ChiSquared chi_squared(const std::vector<ErratumRow>& rows) {
  ChiSquared result;
  if (rows.empty()) return result;
  for (const ErratumRow& row : rows) result.value += row.z() * row.z();
  const boost::math::chi_squared distribution(static_cast<double>(rows.size()));
  result.p = cdf(complement(distribution, result.value));
  return result;
}

std::vector<Case> referee_cases() {
  std::vector<Case> cases;
  const auto add = [&cases](const std::string& a, const std::string& b) {
    add_case(cases, kReferees, a == b ? a : a + " and " + b, a, b);
  };
  for (const double ratio : {1e-6, 0.01, 1.0, 64.0}) add(box_of(ratio), box_of(ratio));
  for (const double ratio : {0.03125, 0.5, 4.0, 32.0}) add(spheroid_of(ratio), spheroid_of(ratio));
  add("ellipsoid:1,2,3", "ellipsoid:1,2,3");
  add("capsule:1,0.25", "capsule:1,0.25");
  add("capsule:100,0.25", "capsule:100,0.25");
  add("sphere:1", "sphere:1");
  for (const char* const other : {"box:1,1,1", "ellipsoid:4,1,1", "capsule:1,0.25"}) {
    add("sphere:1", other);
    add(other, "sphere:1");
  }
  return cases;
}

std::vector<BackendKind> specialised_tests() { return {specialised_backend(), box_edges_backend()}; }

std::vector<RefereeRow> measure_referees(const Case& what, const Sampling& sampling,
                                         const std::vector<BackendKind>& tests, const BackendKind& engine) {
  const LoadedPair pair(what);
  MonteCarloSettings settings = settings_for(what, pair, sampling);
  settings.quick_verdicts = false;
  settings.backend = engine;
  for (const BackendKind& kind : tests) {
    if (kind.takes(pair.body_a(), pair.body_b())) settings.cross_check.push_back(kind);
  }
  const RunRecord record = run_monte_carlo(pair.body_a(), pair.body_b(), settings);
  std::vector<RefereeRow> rows;
  for (std::size_t k = 0; k < settings.cross_check.size(); ++k) {
    const Comparison& comparison = record.comparisons[k];
    RefereeRow row{what, settings.cross_check[k].name};
    row.n_poses = record.tally.n_trials;
    row.n_engine_undecided = record.tally.n_undecided;
    row.n_test_undecided = comparison.n_undecided;
    row.n_disagreements = comparison.n_only_run + comparison.n_only_other;
    row.seconds = record.seconds;
    row.complete = record.complete;
    for (const Disagreement& found : record.disagreements.kept) {
      const Outcome ours = found.outcomes[0], other = found.outcomes[k + 1];
      if (ours == other || ours == Outcome::undecided || other == Outcome::undecided) continue;
      const Outcome truth = exact_outcome(pair.body_a(), pair.body_b(), found.a_from_b);
      ++(truth == ours ? row.n_engine_right : row.n_test_right);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace vex
