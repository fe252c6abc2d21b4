"""Poses and bodies in the words of C++: every number against what its documentation says, operation by operation."""

import pickle

import numpy as np
import pytest

import vex
from conftest import matrices, random_poses


def product(r, s):
    """Sums of products from left to right, none fused."""
    return (r[:, :, 0, None] * s[:, None, 0, :] + r[:, :, 1, None] * s[:, None, 1, :]) + r[:, :, 2, None] * s[:, None, 2, :]


def applied(r, v):
    return (r[:, :, 0] * v[:, None, 0] + r[:, :, 1] * v[:, None, 1]) + r[:, :, 2] * v[:, None, 2]


def test_products_inverses_and_relative_poses_are_these_operations():
    a, b = random_poses(300, 5.0, seed=1), random_poses(300, 5.0, seed=2)
    p, q = vex.pose_of(a[:, 3:], a[:, :3]), vex.pose_of(b[:, 3:], b[:, :3])
    assert np.abs(p.rotation - matrices(a[:, 3:])).max() < 4e-15 and (p.translation == a[:, :3]).all()
    found = p * q
    assert (found.rotation == product(p.rotation, q.rotation)).all()
    assert (found.translation == applied(p.rotation, q.translation) + p.translation).all()
    for same in (vex.product(a, b), a * q, p * b):
        assert (same.rotation == found.rotation).all() and (same.translation == found.translation).all()
    inverse = p.inverse()
    assert (inverse.rotation == p.rotation.transpose(0, 2, 1)).all()
    assert (inverse.translation == -applied(inverse.rotation, p.translation)).all()
    seen = vex.relative_pose(a, b)
    turned = p.rotation.transpose(0, 2, 1)
    assert (seen.rotation == product(turned, q.rotation)).all()
    assert (seen.translation == applied(turned, q.translation - p.translation)).all()


def test_queries_take_what_they_give():
    a, b = random_poses(500, 1.0, seed=3), random_poses(500, 1.0, seed=4)
    seen = vex.relative_pose(a, b)
    verdicts = vex.overlap("box:1,1,1", "cone:1,1", seen)
    assert 0.1 < verdicts.mean() < 0.9
    assert (verdicts == vex.overlap("box:1,1,1", "cone:1,1", (seen.rotation, seen.translation))).all()
    # Somewhere else, with a world that is turned: the same but for rounding.
    world = vex.pose_of([1, 2, 3, 4], [1e3, -2e3, 3e3])
    moved = vex.relative_pose(world * a, world * b)
    error = vex.relative_pose_error(world * a, world * b, vex.Body("cone:1,1").reach)
    assert error.shape == (500,) and (error > 0).all() and error.max() < 1e-12
    gap = vex.signed_distance("box:1,1,1", "cone:1,1", seen)["value"]
    off = vex.signed_distance("box:1,1,1", "cone:1,1", moved)["value"] - gap
    assert np.abs(off).max() < 1e-9
    scene = vex.Scene("box:1,1,1", world * a)
    assert len(scene) == 500
    one = vex.relative_pose(a[0], b[0])
    assert one.rotation.shape == (3, 3) and vex.overlap("box:1,1,1", "cone:1,1", one) == verdicts[0]


def test_between_two_poses():
    a, b = random_poses(50, 2.0, seed=5), random_poses(50, 2.0, seed=6)
    p, q = vex.pose_of(a[:, 3:], a[:, :3]), vex.pose_of(b[:, 3:], b[:, :3])
    for part, end in ((0.0, p), (1.0, q)):
        found = vex.interpolated(p, q, part)
        assert (found.rotation == end.rotation).all() and (found.translation == end.translation).all()
    way = vex.interpolated(a[0], b[0], np.linspace(0, 1, 11))
    assert way.rotation.shape == (11, 3, 3)
    step = vex.relative_pose((way.rotation[:-1], way.translation[:-1]), (way.rotation[1:], way.translation[1:]))
    angles = np.arccos((np.trace(step.rotation, axis1=1, axis2=2) - 1) / 2)
    assert np.ptp(angles) < 1e-12 and 0 < angles[0] <= np.pi / 10 + 1e-12
    assert np.abs(np.diff(way.translation, axis=0) - np.diff(way.translation, axis=0)[0]).max() < 1e-14
    single = vex.interpolated(a[0], b[0], 0.5)
    assert single.translation.shape == (3,)
    assert vex.interpolated(a, b, np.full(50, 0.5)).translation.shape == (50, 3)


def test_quaternions_and_rows_come_back():
    a = random_poses(200, 1.0, seed=7)
    p = vex.pose_of(a[:, 3:], a[:, :3])
    q = vex.quaternion_of(p)
    assert np.abs(np.linalg.norm(q, axis=1) - 1).max() < 1e-15
    unit = a[:, 3:] / np.linalg.norm(a[:, 3:], axis=1, keepdims=True)
    assert np.abs(np.abs((q * unit).sum(axis=1)) - 1).max() < 1e-14
    assert p.rows.shape == (200, 7) and np.abs(vex.pose_of(p.rows[:, 3:]).rotation - p.rotation).max() < 1e-15
    assert vex.quaternion_of([0, 0, 0, 2, 0, 0, 0]).tolist() == [1, 0, 0, 0]
    again = pickle.loads(pickle.dumps(p))
    assert isinstance(again, vex.Pose) and (again.rotation == p.rotation).all()


