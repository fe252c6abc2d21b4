#include "shapes/estimators/excluded_volume.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <atomic>
#include <cmath>

#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/orientation_law_text.h"
#include "python/bindings/body.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/formula.h"

namespace vex::python {
namespace {

py::dict dict_of(const Tally& tally) {
  py::dict decided;
  for (int k = 0; k < kNDecidedBy; ++k) {
    decided[py::str(std::string(name_of(static_cast<DecidedBy>(k))))] = tally.n_decided_by[static_cast<std::size_t>(k)];
  }
  py::dict dict;
  dict["trials"] = tally.n_trials;
  dict["hits"] = tally.n_hits;
  dict["undecided"] = tally.n_undecided;
  dict["decided_by"] = decided;
  return dict;
}

py::object dict_of(const std::optional<Reference>& reference) {
  if (!reference) return py::none();
  py::dict dict;
  dict["kind"] = std::string(name_of(reference->kind));
  dict["value"] = reference->value;
  dict["std_error"] = reference->std_error;
  dict["reduced"] = reference->reduced;
  dict["b2"] = reference->b2;
  return dict;
}

py::dict dict_of(const ExcludedVolume& result) {
  py::dict dict;
  dict["value"] = result.value;
  dict["std_error"] = result.std_error;
  dict["interval"] = py::make_tuple(result.ci95.lower, result.ci95.upper);
  dict["reduced"] = result.reduced;
  dict["b2"] = result.b2;
  dict["reference"] = dict_of(result.reference);
  dict["reference_reason"] = result.reference_reason;
  dict["z"] = result.z;
  dict["z_reason"] = result.z_reason;
  dict["estimator"] =
      result.estimator == nullptr ? py::object(py::none()) : py::object(py::str(std::string(result.estimator->name)));
  dict["samples_poses"] = result.estimator != nullptr && result.estimator->samples_poses;
  dict["sequence"] = std::string(name_of(result.sequence));
  dict["chosen_because"] = result.chosen_because;
  dict["complete"] = result.complete;
  dict["stopped_by"] = std::string(name_of(result.record.stopped_by));
  dict["no_run_reason"] = result.no_run_reason;
  dict["seconds"] = result.record.seconds;
  dict["tally"] = dict_of(result.record.tally);
  dict["unproven"] = result.record.unproven.n_all;
  return dict;
}

/// Signals end the run, as does what `progress` throws; the run's own result is not lost by either.
py::tuple run(const PyBody& a, const PyBody& b, const py::dict& options, const py::object& progress) {
  ExcludedVolumeSettings settings;
  const auto take = [&options](const char* name, auto* to) {
    using Type = std::remove_pointer_t<decltype(to)>;
    if (options.contains(name)) *to = options[name].cast<Type>();
  };
  take("rel_error", &settings.rel_error);
  take("trials", &settings.trials);
  take("seconds", &settings.seconds);
  take("max_trials", &settings.max_trials);
  take("law", &settings.law);
  take("estimator", &settings.estimator);
  take("seed", &settings.seed);
  take("exact_average", &settings.exact_average);
  take("domain", &settings.domain);
  take("verify", &settings.verify);
  take("quick_verdicts", &settings.quick_verdicts);
  int threads = 0;
  take("threads", &threads);
  settings.threads = number_of_threads(threads);
  if (options.contains("sequence")) {
    const auto name = options["sequence"].cast<std::string>();
    if (name != name_of(Sequence::random) && name != name_of(Sequence::sobol)) {
      throw UsageError("not a sequence (" + name + ") - there are random and sobol");
    }
    settings.sequence = name == name_of(Sequence::sobol) ? Sequence::sobol : Sequence::random;
  }
  if (options.contains("control_variate")) {
    for (const py::handle& body : options["control_variate"].cast<py::list>()) {
      settings.control_variate.push_back(body.cast<const PyBody&>().body);
    }
  }

  std::atomic<int> interrupt{0};
  std::exception_ptr thrown;
  SignalWatch watch;
  settings.interrupt = &interrupt;
  settings.on_progress = [&](const Progress& now) {
    if (thrown) return;
    try {
      if (watch.has_thrown()) watch.rethrow();
      if (progress.is_none()) return;
      const WithGil with_gil;
      progress(now.tally.n_trials, now.relative_error, now.seconds);
    } catch (...) {
      thrown = std::current_exception();
      interrupt = 1;
    }
  };
  ExcludedVolume result;
  {
    const WithoutGil without_gil;
    result = excluded_volume(a.body, b.body, settings);
  }
  py::object error = py::none();
  if (thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const py::error_already_set& raised) {
      error = raised.value();
    }
  }
  return py::make_tuple(dict_of(result), error);
}

struct ValueRow {
  double value, error;
};

/// The exact average over law(k) for each of n laws.
template <class Law>
py::array_t<ValueRow> averages(const PyBody& a, const PyBody& b, std::size_t n, std::uint64_t seed, int threads,
                               const Law& law) {
  py::array_t<ValueRow> result(static_cast<py::ssize_t>(n));
  ValueRow* const to = result.mutable_data();
  over_rows(n, threads, 1, [&] {
    return [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        ExactAverageSettings settings;
        settings.seed = seed;
        const ExactAverage value = exact_average(a.body, b.body, law(k), settings);
        to[k] = {value.excluded_volume, value.error};
      }
    };
  });
  return result;
}

