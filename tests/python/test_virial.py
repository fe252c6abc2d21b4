"""Virial coefficients: of the program, and known."""
import json

import pytest

import vex


def test_virial_coefficients_are_those_of_the_program(program):
    found = vex.virial_coefficients("box:1,1,2", order=3, samples=20000, seed=4, threads=2)
    document = json.loads(program("vex_virial", "box:1,1,2", "--order", 3, "--samples", 20000, "--seed", 4, "--json", "-"))
    one = document["coefficients"][0]
    assert (found.higher[0].reduced, found.higher[0].std_error) == (one["reduced"], one["std_error"])
    assert found.b2 == document["b2"] and found.complete
    with pytest.raises(vex.UsageError):
        vex.virial_coefficients("box:1,1,2", order=9)
    with pytest.raises(vex.UsageError):
        vex.virial_coefficients("box:1,1,2", law="angle:20")
    with pytest.raises(vex.UsageError):
        vex.virial_coefficients("box:1,1,2", only=2)
    with pytest.raises(vex.InputError):
        vex.virial_coefficients("needle:1")


def test_one_coefficient_of_bodies_that_a_law_turns_is_that_of_the_program(program):
    found = vex.virial_coefficients("box:1,1,2", only=4, samples=20000, law="onsager:5", seed=4, threads=2)
    document = json.loads(program("vex_virial", "box:1,1,2", "--only", 4, "--samples", 20000, "--orientations", "onsager:5",
                                  "--seed", 4, "--json", "-"))
    assert [one.n for one in found.higher] == [4] and found.b2 == document["b2"]
    assert found.higher[0].reduced == document["coefficients"][0]["reduced"]


def test_spheres_have_the_known_coefficients():
    found = vex.virial_coefficients("sphere:0.5", order=4, samples=200000)
    assert found.b2_per_volume == pytest.approx(4.0)
    for one, known in zip(found.higher, (0.625, 0.28694950598)):
        assert abs(one.reduced - known) < 5.0 * one.std_error
        assert one.per_volume == pytest.approx(one.reduced * 4.0 ** (one.n - 1)) and one.sign_settled
