# %% [markdown]
# # V_ex(γ) of rods against Onsager
# L. Onsager (Ann. N.Y. Acad. Sci. 51, 627, 1949) has the excluded volume of two cylinders whose axes are at an angle γ.
# vex has it for any two bodies, each spun about its own axis: `excluded_volume_of_angle`.

# %%
import numpy as np
from scipy.special import ellipe

import vex

length, diameter = 5.0, 1.0
rod = vex.cylinder(length, diameter / 2)
angles = np.linspace(0.0, 90.0, 10)
gamma = np.radians(angles)
onsager = (np.pi / 2 * diameter**3 * np.sin(gamma)
           + np.pi / 2 * length * diameter**2 * (1 + np.abs(np.cos(gamma)) + 4 / np.pi * ellipe(np.sin(gamma) ** 2))
           + 2 * length**2 * diameter * np.sin(gamma))
found = vex.excluded_volume_of_angle(rod, rod, angles)
for angle, row, exact in zip(angles, found, onsager):
    print(f"{angle:5.0f}°   {row['value']:.8f} ± {row['error']:.1g}   Onsager {exact:.8f}")
assert (np.abs(found["value"] - onsager) < 5 * found["error"] + 1e-9).all()

# %% [markdown]
# The mean over random directions, of density sin γ, is the isotropic average, which the formula knows.

# %%
nodes, weights = np.polynomial.legendre.leggauss(16)
mean = (vex.excluded_volume_of_angle(rod, rod, np.degrees(np.arccos(nodes)))["value"] * weights).sum() / 2
print(f"mean {mean:.4f}, formula {vex.formula(rod):.4f}")

# %%
ax = vex.plot.excluded_volume_of_angle(rod, n=13, label="cylinder 5:1")
vex.plot.excluded_volume_of_angle("capsule:5,0.5", n=13, ax=ax, label="capsule, L = 5 D")
vex.plot.excluded_volume_of_angle("box:1,1,5", n=13, ax=ax, label="box 1:1:5")
vex.plot.excluded_volume(rod, rod, [np.cos(0.6), np.sin(0.6), 0, 0])
