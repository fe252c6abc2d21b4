import copy
import math
import pickle

import numpy as np
import pytest

import vex
from conftest import boxes_overlap, matrices, random_poses

CUBE = vex.box(1, 1, 1)


def test_overlap_of_boxes_is_that_of_an_independent_test():
    box = vex.box(1, 2, 0.5)
    poses = random_poses(20000, 1.6)
    verdicts = vex.overlap(CUBE, box, poses)
    assert verdicts.dtype == np.int8 and verdicts.shape == (20000,)
    rotations = matrices(poses[:, 3:])
    truth, margin = boxes_overlap(np.full(3, 0.5), np.array([0.5, 1.0, 0.25]), rotations, poses[:, :3])
    sure = margin > 1e-9
    assert (verdicts[sure] == truth[sure]).all() and 0.3 < verdicts.mean() < 0.7
    # The same by matrices, one at a time, on any number of threads, and of rows that are not contiguous.
    assert (vex.overlap(CUBE, box, (rotations, poses[:, :3]))[sure] == truth[sure]).all()
    assert all(vex.overlap(CUBE, box, pose) == verdict for pose, verdict in zip(poses[:200], verdicts))
    for threads in (1, 2, 8):
        assert (vex.overlap(CUBE, box, poses, threads=threads) == verdicts).all()
    assert (vex.overlap(CUBE, box, np.asfortranarray(poses)[::3]) == verdicts[::3]).all()
    assert (vex.overlap(CUBE, box, poses[:500].astype(np.float32).astype(float)).shape) == (500,)


def test_distance_depth_and_signed_distance_of_balls():
    rng = np.random.default_rng(3)
    poses = random_poses(500, 4.0)
    a, b = vex.sphere(1.0), vex.sphere(0.5)
    gap = np.linalg.norm(poses[:, :3], axis=1) - 1.5
    found = vex.signed_distance(a, b, poses)
    assert np.abs(found["value"] - gap).max() < 1e-14
    assert (found["lower"] <= found["value"]).all() and (found["value"] <= found["upper"]).all()
    assert (found["verdict"] == (gap <= 0)).all() and not found["is_rough"].any()
    assert np.abs(found["point_b"] - found["point_a"] - found["value"][:, None] * found["normal"]).max() < 1e-12
    apart, deep = vex.distance(a, b, poses), vex.depth(a, b, poses)
    assert np.abs(apart["value"] - np.maximum(gap, 0)).max() < 1e-14
    assert np.abs(deep["value"] - np.maximum(-gap, 0)).max() < 1e-14
    assert np.isnan(apart["normal"][gap < 0]).all() and np.isnan(deep["point_a"][gap > 0]).all()
    for rows in (apart, deep):
        assert (rows["lower"] <= rows["value"]).all() and (rows["value"] <= rows["upper"]).all()
    assert (vex.within(a, b, poses, 0.25) == (gap <= 0.25)).all()
    assert (vex.distance(a, b, poses, max_distance=0.1)["lower"][gap > 0.11] > 0.1).all()
    rough = vex.signed_distance("cone:1,1", "cone:1,1", random_poses(50, 3.0), relative_gap=0.1)
    assert ((rough["upper"] - rough["lower"]) <= 0.1 * (np.abs(rough["value"]) + 3)).all()
    del rng


def test_answers_are_those_of_the_program(program, tmp_path):
    poses = random_poses(200, 1.5, seed=5)
    file = tmp_path / "poses.csv"
    with open(file, "w") as to:
        to.write("tx,ty,tz,qw,qx,qy,qz\n")
        for row in poses:
            to.write(",".join(repr(float(x)) for x in row) + "\n")
    import csv
    import io

    def rows_of(query):
        text = program("vex_pair", "cone:1,0.5", "box:1,1,1", "--poses", file, "--query", query, "--csv")
        return list(csv.DictReader(io.StringIO(text)))

    names = {1: "overlap", 0: "disjoint", -1: "undecided"}
    rows, found = rows_of("depth"), vex.depth("cone:1,0.5", "box:1,1,1", poses)
    assert len(rows) == len(found)
    for row, answer in zip(rows, found):
        assert float(row["depth"] or 0) == answer["value"] and row["verdict"] == names[int(answer["verdict"])]
    # Distances begin where packets guess the nearest points: the program, which asks one pose after the other, has other
    # last digits, within bounds that are as near.
    rows, found = rows_of("signed"), vex.signed_distance("cone:1,0.5", "box:1,1,1", poses)
    n_apart = 0
    for row, answer in zip(rows, found):
        value = float(row["distance"]) if row["distance"] else -float(row["depth"])
        assert row["verdict"] == names[int(answer["verdict"])]
        if answer["verdict"] == 0:
            n_apart += 1
            assert abs(value - answer["value"]) <= 2e-9 * (abs(value) + 2)
            assert float(row["lower"]) <= answer["upper"] and answer["lower"] <= float(row["upper"])
        else:
            assert value == answer["value"]
    assert 50 < n_apart < 150


