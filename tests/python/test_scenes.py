import copy
import itertools
import multiprocessing
import pathlib
import pickle

import numpy as np
import pytest

import vex
from conftest import random_poses

MESHES = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "data"


def brute_force(bodies, poses, box=None):
    """Every pair and image by `overlap`, the pose of b in a's frame by matrices."""
    from conftest import matrices
    rotations, centres = matrices(poses[:, 3:]), poses[:, :3]
    shifts = [np.zeros(3)] if box is None else [np.array(s) * box for s in itertools.product((-1, 0, 1), repeat=3)]
    pairs = set()
    for i, j in itertools.combinations(range(len(poses)), 2):
        relative = rotations[i].T @ rotations[j]
        offsets = np.array([rotations[i].T @ (centres[j] + shift - centres[i]) for shift in shifts])
        if (vex.overlap(bodies[i], bodies[j], (relative, offsets)) == 1).any():
            pairs.add((i, j))
    return pairs


def random_scene(n, edge, seed):
    rng = np.random.default_rng(seed)
    return np.concatenate([edge * (rng.random((n, 3)) - 0.5), rng.normal(size=(n, 4))], axis=1)


def test_pairs_are_those_of_brute_force():
    shapes = [vex.box(1, 1, 1), vex.capsule(1, 0.3), vex.icosahedron(0.8)]
    poses = random_scene(60, 4.0, seed=1)
    pick = np.arange(60) % 3
    bodies = [shapes[k] for k in pick]
    for box in (None, np.array([4.0, 4.0, 4.0])):
        truth = brute_force(bodies, poses, box)
        for broad_phase in ("automatic", "grid", "tree"):
            scene = vex.Scene(shapes, poses, shapes=pick, box=box, broad_phase=broad_phase)
            pairs, images = scene.pairs(images=True)
            assert {tuple(pair) for pair in pairs.tolist()} == truth and len(truth) > 20
            assert pairs.dtype == np.int64 and len(images) == len(pairs) and len(scene) == 60
            assert len(scene.undecided) == 0 and scene.any_overlap() == 1
        assert {tuple(p) for p in vex.Scene(bodies, poses, box=box).pairs().tolist()} == truth


def test_distances_clusters_and_what_is_near():
    poses = np.array([[0.0, 0, 0, 1, 0, 0, 0], [1.2, 0, 0, 1, 0, 0, 0], [2.5, 0, 0, 1, 0, 0, 0], [9, 9, 9, 1, 0, 0, 0]])
    scene = vex.Scene("box:1,1,1", poses)
    assert scene.pairs().shape == (0, 2) and scene.any_overlap() == 0
    assert scene.pairs_within(0.25).tolist() == [[0, 1]]
    near = scene.distances_within(0.5)
    assert near["a"].tolist() == [0, 1] and near["distance"] == pytest.approx([0.2, 0.3], abs=1e-12)
    assert (near["lower"] <= near["distance"]).all() and (near["distance"] <= near["upper"]).all()
    clusters = scene.clusters(0.25)
    assert clusters.labels.tolist() == [0, 0, 1, 2] and clusters.sizes.tolist() == [2, 1, 1]
    assert not clusters.wraps.any()
    assert scene.nearest(2).body == 1 and scene.nearest(2).distance == pytest.approx(0.3, abs=1e-12)
    hit = scene.ray_cast([-5, 0, 0], [1, 0, 0])
    assert (hit.verdict, hit.body, hit.time) == (1, 0, 4.5) and hit.normal.tolist() == [-1, 0, 0]
    assert scene.ray_cast([-5, 3, 0], [1, 0, 0]).verdict == 0
    assert scene.linear_cast("sphere:0.5", [5, 0, 0, 1, 0, 0, 0], [-1, 0, 0]).body == 2
    assert scene.overlaps_of("sphere:0.5", [1.2, 0.9, 0, 1, 0, 0, 0]).tolist() == [1]
    ring = vex.Scene("box:1,1,1", [[k * 1.0, 0, 0, 1, 0, 0, 0] for k in range(3)], box=(3, 5, 5)).clusters()
    assert ring.wraps.tolist() == [[True, False, False]]


def test_bodies_come_go_and_move():
    scene = vex.Scene(box=(10, 10, 10))
    ids = scene.add("box:1,1,1", random_poses(4, 0.1))
    assert ids.tolist() == [0, 1, 2, 3] and len(scene.pairs()) == 6
    scene.remove(1)
    assert len(scene) == 3 and scene.add("sphere:0.1", [3, 3, 3, 1, 0, 0, 0]).tolist() == [1]
    scene.move(0, [-3, -3, -3, 1, 0, 0, 0])
    assert scene.pairs().tolist() == [[2, 3]]
    assert scene.would_overlap(1, [-3, -3, -3, 1, 0, 0, 0]) == 1 and scene.would_overlap(1, [4, 4, 4, 1, 0, 0, 0]) == 0
    scene.move_all([[k * 2.0, 0, 0, 1, 0, 0, 0] for k in range(4)])
    assert len(scene.pairs()) == 0 and scene.overlaps_of(0).shape == (0, 2)
    rotation, translation, image = scene.pose(3)
    assert translation.tolist() == [-4, 0, 0] and image == (-1, 0, 0) and (rotation == np.eye(3)).all()


