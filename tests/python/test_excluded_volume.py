import json
import math
import threading
import time

import numpy as np
import pytest

import vex
from conftest import ctrl_c


def test_the_numbers_are_the_programs_bit_for_bit(program, meshes):
    cases = [(("box:1,1,1",), ["--trials", 65536], dict(trials=65536)),
             (("capsule:1,0.25", "ellipsoid:1,2,3"), ["--trials", 65536, "--seed", 7], dict(trials=65536, seed=7)),
             ((str(meshes / "pebble.obj"), "cone:1,2"), ["--trials", 16384], dict(trials=16384)),
             ((str(meshes / "pebble.obj"),), ["--rel-error", "1e-3"], dict(rel_error=1e-3)),
             (("box:1,2,3", "cylinder:1,1"), ["--trials", 20000, "--estimator", "hit-or-miss"],
              dict(trials=20000, estimator="hit-or-miss")),
             (("cylinder:1,1",), ["--trials", 20000, "--estimator", "hit-or-miss-fitted", "--orientations", "cone:30"],
              dict(trials=20000, estimator="hit-or-miss-fitted", law="cone:30")),
             (("box:1,1,2",), ["--trials", 16384, "--orientations", "angle:40"], dict(trials=16384, law="angle:40")),
             (("icosahedron:1",), ["--trials", 16384, "--estimator", "mixed-volume", "--sequence", "random"],
              dict(trials=16384, estimator="mixed-volume", sequence="random"))]
    for bodies, options, settings in cases:
        document = json.loads(program("vex_mesh", *bodies, *options, "--json", "-"))
        estimate = document["estimate"]
        for threads in (1, 3):
            result = vex.excluded_volume(*bodies, threads=threads, **settings)
            assert (result.value, result.std_error) == (estimate["excluded_volume"], estimate["std_error"])
            assert (result.trials, result.estimator, result.hits) == \
                (estimate["trials"], estimate["estimator"], estimate["hits"])
            assert list(result.interval) == estimate["ci95"] and result.z == document["z"]
            assert result.reference.value == document["reference"]["excluded_volume"]


def test_the_formula_and_what_is_derived():
    r = vex.excluded_volume("box:1,1,1", rel_error=1e-3)
    assert r.formula == vex.formula("box:1,1,1") == 11.0 and r.exact is None and abs(r.z) < 5
    assert r.b2 == r.value / 2 and r.reduced == r.value and r.std_error <= 1e-3 * r.value and r.complete
    lower, upper = r.interval
    assert lower < r.value < upper
    assert "formula 11" in str(r) and "<table>" in r._repr_html_()
    assert json.loads(json.dumps(r.to_dict()))["reference"]["value"] == 11.0
    aligned = vex.excluded_volume("box:1,1,1", law="aligned", trials=10000, estimator="hit-or-miss")
    assert aligned.exact == pytest.approx(8.0, rel=1e-12) and aligned.formula is None
    needles = vex.excluded_volume("needle:1")
    assert needles.value == 0.0 and needles.note and needles.estimator is None
    assert vex.excluded_volume("disc:1", trials=10**4).to_dict()["reduced"] is None