def test_certificates():
    poses = random_poses(60, 1.5)
    verdicts, proof = vex.overlap(CUBE, "tetrahedron:1", poses, certify=True)
    assert proof.is_proven.all() and set(proof.faults) == {""} and 0 < verdicts.sum() < 60
    for query in (vex.signed_distance, vex.distance, vex.depth):
        _, proof = query(CUBE, "capsule:1,0.25", poses[:20], certify=True)
        assert proof.is_proven.all(), proof.faults
    certificate = vex.overlap_certificate(CUBE, CUBE, [1.5, 0, 0, 1, 0, 0, 0])
    direction = np.array(certificate["separating_dir"])
    assert certificate["verdict"] == "disjoint" and certificate["is_proven"]
    assert (CUBE.vertices @ direction).max() < ((CUBE.vertices + [1.5, 0, 0]) @ direction).min()
    certificate = vex.overlap_certificate(CUBE, CUBE, [0.3, 0.2, 0.1, 1, 0.1, 0.2, 0.3])
    assert certificate["verdict"] == "overlap" and len(certificate["witnesses"]) >= 4
    touching = vex.signed_distance("ellipsoid:1,2,3", "ellipsoid:1,2,3", [2, 0, 0, 1, 0, 0, 0], certify=True)
    assert touching[0]["verdict"] in (1, -1)


def test_rays_casts_and_impacts():
    origins = np.array([[-3.0, 0.1, 0.2], [-3.0, 2.0, 0.0], [0.0, 0.0, 0.0]])
    found = vex.ray_cast(CUBE, origins, [1, 0, 0])
    assert found["verdict"].tolist() == [1, 0, 1]
    assert found["time"][0] == pytest.approx(2.5, rel=1e-15) and found["time"][2] == 0 and math.isinf(found["time"][1])
    assert found["lower"][0] <= 2.5 <= found["upper"][0]
    assert found["normal"][0].tolist() == [-1, 0, 0] and np.isnan(found["point_a"][1]).all()
    assert vex.ray_cast(CUBE, origins[0], [1, 0, 0], until=2.0)["verdict"] == 0
    cast = vex.linear_cast(CUBE, "sphere:0.5", [5, 0, 0, 1, 0, 0, 0], [-2, 0, 0])
    assert cast["verdict"] == 1 and cast["time"] == pytest.approx(2.0, abs=1e-9)
    casts = vex.linear_cast(CUBE, CUBE, [[3, 0, 0, 1, 0, 0, 0]] * 4, [[-1, 0, 0], [1, 0, 0], [-2, 0, 0], [0, 1, 0]])
    assert casts["verdict"].tolist() == [1, 0, 1, 0] and casts["time"][2] == 1.0
    hit = vex.time_of_impact(CUBE, CUBE, [2.2, 0, 0, 1, 0, 0, 0], [0, 0, 0], [0, 0, 1])
    assert hit["verdict"] == 0
    hit = vex.time_of_impact(CUBE, CUBE, [1.1, 0, 0, 1, 0, 0, 0], [0, 0, 0], [0, 0, 1])
    assert hit["verdict"] == 1 and 0 < hit["time"] < math.pi / 4
    # Its half diagonal reaches 0.6 where cos(angle - 45 degrees) = 0.6 sqrt 2.
    assert hit["time"] == pytest.approx(math.pi / 4 - math.acos(0.6 * math.sqrt(2)), abs=1e-9)
    both = vex.time_of_impact(CUBE, CUBE, [3, 0, 0, 1, 0, 0, 0], [-1, 0, 0], velocities_a=[1, 0, 0])
    assert both["time"] == pytest.approx(1.0, abs=1e-9)
    for query, arguments in ((vex.ray_cast, (CUBE, origins, [1, 0, 0])),
                             (vex.linear_cast, (CUBE, CUBE, [3, 0, 0, 1, 0, 0, 0], [[-1, 0.1, 0], [1, 0, 0]])),
                             (vex.time_of_impact, (CUBE, CUBE, [1.1, 0, 0, 1, 0, 0, 0], [0, 0, 0], [[0, 0, 1]]))):
        _, proof = query(*arguments, certify=True)
        assert proof.is_proven.all(), proof.faults


