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
    // Where no trial is made and nothing is told, as in exact averages; the run ends by `interrupt`, with its result.
    const Interruption ahead([&] {
      if (!thrown && watch.has_thrown()) settings.on_progress({});
      return false;
    });
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

/// What a law is made from: the quaternion, the angle, or each body's law, with the points of tables; and the axes.
py::tuple parts_of_law(const OrientationLaw& law) {
  const auto of_body = [&law](std::size_t body) {
    const AxisLaw& axis = law.of_body(body);
    const AxisTable* const points = axis.points();
    return points != nullptr ? py::make_tuple(points->cosines, points->densities) : py::make_tuple(axis.name());
  };
  const auto axis = [&law](std::size_t body) {
    const Vec3d& v = law.axis_of(body);
    return py::make_tuple(v.x, v.y, v.z);
  };
  const bool is_of_two = law.kind() == OrientationLaw::Kind::fixed || law.kind() == OrientationLaw::Kind::angle;
  const std::string text = law.name();
  const py::object of_two =
      is_of_two ? py::object(py::cast(text.substr(0, text.find(" about ")))) : py::object(py::none());
  return py::make_tuple(of_two, of_body(0), of_body(1),
                        law.has_axes() ? py::make_tuple(axis(0), axis(1)) : py::tuple());
}

Vec3d vector_of(const py::handle& three) {
  const auto [x, y, z] = three.cast<std::tuple<double, double, double>>();
  return {x, y, z};
}

OrientationLaw law_of_parts(const py::tuple& state) {
  if (state.size() != 4) throw UsageError("no state of an orientation law - pickle one again");
  const auto of_body = [&state](std::size_t body) {
    const auto parts = state[1 + body].cast<py::tuple>();
    if (parts.size() == 1) return parse_axis_law(parts[0].cast<std::string>());
    return AxisLaw::table({parts[0].cast<std::vector<double>>(), parts[1].cast<std::vector<double>>()});
  };
  const OrientationLaw law = state[0].is_none() ? OrientationLaw::each(of_body(0), of_body(1))
                                                : parse_orientation_law(state[0].cast<std::string>());
  const auto axes = state[3].cast<py::tuple>();
  return axes.empty() ? law : law.about(vector_of(axes[0]), vector_of(axes[1]));
}

/// A law of one body, by name or as that of both: "cone:20", OrientationLaw.table(...).
AxisLaw axis_law_of(const py::object& law) {
  if (py::isinstance<py::str>(law)) return parse_axis_law(law.cast<std::string>());
  const auto both = law.cast<OrientationLaw>();
  if (both.kind() == OrientationLaw::Kind::fixed || both.kind() == OrientationLaw::Kind::angle || both.has_axes() ||
      !(both.of_body(0) == both.of_body(1))) {
    throw UsageError("no law of one body (" + both.name() + ") - give isotropic, aligned, a cone, a density");
  }
  return both.of_body(0);
}

Vec3d axis_of_object(const py::object& axis) {
  return py::isinstance<py::str>(axis) ? parse_axis(axis.cast<std::string>()) : vector_of(axis);
}

}  // namespace

void bind_excluded_volume(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ValueRow, value, error);

  py::class_<OrientationLaw>(module, "OrientationLaw", "How the bodies are turned.")
      .def_static("isotropic", &OrientationLaw::isotropic, "Each body in any orientation, all as likely.")
      .def_static("aligned", &OrientationLaw::aligned, "Both bodies as they are.")
      .def_static("fixed", &OrientationLaw::fixed, py::arg("w"), py::arg("x"), py::arg("y"), py::arg("z"),
                  "B turned by this quaternion in A's frame, of any length but 0.")
      .def_static("cone", &OrientationLaw::cone, py::arg("degrees"),
                  "Each body's z axis within this angle, from 0 to 90, of one line, spun about itself.")
      .def_static("angle", &OrientationLaw::angle, py::arg("degrees"),
                  "B's z axis at this angle to A's, each body spun about its own.")
      .def_static("onsager", &OrientationLaw::onsager, py::arg("alpha"),
                  "The density of each body's z axis is as cosh(alpha cos theta), alpha from 0 on.")
      .def_static("maier_saupe", &OrientationLaw::maier_saupe, py::arg("strength"),
                  "The density of each body's z axis is as exp(strength P_2(cos theta)).")
      .def_static(
          "table",
          [](std::vector<double> cosines, std::vector<double> densities) {
            return OrientationLaw::table({std::move(cosines), std::move(densities)});
          },
          py::arg("cosines"), py::arg("densities"), "A density over cos theta of each body's z axis, by points of it.")
      .def_static(
          "each",
          [](const py::object& a, const py::object& b) { return OrientationLaw::each(axis_law_of(a), axis_law_of(b)); },
          py::arg("a"), py::arg("b"), "A law for each body: texts, or laws of which both bodies' is one.")
      .def(
          "about",
          [](const OrientationLaw& law, const py::object& axis_a, const py::object& axis_b) {
            const Vec3d a = axis_of_object(axis_a);
            return law.about(a, axis_b.is_none() ? a : axis_of_object(axis_b));
          },
          py::arg("axis_a"), py::arg("axis_b") = py::none(),
          "The same about other axes of the bodies than z: three numbers, or x, y, z; B's as A's where it is not "
          "given.")
      .def(py::pickle(&parts_of_law, &law_of_parts))
      .def_static(
          "parse", [](const std::string& text) { return parse_orientation_law(text); }, py::arg("text"),
          "By the text that vex_mesh takes: \"cone:20\".")
      .def("__repr__", [](const OrientationLaw& law) { return "<vex.OrientationLaw " + law.name() + ">"; })
      .def(
          "__eq__", [](const OrientationLaw& x, const OrientationLaw& y) { return x == y; }, py::is_operator())
      .def("__hash__", [](const OrientationLaw& law) { return std::hash<std::string>()(law.name()); })
      .def_property_readonly("name", &OrientationLaw::name, "The text of it.")
      .def_property_readonly("order_parameter", &OrientationLaw::order_parameter,
                             "The mean of P_2(cos theta) of one body's axis; None where the bodies' differ.")
      .def_property_readonly("order_parameters", &OrientationLaw::order_parameters, "Of each body's axis.");

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
