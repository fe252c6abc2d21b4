"""Half-spaces, such as floors, and compounds: unions of convex bodies, static meshes of triangles among them.

Poses are of the convex body B in the frame of the half-space or the compound, in the forms that `vex.queries` takes.
Points and normals are in that frame; normals point towards B.
"""

from __future__ import annotations

import math
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats, Poses, as_floats, as_many, as_number, as_poses, as_rows, threads_of, together
from .bodies import Body, BodyLike, as_body


class HalfSpace:
    """The points x with normal . x <= offset. The normal has any length but 0."""

    def __init__(self, normal: npt.ArrayLike, offset: float = 0.0) -> None:
        rows, _ = as_rows(normal, 3, "normal")
        if len(rows) != 1:
            raise _vex.UsageError(f"normal: {len(rows)} rows - give three numbers")
        self._normal = (float(rows[0, 0]), float(rows[0, 1]), float(rows[0, 2]))
        self._offset = as_number(offset, "offset")
        self._core = _vex.HalfSpace(list(self._normal), self._offset)

    @property
    def normal(self) -> Floats:
        """As it was given, (3,): out of the half-space."""
        return np.array(self._normal)

    @property
    def offset(self) -> float:
        """As it was given."""
        return self._offset

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, HalfSpace):
            return NotImplemented
        return (self._normal, self._offset) == (other._normal, other._offset)

    def __hash__(self) -> int:
        return hash((self._normal, self._offset))

    def __reduce__(self) -> Tuple[Any, ...]:
        return HalfSpace, (self._normal, self._offset)

    def __repr__(self) -> str:
        return f"vex.HalfSpace({list(self._normal)!r}, {self._offset!r})"

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

    def ray_cast(self, origins: npt.ArrayLike, directions: npt.ArrayLike, *, until: float = math.inf,
                 threads: Optional[int] = None) -> Any:
        """The rays origin + t direction, t >= 0, against the half-space: fields as of `vex.ray_cast`, and part, -1."""
        return _rays(self._core, origins, directions, until, threads)

    def linear_cast(self, body: BodyLike, poses: Poses, motions: npt.ArrayLike, *, until: float = math.inf,
                    threads: Optional[int] = None) -> Any:
        """The body moving without turning, onto the half-space: fields as of `vex.linear_cast`, and part, -1."""
        return _casts(self._core, body, poses, motions, until, threads)

    def time_of_impact(self, body: BodyLike, poses: Poses, velocities: npt.ArrayLike,
                       angular_velocities: npt.ArrayLike = (0.0, 0.0, 0.0), *, until: float = math.inf,
                       threads: Optional[int] = None) -> Any:
        """The body moving straight and turning about its own origin, by radians per unit of time, onto the half-space:
        fields as of `vex.time_of_impact`, and part, -1."""
        return _impacts(self._core, body, poses, [(velocities, "velocities"), (angular_velocities, "angular velocities")],
                        until, threads)

    def contacts(self, body: BodyLike, pose: Poses, margin: float = 0.0) -> Any:
        """The points of the body that are no farther than `margin` above the plane: fields point_a, point_b, distance,
        and feature, the same number for the same point in every pose."""
        rows, translations, _ = as_poses(pose)
        return self._core.contacts(as_body(body)._core, rows, translations, as_number(margin, "margin"))