def test_manifolds():
    [manifold] = vex.contact_manifold(CUBE, CUBE, [[0.1, 0.2, 0.99, 1, 0, 0, 0]])
    assert len(manifold.contacts) == 4 and manifold.contacts["distance"] == pytest.approx(-0.01, abs=1e-12)
    assert manifold.separation["normal"].tolist() == [0, 0, 1]
    one = vex.contact_manifold(CUBE, "sphere:0.5", [0, 0, 1.01, 1, 0, 0, 0], margin=0.1)
    assert len(one.contacts) == 1
    assert len(vex.contact_manifold(CUBE, "sphere:0.5", [0, 0, 1.01, 1, 0, 0, 0]).contacts) == 0
    names = {(int(c["feature_a"]), int(c["feature_b"])) for c in manifold.contacts}
    assert len(names) == 4 and max(max(name) for name in names) < 2**53
    [nearby] = vex.contact_manifold(CUBE, CUBE, [[0.101, 0.2, 0.99, 1, 0, 0, 0]])
    assert {(int(c["feature_a"]), int(c["feature_b"])) for c in nearby.contacts} == names
    standing = vex.contact_manifold("box:4,4,1", "cylinder:1,0.5", [0, 0, 0.999, 1, 0, 0, 0])
    assert len(standing.contacts) == 16
    four = vex.contact_manifold("box:4,4,1", "cylinder:1,0.5", [0, 0, 0.999, 1, 0, 0, 0], four_at_most=True)
    assert len(four.contacts) == 4 and four.contacts["distance"] == pytest.approx(-0.001, abs=1e-9)
    (_, proof) = vex.contact_manifold(CUBE, CUBE, [[0.1, 0.2, 0.99, 1, 0, 0, 0]], certify=True)
    assert proof.is_proven.all(), proof.faults


def test_what_is_no_pose_is_refused_and_named():
    good = [0.0, 0, 0, 1, 0, 0, 0]
    for bad in ([0, 0, 0, 0, 0, 0, 0], [np.nan, 0, 0, 1, 0, 0, 0], [0, 0, 0, np.inf, 0, 0, 0], [np.inf, 0, 0, 1, 0, 0, 0]):
        for query in (vex.overlap, vex.distance):
            for threads in (1, 4):
                with pytest.raises(vex.InputError, match="pose 700:"):
                    vex.overlap(CUBE, CUBE, [good] * 700 + [bad] + [good] * 200 + [bad] * 100, threads=threads)
            with pytest.raises(vex.InputError, match="pose 1:"):
                query(CUBE, CUBE, [good, bad])
    mirror = np.diag([1.0, 1.0, -1.0])
    with pytest.raises(vex.InputError, match="pose 0:.*reflection"):
        vex.overlap(CUBE, CUBE, (mirror, [0, 0, 0]))
    for poses in (np.zeros((3, 6)), np.zeros(8), np.zeros((2, 2, 7)), 3.0, [], (np.eye(3), np.zeros((2, 2)))):
        with pytest.raises(vex.UsageError):
            vex.overlap(CUBE, CUBE, poses)
    for poses in ("abc", [["a"] * 7], np.zeros((1, 7), dtype=complex), np.zeros((1, 7), dtype=object), None):
        with pytest.raises(TypeError):
            vex.overlap(CUBE, CUBE, poses)
    assert vex.overlap(CUBE, CUBE, np.zeros((0, 7))).shape == (0,)
    assert vex.distance(CUBE, CUBE, np.zeros((0, 7))).shape == (0,)
    for threads in (0, -1, 1.5):
        with pytest.raises(vex.UsageError):
            vex.overlap(CUBE, CUBE, [good], threads=threads)


def walk(n, step, seed=6):
    """A pose that turns by steps, and goes out of the other body and into it."""
    turns = np.array([1, 0.1, 0.2, 0.3]) + np.cumsum(step * np.random.default_rng(seed).normal(size=(n, 4)), axis=0)
    away = 1.3 + 0.6 * np.sin(3.0 * step * np.arange(n))
    return np.concatenate([np.stack([away, 0.3 + 0 * away, 0.2 + 0 * away], axis=1), turns], axis=1)


def test_a_warm_start_changes_the_time_and_nothing_that_is_proven():
    for a, b in (("icosahedron:1", "dodecahedron:0.6"), ("cone:1,1", "cylinder:1,0.5"), ("ellipsoid:1,0.5,0.7", "disc:1")):
        poses = walk(300, 0.02)
        for query in (vex.signed_distance, vex.distance, vex.depth):
            cold, state = query(a, b, poses), vex.WarmStart()
            warm = query(a, b, poses, warm_start=state)
            assert (warm["verdict"] == cold["verdict"]).all() and 0.1 < cold["verdict"].mean() < 0.9
            assert (np.maximum(warm["lower"], cold["lower"]) <= np.minimum(warm["upper"], cold["upper"])).all()
            # One by one, in the same order, with whatever copy of the state.
            one, others = vex.WarmStart(), []
            for k, pose in enumerate(poses):
                others.append(query(a, b, pose, warm_start=one))
                one = (one, copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one)))[k % 4]
            for field in warm.dtype.names:
                np.testing.assert_array_equal(np.array(others)[field], warm[field])
    foreign = vex.WarmStart()
    vex.signed_distance("icosahedron:1", "icosahedron:1", walk(20, 0.1), warm_start=foreign)
    found, proof = vex.signed_distance("box:1,1,1", "cone:1,1", walk(20, 0.1), warm_start=foreign, certify=True)
    assert proof.is_proven.all() and (found["lower"] <= found["value"]).all()
    with pytest.raises(vex.UsageError, match="one thread"):
        vex.distance(CUBE, CUBE, walk(3, 0.1), warm_start=foreign, threads=2)
    with pytest.raises(TypeError):
        vex.distance(CUBE, CUBE, walk(3, 0.1), warm_start=b"none")
