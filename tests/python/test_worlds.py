import pickle

import numpy as np
import pytest

import vex
from conftest import random_poses

FLOOR = vex.HalfSpace([0, 0, 2])


def test_a_ball_on_a_floor_is_as_high_as_its_centre_says():
    poses = random_poses(500, 3.0)
    found = FLOOR.signed_distance(vex.sphere(0.5), poses)
    height = poses[:, 2] - 0.5
    assert np.abs(found["value"] - height).max() < 1e-14
    assert (found["lower"] <= height + 1e-15).all() and (height - 1e-15 <= found["upper"]).all()
    assert (FLOOR.overlap("sphere:0.5", poses) == (height <= 0)).all()
    assert np.abs(found["point_a"][:, 2]).max() < 1e-14 and (found["part"] == -1).all()
    assert FLOOR.overlap("cylinder:1,0.5", [0, 0, 0.5, 1, 0, 0, 0]) == 1
    assert FLOOR.overlap("cylinder:1,0.5", [0, 0, 0.5 + 2**-52, 1, 0, 0, 0]) == 0


def test_bodies_stand_on_points_with_names():
    contacts = FLOOR.contacts("box:1,1,1", [0, 0, 0.49, 1, 0, 0, 0])
    assert len(contacts) == 4 and len(set(contacts["feature"])) == 4
    assert np.abs(contacts["distance"] + 0.01).max() < 1e-15
    assert len(FLOOR.contacts("box:1,1,1", [0, 0, 0.51, 1, 0, 0, 0])) == 0


def test_a_compound_answers_as_the_nearest_of_its_parts():
    bodies = ["box:1,1,1", "sphere:0.5", "cone:1,0.5"]
    places = np.array([[0, 0, 0, 1, 0, 0, 0], [2, 0, 0, 1, 0, 0, 0], [0, 2, 0, 1, 0, 0, 0]], dtype=float)
    compound = vex.Compound(bodies, places)
    assert len(compound) == 3
    poses = random_poses(400, 2.2)
    parts = []
    for body, place in zip(bodies, places):
        seen = poses.copy()
        seen[:, :3] -= place[:3]
        parts.append(vex.distance(body, "capsule:1,0.25", seen))
    values = np.array([rows["value"] for rows in parts])
    verdicts = np.array([rows["verdict"] for rows in parts])
    found = compound.distance("capsule:1,0.25", poses)
    assert 0.1 < verdicts.max(axis=0).mean() < 0.9
    assert (found["verdict"] == verdicts.max(axis=0)).all()
    assert (compound.overlap("capsule:1,0.25", poses) == found["verdict"]).all()
    assert np.abs(found["value"] - values.min(axis=0)).max() < 1e-8
    apart = found["verdict"] == 0
    assert (found["part"][apart] == values.argmin(axis=0)[apart]).mean() > 0.99
    for threads in (1, 2):
        assert (compound.distance("capsule:1,0.25", poses, threads=threads)["value"] == found["value"]).all()
    near = compound.distance("sphere:0.1", [50, 0, 0, 1, 0, 0, 0], max_distance=1.0)
    assert near["verdict"] == 0 and near["part"] == -1 and near["lower"] >= 1.0


