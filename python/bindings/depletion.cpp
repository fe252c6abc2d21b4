#include "shapes/estimators/depletion.h"

#include <pybind11/stl.h>

#include "python/bindings/body.h"

namespace vex::python {
namespace {

struct DepletionRow {
  std::int8_t bodies;  // a verdict
  double overlap_volume, std_error;
  std::uint64_t trials, undecided;
  bool complete;
};
struct DepletionAverageRow {
  double free_share, free_share_error;
  double overlap_volume, overlap_volume_error;
  double mean_of_free, mean_of_free_error;
  std::uint64_t trials, undecided;
  bool complete;
};

/// Of the options that Python gives.
DepletionSettings depletion_settings(const py::dict& options) {
  DepletionSettings settings;
  settings.ball_radius = options["ball_radius"].cast<double>();
  settings.rel_error = options["rel_error"].cast<std::optional<double>>();
  settings.trials = options["trials"].cast<std::optional<std::uint64_t>>();
  settings.seconds = options["seconds"].cast<std::optional<double>>();
  settings.max_trials = options["max_trials"].cast<std::uint64_t>();
  settings.threads = number_of_threads(options["threads"].cast<int>());
  return settings;
}

/// work(k, settings) for each of n runs, one after another, each by all threads. Signals end them and are raised.
template <class Work>
void over_runs(std::size_t n, DepletionSettings settings, const Work& work) {
  settings.on_progress = [](const Progress&) { end_if_interrupted(); };
  interruptibly([&] {
    for (std::size_t k = 0; k < n; ++k) {
      end_if_interrupted();
      work(k, settings);
    }
  });
}

using Seeds = py::array_t<std::uint64_t, py::array::c_style>;

py::array_t<DepletionRow> depletion_of_poses(const PyBody& a, const PyBody& b, const Floats& rows,
                                             const std::optional<Floats>& translations, const Seeds& seeds,
                                             const py::dict& options) {
  const PoseRows poses(rows, translations);
  if (static_cast<std::size_t>(seeds.size()) != poses.size()) throw UsageError("not a seed for each pose - give one");
  py::array_t<DepletionRow> result(static_cast<py::ssize_t>(poses.size()));
  DepletionRow* const to = result.mutable_data();
  const std::uint64_t* const seed = seeds.data();
  over_runs(poses.size(), depletion_settings(options), [&](std::size_t k, DepletionSettings& settings) {
    settings.seed = seed[k];
    const DepletionAtPose found = depletion_at(a.body, b.body, poses[k], settings);
    const DepletionValue& volume = found.overlap_volume;
    to[k] = {number_of(found.bodies),         volume.value,   volume.std_error, volume.record.tally.n_trials,
             volume.record.tally.n_undecided, volume.complete};
  });
  return result;
}

py::array_t<DepletionAverageRow> depletion_averages(const PyBody& a, const PyBody& b, const Floats& distances,
                                                    const OrientationLaw& law, const Seeds& seeds,
                                                    const py::dict& options) {
  if (seeds.size() != distances.size()) throw UsageError("not a seed for each distance - give one");
  py::array_t<DepletionAverageRow> result(distances.size());
  DepletionAverageRow* const to = result.mutable_data();
  const double* const distance = distances.data();
  const std::uint64_t* const seed = seeds.data();
  over_runs(static_cast<std::size_t>(distances.size()), depletion_settings(options),
            [&](std::size_t k, DepletionSettings& settings) {
              settings.seed = seed[k];
              const DepletionAverage found = depletion_average(a.body, b.body, distance[k], law, settings);
              const DepletionValue &share = found.free_share, &volume = found.overlap_volume;
              to[k] = {share.value,
                       share.std_error,
                       volume.value,
                       volume.std_error,
                       found.mean_of_free(),
                       found.mean_of_free_error(),
                       share.record.tally.n_trials + volume.record.tally.n_trials,
                       share.record.tally.n_undecided + volume.record.tally.n_undecided,
                       share.complete && volume.complete};
            });
  return result;
}

/// Of arrays (N,) of one length.
Floats overlaps_of_balls(const Floats& radii_1, const Floats& radii_2, const Floats& distances) {
  if (radii_1.size() != distances.size() || radii_2.size() != distances.size()) {
    throw UsageError("not as many radii as distances - give one each");
  }
  Floats volumes(distances.size());
  for (py::ssize_t k = 0; k < distances.size(); ++k) {
    volumes.mutable_data()[k] = overlap_of_balls(radii_1.data()[k], radii_2.data()[k], distances.data()[k]);
  }
  return volumes;
}

}  // namespace

void bind_depletion(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(DepletionRow, bodies, overlap_volume, std_error, trials, undecided, complete);
  PYBIND11_NUMPY_DTYPE(DepletionAverageRow, free_share, free_share_error, overlap_volume, overlap_volume_error,
                       mean_of_free, mean_of_free_error, trials, undecided, complete);
  const auto a = py::arg("a"), b = py::arg("b"), seeds = py::arg("seeds"), options = py::arg("options");
  module.def("depletion_at", &depletion_of_poses, a, b, py::arg("poses"), py::arg("translations").none(true), seeds,
             options);
  module.def("depletion_average", &depletion_averages, a, b, py::arg("distances"), py::arg("law"), seeds, options);
  module.def("overlap_of_balls", &overlaps_of_balls, py::arg("radii_1"), py::arg("radii_2"), py::arg("distances"));
}

}  // namespace vex::python
