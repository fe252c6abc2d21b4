"""Faults that fresh readers of the package found, each named after its cause."""

import pathlib
import subprocess
import sys
import threading
import types

import numpy as np
import pytest

import vex

ROOT = pathlib.Path(__file__).resolve().parents[2]
POSE = [0, 0, 0, 1, 0, 0, 0]


def ball(directions):
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def test_a_scene_that_threads_share_answers_each_of_them():
    rng = np.random.default_rng(1)
    poses = np.concatenate([20 * rng.random((2000, 3)), rng.normal(size=(2000, 4))], axis=1)
    scene = vex.Scene("box:1,1,1", poses, box=(20, 20, 20), threads=1)
    wanted = {d: len(scene.pairs_within(d)) for d in (0.01, 1.0)}
    wrong = []

    def ask(distance):
        for _ in range(20):
            if len(scene.pairs_within(distance)) != wanted[distance]:
                wrong.append(distance)
            scene.clusters(distance)
            scene.overlaps_of(7)

    threads = [threading.Thread(target=ask, args=(d,)) for d in (0.01, 1.0, 0.01, 1.0)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@pytest.mark.parametrize("work", [
    "vex.excluded_volume('box:1,1,1', rel_error=1e-9)",
    "vex.distance('cone:1,1', 'cone:1,1', np.tile([1.5, .3, .2, 1, .1, .2, .3], (10**7, 1)))",
    "vex.percolation('box:1,1,1', sizes=(20,), realisations=10**5)"])
def test_the_interpreter_ends_while_a_thread_is_at_work(work):
    # Also one that asks for the interpreter after its end, as of one that ends soon after a thread has begun.
    for pause in (.5, .12, .14, .16):
        end_while_at_work(work, pause)


def end_while_at_work(work, pause):
    script = ("import threading, time, numpy as np, vex\n"
              f"threading.Thread(target=lambda: {work}, daemon=True).start()\ntime.sleep({pause})\n")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr


def test_a_support_function_that_asks_its_own_scene():
    scenes = []

    def support(directions):
        if scenes:
            len(scenes[0])
        return ball(directions)

    own = vex.from_support(support, circumradius=1 + 1e-14, support_error=1e-15)
    scene = vex.Scene(own, [POSE, [1.5, 0.2, 0.1, 1, 0, 0, 0]], threads=2)
    scenes.append(scene)
    with pytest.raises(vex.UsageError, match="busy"):
        scene.pairs()


def test_bodies_of_ones_own_can_be_rounded_and_be_keys():
    class Function:
        def __call__(self, directions):
            return ball(directions)

        def __eq__(self, other):
            return True

    own = vex.from_support(Function(), circumradius=1 + 1e-14, support_error=1e-15)
    bigger = own.rounded(0.5)
    assert vex.overlap(bigger, own, [[2.4, 0, 0, 1, 0, 0, 0], [2.6, 0, 0, 1, 0, 0, 0]]).tolist() == [1, 0]
    assert len({own, bigger, vex.from_support(Function(), circumradius=2, support_error=1e-15)}) == 3
    assert len(vex.Scene([own, bigger], [POSE, [2.4, 0, 0, 1, 0, 0, 0]]).pairs()) == 1


def test_percolation_takes_sizes_as_the_program_does():
    one = vex.percolation("sphere:0.5", sizes=(5, 3), realisations=60)
    other = vex.percolation("sphere:0.5", sizes=(3, 5), realisations=60)
    assert one.sizes == (3, 5) and one.eta_c == other.eta_c
    own = vex.from_support(ball, circumradius=1 + 1e-14, support_error=1e-15)
    for bodies, sizes in (("sphere:0.5", (1.2,)), ([], (3,)), (own, (3,))):
        with pytest.raises(vex.UsageError):
            vex.percolation(bodies, sizes=sizes, realisations=60)


def test_a_spheropolyhedron_keeps_its_radius():
    shape = types.SimpleNamespace(vertices=vex.box(1, 1, 1).vertices, radius=0.5)
    assert vex.Body(shape) == vex.rounded("box:1,1,1", 0.5)
    assert vex.Body(shape, scale=2.0).volume == pytest.approx(8 * vex.Body(shape).volume, rel=1e-12)


@pytest.mark.parametrize("text, smallest", [("box:1,1,1e8", 1e8 / 6), ("ellipsoid:1e8,1,1", None),
                                            ("ellipsoid:1e40,1,1", None)])
def test_moments_of_long_bodies(text, smallest):
    body = vex.Body(text)
    expected = smallest if smallest is not None else 0.4 * body.volume
    assert np.diag(body.moment_of_inertia).min() == pytest.approx(expected, rel=1e-12)


def test_messages_speak_of_parameters(tmp_path):
    cube = vex.box(1, 1, 1)
    for faces in (cube.faces[1:], []):
        file = tmp_path / "open.obj"
        file.write_text("".join("v %r %r %r\n" % tuple(v) for v in cube.vertices.tolist())
                        + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces))
        with pytest.raises(vex.Error) as raised:
            vex.load(file)
        assert "--" not in str(raised.value) and "hull=True" in str(raised.value)
    with pytest.raises(vex.Error) as raised:
        vex.load(tmp_path / "open.obj", format="nope")
    assert "--" not in str(raised.value)


