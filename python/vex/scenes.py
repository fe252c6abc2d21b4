"""Many bodies, in open space or in a periodic box: pairs, distances, clusters, rays, trial moves."""

from __future__ import annotations

import math
import operator
import warnings
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats, Poses, as_floats, as_number, as_poses, as_rows, threads_of
from .bodies import Body, BodyLike, as_body


class UndecidedWarning(UserWarning):
    """Of some pairs it is not proven whether they overlap; they are in `Scene.undecided`."""


class Clusters(NamedTuple):
    """Bodies that are connected."""

    labels: npt.NDArray[np.int64]  #: of each body the number of its cluster, from 0 on; -1 where no body has the number
    wraps: npt.NDArray[np.bool_]  #: (clusters, 3): whether a cluster wraps around the box along its edges a, b, c

    @property
    def sizes(self) -> npt.NDArray[np.intp]:
        """How many bodies each cluster has."""
        return np.bincount(self.labels[self.labels >= 0], minlength=len(self.wraps))


class Neighbour(NamedTuple):
    """The body nearest to another one."""

    body: int  #: -1 where there is none
    image: Tuple[int, int, int]
    distance: float  #: 0 where they overlap
    lower: float
    upper: float


class Hit(NamedTuple):
    """The first body that a ray or a moving body meets."""

    verdict: int  #: 1 it meets one, 0 it does not, -1 undecided
    body: int  #: -1 where there is none
    image: Tuple[int, int, int]
    time: float
    lower: float
    upper: float
    normal: Floats  #: in the scene's frame, as `point`
    point: Floats
    rivals: npt.NDArray[Any]  #: pairs of which it is not proven that they are not met before


