"""The numbers of docs/guide.md, from Python: each as the guide prints it, and that it does print it."""

import pathlib
import types

import numpy as np
import pytest

import vex
from vex.average import with_error

ROOT = pathlib.Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs" / "guide.md").read_text()
GEM = vex.load(ROOT / "meshes" / "data" / "gem.obj")


def printed(number, digits=12):
    """As the report prints a number; and it must stand in the guide."""
    text = number if isinstance(number, str) else f"{number:.{digits}g}"
    assert text in GUIDE, text
    return text


def test_the_report():
    for number in (GEM.volume, GEM.surface_area, GEM.integrated_mean_curvature, GEM.mean_radius, GEM.circumradius,
                   GEM.inradius):
        printed(number)
    assert f"{len(GEM.vertices)} vertices, {len(GEM.faces)} faces" in GUIDE
    result = vex.excluded_volume(GEM, rel_error=1e-3)
    printed(result.formula)
    printed(result.reference.reduced)
    printed(result.reference.b2)
    printed(with_error(result.value, result.std_error))
    printed(with_error(result.reduced, result.std_error * result.reduced / result.value))
    printed(with_error(result.b2, result.std_error / 2))
    printed(f"{result.interval[0]:.8g} ... {result.interval[1]:.8g}")
    printed(f"values                            {result.trials}")
    printed(f"z = {result.z:.3g} standard errors")
    other = vex.excluded_volume(GEM, rel_error=1e-3, seed=2)
    printed(f"{with_error(other.value, other.std_error)}, z = {other.z:.3g}")
    hits = vex.excluded_volume(GEM, trials=10**6, estimator="hit-or-miss")
    printed(f"{hits.hits} / {hits.trials}")
    printed(with_error(hits.value, hits.std_error))


def test_trials_to_an_error():
    rows = {"hemisphere:1": 65536, "box:1,1,1": 131072, "cylinder:0.1,0.5": 65536, "disc:1": 131072,
            "tetrahedron:1": 1048576, "capsule:5,0.5": 65536, "ellipsoid:1,1,10": 32768}
    for text, trials in rows.items():
        assert vex.excluded_volume(text, rel_error=1e-4).trials == trials
        [line] = [line for line in GUIDE.splitlines() if line.startswith(f"| `{text}` | 0.")]
        assert f"{trials:,}".replace(",", " ") in line


def test_laws_hulls_and_units():
    printed(f"{vex.excluded_volume_at('box:1,1,1', 'box:1,1,1', [1, 2, 3, 4])['value']:.12g}, exact")
    aligned = vex.excluded_volume("box:1,1,1", law="aligned", rel_error=1e-4)
    printed(f"<V_ex>, exact                     {aligned.exact:.12g}")
    ball, gem = vex.Body("sphere:1", unit_volume=True), vex.Body(GEM, unit_volume=True)
    printed(vex.formula(ball, gem))
    cube, tetrahedron = (vex.load(ROOT / "meshes" / "data" / name) for name in ("cube.obj", "tetrahedron.obj"))
    printed(f"M = 3π = {cube.integrated_mean_curvature:.6g}")
    printed(f"M = {tetrahedron.integrated_mean_curvature:.5f}" if tetrahedron.integrated_mean_curvature < 10 else
            f"`tetrahedron.obj` M = {tetrahedron.integrated_mean_curvature:.7g}")
    one = vex.box(1, 1, 1)
    two = types.SimpleNamespace(vertices=np.concatenate([one.vertices, one.vertices + [3, 0, 0]]),
                                faces=one.faces + [face + 8 for face in one.faces])
    with pytest.raises(vex.InputError):
        vex.Body(two)
    hull = vex.Body(two, hull=True)
    assert len(hull.vertices) == 8 and hull.volume == pytest.approx(4.0)
    printed(f"volume V                          {hull.volume:.12g}")
    printed(f"volume added by the hull          {hull.report['hull_added_volume']:.12g}")


def test_one_pose():
    cube, ball = "box:1,1,1", "sphere:0.5"
    assert vex.overlap(cube, ball, [0.9, 0.1, 0, 1, 0, 0, 0]) == 1
    apart = vex.distance(cube, ball, [1.5, 0.25, 0, 1, 0, 0, 0])
    printed(f"distance                          {apart['value']:.12g}")
    printed(f"{apart['lower']!r} and {apart['upper']!r}")
    assert apart["point_a"].tolist() == [0.5, 0.25, 0] and apart["point_b"].tolist() == [1, 0.25, 0]
    assert vex.depth(cube, ball, [0.75, 0.25, 0, 1, 0, 0, 0])["value"] == 0.25
    hit = vex.linear_cast(cube, ball, [3, 0, 0, 1, 0, 0, 0], [-4, 0, 0])
    assert hit["time"] == pytest.approx(0.5, abs=1e-9)
    turning = vex.time_of_impact(cube, "needle:4", [0, 2, 0, 1, 0, 1, 0], [0, 0, 0], [0, 0, np.pi / 2])
    printed(f"at {turning['time']:.3f}")
    manifold = vex.contact_manifold(cube, cube, [0.875, 0.25, 0, 1, 0, 0, 0])
    assert -manifold.separation["value"] == 0.125 and len(manifold.contacts) == 4
    assert vex.within(cube, cube, [1.125, 0, 0, 1, 0, 0, 0], 0.125) == 1
