"""Orientation laws as values: of one body, about other axes, from points, pickled."""
import math
import pickle

import numpy as np
import pytest

import vex

COSINES = list(np.linspace(-1.0, 1.0, 201))
LAW = vex.OrientationLaw


def laws():
    table = LAW.table(COSINES, [math.cosh(5.0 * c) for c in COSINES])
    return [LAW.isotropic(), LAW.aligned(), LAW.fixed(1, 2, 3, 4), LAW.cone(20), LAW.angle(30), LAW.onsager(5),
            LAW.maier_saupe(-2.5), table, LAW.each("aligned", "cone:20"), LAW.each(table, LAW.maier_saupe(4)),
            LAW.cone(20).about("x"), LAW.angle(30).about("x", (1, 1, 0)), table.about((0, 3, 4))]


def test_laws_are_pickled():
    for law in laws():
        again = pickle.loads(pickle.dumps(law))
        assert again == law and hash(again) == hash(law) and again.name == law.name
    assert len({law.name for law in laws()}) == len(laws())


def test_a_table_is_near_the_density_it_was_made_from():
    table = laws()[7]
    assert abs(table.order_parameter - LAW.onsager(5).order_parameter) < 1e-3
    found = vex.excluded_volume("capsule:5,0.5", law=table, trials=16384)
    assert abs(found.z) < 5.0 and found.reference.kind == "exact"
    truth = vex.excluded_volume("capsule:5,0.5", law="onsager:5", trials=1024).reference.value
    assert abs(found.reference.value / truth - 1.0) < 1e-3


def test_each_body_has_its_own_law():
    law = LAW.each(LAW.onsager(5), "maier-saupe:3")
    assert law.order_parameter is None
    assert law.order_parameters == [LAW.onsager(5).order_parameter, LAW.maier_saupe(3).order_parameter]
    found = vex.excluded_volume("capsule:5,0.5", law=law, trials=16384)
    assert abs(found.z) < 5.0
    turned = vex.excluded_volume("box:4,1,1", "box:1,1,4", law=LAW.cone(20).about("x", "z"), trials=16384)
    upright = vex.excluded_volume("box:1,1,4", law="cone:20", trials=1024)
    assert abs(turned.value - upright.reference.value) < 5.0 * turned.std_error


def test_what_is_no_law_is_refused():
    for wrong in (lambda: LAW.table([0, 1], [1, -1]), lambda: LAW.table([1, 0], [1, 1]), lambda: LAW.maier_saupe(1e4),
                  lambda: LAW.each("angle:20", "cone:20"), lambda: LAW.isotropic().about("x"),
                  lambda: LAW.cone(20).about("w"), lambda: LAW.each(LAW.cone(20).about("x"), "cone:20"),
                  lambda: LAW.parse("table:/nowhere")):
        with pytest.raises(vex.Error):
            wrong()
