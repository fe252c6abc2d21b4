"""What a new user, with docs/python.md alone, stumbled over."""

import multiprocessing
import warnings

import numpy as np
import pytest

import vex
from conftest import matrices, random_poses

POSES = random_poses(60, 1.9)


def test_arrays_as_they_come():
    asked = vex.overlap("box:1,1,1", "box:1,1,1", POSES)
    assert 0.1 < asked.mean() < 0.9
    wide = np.zeros((120, 14))
    wide[::2, ::2] = POSES
    read_only = POSES.copy()
    read_only.setflags(write=False)
    for same in (np.asfortranarray(POSES), wide[::2, ::2], read_only, POSES.astype(">f8"), POSES.tolist()):
        assert (vex.overlap("box:1,1,1", "box:1,1,1", same) == asked).all()
    single = POSES.astype(np.float32)
    assert (vex.overlap("box:1,1,1", "box:1,1,1", np.asfortranarray(single))
            == vex.overlap("box:1,1,1", "box:1,1,1", single.astype(float))).all()
    # Matrices of 32-bit numbers are rotations to some 1e-7, which is near enough.
    rotations, translations = matrices(POSES[:, 3:]).astype(np.float32), POSES[:, :3].astype(np.float32)
    assert (vex.overlap("box:1,1,1", "box:1,1,1", (rotations, translations)) == asked).mean() > 0.95


def test_rotations_that_are_nearly_none_are_told_from_those_that_are():
    rotations, translations = matrices(POSES[:, 3:]), POSES[:, :3]
    for off, is_fine in ((0.4e-6, True), (0.9e-6, True), (1.1e-6, False), (-1.0, False), (np.nan, False)):
        for k, i, j in ((0, 0, 0), (31, 1, 2), (59, 2, 1)):
            bent = rotations.copy()
            stretch = np.eye(3)
            stretch[i, j] += 0.5 * off
            stretch[j, i] = stretch[i, j]
            bent[k] = bent[k] @ stretch
            off_by = np.abs(bent[k].T @ bent[k] - np.eye(3)).max()
            if is_fine:
                assert off_by < 1e-6
                vex.overlap("box:1,1,1", "box:1,1,1", (bent, translations))
            else:
                assert not off_by < 1e-6
                with pytest.raises(vex.InputError, match=f"pose {k}: "):
                    vex.overlap("box:1,1,1", "box:1,1,1", (bent, translations))
    mirrored = rotations.copy()
    mirrored[7] = -mirrored[7]
    with pytest.raises(vex.InputError, match="pose 7: "):
        vex.overlap("box:1,1,1", "box:1,1,1", (mirrored, translations))
    for k in (0, 59):
        infinite = translations.copy()
        infinite[k, 1] = np.inf
        with pytest.raises(vex.InputError, match=f"pose {k}: "):
            vex.overlap("box:1,1,1", "box:1,1,1", (rotations, infinite))


def test_poses_in_other_forms():
    rotations, translations = matrices(POSES[:, 3:]), POSES[:, :3]
    asked = vex.overlap("box:1,1,1", "box:1,1,1", (rotations, translations))
    whole = np.tile(np.eye(4), (len(POSES), 1, 1))
    whole[:, :3, :3], whole[:, :3, 3] = rotations, translations
    assert (vex.overlap("box:1,1,1", "box:1,1,1", whole) == asked).all()
    assert (vex.overlap("box:1,1,1", "box:1,1,1", [rotations, translations]) == asked).all()
    assert (vex.overlap("box:1,1,1", "box:1,1,1", [whole[0], whole[1]]) == asked[:2]).all()
    assert vex.overlap("box:1,1,1", "box:1,1,1", whole[0]) == asked[0]
    whole[3, 3, 0] = 0.5
    with pytest.raises(vex.InputError, match="pose 3: the last row"):
        vex.overlap("box:1,1,1", "box:1,1,1", whole)
    for wrong in ((translations, rotations), [[1, 2, 3], [1, 2]], (np.zeros(3), np.eye(3))):
        with pytest.raises(vex.UsageError):
            vex.overlap("box:1,1,1", "box:1,1,1", wrong)
    with pytest.raises(vex.UsageError, match=r"\(N, 3, 3\)"):
        vex.overlap("box:1,1,1", "box:1,1,1", translations)


def test_messages_say_what_is_meant():
    with pytest.raises(TypeError, match=r"vex\.hull"):
        vex.Body(np.zeros((8, 3)))

    class Shape:
        vertices = vex.tetrahedron(1).vertices
        faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=float)
    with pytest.raises(TypeError, match="faces"):
        vex.Body(Shape())
    with pytest.raises(vex.UsageError, match="box"):
        vex.Scene("box:1,1,1", POSES, box=9)


def volume_below(world, body, pose):
    return int(world.overlap(body, pose))


def test_worlds_and_bodies_go_to_other_processes():
    work = [(vex.HalfSpace([0, 0, 1]), vex.cone(1, 1).scaled((1, 2, 3)), POSES[0]),
            (vex.Compound("sphere:1", POSES[:5]), vex.box(1, 1, 1).rounded(0.1), POSES[1])]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.starmap(volume_below, work) == [volume_below(*one) for one in work]


def test_confinement_is_asked_for(meshes, tmp_path):
    pebble = vex.load(meshes / "pebble.obj", require_confinement=True)  # no process is needed for this format
    assert pebble == vex.Body(str(meshes / "pebble.obj"), require_confinement=True)
    assert pebble.report["reader_unconfined"] == ""
    with pytest.raises(vex.UsageError, match="require_confinement"):
        vex.Body("box:1,1,1", require_confinement=True)
    by_assimp = meshes / "icosahedron.gltf"
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        body = vex.load(by_assimp)
    if told:  # a system that lets no process be confined
        assert told[0].category is vex.UnconfinedWarning and body.report["reader_unconfined"]
        with pytest.raises(vex.InputError):
            vex.load(by_assimp, require_confinement=True)
    else:
        assert vex.load(by_assimp, require_confinement=True) == body
