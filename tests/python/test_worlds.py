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