def test_excluded_volume_at_and_of_an_angle():
    cube = vex.box(1, 1, 1)
    about_z = [math.cos(math.pi / 8), 0, 0, math.sin(math.pi / 8)]  # 45 degrees
    found = vex.excluded_volume_at(cube, cube, [[1, 0, 0, 0], about_z])
    # Two squares at 45 degrees: area of the sum 1 + 1 + 2 * (perimeter * mean support) = 2 + 2 sqrt 2, times height 2.
    assert found["value"] == pytest.approx([8.0, 2 * (2 + 2 * math.sqrt(2))], rel=1e-13)
    assert (found["error"] < 1e-10).all()
    c = math.sqrt(0.5)
    matrix = np.array([[c, -c, 0], [c, c, 0], [0, 0, 1]])
    assert vex.excluded_volume_at(cube, cube, matrix)["value"] == pytest.approx(found["value"][1], rel=1e-13)

    # Onsager 1949: cylinders of length L and diameter D.
    length, diameter = 5.0, 1.0
    angles = np.array([0.0, 20.0, 45.0, 90.0, 135.0])
    g = np.radians(angles)
    s, c = np.sin(g), np.abs(np.cos(g))
    m = np.sin(g) ** 2
    from scipy.special import ellipe
    onsager = (math.pi / 2 * diameter**3 * s + math.pi / 2 * length * diameter**2 * (1 + c + 4 / math.pi * ellipe(m))
               + 2 * length**2 * diameter * s)
    found = vex.excluded_volume_of_angle("cylinder:5,0.5", "cylinder:5,0.5", angles)
    assert (np.abs(found["value"] - onsager) < 5 * found["error"] + 1e-9).all()
    capsules = vex.excluded_volume_of_angle("capsule:5,0.5", "capsule:5,0.5", angles)
    exact = 4 / 3 * math.pi + 2 * math.pi * length + 2 * length**2 * s + 0 * c
    assert (np.abs(capsules["value"] - exact) < 5 * capsules["error"] + 1e-9).all()
    # Bodies that are not round about their axes are spun: the mean over the angle is the isotropic average.
    nodes, weights = np.polynomial.legendre.leggauss(9)
    box = vex.box(1, 2, 3)
    spun = vex.excluded_volume_of_angle(box, box, np.degrees(np.arccos(nodes)))
    assert (spun["value"] * weights).sum() / 2 == pytest.approx(vex.formula(box), rel=2e-3)
    assert vex.excluded_volume_of_angle(box, box, 30.0)["value"] > 0
    with pytest.raises(vex.UsageError, match="180"):
        vex.excluded_volume_of_angle(box, box, [10, 190])


def test_what_makes_no_sense_is_refused():
    for settings in (dict(rel_error=0), dict(trials=0), dict(trials=1.5), dict(trials=-1), dict(seconds=-1.0),
                     dict(seed=-1), dict(threads=0), dict(law="cone"), dict(law="cone:91"), dict(law="sideways"),
                     dict(estimator="best-guess"), dict(sequence="halton"), dict(on_interrupt="ignore"),
                     dict(domain="box", estimator="radial"), dict(law="fixed:0,0,0,0")):
        with pytest.raises((vex.UsageError, vex.InputError)):
            vex.excluded_volume("box:1,1,1", **settings)
    with pytest.raises(vex.UsageError):
        vex.excluded_volume("box:1,1")


def test_progress_is_told():
    seen = []
    vex.excluded_volume("cone:1,1", seconds=1.0, estimator="hit-or-miss", progress=lambda *now: seen.append(now))
    trials = [now[0] for now in seen]
    assert len(seen) >= 2 and trials == sorted(trials) and all(len(now) == 3 for now in seen)
    with pytest.raises(RuntimeError, match="enough"):
        def stop(*_):
            raise RuntimeError("enough")
        vex.excluded_volume("cone:1,1", seconds=60.0, progress=stop)


def test_ctrl_c_ends_a_run_and_keeps_its_result():
    start = time.monotonic()
    with ctrl_c(0.4):
        result = vex.excluded_volume("cone:1,1", seconds=60.0, estimator="hit-or-miss", on_interrupt="return")
    assert not result.complete and result.stopped_by == "interrupted" and result.trials > 0
    with pytest.raises(KeyboardInterrupt) as raised, ctrl_c(0.4):
        vex.excluded_volume("cone:1,1", seconds=60.0, estimator="hit-or-miss")
    assert isinstance(raised.value, vex.Interrupted) and raised.value.result.trials > 0
    assert time.monotonic() - start < 20.0


def test_ctrl_c_ends_a_query_of_many_poses():
    poses = np.tile([1.5, 0.3, 0.2, 1.0, 0.1, 0.2, 0.3], (1_000_000, 1))
    for threads in (1, 2):
        start = time.monotonic()
        with pytest.raises(KeyboardInterrupt), ctrl_c(0.3):
            vex.signed_distance("cone:1,1", "ellipsoid:1,2,3", poses, threads=threads)
        assert time.monotonic() - start < 20.0


def test_the_gil_is_released():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.01)

    thread = threading.Thread(target=tick)
    thread.start()
    vex.excluded_volume("cone:1,1", seconds=1.0, estimator="hit-or-miss", threads=1)
    stop.set()
    thread.join()
    assert len(ticks) > 20
