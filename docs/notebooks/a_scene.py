# %% [markdown]
# # A scene, and snapshots of a simulation
# Many bodies in a periodic box: pairs, clusters, distances; and a snapshot in HOOMD-blue's GSD format.

# %%
import pathlib
import tempfile

import numpy as np

import vex

rng = np.random.default_rng(3)
n, edge = 4000, 16.0
rod = vex.capsule(2.0, 0.25)
poses = np.concatenate([edge * (rng.random((n, 3)) - 0.5), rng.normal(size=(n, 4))], axis=1)
scene = vex.Scene(rod, poses, box=(edge, edge, edge))
pairs = scene.pairs()
print(f"{len(pairs)} pairs overlap, {2 * len(pairs) / n:.2f} others a body; the mean is n <V_ex> / V = "
      f"{n * vex.formula(rod) / edge**3:.2f}")
print("stages, pairs seen and settled:", scene.counts)

# %%
clusters = scene.clusters()
print(f"{len(clusters.sizes)} clusters, the largest of {clusters.sizes.max()} bodies; around the box along x, y, z: "
      f"{clusters.wraps.any(axis=0).tolist()}")

# %% [markdown]
# Snapshots: positions and orientations of a frame are arrays of the very form that `Scene` takes.

# %%
try:
    import gsd.hoomd
except ImportError:
    print("the package gsd is not installed")
else:
    file = pathlib.Path(tempfile.mkdtemp()) / "trajectory.gsd"
    frame = gsd.hoomd.Snapshot() if not hasattr(gsd.hoomd, "Frame") else gsd.hoomd.Frame()
    frame.particles.N = n
    frame.particles.position = poses[:, :3]
    frame.particles.orientation = poses[:, 3:] / np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    frame.configuration.box = [edge, edge, edge, 0, 0, 0]
    with gsd.hoomd.open(str(file), "wb") as to:
        to.append(frame)
    with gsd.hoomd.open(str(file), "rb") as trajectory:
        for step in trajectory:
            particles = step.particles
            read = vex.Scene(rod, np.concatenate([particles.position, particles.orientation], axis=1).astype(float),
                             box=step.configuration.box)
            print(f"in the file, of 32-bit numbers: {len(read.pairs())} pairs")
            # Rounding moves bodies by some 1e-7: pairs nearer to contact than that may be other ones.
            assert abs(len(read.pairs()) - len(pairs)) <= 3
