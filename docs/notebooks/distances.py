# %% [markdown]
# # Distances beside another way
# Distances of two polytopes at a thousand poses, with bounds; beside them what python-fcl says, where it is installed, and
# in any case a least-squares referee: the point nearest to the origin of the hull of all differences of vertices.

# %%
import time

import numpy as np
from scipy.optimize import nnls

import vex

a, b = vex.icosahedron(1.0), vex.box(1, 2, 0.5)
rng = np.random.default_rng(7)
n = 1000
poses = np.concatenate([2.5 * rng.normal(size=(n, 3)), rng.normal(size=(n, 4))], axis=1)
start = time.perf_counter()
found = vex.distance(a, b, poses)
seconds = time.perf_counter() - start
apart = found["verdict"] == 0
print(f"{n} distances in {1e3 * seconds:.1f} ms, {apart.sum()} of them apart, bounds at most "
      f"{(found['upper'] - found['lower']).max():.1g} wide")


# %%
def referee(pose):
    """min |sum of w_k (a_i - b_j)| over weights that add up to 1, by non-negative least squares."""
    w, x, y, z = pose[3:] / np.linalg.norm(pose[3:])
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    differences = (a.vertices[:, None] - (b.vertices @ rotation.T + pose[:3])[None]).reshape(-1, 3)
    heavy = 1e3  # of the row that says that weights add up to 1
    weights, _ = nnls(np.vstack([differences.T, np.full(len(differences), heavy)]), [0, 0, 0, heavy])
    return np.linalg.norm(differences.T @ weights / weights.sum())


chosen = np.flatnonzero(apart)[:100]
off = max(abs(referee(poses[k]) - found["value"][k]) for k in chosen)
print(f"largest difference from the referee on {len(chosen)} poses: {off:.1g}")
assert off < 1e-5

# %%
try:
    import fcl
except ImportError:
    print("python-fcl is not installed")
else:
    box, shape = fcl.Box(1, 2, 0.5), fcl.Convex(a.vertices, len(a.faces),
                                               np.concatenate([[len(f), *f] for f in a.faces]).astype(int))
    for k in chosen[:10]:
        objects = [fcl.CollisionObject(shape), fcl.CollisionObject(box, fcl.Transform(poses[k, 3:], poses[k, :3]))]
        print(found["value"][k], fcl.distance(*objects, fcl.DistanceRequest(), fcl.DistanceResult()))

# %%
vex.plot.pair(a, b, poses[chosen[0]])
