// The compiled part of the Python package `vex`. It takes arrays that the Python side has made contiguous, and gives
// arrays; names, units and what is checked for the user are told there.
#include <pybind11/pybind11.h>

#include <algorithm>
#include <regex>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"
#include "python/bindings/body.h"

namespace py = pybind11;

namespace {

/// Options of the programs are parameters here: "--convex-tolerance 1e-3" is "convex_tolerance=1e-3".
std::string in_python_words(const std::string& message) {
  std::string text = std::regex_replace(message, std::regex("--hull\\b"), "hull=True");
  text = std::regex_replace(text, std::regex("--unit-volume\\b"), "unit_volume=True");
  std::string result;
  const std::regex option("--([a-z]+(?:-[a-z]+)*)(?: (?=[0-9A-Z.]))?");
  std::size_t from = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match) {
    std::string name = (*match)[1];
    std::replace(name.begin(), name.end(), '-', '_');
    result += text.substr(from, static_cast<std::size_t>(match->position()) - from) + name + "=";
    from = static_cast<std::size_t>(match->position() + match->length());
  }
  return result + text.substr(from);
}

// Pickle's protocols 0 and 1 make an object of pybind11's own base, whose constructor throws through C and ends the
// interpreter: whatever protocol is asked for, objects say how they are made as the second one has it.
void pickle_as_protocol_2(const py::module_& module) {
  const py::handle object = reinterpret_cast<PyObject*>(&PyBaseObject_Type);
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (std::string(py::str(py::type::handle_of(value).attr("__name__"))) != "pybind11_type") continue;
    value.attr("__reduce_ex__") =
        py::cpp_function([object](const py::object& self,
                                  int protocol) { return object.attr("__reduce_ex__")(self, std::max(protocol, 2)); },
                         py::name("__reduce_ex__"), py::is_method(value));
  }
}

}  // namespace

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
      usage_error(in_python_words(e.what()).c_str());
    } catch (const vex::InputError& e) {
      input_error(in_python_words(e.what()).c_str());
    } catch (const vex::Error& e) {
      error(in_python_words(e.what()).c_str());
    } catch (const vex::Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });

  vex::python::bind_bodies(module);
  vex::python::bind_excluded_volume(module);
  vex::python::bind_queries(module);
  vex::python::bind_separations(module);
  vex::python::bind_scenes(module);
  vex::python::bind_percolation(module);
  vex::python::bind_virial(module);
  vex::python::bind_nematic(module);
  vex::python::bind_depletion(module);
  vex::python::bind_worlds(module);
  vex::python::bind_poses(module);
  pickle_as_protocol_2(module);
}
