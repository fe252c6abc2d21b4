# %% [markdown]
# # From a mesh to B₂
# A body from a file, its measures, its average excluded volume by the formula and by Monte Carlo, and B₂.
#
# The cells run in Jupyter (with jupytext), in editors that know `# %%`, or as a script from the repository's root.

# %%
import pathlib

import vex

meshes = pathlib.Path(__file__).resolve().parents[2] / "meshes" / "data" if "__file__" in globals() else \
    pathlib.Path("meshes/data")
gem = vex.load(meshes / "gem.obj")
print(gem)
print(f"V = {gem.volume:.12g}   S = {gem.surface_area:.12g}   M = {gem.integrated_mean_curvature:.12g}")

# %% [markdown]
# The formula holds for convex bodies whose relative orientation is uniformly random. Monte Carlo shares no geometry with
# it: `z` is how many standard errors they are apart.

# %%
result = vex.excluded_volume(gem, rel_error=1e-4)
print(result)
print(f"B2 = {result.b2:.8g} by Monte Carlo, {result.reference.b2:.12g} by the formula")

# %%
gem.plot()
vex.plot.convergence(gem, trials=[2**k for k in range(10, 17)])

# %% [markdown]
# A mixture is a pair of different bodies. In numbers without a unit: 8 for two equal balls, more for anything else.

# %%
ball = vex.Body("sphere:1", unit_volume=True)
unit_gem = vex.Body(gem, unit_volume=True)
print(f"gem-gem {vex.formula(unit_gem):.6f}   gem-ball {vex.formula(unit_gem, ball):.6f}   ball-ball "
      f"{vex.formula(ball):.6f}")