def test_bodies_that_were_refused_leave_no_gap():
    poses = [[0, 0, 0, 1, 0, 0, 0], [3, 0, 0, 1, 0, 0, 0]]
    scene = vex.Scene("box:1,1,1", poses)
    with pytest.raises(vex.InputError):
        scene.add("box:1,1,1", [[9, 0, 0, 1, 0, 0, 0], [6, 0, 0, 0, 0, 0, 0]])
    scene.move_all(poses)
    assert len(scene) == 2


def test_contacts_of_all_pairs_are_those_of_each():
    poses = random_scene(300, 7.0, seed=5)
    scene = vex.Scene("box:1,1,1", poses, threads=2)
    found = scene.contact_manifolds(0.05)
    pairs = scene.pairs_within(0.05)
    assert len(pairs) > 50
    assert (np.unique(np.stack([found["a"], found["b"]], axis=1), axis=0) == pairs).all()
    some = pairs[::10]
    for (a, b), each in zip(some, vex.contact_manifold("box:1,1,1", "box:1,1,1",
                                                       vex.relative_pose(poses[some[:, 0]], poses[some[:, 1]]),
                                                       margin=0.05)):
        rows = found[(found["a"] == a) & (found["b"] == b)]
        for name in ("distance", "point_a", "point_b", "feature_a", "feature_b"):
            assert np.allclose(rows[name], each.contacts[name], rtol=0, atol=1e-9)
        assert np.allclose(rows["normal"], each.separation["normal"], rtol=0, atol=1e-9)
    turned = vex.Scene("box:1,1,1", [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0.99, np.cos(np.pi / 8), 0, 0, np.sin(np.pi / 8)]])
    assert len(turned.contact_manifolds()) == 8 and len(turned.contact_manifolds(four_at_most=True)) == 4


def test_undecided_pairs_are_told():
    scene = vex.Scene("ellipsoid:1,2,3", [[0, 0, 0, 1, 0, 0, 0], [2, 0, 0, 1, 0, 0, 0]])
    with pytest.warns(vex.UndecidedWarning):
        pairs = scene.pairs()
    assert len(pairs) == 0 and scene.undecided.tolist() == [[0, 1]] and scene.any_overlap() == -1


def test_what_makes_no_sense_is_refused():
    pose = [0, 0, 0, 1, 0, 0, 0]
    for make in (lambda: vex.Scene("box:1,1,1"), lambda: vex.Scene("box:1,1,1", [pose], box=(1, 2)),
                 lambda: vex.Scene("box:1,1,1", [pose], box=(1, 2, -3)),
                 lambda: vex.Scene(["box:1,1,1"], [pose, pose]), lambda: vex.Scene("box:100,1,1", [pose], box=(1, 1, 1)),
                 lambda: vex.Scene(["box:1,1,1"], [pose], shapes=[1]), lambda: vex.Scene(skin=-1.0),
                 lambda: vex.Scene(broad_phase="quick"), lambda: vex.Scene("box:1,1,1", [[0] * 7])):
        with pytest.raises((vex.UsageError, vex.InputError)):
            make()
    scene = vex.Scene("box:1,1,1", [pose])
    for ask in (lambda: scene.remove(1), lambda: scene.move(7, pose), lambda: scene.overlaps_of(3),
                lambda: scene.nearest(5), lambda: scene.pairs_within(-1.0), lambda: scene.pairs_within(np.nan),
                lambda: scene.move_all([pose, pose]), lambda: scene.pose(9)):
        with pytest.raises((vex.UsageError, vex.InputError)):
            ask()
    with pytest.raises(TypeError):
        scene.overlaps_of("box:1,1,1")
    with pytest.raises(vex.InputError):
        scene.add("box:1,1,1", [pose, [0] * 7])
    assert len(scene) == 1