class Compound:
    """The union of convex bodies, each at a pose of the compound's frame.

    Parameters
    ----------
    bodies
        A list of bodies, or of texts that name them; or one for all poses.
    poses
        As many.

    Notes
    -----
    A compound never changes, and can be pickled.
    """

    def __init__(self, bodies: Union[BodyLike, Sequence[BodyLike]], poses: Poses) -> None:
        rows, translations, _ = as_poses(poses)
        parts = [as_body(body) for body in bodies] if isinstance(bodies, (list, tuple)) else [as_body(bodies)] * len(rows)
        self._core = _vex.Compound([part._core for part in parts], rows, translations)
        self._made_of: Tuple[Any, ...] = (_compound_of_parts, parts, rows.copy(),
                                          None if translations is None else translations.copy())

    @classmethod
    def of_triangles(cls, triangles: npt.ArrayLike) -> "Compound":
        """The surface of triangles (N, 3, 3), each with three corners; what is wholly inside of it touches nothing."""
        corners = as_floats(triangles, "triangles")
        if corners.ndim != 3 or corners.shape[1:] != (3, 3):
            raise _vex.UsageError(f"triangles: an array of shape {corners.shape} - give one of shape (N, 3, 3)")
        made = cls.__new__(cls)
        made._core = _vex.compound_of_corners(corners.reshape(-1, 3))
        made._made_of = (cls.of_triangles, corners.copy())
        return made

    def __reduce__(self) -> Tuple[Any, ...]:
        return self._made_of[0], self._made_of[1:]

    def __repr__(self) -> str:
        return f"<vex.Compound of {len(self)} parts>"

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
        found = self._core.distance(as_body(body)._core, rows, translations,
                                    as_number(relative_gap, "relative_gap"), as_number(max_distance, "max_distance"),
                                    threads_of(threads))
        return found[0] if single else found

    def ray_cast(self, origins: npt.ArrayLike, directions: npt.ArrayLike, *, until: float = math.inf,
                 threads: Optional[int] = None) -> Any:
        """The rays origin + t direction, t >= 0, against the union: fields as of `vex.ray_cast`, and ``part``, the one
        that is met, -1 where none is."""
        return _rays(self._core, origins, directions, until, threads)

    def linear_cast(self, body: BodyLike, poses: Poses, motions: npt.ArrayLike, *, until: float = math.inf,
                    threads: Optional[int] = None) -> Any:
        """The body moving without turning: fields as of `vex.linear_cast`, and ``part``."""
        return _casts(self._core, body, poses, motions, until, threads)

    def time_of_impact(self, body: BodyLike, poses: Poses, velocities: npt.ArrayLike,
                       angular_velocities: npt.ArrayLike = (0.0, 0.0, 0.0), *,
                       velocities_a: npt.ArrayLike = (0.0, 0.0, 0.0),
                       angular_velocities_a: npt.ArrayLike = (0.0, 0.0, 0.0), until: float = math.inf,
                       threads: Optional[int] = None) -> Any:
        """The body moving straight and turning about its own origin, in the compound's frame, by radians per unit of
        time: fields as of `vex.time_of_impact`, and ``part``. With `velocities_a` and `angular_velocities_a` the
        compound moves as well, in its own frame as it is at first."""
        motions = [(velocities, "velocities"), (angular_velocities, "angular velocities"),
                   (velocities_a, "velocities of A"), (angular_velocities_a, "angular velocities of A")]
        return _impacts(self._core, body, poses, motions, until, threads)


def _compound_of_parts(parts: Sequence[Body], rows: Floats, translations: Optional[Floats]) -> Compound:
    return Compound(list(parts), rows if translations is None else (rows, translations))


def _rays(core: Any, origins: npt.ArrayLike, directions: npt.ArrayLike, until: float, threads: Optional[int]) -> Any:
    (from_, along), single = together((origins, "origins"), (directions, "directions"))
    found = core.ray_cast(from_, along, as_number(until, "until"), threads_of(threads))
    return found[0] if single else found


def _impacts(core: Any, body: BodyLike, poses: Poses, motions: Sequence[Tuple[npt.ArrayLike, str]], until: float,
             threads: Optional[int]) -> Any:
    rows, translations, single = as_poses(poses)
    vectors = []
    for values, what in motions:
        vector, single_vector = as_rows(values, 3, what)
        vectors.append(vector)
        single = single and single_vector
    rows, translations, vectors = as_many(rows, translations, vectors)
    found = core.time_of_impact(as_body(body)._core, rows, translations, *vectors, as_number(until, "until"),
                                threads_of(threads))
    return found[0] if single else found


def _casts(core: Any, body: BodyLike, poses: Poses, motions: npt.ArrayLike, until: float,
           threads: Optional[int]) -> Any:
    rows, translations, single = as_poses(poses)
    motion, single_motion = as_rows(motions, 3, "motions")
    rows, translations, [motion] = as_many(rows, translations, [motion])
    found = core.linear_cast(as_body(body)._core, rows, translations, motion, as_number(until, "until"),
                             threads_of(threads))
    return found[0] if single and single_motion else found
