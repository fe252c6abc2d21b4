"""The depletion attraction: the program's numbers, and known ones."""
import json
import math

import numpy as np
import pytest

import vex

def test_poses_are_those_of_the_program(program):
    document = json.loads(program("vex_depletion", "cylinder:5,0.5", "--depletant", 0.2, "--distance", 1.1, "--angle",
                                  "0:90:30", "--rel-error", 0.02, "--seed", 3, "--json", "-"))
    angles = np.radians([row["angle"] for row in document["rows"]])
    poses = np.zeros((len(angles), 7))
    poses[:, 0], poses[:, 3], poses[:, 4] = 1.1, np.cos(angles / 2), np.sin(angles / 2)
    for threads in (1, 2):
        found = vex.depletion_at("cylinder:5,0.5", "cylinder:5,0.5", poses, ball_radius=0.2, rel_error=0.02,
                                 seed=[row["seed"] for row in document["rows"]], threads=threads)
        # The program's quaternions are of its own sine and cosine: the poses may differ in a last place.
        for row, told in zip(found, document["rows"]):
            assert row["overlap_volume"] == pytest.approx(told["overlap_volume"], rel=1e-12)
            assert row["std_error"] == pytest.approx(told["std_error"], rel=1e-9)
            assert (row["trials"], row["undecided"]) == (told["trials"], told["undecided"])
            assert row["complete"] and row["bodies"] == 0


def test_means_are_those_of_the_program(program):
    for law in ("isotropic", "cone:20"):
        document = json.loads(program("vex_depletion", "box:1,1,1", "--depletant", 0.3, "--distance",
                                      "1.2:1.9:0.35", "--orientations", law, "--trials", 20000, "--json", "-"))
        found = vex.depletion_average("box:1,1,1", "box:1,1,1", [row["distance"] for row in document["rows"]],
                                      ball_radius=0.3, law=law, trials=20000,
                                      seed=[row["seed"] for row in document["rows"]])
        for row, told in zip(found, document["rows"]):
            assert (row["free_share"], row["free_share_error"]) == (told["free_share"], told["free_share_std_error"])
            assert (row["mean_of_free"], row["mean_of_free_error"]) == (told["overlap_volume"], told["std_error"])
            assert row["trials"] == told["trials"] and row["complete"]


def test_balls_have_the_known_lens():
    found = vex.depletion_at("sphere:1", "sphere:0.5", [[d, 0, 0, 1, 0, 0, 0] for d in (1.4, 1.6, 2.0)], ball_radius=0.2,
                             trials=50000, seed=(1, 2, 3))
    known = vex.overlap_of_balls(1.2, 0.7, [1.4, 1.6, 2.0])
    assert (np.abs(found["overlap_volume"] - known) <= 4.5 * found["std_error"]).all() and known[2] == 0
    assert found["bodies"].tolist() == [1, 0, 0] and found["std_error"][2] == 0
    one = vex.depletion_at("sphere:1", "sphere:0.5", [1.6, 0, 0, 1, 0, 0, 0], ball_radius=0.2, trials=50000, seed=2)
    assert one == found[1]
    mean = vex.depletion_average("sphere:1", "sphere:0.5", 1.6, ball_radius=0.2, trials=50000)
    assert mean["free_share"] == 1 and abs(mean["mean_of_free"] - known[1]) < 4.5 * mean["mean_of_free_error"]
    assert math.isnan(vex.depletion_average("sphere:1", "sphere:1", 0.5, ball_radius=0.2, trials=2000)["mean_of_free"])
    assert vex.overlap_of_balls(1, 2, 3) == 0 and vex.overlap_of_balls(1, 2, 1) == pytest.approx(4 / 3 * math.pi)


def test_what_makes_no_sense_is_refused():
    pose = [1.6, 0, 0, 1, 0, 0, 0]
    for call in (lambda: vex.depletion_at("sphere:1", "sphere:1", pose, ball_radius=0),
                 lambda: vex.depletion_at("sphere:1", "sphere:1", pose, ball_radius=math.nan),
                 lambda: vex.depletion_at("sphere:1", "sphere:1", pose, ball_radius=0.1, seed=(1, 2)),
                 lambda: vex.depletion_at("sphere:1", "sphere:1", pose, ball_radius=0.1, trials=0),
                 lambda: vex.depletion_at("sphere:1", "sphere:1", pose, ball_radius=0.1, rel_error=-1),
                 lambda: vex.depletion_average("sphere:1", "sphere:1", -1.0, ball_radius=0.1),
                 lambda: vex.depletion_average("sphere:1", "sphere:1", [[1.0]], ball_radius=0.1),
                 lambda: vex.depletion_average("sphere:1", "sphere:1", 1.0, ball_radius=0.1, law="spin"),
                 lambda: vex.overlap_of_balls(-1, 1, 1), lambda: vex.overlap_of_balls(1, 1, math.nan)):
        with pytest.raises(vex.UsageError):
            call()
    with pytest.raises(vex.InputError, match="pose 1:"):
        vex.depletion_at("sphere:1", "sphere:1", [pose, [0] * 7], ball_radius=0.1, trials=1000)
    assert vex.depletion_at("sphere:1", "sphere:1", np.zeros((0, 7)), ball_radius=0.1).shape == (0,)
