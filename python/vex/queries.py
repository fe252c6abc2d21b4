"""Queries of two bodies over arrays of poses: of B in A's frame.

Poses are an array (N, 7), rows of x, y, z, qw, qx, qy, qz; or a pair of rotations (N, 3, 3) and translations (N, 3); or
matrices (N, 4, 4) of both. One pose alone, (7,), (3, 3) and (3,), or (4, 4), gives one answer without an axis for it.

Every answer is proven or says that it is not: a verdict is 1 for bodies that share a point, 0 for bodies that do not,
and -1 where neither is proven, as of curved bodies that touch to within rounding. Numbers come with bounds, ``lower``
and ``upper``, of the true value. Points and normals are in A's frame; normals are unit vectors from A towards B.

With ``certify=True`` each answer is proven again, in exact arithmetic, from a certificate and by a checker that shares
nothing with the search. The result is then a pair: the answers, and a `Proof`. That is slow.
"""

from __future__ import annotations

import math
from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

from . import _vex
from ._vex import WarmStart
from ._arrays import Poses, as_many, as_number, as_poses, as_rows, threads_of, together
from .bodies import BodyLike, as_body


class Proof(NamedTuple):
    """What the checker said of each answer."""

    is_proven: npt.NDArray[np.bool_]
    faults: List[str]  #: what is missing, or ""


class Manifold(NamedTuple):
    """Where two bodies touch."""

    separation: npt.NDArray[Any]  #: one row of `signed_distance`; its normal is the manifold's
    #: fields point_a, point_b (3,), distance, negative where the bodies are in each other, feature_a and feature_b:
    #: numbers of what of A and of B makes the contact, the same from step to step
    contacts: npt.NDArray[Any]


def _answer(values: Any, proof: Any, single: bool) -> Any:
    answers = values[0] if single else values
    return answers if proof is None else (answers, Proof(*proof))


def overlap(a: BodyLike, b: BodyLike, poses: Poses, *, certify: bool = False,
            threads: Optional[int] = None) -> Any:
    """Whether the bodies share a point.

    Parameters
    ----------
    a, b
        Bodies, texts that name them, or objects with vertices.
    poses
        Of B in A's frame: (N, 7), rows of x, y, z, qw, qx, qy, qz; or rotations (N, 3, 3) and translations (N, 3), or
        matrices (N, 4, 4) of both. One pose without an axis for it gives one answer.
    certify
        Prove each answer again: the result is then the answers and a `Proof`.
    threads
        One a core where it is not given. Answers are the same for any number.

    Returns
    -------
    int8 array (N,): 1 overlap, 0 disjoint, -1 undecided. Of two polytopes the answer is always exact.
    """
    body_a, body_b = as_body(a)._core, as_body(b)._core
    rows, translations, single = as_poses(poses)
    if certify:
        verdicts, proof = _vex.certified_overlap(body_a, body_b, rows, translations, threads_of(threads))
        return _answer(verdicts, proof, single)
    return _answer(_vex.overlap(body_a, body_b, rows, translations, threads_of(threads)), None, single)


def within(a: BodyLike, b: BodyLike, poses: Poses, margin: float, *, threads: Optional[int] = None) -> Any:
    """Whether the bodies' gap is at most `margin`, a length from 0 on: as `overlap`, no distance is computed."""
    rows, translations, single = as_poses(poses)
    found = _vex.within(as_body(a)._core, as_body(b)._core, rows, translations, as_number(margin, "margin"),
                        threads_of(threads))
    return _answer(found, None, single)


def signed_distance(a: BodyLike, b: BodyLike, poses: Poses, *, relative_gap: float = 0.0,
                    max_distance: float = math.inf, certify: bool = False, warm_start: Optional[WarmStart] = None,
                    threads: Optional[int] = None) -> Any:
    """The distance where the bodies are apart, minus the penetration depth where they overlap.

    Parameters
    ----------
    a, b, poses, certify, threads
        As of `overlap`.
    relative_gap
        The search ends once upper - lower is below this times |value| + R_A + R_B. 0: as near as double precision gets
        for polytopes, 2^-32 for curved bodies.
    max_distance
        The search ends once the distance is known to be larger; ``lower`` is then above it.
    warm_start
        A `vex.WarmStart` that is kept for a pair which moves in steps: each query begins where the last one has ended.
        Rows are then steps of one motion, answered in their order by one thread. It changes the time, and last digits
        within the bounds: verdicts and bounds are proven as ever, whatever it holds.

    Returns
    -------
    array (N,) of fields ``value``, ``lower``, ``upper`` (length), ``normal``, ``point_a``, ``point_b`` (3,), with
    point_b - point_a = value * normal, ``verdict`` (int8) and ``is_rough``: whether the bounds are wider than asked for.
    """
    return _separation(_vex.signed_distance, a, b, poses, relative_gap, max_distance, certify, warm_start, threads)


def distance(a: BodyLike, b: BodyLike, poses: Poses, *, relative_gap: float = 0.0, max_distance: float = math.inf,
             certify: bool = False, warm_start: Optional[WarmStart] = None, threads: Optional[int] = None) -> Any:
    """As `signed_distance`, of bodies that are apart; 0 where they overlap, and no depth is looked for.

    Where they overlap normal and points are NaN.
    """
    return _separation(_vex.distance, a, b, poses, relative_gap, max_distance, certify, warm_start, threads)


def depth(a: BodyLike, b: BodyLike, poses: Poses, *, relative_gap: float = 0.0, certify: bool = False,
          warm_start: Optional[WarmStart] = None, threads: Optional[int] = None) -> Any:
    """The penetration depth: the length of the shortest translation of B that leaves the bodies touching.

    Fields as of `signed_distance`, but for the sign: point_b - point_a = -value * normal, and moving B by value * normal
    makes contact. 0 where the bodies are apart: normal and points are then NaN.
    """
    return _separation(_vex.depth, a, b, poses, relative_gap, math.inf, certify, warm_start, threads)


