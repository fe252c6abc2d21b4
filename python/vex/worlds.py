"""Half-spaces, such as floors, and compounds: unions of convex bodies, static meshes of triangles among them.

Poses are of the convex body B in the frame of the half-space or the compound, in the forms that `vex.queries` takes.
Points and normals are in that frame; normals point towards B.
"""

from __future__ import annotations

import math
from typing import Any, Optional, Sequence

import numpy.typing as npt

from . import _vex
from ._arrays import Poses, as_floats, as_poses, as_rows, threads_of
from .bodies import BodyLike, as_body


class HalfSpace:
    """The points x with normal . x <= offset. The normal has any length but 0."""

    def __init__(self, normal: npt.ArrayLike, offset: float = 0.0) -> None:
        rows, _ = as_rows(normal, 3, "normal")
        if len(rows) != 1:
            raise _vex.UsageError(f"normal: {len(rows)} rows - give three numbers")
        self._core = _vex.HalfSpace([float(x) for x in rows[0]], float(offset))

    def overlap(self, body: BodyLike, poses: Poses, *, threads: Optional[int] = None) -> Any:
        """int8 array (N,): 1 overlap, 0 disjoint, -1 undecided, which no body with an exact form is."""
        rows = self.signed_distance(body, poses, threads=threads)
        return rows["verdict"]

    def signed_distance(self, body: BodyLike, poses: Poses, *, threads: Optional[int] = None) -> Any:
        """The distance, or minus how deep the body goes into the half-space.

        Returns
        -------
        Structured array (N,) with the fields value, lower, upper, normal, point_a (on the plane), point_b, verdict and
        part, which is -1.
        """
        rows, translations, single = as_poses(poses)
        found = self._core.signed_distance(as_body(body)._core, rows, translations, threads_of(threads))
        return found[0] if single else found

    def contacts(self, body: BodyLike, pose: Poses, margin: float = 0.0) -> Any:
        """The points of the body that are no farther than `margin` above the plane: fields point_a, point_b, distance,
        and feature, the same number for the same point in every pose."""
        rows, translations, _ = as_poses(pose)
        return self._core.contacts(as_body(body)._core, rows, translations, float(margin))


class Compound:
    """The union of convex bodies, each at a pose of the compound's frame.

    Parameters
    ----------
    bodies
        A list of bodies, or of texts that name them.
    poses
        As many.
    """

    def __init__(self, bodies: Sequence[BodyLike], poses: Poses) -> None:
        rows, translations, _ = as_poses(poses)
        self._core = _vex.Compound([as_body(body)._core for body in bodies], rows, translations)

    @classmethod
    def of_triangles(cls, triangles: npt.ArrayLike) -> "Compound":
        """The surface of triangles (N, 3, 3), each with three corners; what is wholly inside of it touches nothing."""
        corners = as_floats(triangles, "triangles")
        if corners.ndim != 3 or corners.shape[1:] != (3, 3):
            raise _vex.UsageError(f"triangles: an array of shape {corners.shape} - give one of shape (N, 3, 3)")
        made = cls.__new__(cls)
        made._core = _vex.compound_of_corners(corners.reshape(-1, 3))
        return made

    def __len__(self) -> int:
        return len(self._core)

    def overlap(self, body: BodyLike, poses: Poses, *, threads: Optional[int] = None) -> Any:
        """int8 array (N,): 1 where some part shares a point with the body, 0 where none does, -1 where neither is
        proven."""
        rows, translations, single = as_poses(poses)
        verdicts, _ = self._core.overlap(as_body(body)._core, rows, translations, threads_of(threads))
        return verdicts[0] if single else verdicts

    def distance(self, body: BodyLike, poses: Poses, *, relative_gap: float = 0.0, max_distance: float = math.inf,
                 threads: Optional[int] = None) -> Any:
        """The distance of the union, 0 where it overlaps the body. A depth of a union there is none.

        Returns
        -------
        Structured array (N,) with the fields value, lower, upper, normal, point_a, point_b, verdict and part, the part
        that is nearest (-1 where none is as near as `max_distance`). Where the bodies overlap normal and points are NaN.
        """
        rows, translations, single = as_poses(poses)
        found = self._core.distance(as_body(body)._core, rows, translations, float(relative_gap), float(max_distance),
                                    threads_of(threads))
        return found[0] if single else found