def test_what_is_no_pose_is_refused_and_named():
    good = random_poses(5, 1.0)
    bad = good.copy()
    bad[3, 3:] = 0
    for call in (vex.inverse, vex.quaternion_of, lambda p: vex.product(p, good), lambda p: vex.product(good, p),
                 lambda p: vex.relative_pose(good, p), lambda p: vex.interpolated(p, good, 0.5)):
        with pytest.raises(vex.InputError, match="pose 3: "):
            call(bad)
        with pytest.raises(vex.UsageError):
            call(np.zeros((5, 6)))
    with pytest.raises(vex.UsageError, match="3 rows beside 5"):
        vex.product(good, good[:3])
    for part in (-0.1, 1.1, np.nan, np.zeros((2, 2))):
        with pytest.raises(vex.UsageError):
            vex.interpolated(good, good, part)
    with pytest.raises(vex.InputError):
        vex.pose_of([[1, 0, 0, 0]], [np.inf, 0, 0])
    with pytest.raises(vex.UsageError):
        vex.relative_pose_error(good, good, -1.0)
    with pytest.raises(TypeError):
        2 * vex.inverse(good)
    empty = vex.product(np.zeros((0, 7)), good[:1])
    assert empty.rotation.shape == (0, 3, 3) and empty.translation.shape == (0, 3)


def test_scaled_mirrored_and_mapped_bodies():
    assert vex.scaled("box:1,2,3", (2, 0.5, 1)) == vex.box(2, 1, 3)
    assert vex.scaled("sphere:1", (1, 2, 3)) == vex.ellipsoid(1, 2, 3)
    assert vex.scaled("sphere:1", (1, 2, 3)).surface_area == vex.ellipsoid(1, 2, 3).surface_area
    assert vex.scaled("cone:1,1", 2) == vex.cone(2, 2)
    can = vex.cylinder(1, 0.5)
    flat = can.scaled((1, 2, 0.1))
    assert flat.volume == pytest.approx(0.2 * can.volume, rel=1e-14) and np.isnan(flat.surface_area)
    directions = np.random.default_rng(1).normal(size=(100, 3))
    factors = np.array([1, 2, 0.1])
    heights = (can.support(directions * factors) * (directions * factors)).sum(axis=1)
    assert np.abs((flat.support(directions) * directions).sum(axis=1) - heights).max() < 1e-13
    shape = vex.hull([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3], [1, 1, 1]])
    twin = shape.mirrored()
    order = lambda points: points[np.lexsort(points.T)]  # noqa: E731
    assert (order(twin.vertices) == order(shape.vertices * [-1, 1, 1])).all()
    assert twin.volume == pytest.approx(shape.volume, rel=1e-12) and twin.mirrored() == shape
    assert twin.surface_area == pytest.approx(shape.surface_area, rel=1e-12)
    matrix = np.array([[1, 0.5, 0], [0, 2, 0.25], [0.125, 0, 1]])
    sheared = vex.mapped(shape, matrix)
    assert (order(sheared.vertices) == order(applied(np.broadcast_to(matrix, (5, 3, 3)), shape.vertices))).all()
    assert sheared.volume == pytest.approx(abs(np.linalg.det(matrix)) * shape.volume, rel=1e-12)
    for body in (flat, twin, sheared, flat.rounded(0.1), shape.scaled((1, 2, 3), unit_volume=True)):
        again = pickle.loads(pickle.dumps(body))
        assert again == body and hash(again) == hash(body) and repr(again) == repr(body)
        assert not body.validate(n_directions=100)
    assert repr(flat) == "vex.Body('cylinder:1.0,0.5').scaled((1.0, 2.0, 0.1))"
    assert shape.scaled((1, 2, 3), unit_volume=True).volume == pytest.approx(6, rel=1e-12)
    for factors in ((1, 0, 1), (1, np.nan, 1), (np.inf, 1, 1)):
        with pytest.raises(vex.InputError):
            can.scaled(factors)
    for factors in ((1, 2), [[1, 2, 3]]):
        with pytest.raises(vex.UsageError):
            can.scaled(factors)
    with pytest.raises(vex.InputError, match="polytope"):
        can.mapped(np.eye(3))
    with pytest.raises(vex.InputError):
        shape.mapped(np.zeros((3, 3)))
    with pytest.raises(vex.UsageError):
        shape.mapped(np.eye(2))


def test_a_body_of_ones_own_is_scaled_too():
    def ball(directions):
        return directions / np.linalg.norm(directions, axis=1, keepdims=True)
    own = vex.from_support(ball, circumradius=1 + 1e-14, support_error=1e-15)
    assert own.scaled(2.0).support([0, 0, 1]).tolist() == [0, 0, 2]
    egg = own.scaled((1, 2, 3))
    assert egg.support([0, 1, 0]) == pytest.approx([0, 2, 0]) and not egg.validate(n_directions=50)
    assert egg == own.scaled((1, 2, 3)) and egg != own