class Scene:
    """Many bodies in one frame.

    Parameters
    ----------
    bodies
        One body for all poses; a body for each pose; or, with `shapes`, the list that `shapes` picks from.
    poses
        (N, 7), rows of x, y, z, qw, qx, qy, qz, or rotations (N, 3, 3) and translations (N, 3): of each body in the
        scene's frame.
    shapes
        Of each pose the number of its body in the list `bodies`.
    box
        Periodic: edges (Lx, Ly, Lz), or with tilts (Lx, Ly, Lz, xy, xz, yz) as in HOOMD. Open space without.
    skin
        For scenes that move in small steps: a length, above 0, within which pairs are remembered.
    broad_phase
        "automatic", "grid", or "tree".
    threads
        All cores unless given. Answers are the same for any number.

    Notes
    -----
    Verdicts are proven. Pairs of which nothing is proven, curved bodies that touch to within rounding, are in no
    result: they are in `undecided` after each query, and an `UndecidedWarning` tells of them.

    Python's threads may share a scene: its queries wait for each other. Ctrl-C ends a query, and the scene is as it was.
    Bodies that were added stay known to it after they are removed.

    Of bodies that reach over a periodic box several images may overlap: then a pair stands in the list once for each.

    Scenes can be copied and pickled: bodies keep their numbers, places, images and answers, bit for bit. What `skin`
    remembers is found again.
    """

    def __init__(self, bodies: Union[None, BodyLike, Sequence[BodyLike]] = None, poses: Optional[Poses] = None, *,
                 shapes: Optional[npt.ArrayLike] = None, box: Optional[Sequence[float]] = None, skin: float = 0.0,
                 broad_phase: str = "automatic", threads: Optional[int] = None) -> None:
        edges = None if box is None else as_floats(box, "box")
        if edges is not None and edges.shape not in ((3,), (6,)):
            raise _vex.UsageError(f"box: an array of shape {edges.shape} - give its edges (Lx, Ly, Lz), or these and its "
                                  "tilts (xy, xz, yz)")
        self._settings = (None if edges is None else edges.tolist(), str(broad_phase),
                          as_number(skin, "skin"), threads_of(threads))
        self._core = _vex.Scene(*self._settings)
        self._shapes: Dict[Body, int] = {}
        self.undecided: npt.NDArray[Any] = np.empty((0, 2), dtype=np.int64)  #: pairs (M, 2) of the last query
        self.counts: Dict[str, Tuple[int, int]] = {}  #: of the last query: how many pairs each stage saw and settled
        if bodies is not None:
            if poses is None:
                raise _vex.UsageError("bodies without poses - give poses (N, 7)")
            self.add(bodies, poses, shapes=shapes)

    def add(self, bodies: Union[BodyLike, Sequence[BodyLike]], poses: Poses, *,
            shapes: Optional[npt.ArrayLike] = None) -> npt.NDArray[np.int64]:
        """Adds bodies, all or none of them; returns their numbers. Parameters as of `Scene`."""
        rows, translations, _ = as_poses(poses)
        n = len(rows)
        if isinstance(bodies, (list, tuple)):
            ids = np.array([self._shape(body) for body in bodies], dtype=np.uint32)
            if shapes is not None:
                pick = np.asarray(shapes)
                if pick.shape != (n,) or pick.dtype.kind not in "iu" or (n and not 0 <= pick.min() <= pick.max() < len(ids)):
                    raise _vex.UsageError(f"shapes: give {n} whole numbers from 0 to {len(ids) - 1}")
                ids = ids[pick]
            elif len(ids) != n:
                raise _vex.UsageError(f"{len(ids)} bodies for {n} poses - give as many, or shapes that pick from them")
        else:
            if shapes is not None:
                raise _vex.UsageError("shapes pick from a list of bodies - give a list")
            ids = np.full(n, self._shape(bodies), dtype=np.uint32)
        return np.array(self._core.add(np.ascontiguousarray(ids), rows, translations, None), dtype=np.int64)

    def _shape(self, body: BodyLike) -> int:
        made = as_body(body)
        if made not in self._shapes:
            self._shapes[made] = self._core.add_shape(made._core)
        return self._shapes[made]

    def remove(self, body: int) -> None:
        """Takes a body out; its number is free for the next one that is added."""
        self._core.remove(_number(body))

    def move(self, body: int, pose: Poses) -> None:
        """Puts a body elsewhere."""
        rows, translations, _ = as_poses(pose)
        self._core.move(_number(body), rows, translations)

    def move_all(self, poses: Poses) -> None:
        """New poses of all bodies, in the order of their numbers; not of a scene with numbers that no body has."""
        rows, translations, _ = as_poses(poses)
        self._core.move_all(rows, translations)

    def __len__(self) -> int:
        return self._core.size()

    def pose(self, body: int) -> Tuple[Floats, Floats, Tuple[int, int, int]]:
        """A body's rotation (3, 3), its translation (3,), moved into the box, and by how many lattice vectors it was."""
        (rotation, translation), image = self._core.pose(_number(body))
        return rotation, translation, (image[0], image[1], image[2])

    def _told(self, undecided: Any, counts: Dict[str, Tuple[int, int]]) -> None:
        self.undecided = _numbers(undecided)
        self.counts = counts
        if len(undecided):
            warnings.warn(f"{len(undecided)} pairs are undecided: see Scene.undecided", UndecidedWarning, stacklevel=3)

    def pairs(self, *, images: bool = False) -> Any:
        """The pairs of bodies that share a point.

        Returns
        -------
        int array (M, 2) of numbers a < b, sorted; with `images` a pair of that and an array (M, 3): by how many lattice
        vectors the copy of b that overlaps a is away from b.
        """
        found, undecided, counts = self._core.pairs(0.0)
        self._told(undecided, counts)
        return (_numbers(found), found["image"].astype(np.int64)) if images else _numbers(found)

    def pairs_within(self, distance: float, *, images: bool = False) -> Any:
        """The pairs whose distance is at most this: proven, but no distance is computed. Result as of `pairs`."""
        found, undecided, counts = self._core.pairs(as_number(distance, "distance"))
        self._told(undecided, counts)
        return (_numbers(found), found["image"].astype(np.int64)) if images else _numbers(found)

    def distances_within(self, distance: float) -> npt.NDArray[Any]:
        """The same with the distances.

        Returns
        -------
        array (M,) of fields ``a``, ``b``, ``image`` (3,), ``distance`` with bounds ``lower`` and ``upper``, and in the
        frame of body a ``normal``, ``point_a``, ``point_b`` (3,), NaN where the bodies overlap.
        """
        found, undecided, counts = self._core.distances(as_number(distance, "distance"))
        self._told(undecided, counts)
        return found

    def contact_manifolds(self, margin: float = 0.0, *, feature_angle: float = 0.01,
                          four_at_most: bool = False) -> npt.NDArray[Any]:
        """The contacts of all pairs that are within `margin` of each other: parameters as of `vex.contact_manifold`.

        Returns
        -------
        array (K,), a row each contact and those of a pair together, pairs sorted: fields ``a``, ``b``, ``image`` (3,),
        and in the frame of body a ``normal``, the pair's, ``point_a``, ``point_b`` (3,); ``distance``, negative where
        the bodies are in each other; ``feature_a`` and ``feature_b``, the same from step to step.
        """
        found, undecided, counts = self._core.contact_manifolds(
            as_number(margin, "margin"), as_number(feature_angle, "feature_angle"), bool(four_at_most))
        self._told(undecided, counts)
        return found

    def any_overlap(self) -> int:
        """1 where any two bodies overlap, 0 where none do, -1 where neither is proven. Ends at the first."""
        verdict, undecided, counts = self._core.any_overlap()
        self.undecided = _numbers(undecided)
        self.counts = counts
        return int(verdict)

    def overlaps_of(self, body: Union[int, BodyLike], pose: Optional[Poses] = None) -> npt.NDArray[np.int64]:
        """The pairs of one body, as of `pairs`; or of a visitor at a pose: the numbers (M,) of the bodies it overlaps."""
        if pose is None:
            found, undecided, counts = self._core.overlaps_of(_number(body))
            self._told(undecided, counts)
            return _numbers(found)
        rows, translations, _ = as_poses(pose)
        found, undecided, counts = self._core.overlaps_of_visitor(as_body(body)._core, rows, translations)
        self._told(undecided, counts)
        return found["b"].astype(np.int64)

    def would_overlap(self, body: int, pose: Poses) -> int:
        """Whether a body would overlap any other at a pose: a trial move, 1, 0 or -1. Nothing is moved."""
        rows, translations, _ = as_poses(pose)
        self.undecided, self.counts = np.empty((0, 2), dtype=np.int64), {}
        return self._core.would_overlap(_number(body), rows, translations)

    def nearest(self, body: int) -> Neighbour:
        """The body nearest to one; copies of itself are neighbours, too."""
        number, image, *values = self._core.nearest(_number(body))
        return Neighbour(number, (image[0], image[1], image[2]), *values)

    def ray_cast(self, origin: npt.ArrayLike, direction: npt.ArrayLike, *, until: float = math.inf) -> Hit:
        """The first body on a ray. In a periodic box `until` must be finite."""
        return _hit(self._core.ray_cast(as_rows(origin, 3, "origin")[0], as_rows(direction, 3, "direction")[0],
                                        as_number(until, "until")))

    def linear_cast(self, visitor: BodyLike, pose: Poses, motion: npt.ArrayLike, *, until: float = math.inf) -> Hit:
        """The first body that a visitor meets that moves without turning."""
        rows, translations, _ = as_poses(pose)
        return _hit(self._core.linear_cast(as_body(visitor)._core, rows, translations,
                                           as_rows(motion, 3, "motion")[0], as_number(until, "until")))

    def clusters(self, distance: float = 0.0) -> Clusters:
        """Clusters of bodies that overlap, or whose distance is at most this, and which of them wrap around the box."""
        labels, wraps, undecided, counts = self._core.clusters(as_number(distance, "distance"))
        self._told(undecided, counts)
        return Clusters(labels, wraps)

    def __getstate__(self) -> Dict[str, Any]:
        # Another thread may add a body, and its shape, meanwhile: what is there first is not lost then.
        bodies = self._core.bodies()
        state = {**self.__dict__, "_bodies": bodies, "_shapes": dict(self._shapes)}
        del state["_core"]
        return state

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state)
        shapes, rotations, translations, images = self.__dict__.pop("_bodies")
        self._core = _vex.Scene(*self._settings)
        # Bodies that are the same to C++ alone may be of one shape before, and of two now.
        ids = np.zeros(1 + max(self._shapes.values(), default=0), dtype=np.uint32)
        for body, shape in self._shapes.items():
            ids[shape] = self._core.add_shape(body._core)
        self._shapes = {body: int(ids[shape]) for body, shape in self._shapes.items()}
        is_free = shapes < 0
        self._core.add(ids[np.where(is_free, 0, shapes)], rotations, translations, images)
        for number in np.flatnonzero(is_free):
            self._core.remove(int(number))

    def __repr__(self) -> str:
        return f"<vex.Scene of {len(self)} bodies>"


def _number(body: Any) -> int:
    if isinstance(body, (bool, str)) or not hasattr(body, "__index__"):
        raise TypeError(f"not the number of a body ({body!r}) - `add` tells the numbers; a visitor needs a pose")
    number = operator.index(body)
    if not 0 <= number < 2**32:
        raise _vex.UsageError(f"no body has this number ({number}) - `add` tells the numbers")
    return number


def _numbers(pairs: Any) -> npt.NDArray[np.int64]:
    return np.stack([pairs["a"], pairs["b"]], axis=1)


def _hit(values: Tuple[Any, ...]) -> Hit:
    verdict, body, image, time, lower, upper, normal, point, rivals = values
    met = verdict == 1
    nan = np.full(3, np.nan)
    return Hit(verdict, body, (image[0], image[1], image[2]), time, lower, upper, np.array(normal) if met else nan,
               np.array(point) if met else nan, _numbers(rivals))
