#include <pybind11/stl.h>

#include "python/bindings/body.h"
#include "shapes/estimators/nematic_transition.h"

namespace vex::python {
namespace {

NematicTheory theory_of(const std::string& name) {
  if (name == "onsager") return NematicTheory::onsager;
  if (name == "parsons-lee") return NematicTheory::parsons_lee;
  throw UsageError("not a theory of nematics (" + name + ") - there are onsager and parsons-lee");
}

py::dict dict_of(const NematicTransition& of, const NematicPhase& phase) {
  py::dict dict;
  dict["number_density"] = of.number_density(phase);
  dict["volume_fraction"] = of.volume_fraction(phase);
  dict["reduced_density"] = phase.reduced_density;
  dict["order_parameter"] = phase.order_parameter;
  dict["pressure"] = of.pressure(phase);
  dict["chemical_potential"] = phase.chemical_potential;
  dict["cosines"] = py::array_t<double>(static_cast<py::ssize_t>(phase.cosines.size()), phase.cosines.data());
  dict["density"] = py::array_t<double>(static_cast<py::ssize_t>(phase.density.size()), phase.density.data());
  return dict;
}

py::dict dict_of(const MixtureTransition& of, const MixturePhase& phase) {
  py::dict dict;
  dict["number_densities"] = py::make_tuple(phase.number_densities[0], phase.number_densities[1]);
  dict["number_density"] = phase.number_density();
  dict["composition"] = phase.composition();
  dict["volume_fraction"] = of.volume_fraction(phase);
  dict["reduced_density"] = of.reduced_density(phase);
  dict["order_parameters"] = py::make_tuple(phase.order_parameters[0], phase.order_parameters[1]);
  dict["pressure"] = phase.pressure;
  dict["chemical_potentials"] = py::make_tuple(phase.chemical_potentials[0], phase.chemical_potentials[1]);
  return dict;
}

/// <V_ex>; both fluids, or none, and why; the error of the grid; the series of V_ex(gamma) / <V_ex>; notes.
py::tuple nematic_transition_of(const PyBody& body, const std::string& theory, bool trial_function) {
  const NematicTheory by = theory_of(theory);
  const NematicTransition found = interruptibly([&] { return nematic_transition(body.body, by, trial_function); });
  py::object isotropic = py::none(), nematic = py::none();
  double grid_error = kNan;
  if (found.result.found) {
    isotropic = dict_of(found, found.result.found->isotropic);
    nematic = dict_of(found, found.result.found->nematic);
    grid_error = found.result.found->grid_error;
  }
  return py::make_tuple(found.excluded_volume, isotropic, nematic, found.result.reason, grid_error, found.fluid.series,
                        found.notes);
}

/// <V_ex> of A with A, A with B, B with B; the equilibria, those of three fluids, and why not to the end.
py::tuple mixture_transition_of(const PyBody& a, const PyBody& b, const std::vector<double>& compositions,
                                const std::string& theory) {
  const NematicTheory by = theory_of(theory);
  const MixtureTransition found = interruptibly([&] { return mixture_transition(a.body, b.body, compositions, by); });
  py::list equilibria, three;
  for (const MixtureCoexistence& one : found.result.found) {
    equilibria.append(
        py::make_tuple(one.composition, dict_of(found, one.isotropic), dict_of(found, one.nematic), one.residual));
  }
  for (const ThreeFluids& one : found.result.three) {
    three.append(
        py::make_tuple(dict_of(found, one.isotropic), dict_of(found, one.nematic[0]), dict_of(found, one.nematic[1])));
  }
  const NematicMixture& mixture = found.mixture;
  return py::make_tuple(
      py::make_tuple(mixture.aa.excluded_volume, mixture.ab.excluded_volume, mixture.bb.excluded_volume), equilibria,
      three, found.result.reason);
}

}  // namespace

void bind_nematic(py::module_& module) {
  module.def("nematic_transition", &nematic_transition_of, py::arg("body"), py::arg("theory"),
             py::arg("trial_function"));
  module.def("mixture_transition", &mixture_transition_of, py::arg("a"), py::arg("b"), py::arg("compositions"),
             py::arg("theory"));
}

}  // namespace vex::python
