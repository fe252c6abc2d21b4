"""vex: excluded volumes, overlaps, distances and contacts of convex bodies, every answer proven or said not to be.

>>> import vex
>>> vex.excluded_volume("box:1,1,1", rel_error=1e-3).formula
11.0
>>> vex.overlap("box:1,1,1", "sphere:0.5", [[0.9, 0, 0, 1, 0, 0, 0], [1.1, 0, 0, 1, 0, 0, 0]])
array([1, 0], dtype=int8)

Lengths are in your unit. docs/python.md has a tour; names are those of the C++ library.
"""

from . import plot
from ._vex import Error, InputError, OrientationLaw, UsageError, WarmStart
from ._vex import stream_version as stream_version
from ._vex import version as __version__
from .average import (ExcludedVolume, Interrupted, Reference, estimators, excluded_volume, excluded_volume_at,
                      excluded_volume_of_angle, formula)
from .bodies import (Body, BodyLike, UnconfinedWarning, from_support, hull, load, mapped, mirrored, named_shapes,
                     rounded, scaled)
from .depletion import depletion_at, depletion_average, overlap_of_balls
from .nematic import (MixtureCoexistence, MixturePhase, MixtureTransition, NematicPhase, NematicTransition,
                      ThreeFluids, mixture_transition, nematic_transition)
from .percolation import Percolation, percolation
from .poses import (Pose, interpolated, inverse, pose_of, product, quaternion_of, relative_pose,
                    relative_pose_error)
from .queries import (Manifold, Proof, contact_manifold, depth, distance, linear_cast, overlap, overlap_certificate,
                      ray_cast, signed_distance, time_of_impact, within)
from .scenes import Clusters, Hit, Neighbour, Scene, UndecidedWarning
from .shapes import (antiprism, box, capsule, cone, cuboctahedron, cut_sphere, cylinder, disc, dodecahedron, egg,
                     ellipsoid, frustum, hemisphere, icosahedron, icosidodecahedron, lens, needle, octahedron, plate,
                     prism, pyramid, rhombicosidodecahedron, rhombicuboctahedron, snub_cube, snub_dodecahedron, sphere,
                     spindle, superball, superellipsoid, tetrahedron, truncated_cube, truncated_cuboctahedron,
                     truncated_dodecahedron, truncated_icosahedron, truncated_icosidodecahedron, truncated_octahedron,
                     truncated_tetrahedron)
from .virial import VirialCoefficient, VirialCoefficients, virial_coefficients
from .worlds import Compound, HalfSpace

__all__ = [
    "Body", "BodyLike", "Clusters", "Compound", "Error", "ExcludedVolume", "HalfSpace", "Hit", "InputError",
    "Interrupted", "Manifold", "MixtureCoexistence", "MixturePhase", "MixtureTransition", "Neighbour", "NematicPhase",
    "NematicTransition", "OrientationLaw", "Percolation", "Pose", "Proof", "Reference", "Scene", "ThreeFluids",
    "UnconfinedWarning", "UndecidedWarning", "UsageError", "VirialCoefficient", "VirialCoefficients", "WarmStart",
    "__version__", "antiprism", "box", "capsule", "cone", "contact_manifold", "cuboctahedron", "cut_sphere",
    "cylinder", "depletion_at", "depletion_average", "depth", "disc", "distance", "dodecahedron", "egg", "ellipsoid",
    "estimators", "excluded_volume", "excluded_volume_at", "excluded_volume_of_angle", "formula", "from_support",
    "frustum", "hemisphere", "hull", "icosahedron", "icosidodecahedron", "interpolated", "inverse", "lens",
    "linear_cast", "load", "mapped", "mirrored", "mixture_transition", "named_shapes", "needle", "nematic_transition",
    "octahedron", "overlap", "overlap_certificate", "overlap_of_balls", "percolation", "plate", "plot", "pose_of",
    "prism", "product", "pyramid", "quaternion_of", "ray_cast", "relative_pose", "relative_pose_error",
    "rhombicosidodecahedron", "rhombicuboctahedron", "rounded", "scaled", "signed_distance", "snub_cube",
    "snub_dodecahedron", "sphere", "spindle", "stream_version", "superball", "superellipsoid", "tetrahedron",
    "time_of_impact", "truncated_cube", "truncated_cuboctahedron", "truncated_dodecahedron", "truncated_icosahedron",
    "truncated_icosidodecahedron", "truncated_octahedron", "truncated_tetrahedron", "virial_coefficients", "within",
]