def test_percolation_is_the_programs(program):
    import json
    document = json.loads(program("vex_percolate", "box:1,1,1", "--sizes", "3,5", "--realisations", 200, "--seed", 4,
                                  "--json", "-"))
    for threads in (1, 3):
        found = vex.percolation("box:1,1,1", sizes=(3, 5), realisations=200, seed=4, threads=threads)
        assert found.eta_c == pytest.approx(document["eta_c"]["value"], rel=1e-14)
        assert found.std_error == pytest.approx(document["eta_c"]["std_error"], rel=1e-12)
        assert found.b_c == pytest.approx(document["b_c"]["value"], rel=1e-14)
        assert [len(rows) for rows in found.numbers] == [200, 200]
    assert abs(found.eta_c - 0.2444) < 5 * found.std_error and "eta_c" in str(found)
    mixed = vex.percolation(["sphere:0.5", "disc:0.5"], [3, 1], sizes=(3, 5), realisations=60, law="cone:60")
    assert 0 < mixed.phi_c < mixed.eta_c < 1 and mixed.b_c > 1
    assert np.isnan(vex.percolation("disc:1", sizes=(3,), realisations=50).eta_c)
    assert vex.percolation("box:1,1,1", sizes=(3,), realisations=100, shell=0.2).eta_c < found.eta_c
    for arguments in (dict(sizes=()), dict(sizes=(3, 3)), dict(sizes=(-1,)), dict(realisations=1), dict(law="fixed:1,0,0,0"),
                      dict(law="angle:30"), dict(shell=-1.0), dict(fractions=[0]), dict(std_error=0.0)):
        with pytest.raises((vex.UsageError, vex.InputError)):
            vex.percolation("box:1,1,1", **arguments)
    document = json.loads(program("vex_percolate", "box:1,1,3", "--orientations", "aligned", "--sizes", "3,5",
                                  "--realisations", 200, "--json", "-"))
    crossing = vex.percolation("box:1,1,3", law="aligned", sizes=(3, 5), realisations=200)
    assert not crossing.isotropic and found.isotropic and set(crossing.thresholds[0]) == {"x", "y", "z"}
    assert crossing.eta_c == pytest.approx(document["eta_c"]["value"], rel=1e-12)
    assert crossing.std_error == pytest.approx(document["eta_c"]["std_error"], rel=1e-9)
    with pytest.raises(vex.UsageError, match="isotropic"):
        vex.percolation("box:1,1,3", law="aligned", sizes=(3,))
    with pytest.raises(vex.InputError, match="never overlap"):
        vex.percolation("needle:1")


def test_every_protocol_of_pickle():
    # The first two ended the interpreter: pickle made an object of a base class, whose constructor throws through C.
    class Tetrahedron:
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        faces = []

    body = vex.Body(Tetrahedron())
    scene = vex.Scene(body, [[0, 0, 0, 1, 0, 0, 0]])
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(body, protocol)) == body
        assert len(pickle.loads(pickle.dumps(scene, protocol))) == 1
        for other in (vex.WarmStart(), vex.OrientationLaw.parse("cone:10")):
            assert type(pickle.loads(pickle.dumps(other, protocol))) is type(other)
        with pytest.raises(TypeError):
            pickle.dumps(scene._core, protocol)


def test_scenes_are_copied_and_pickled():
    shapes = [vex.box(1, 1, 1), vex.capsule(1, 0.3), vex.load(MESHES / "gem.obj", unit_volume=True)]
    for box in (None, (4.0, 4.0, 4.0), (4.0, 5.0, 4.0, 0.1, -0.2, 0.3)):
        poses = random_scene(60, 20.0 if box else 4.0, seed=8)  # in a box: many outside, which are moved into it
        scene = vex.Scene(shapes, poses, shapes=np.arange(60) % 3, box=box, skin=0.1, broad_phase="tree", threads=2)
        scene.pairs()
        for number in (17, 3, 44):
            scene.remove(number)
        scene.move(5, poses[17])
        pairs, labels = scene.pairs(), scene.clusters(0.1).labels
        counts = scene.counts
        assert len(pairs) > 10 and len(counts) > 1
        for again in (pickle.loads(pickle.dumps(scene)), copy.copy(scene), copy.deepcopy(scene)):
            assert len(again) == 57 and again.counts == counts and again.undecided.tolist() == []
            for number in (set(range(60)) - {3, 17, 44}):
                for one, other in zip(again.pose(number), scene.pose(number)):
                    assert np.array_equal(one, other)  # rotation, translation, image
            with pytest.raises(vex.UsageError):
                again.pose(17)
            assert (again.pairs() == pairs).all() and (again.clusters(0.1).labels == labels).all()
            # It is one of its own, and goes on as the other would.
            assert again.add(shapes[2], poses[3]).tolist() == [3] and again.add("sphere:1", poses[17]).tolist() == [17]
            again.remove(0)
            assert len(scene) == 57 and (scene.pairs() == pairs).all()
        again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(scene))))
        assert (again.pairs() == pairs).all()
    for empty in (vex.Scene(box=(3, 3, 3)), vex.Scene("box:1,1,1", poses[:2])):
        for number in range(len(empty)):
            empty.remove(number)
        again = copy.deepcopy(empty)
        assert len(again) == 0 and again.pairs().shape == (0, 2) and again.add("box:1,1,1", poses[0]).tolist() == [0]


def pairs_of(scene):
    return scene.pairs().tolist()


def test_scenes_go_to_other_processes():
    scene = vex.Scene("box:1,1,1", random_scene(50, 3.0, seed=9), box=(3, 3, 3))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(pairs_of, [scene]) == [scene.pairs().tolist()]
