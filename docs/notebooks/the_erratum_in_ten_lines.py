# %% [markdown]
# # The erratum in ten lines
# cond-mat/0207739 printed ⟨V_ex⟩ = 10.56(1) V for cubes where the formula has 11. Its overlap test asked whether an edge of
# the second body meets the first one, and not the other way round. docs/erratum.md has the whole of it.

# %%
import numpy as np

import vex

rng = np.random.default_rng(1)
n, radius = 400_000, np.sqrt(3.0)
direction = rng.normal(size=(n, 3))
centres = radius * rng.random((n, 1)) ** (1 / 3) * direction / np.linalg.norm(direction, axis=1, keepdims=True)
quaternions = rng.normal(size=(n, 4))
cube = vex.box(1, 1, 1)
both_sides = vex.overlap(cube, cube, np.concatenate([centres, quaternions], axis=1)) == 1

# %% [markdown]
# Whether an edge of B meets A: each edge is a segment, clipped by the three slabs of A.

# %%
w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
rotation = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1).reshape(-1, 3, 3)
corners = np.einsum("nij,kj->nki", rotation, cube.vertices) + centres[:, None, :]
edges = [(i, j) for i in range(8) for j in range(i) if np.count_nonzero(cube.vertices[i] != cube.vertices[j]) == 1]
one_sided = np.zeros(n, dtype=bool)
for i, j in edges:
    start, along = corners[:, i], corners[:, j] - corners[:, i]
    with np.errstate(divide="ignore"):
        times = np.stack([(-0.5 - start) / along, (0.5 - start) / along])
    one_sided |= np.maximum(times.min(axis=0).max(axis=1), 0.0) <= np.minimum(times.max(axis=0).min(axis=1), 1.0)

# %%
volume = 4 / 3 * np.pi * radius**3
for name, hits in (("both sides", both_sides), ("one side, as in the paper", one_sided)):
    p = hits.mean()
    print(f"{name:27s} {volume * p:.3f} ± {volume * np.sqrt(p * (1 - p) / n):.3f}")
print(f"the formula                 {vex.formula(cube):.3f}")
assert abs(volume * both_sides.mean() - 11.0) < 5 * volume * 0.5 / np.sqrt(n)
assert not (one_sided & ~both_sides).any() and 10.45 < volume * one_sided.mean() < 10.70
