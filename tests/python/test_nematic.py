"""Fluids that become nematic: the program's numbers, and known ones."""
import json
import math

import numpy as np
import pytest

import vex


@pytest.mark.parametrize("body, options", [("capsule:20,0.5", ()), ("cylinder:10,0.5", ("--theory", "parsons-lee")),
                                           ("disc:1", ("--trial-function", "onsager")), ("cone:5,0.5", ())])
def test_the_transition_is_that_of_the_program(program, body, options):
    document = json.loads(program("vex_nematic", body, *options, "--json", "-"))
    found = vex.nematic_transition(body, theory="parsons-lee" if "parsons-lee" in options else "onsager",
                                   trial_function="--trial-function" in options)
    assert found.excluded_volume == document["excluded_volume"]
    for phase, told in ((found.isotropic, document["isotropic"]), (found.nematic, document["nematic"])):
        assert (phase.number_density, phase.reduced_density) == (told["number_density"], told["reduced_density"])
        assert phase.volume_fraction == told["volume_fraction"] or (
            told["volume_fraction"] is None and math.isnan(phase.volume_fraction))
    nematic = found.nematic
    assert (nematic.order_parameter, nematic.pressure, nematic.chemical_potential) == (
        document["nematic"]["order_parameter"], document["pressure"], document["chemical_potential"])
    assert np.stack([nematic.cosines, nematic.density], axis=1).tolist() == document["density"]
    assert len(found.isotropic.density) == 0 and found.isotropic.order_parameter == 0
    assert found.grid_error == document["grid_error"] < 1e-10 and found.reason == ""
    assert found.series[:17].tolist() == document["excluded_volume_series"]
    assert list(found.notes) == document["notes"] and "(nematic)" in str(found)


def test_long_rods_have_the_known_transition():
    found = vex.nematic_transition("capsule:1e6,0.5")
    assert found.isotropic.reduced_density == pytest.approx(3.290, abs=1e-3)
    assert found.nematic.reduced_density == pytest.approx(4.191, abs=1e-3)
    assert found.nematic.order_parameter == pytest.approx(0.792, abs=1e-3)


def test_mixtures_are_those_of_the_program(program):
    document = json.loads(program("vex_nematic", "capsule:1000,0.5", "capsule:3500,0.5", "--composition", "0:0.2:0.1",
                                  "--json", "-"))
    found = vex.mixture_transition("capsule:1000,0.5", "capsule:3500,0.5", [0, 0.1, 0.2])
    assert list(found.excluded_volumes) == document["excluded_volumes"]
    assert len(found.found) == len(document["mixture"]) == 3 and found.reason == ""

    def same(phase, told):
        assert (phase.number_density, phase.composition, phase.reduced_density) == (
            told["number_density"], told["composition"], told["reduced_density"])
        assert phase.volume_fraction == told["volume_fraction"]
        assert list(phase.order_parameters) == told.get("order_parameters", list(phase.order_parameters))

    for one, told in zip(found.found, document["mixture"]):
        same(one.isotropic, told["isotropic"])
        same(one.nematic, told["nematic"])
        assert (one.composition, one.nematic.pressure, one.residual) == (
            told["composition"], told["pressure"], told["residual"])
        assert list(one.nematic.chemical_potentials) == told["chemical_potentials"]
    assert len(found.three) == len(document["three_fluids"]) == 1  # of rods that are unlike enough
    same(found.three[0].isotropic, document["three_fluids"][0]["isotropic"])
    for phase, told in zip(found.three[0].nematic, document["three_fluids"][0]["nematic"]):
        same(phase, told)


def test_what_has_no_transition_says_why():
    found = vex.nematic_transition("sphere:1")
    assert found.isotropic is None and found.nematic is None and "align" in found.reason
    assert math.isnan(found.grid_error) and str(found).startswith("no transition")
    assert any("fourth rank" in note for note in vex.nematic_transition("box:1,1,1").notes)
    assert "A alone" in vex.mixture_transition("sphere:1", "capsule:1000,0.5", [0.5]).reason
    with pytest.raises(vex.InputError, match="exclude no volume"):
        vex.nematic_transition("needle:1")
    with pytest.raises(vex.InputError, match="too long"):
        vex.nematic_transition("ellipsoid:1,1,500")
    own = vex.from_support(lambda d: d / np.linalg.norm(d, axis=1, keepdims=True), circumradius=1 + 1e-14,
                           support_error=1e-15)
    for call in (lambda: vex.nematic_transition("disc:1", theory="parsons-lee"),
                 lambda: vex.nematic_transition("capsule:9,1", theory="landau"), lambda: vex.nematic_transition(own),
                 lambda: vex.mixture_transition("capsule:90,1", "capsule:99,1", [0.5, 0.1]),
                 lambda: vex.mixture_transition("capsule:90,1", "capsule:99,1", [math.nan]),
                 lambda: vex.mixture_transition("capsule:90,1", "capsule:99,1", [[0.5]])):
        with pytest.raises(vex.UsageError):
            call()
