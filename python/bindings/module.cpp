// The compiled part of the Python package `vex`. It takes arrays that the Python side has made contiguous, and gives
// arrays; names, units and what is checked for the user are told there.
#include <pybind11/pybind11.h>

#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "python/bindings/body.h"

namespace py = pybind11;

PYBIND11_MODULE(_vex, module) {
  module.doc() = "The compiled part of vex; use the package vex.";
  module.attr("version") = VEX_VERSION;
  module.attr("stream_version") = vex::kStreamVersion;

  // As in C++: both are errors that a caller's input can cause, and ValueErrors.
  static py::exception<vex::Error> error(module, "Error", PyExc_ValueError);
  static py::exception<vex::UsageError> usage_error(module, "UsageError", error.ptr());
  static py::exception<vex::InputError> input_error(module, "InputError", error.ptr());
  for (const py::object& each : std::initializer_list<py::object>{error, usage_error, input_error})
    each.attr("__module__") = "vex";
  error.attr("__doc__") = "What a caller's input can cause.";
  usage_error.attr("__doc__") = "The call itself is wrong.";
  input_error.attr("__doc__") = "The call is right, but what it is given cannot be used.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const vex::UsageError& e) {
      usage_error(e.what());
    } catch (const vex::InputError& e) {
      input_error(e.what());
    } catch (const vex::Error& e) {
      error(e.what());
    }
  });

  vex::python::bind_bodies(module);
  vex::python::bind_excluded_volume(module);
  vex::python::bind_queries(module);
  vex::python::bind_scenes(module);
  vex::python::bind_percolation(module);
}
