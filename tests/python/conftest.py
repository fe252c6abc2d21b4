import contextlib
import os
import pathlib
import signal
import subprocess
import threading

import numpy as np
import pytest

import vex

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    """Runs a program of vex; its folder is in VEX_PROGRAMS."""
    folder = os.environ.get("VEX_PROGRAMS")
    if folder is None:
        pytest.skip("VEX_PROGRAMS does not name the folder of the programs")

    def run(name, *arguments):
        return subprocess.run([os.path.join(folder, name), *map(str, arguments)], capture_output=True, text=True,
                              check=True, timeout=300).stdout
    return run


@pytest.fixture(scope="session")
def meshes():
    return ROOT / "meshes" / "data"


@contextlib.contextmanager
def ctrl_c(seconds):
    """Sends SIGINT after so long, and sees to it that Python heeds it: what a shell starts in the background ignores
    it, and so do its children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(seconds, signal.raise_signal, [signal.SIGINT])
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        signal.signal(signal.SIGINT, before)


def random_poses(n, reach, seed=1):
    """Isotropic orientations, centres uniform in a ball."""
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(n, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.concatenate([reach * rng.random((n, 1)) ** (1 / 3) * direction, rng.normal(size=(n, 4))], axis=1)


def matrices(quaternions):
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1).reshape(-1, 3, 3)


def boxes_overlap(half_a, half_b, rotations, translations):
    """The separating-axis test of two boxes, and how far each pose is from being otherwise, in floating point."""
    worst = np.full(len(rotations), -np.inf)
    axes_a = np.broadcast_to(np.eye(3), rotations.shape)
    axes_b = rotations.transpose(0, 2, 1)  # rows: B's axes in A's frame
    candidates = [axes_a[:, i] for i in range(3)] + [axes_b[:, i] for i in range(3)]
    candidates += [np.cross(axes_a[:, i], axes_b[:, j]) for i in range(3) for j in range(3)]
    for axis in candidates:
        length = np.linalg.norm(axis, axis=1)
        usable = length > 1e-9
        unit = axis / np.where(usable, length, 1.0)[:, None]
        reach = (np.abs(np.einsum("nij,nj->ni", axes_a, unit)) @ half_a
                 + np.abs(np.einsum("nij,nj->ni", axes_b, unit)) @ half_b)
        gap = np.abs(np.einsum("ni,ni->n", unit, translations)) - reach
        worst = np.maximum(worst, np.where(usable, gap, -np.inf))
    return worst <= 0.0, np.abs(worst)
