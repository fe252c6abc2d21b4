"""Ctrl-C ends long calls. Each of these would take minutes of a processor, and the hull and the compound three seconds of
one."""

import signal
import time

import numpy as np
import pytest

import vex
from conftest import ctrl_c, random_poses


def on_sphere(n):
    points = np.random.default_rng(1).normal(size=(n, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def slow_ball(directions):
    time.sleep(0.01)
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def slow_body():
    return vex.from_support(slow_ball, circumradius=1 + 1e-14, support_error=1e-15, check=False)


def crowd(n, edge, **options):
    rng = np.random.default_rng(2)
    return vex.Scene("box:1,1,1", np.concatenate([edge * rng.random((n, 3)), rng.normal(size=(n, 4))], axis=1), **options)


def hull():
    points = on_sphere(600_000)
    return lambda: vex.hull(points)


def validation():
    return lambda: vex.box(1, 2, 3).validate(n_directions=1_000_000)


def validation_of_ones_own():
    return lambda: vex.from_support(slow_ball, circumradius=1 + 1e-14, support_error=1e-15)


def queries_of_ones_own():
    body, poses = slow_body(), random_poses(1000, 1.9)
    return lambda: vex.overlap(body, "box:1,1,1", poses, threads=2)


def average_of_ones_own():
    body = slow_body()
    return lambda: vex.excluded_volume(body, threads=2)


def scene_of_ones_own():
    scene = vex.Scene(slow_body(), random_poses(400, 6.0), threads=2)
    return scene.pairs


def pairs():
    scene = crowd(100_000, 2.0, threads=2)
    return scene.pairs


def pairs_in_a_tree():
    scene = crowd(100_000, 2.0, broad_phase="tree")
    return scene.pairs


def clusters():
    # Each cluster is known after some pairs; but not that none of 10^9 others wraps around the box.
    scene = crowd(60_000, 4.0, box=(4, 4, 4))
    return scene.clusters


def compound():
    rng = np.random.default_rng(3)
    triangles = 100 * rng.random((1_000_000, 1, 3)) + rng.random((1_000_000, 3, 3))
    return lambda: vex.Compound.of_triangles(triangles)


def steps_of_a_pair():
    poses, state = np.tile(random_poses(1000, 1.9), (2000, 1)), vex.WarmStart()
    return lambda: vex.depth("cone:1,1", "cylinder:1,0.5", poses, warm_start=state)


def depletion():
    return lambda: vex.depletion_at("cone:1,1", "cone:1,1", [1.5, 0, 0, 1, 0, 0, 0], ball_radius=0.5, rel_error=1e-7)


def depletion_of_many_poses():
    poses = random_poses(200_000, 1.9)
    return lambda: vex.depletion_at("cone:1,1", "cone:1,1", poses, ball_radius=0.5, trials=2000, threads=2)


def depletion_of_ones_own():
    body = slow_body()
    return lambda: vex.depletion_average(body, body, 2.1, ball_radius=0.5, threads=2)


@pytest.mark.parametrize("work", [hull, validation, validation_of_ones_own, queries_of_ones_own, average_of_ones_own,
                                  scene_of_ones_own, pairs, pairs_in_a_tree, clusters, compound, steps_of_a_pair,
                                  depletion, depletion_of_many_poses, depletion_of_ones_own])
def test_ctrl_c_ends(work):
    call = work()
    before = time.process_time()
    with pytest.raises(KeyboardInterrupt), ctrl_c(0.2):
        call()
    assert time.process_time() - before < 1.5  # of a processor, which other processes do not count for


def test_a_scene_answers_after_it():
    few = crowd(200, 5.0)
    expected = few.pairs()
    for options in (dict(threads=2), dict(skin=0.1)):
        scene = crowd(15_000, 1.0, **options)
        with pytest.raises(KeyboardInterrupt), ctrl_c(0.1):
            scene.pairs()
        for body in range(200, 15_000):
            scene.remove(body)
        rng = np.random.default_rng(2)
        poses = np.concatenate([5.0 * rng.random((200, 3)), rng.normal(size=(200, 4))], axis=1)
        for body in range(200):
            scene.move(body, poses[body])
        assert len(expected) > 0 and (scene.pairs() == expected).all()


def test_a_handler_may_not_ask_the_scene_that_is_at_work():
    scene = crowd(100_000, 2.0)
    raised = []

    def handler(*_):
        try:
            len(scene)
        except vex.UsageError as error:
            raised.append(str(error))
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), ctrl_c(0.2):
        signal.signal(signal.SIGINT, handler)
        scene.pairs()
    assert len(raised) == 1 and "busy" in raised[0]
    assert len(scene) == 100_000
