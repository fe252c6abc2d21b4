#include <pybind11/stl.h>

#include <atomic>

#include "python/bindings/body.h"
#include "shapes/estimators/virial_coefficients.h"

namespace vex::python {
namespace {

py::dict dict_of(const VirialCoefficient& found) {
  py::dict dict;
  dict["n"] = found.n;
  dict["reduced"] = found.reduced;
  dict["std_error"] = found.std_error;
  dict["per_volume"] = found.per_volume;
  dict["per_volume_std_error"] = found.per_volume_std_error;
  dict["samples"] = found.samples;
  dict["sign_settled"] = found.sign_is_settled();
  dict["complete"] = found.record.complete;
  dict["undecided"] = found.record.tally.n_undecided;
  return dict;
}

/// B2, B2 / V, the higher ones, whether all runs were complete, seconds. Signals end the run and are raised.
py::tuple virial_coefficients_of(const PyBody& body, int first_order, int order, std::optional<double> rel_error,
                                 std::optional<double> seconds, std::optional<std::uint64_t> samples,
                                 const OrientationLaw& law, std::uint64_t seed, int threads) {
  VirialSettings settings;
  settings.first_order = first_order;
  settings.order = order;
  settings.rel_error = rel_error;
  settings.seconds = seconds;
  settings.samples = samples;
  settings.law = law;
  settings.seed = seed;
  settings.threads = number_of_threads(threads);
  std::atomic<int> interrupt{0};
  SignalWatch watch;
  settings.interrupt = &interrupt;
  settings.on_progress = [&](int, const Progress&) {
    if (watch.has_thrown()) interrupt = 1;
  };
  VirialCoefficients found;
  {
    const WithoutGil without_gil;
    found = virial_coefficients(body.body, settings);
  }
  if (watch.has_thrown()) watch.rethrow();
  py::list higher;
  for (const VirialCoefficient& one : found.higher) higher.append(dict_of(one));
  return py::make_tuple(found.b2, found.b2_per_volume, higher, found.complete, found.seconds);
}

}  // namespace

void bind_virial(py::module_& module) {
  module.def("virial_coefficients", &virial_coefficients_of, py::arg("body"), py::arg("first_order"), py::arg("order"),
             py::arg("rel_error"), py::arg("seconds"), py::arg("samples"), py::arg("law"), py::arg("seed"),
             py::arg("threads"));
}

}  // namespace vex::python