py::array_t<ValueRow> excluded_volume_of_angle(const PyBody& a, const PyBody& b, const Floats& degrees,
                                               std::uint64_t seed, int threads) {
  const double* const angles = degrees.data();
  return averages(a, b, static_cast<std::size_t>(degrees.size()), seed, threads,
                  [angles](std::size_t k) { return OrientationLaw::angle(angles[k]); });
}

/// V_ex at each rotation, exactly but for `error`: a bound on rounding, and one standard error where curved parts are
/// summed over random points.
py::array_t<ValueRow> excluded_volume_at(const PyBody& a, const PyBody& b, const Floats& quaternions,
                                         std::uint64_t seed, int threads) {
  if (quaternions.ndim() != 2 || quaternions.shape(1) != 4) {
    throw UsageError("not an array of rotations - give quaternions (N, 4), rows of qw, qx, qy, qz");
  }
  const double* const rows = quaternions.data();
  return averages(a, b, static_cast<std::size_t>(quaternions.shape(0)), seed, threads, [rows](std::size_t k) {
    const double* const q = rows + 4 * k;
    return OrientationLaw::fixed(q[0], q[1], q[2], q[3]);
  });
}

}  // namespace

void bind_excluded_volume(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ValueRow, value, error);

  py::class_<OrientationLaw>(module, "OrientationLaw", "How the bodies are turned.")
      .def_static("isotropic", &OrientationLaw::isotropic)
      .def_static("aligned", &OrientationLaw::aligned)
      .def_static("fixed", &OrientationLaw::fixed, py::arg("w"), py::arg("x"), py::arg("y"), py::arg("z"))
      .def_static("cone", &OrientationLaw::cone, py::arg("degrees"))
      .def_static("angle", &OrientationLaw::angle, py::arg("degrees"))
      .def_static("onsager", &OrientationLaw::onsager, py::arg("alpha"))
      .def_static(
          "parse", [](const std::string& text) { return parse_orientation_law(text); }, py::arg("text"))
      .def("__repr__", [](const OrientationLaw& law) { return "<vex.OrientationLaw " + law.name() + ">"; })
      .def(
          "__eq__", [](const OrientationLaw& x, const OrientationLaw& y) { return x == y; }, py::is_operator())
      .def("__hash__", [](const OrientationLaw& law) { return std::hash<std::string>()(law.name()); })
      .def_property_readonly("name", &OrientationLaw::name)
      .def_property_readonly("order_parameter", &OrientationLaw::order_parameter);

  module.def("excluded_volume", &run, py::arg("a"), py::arg("b"), py::arg("options"), py::arg("progress"));
  module.def("excluded_volume_at", &excluded_volume_at, py::arg("a"), py::arg("b"), py::arg("quaternions"),
             py::arg("seed"), py::arg("threads"));
  module.def("excluded_volume_of_angle", &excluded_volume_of_angle, py::arg("a"), py::arg("b"), py::arg("degrees"),
             py::arg("seed"), py::arg("threads"));
  module.def(
      "formula",
      [](const PyBody& a, const PyBody& b) { return average_excluded_volume(a.body.measures, b.body.measures); },
      py::arg("a"), py::arg("b"));
  module.def("estimators", [] {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const Estimator* estimator : estimators()) lines.emplace_back(estimator->name, estimator->meaning);
    return lines;
  });
}

}  // namespace vex::python