def test_triangles_are_a_surface():
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9), indexing="ij")
    grid = np.stack([x, y, 0 * x], axis=-1)
    lower = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:]], axis=-2)
    upper = np.stack([grid[:-1, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-2)
    ground = vex.Compound.of_triangles(np.concatenate([lower.reshape(-1, 3, 3), upper.reshape(-1, 3, 3)]))
    assert len(ground) == 128
    poses = random_poses(300, 0.9)
    found = ground.distance("sphere:0.2", poses)
    inside = (np.abs(poses[:, :2]) <= 1).all(axis=1)
    assert np.abs(found["value"] - np.maximum(np.abs(poses[:, 2]) - 0.2, 0))[inside].max() < 1e-9
    assert (ground.overlap("sphere:0.2", poses)[inside] == (np.abs(poses[:, 2]) <= 0.2)[inside]).all()


def test_rays_casts_and_impacts_of_worlds():
    dumbbell = vex.Compound(["sphere:0.5", "sphere:0.5"], [[0, 0, 1, 1, 0, 0, 0], [0, 0, -1, 1, 0, 0, 0]])
    found = dumbbell.ray_cast([[5, 0, 1], [5, 0, -1], [5, 0, 3]], [-1, 0, 0])
    assert found["verdict"].tolist() == [1, 1, 0] and found["part"].tolist() == [0, 1, -1]
    assert np.abs(found["time"][:2] - 4.5).max() < 1e-12 and np.isnan(found["normal"][2]).all()
    poses = random_poses(100, 1.0) + [4, 0, 0, 0, 0, 0, 0]
    cast = dumbbell.linear_cast("sphere:0.25", poses, [-1, 0, 0], threads=2)
    each = [vex.linear_cast("sphere:0.5", "sphere:0.25", poses - [0, 0, z, 0, 0, 0, 0], [-1, 0, 0]) for z in (1, -1)]
    times = np.minimum(*[np.where(rows["verdict"] == 1, rows["time"], np.inf) for rows in each])
    assert 10 < (cast["verdict"] == 1).sum() < 90
    met = cast["verdict"] == 1
    assert np.abs(cast["time"][met] - times[met]).max() < 1e-8
    assert ((cast["verdict"] == 1) == np.isfinite(times)).all()
    hit = dumbbell.time_of_impact("sphere:0.25", [3, 0, 1, 1, 0, 0, 0], [-2, 0, 0], [0, 0, 1])
    assert hit["verdict"] == 1 and abs(hit["time"] - 1.125) < 1e-9 and hit["part"] == 0
    fall = FLOOR.linear_cast("cylinder:1,0.5", [[0, 0, 2, 1, 0, 0, 0]] * 2, [[0, 0, -3], [0, 0, 3]])
    assert fall["verdict"].tolist() == [1, 0] and abs(fall["time"][0] - 0.5) < 1e-12 and fall["part"][0] == -1
    assert abs(FLOOR.ray_cast([0, 0, 2], [0, 0, -0.5])["time"] - 4) < 1e-12
    assert FLOOR.ray_cast([0, 0, 2], [0, 0, -0.5], until=3.0)["verdict"] == 0
    for wrong in (lambda: dumbbell.ray_cast(np.zeros((3, 3)), np.ones((2, 3))),
                  lambda: dumbbell.linear_cast("sphere:1", poses[:3], np.ones((2, 3))),
                  lambda: FLOOR.linear_cast("sphere:1", poses, np.ones((100, 2)))):
        with pytest.raises(vex.UsageError):
            wrong()


def test_what_turns_meets_floors_and_compounds_that_turn():
    lying = [0, 0, 0.5, np.sqrt(0.5), 0, np.sqrt(0.5), 0]
    hits = FLOOR.time_of_impact("needle:2", [lying, lying], [0, 0, 0], [[0, 1, 0], [0, 0, 1]])
    assert hits["verdict"].tolist() == [1, 0] and abs(hits["time"][0] - np.pi / 6) < 1e-12
    assert hits["lower"][0] <= np.pi / 6 + 1e-15 and np.pi / 6 - 1e-15 <= hits["upper"][0]
    assert FLOOR.time_of_impact("needle:2", lying, [0, 0, 0], [0, 1, 0], until=0.5)["verdict"] == 0
    arm = vex.Compound("sphere:0.5", [[3, 0, 0, 1, 0, 0, 0]])
    turned = arm.time_of_impact("sphere:0.5", [0, 3, 0, 1, 0, 0, 0], [0, 0, 0], angular_velocities_a=[0, 0, 1])
    assert turned["verdict"] == 1 and turned["part"] == 0
    assert abs(turned["time"] - (np.pi / 2 - 2 * np.arcsin(1 / 6))) < 1e-9
    away = arm.time_of_impact("sphere:0.5", [6, 0, 0, 1, 0, 0, 0], [1, 0, 0], velocities_a=[[0.5, 0, 0], [3, 0, 0]])
    assert away["verdict"].tolist() == [0, 1] and abs(away["time"][1] - 1) < 1e-12
    with pytest.raises(vex.UsageError):
        FLOOR.time_of_impact("sphere:1", [lying] * 3, np.ones((2, 3)))


def test_worlds_are_values():
    dumbbell = vex.Compound("sphere:0.5", [[0, 0, 1, 1, 0, 0, 0], [0, 0, -1, 1, 0, 0, 0]])
    ground = vex.Compound.of_triangles([[[-9, -9, 0], [9, -9, 0], [9, 9, 0]]])
    turned = vex.Compound(["box:1,1,1"], (np.eye(3), np.zeros(3)))
    poses = random_poses(200, 1.5)
    for world in (dumbbell, ground, turned, FLOOR):
        again = pickle.loads(pickle.dumps(world))
        assert repr(again) == repr(world)
        assert (again.overlap("cone:1,1", poses) == world.overlap("cone:1,1", poses)).all()
    assert repr(dumbbell) == "<vex.Compound of 2 parts>" and repr(FLOOR) == "vex.HalfSpace([0.0, 0.0, 2.0], 0.0)"
    assert FLOOR == vex.HalfSpace([0, 0, 2.0]) and FLOOR != vex.HalfSpace([0, 0, 1]) and len({FLOOR, FLOOR}) == 1
    assert FLOOR.normal.tolist() == [0, 0, 2] and FLOOR.offset == 0.0


def test_what_is_none_is_refused():
    with pytest.raises(vex.InputError):
        vex.HalfSpace([0, 0, 0])
    with pytest.raises(vex.UsageError):
        vex.HalfSpace([0, 0])
    with pytest.raises(vex.InputError):
        vex.Compound([], np.zeros((0, 7)))
    with pytest.raises(vex.UsageError):
        vex.Compound(["box:1,1,1"], np.array([[0, 0, 0, 1, 0, 0, 0]] * 2, dtype=float))
    with pytest.raises(vex.UsageError):
        vex.Compound.of_triangles(np.zeros((4, 3)))
    with pytest.raises(vex.InputError):
        vex.Compound.of_triangles(np.full((1, 3, 3), np.nan))