def _separation(ask: Any, a: BodyLike, b: BodyLike, poses: Poses, relative_gap: float, max_distance: float,
                certify: bool, warm_start: Optional[WarmStart], threads: Optional[int]) -> Any:
    rows, translations, single = as_poses(poses)
    if warm_start is not None and threads is not None and threads_of(threads) > 1:
        raise _vex.UsageError("threads: with warm_start one thread answers, step by step - leave it out")
    found, proof = ask(as_body(a)._core, as_body(b)._core, rows, translations, as_number(relative_gap, "relative_gap"),
                       as_number(max_distance, "max_distance"), bool(certify), warm_start, threads_of(threads))
    return _answer(found, proof, single)


def ray_cast(a: BodyLike, origins: npt.ArrayLike, directions: npt.ArrayLike, *, until: float = math.inf,
             certify: bool = False, threads: Optional[int] = None) -> Any:
    """The rays origin + t direction, t >= 0, against a body.

    Parameters
    ----------
    origins, directions
        (N, 3) or (3,), one of either or as many of both; a direction has any length but 0.
    until
        The last t that is looked at.

    Returns
    -------
    array (N,) of fields ``verdict`` (1 the ray meets the body, 0 it does not, -1 undecided), ``time`` of the first
    contact with its bounds ``lower`` and ``upper`` (infinite where there is none), ``normal`` out of the body,
    ``point_a`` of the body, ``point_b`` of the ray (3,).
    """
    (from_, along), single = together((origins, "origins"), (directions, "directions"))
    found, proof = _vex.ray_cast(as_body(a)._core, from_, along, as_number(until, "until"), bool(certify),
                                 threads_of(threads))
    return _answer(found, proof, single)


def linear_cast(a: BodyLike, b: BodyLike, poses: Poses, motions: npt.ArrayLike, *, until: float = math.inf,
                certify: bool = False, threads: Optional[int] = None) -> Any:
    """B moving without turning, at time t where its pose has it plus t times its motion. Fields as of `ray_cast`."""
    rows, translations, single_pose = as_poses(poses)
    motion, single = as_rows(motions, 3, "motions")
    rows, translations, [motion] = as_many(rows, translations, [motion])
    found, proof = _vex.linear_cast(as_body(a)._core, as_body(b)._core, rows, translations, motion,
                                    as_number(until, "until"), bool(certify), threads_of(threads))
    return _answer(found, proof, single_pose and single)


def time_of_impact(a: BodyLike, b: BodyLike, poses: Poses, velocities: npt.ArrayLike,
                   angular_velocities: npt.ArrayLike = (0.0, 0.0, 0.0), *,
                   velocities_a: Optional[npt.ArrayLike] = None, angular_velocities_a: Optional[npt.ArrayLike] = None,
                   until: float = math.inf, certify: bool = False, threads: Optional[int] = None) -> Any:
    """B moving straight and turning about its own origin, in A's frame; angular velocities in radians per unit of time.

    With `velocities_a` and `angular_velocities_a` A moves as well, in its own frame as it is at first. Fields as of
    `ray_cast`.
    """
    rows, translations, single = as_poses(poses)
    vectors: List[Any] = []
    given = ((velocities, "velocities"), (angular_velocities, "angular velocities"), (velocities_a, "velocities of A"),
             (angular_velocities_a, "angular velocities of A"))
    for values, what in given:
        if values is None:
            vectors.append(None)
            continue
        vector, single_vector = as_rows(values, 3, what)
        vectors.append(vector)
        single = single and single_vector
    rows, translations, (v, w, v_a, w_a) = as_many(rows, translations, vectors)
    found, proof = _vex.time_of_impact(as_body(a)._core, as_body(b)._core, rows, translations, v, w, v_a, w_a,
                                       as_number(until, "until"), bool(certify), threads_of(threads))
    return _answer(found, proof, single)


def contact_manifold(a: BodyLike, b: BodyLike, poses: Poses, *, margin: float = 0.0, feature_angle: float = 0.01,
                     four_at_most: bool = False, certify: bool = False, threads: Optional[int] = None) -> Any:
    """Where bodies in contact touch: the corners of the polygon in which their faces across the contact meet.

    Parameters
    ----------
    margin
        Contacts are given up to this gap.
    feature_angle
        Radians: what of a body is within it of the plane across the normal is the face.
    four_at_most
        Of more than four contacts those that span the largest area, and the deepest.

    Returns
    -------
    list of `Manifold`, one a pose. Of a cap, as a cylinder's, the face is a polygon of sixteen corners; of a line on
    which a body lies, its two ends; of what bends away there is one contact.
    """
    rows, translations, single = as_poses(poses)
    found, proof = _vex.contact_manifold(as_body(a)._core, as_body(b)._core, rows, translations,
                                         as_number(margin, "margin"), as_number(feature_angle, "feature_angle"),
                                         bool(four_at_most), bool(certify), threads_of(threads))
    return _answer([Manifold(separation[0], contacts) for separation, contacts in found], proof, single)


def overlap_certificate(a: BodyLike, b: BodyLike, pose: Poses) -> Dict[str, Any]:
    """What proves the verdict of one pose, for a checker of one's own; and what our checker says of it.

    A direction ``separating_dir`` + ``separating_dir_low`` with every point of A behind every point of B; or
    ``witnesses``, points of A - B whose hull holds the origin.
    """
    rows, translations, _ = as_poses(pose)
    return _vex.overlap_certificate(as_body(a)._core, as_body(b)._core, rows, translations)