def test_rounding_radii_and_options_that_would_be_ignored(meshes):
    for radius in (0, -1, np.nan, np.inf):
        with pytest.raises(vex.UsageError, match="radius"):
            vex.rounded("box:1,1,1", radius)
    with pytest.raises(vex.Error):
        vex.Body(f"rounded:-0.05,rounded:0.2,{meshes / 'gem.obj'}")
    assert vex.Body(f"rounded:0.25,{meshes / 'gem.obj'}", unit_volume=True).volume == pytest.approx(1, rel=1e-12)
    for option in (dict(hull=True), dict(unit="mm"), dict(weld=5.0), dict(format="stl")):
        with pytest.raises(vex.UsageError, match="meshes alone"):
            vex.Body("box:1,1,1", **option)


def test_no_body_is_minus_one_and_a_query_leaves_nothing_of_the_last():
    scene = vex.Scene("ellipsoid:1,2,3", [POSE, [2, 0, 0, 1, 0, 0, 0]])
    with pytest.warns(vex.UndecidedWarning):
        assert scene.overlaps_of("ellipsoid:1,2,3", [0, 4, 0, 1, 0, 0, 0]).tolist() == []
    assert (scene.undecided[:, 0] == -1).all()
    far = vex.Scene("box:1,1,1", [POSE, [9, 0, 0, 1, 0, 0, 0]])
    assert far.any_overlap() == 0 and len(far.undecided) == 0
    for ask in (far.remove, far.nearest, far.overlaps_of, far.pose):
        with pytest.raises(vex.UsageError):
            ask(-1)
        with pytest.raises(TypeError):
            ask(1.5)


def test_a_tuple_of_two_poses():
    assert vex.overlap("box:1,1,1", "box:1,1,1", ((0, 0, 0, 1, 0, 0, 0), (3, 0, 0, 1, 0, 0, 0))).tolist() == [1, 0]


def test_pictures_of_thin_flat_and_touching_bodies():
    import matplotlib.pyplot as plt
    for text in ("cone:1,1", "hemisphere:1", "plate:1,2", "needle:1", "box:1,1,1e-10", "box:1,1e-10,1e-10"):
        assert vex.Body(text).plot() is not None
    assert len(vex.Body("box:1,1,1e-10").faces) == 6
    assert vex.plot.excluded_volume("disc:1", "disc:1") is not None
    assert vex.plot.pair("box:1,1,1", "box:1,1,1", [1, 0, 0, 1, 0, 0, 0]).get_title() == "touching"
    for call in (lambda: vex.plot.excluded_volume("box:1,1,1", "box:1,1,1", 2 * np.eye(3)),
                 lambda: vex.plot.body("sphere:1", n_around=10**9), lambda: vex.plot.body("sphere:1", pose=[0] * 7)):
        with pytest.raises(vex.Error):
            call()
    plt.close("all")


def test_small_things():
    assert vex.excluded_volume("box:1,1,1", control_variate="box:1,1,1", trials=4096).complete
    for threads in (float("inf"), "many"):
        with pytest.raises(vex.UsageError):
            vex.overlap("box:1,1,1", "box:1,1,1", POSE, threads=threads)
    with pytest.raises(TypeError, match="progress"):
        vex.excluded_volume("box:1,1,1", trials=4096, progress=5)
    law = vex.OrientationLaw.cone(30)
    assert law == vex.OrientationLaw.cone(30) != vex.OrientationLaw.cone(31) and "cone:30" in repr(law)
    hash(vex.excluded_volume("box:1,1,1", trials=4096))


def test_what_is_no_number_is_named():
    body = vex.sphere(1)
    pose = [3, 0, 0, 1, 0, 0, 0]
    for name, ask in {"ball_radius": lambda x: vex.depletion_at(body, body, pose, ball_radius=x),
                      "rel_error": lambda x: vex.excluded_volume(body, rel_error=x),
                      "margin": lambda x: vex.within(body, body, pose, x),
                      "until": lambda x: vex.ray_cast(body, [3, 0, 0], [-1, 0, 0], until=x),
                      "scale": lambda x: vex.Body("box:1,1,1", scale=x),
                      "distance": lambda x: vex.Scene([body], [pose]).pairs_within(x)}.items():
        for wrong in ("a", [1, 2], 10 ** 400):
            with pytest.raises(vex.UsageError, match=f"^{name}: .* - give a number$"):
                ask(wrong)
    with pytest.raises(vex.UsageError, match="mirrored"):
        vex.Body("box:1,1,1", scale=-1)
    with pytest.raises(vex.InputError, match="radius of the ball 1e-300"):
        vex.depletion_at(body, body, pose, ball_radius=1e-300)
    with pytest.raises(TypeError):
        type("Mine", (vex.WarmStart,), {})  # whose copies would be without what it adds
