"""Pictures, with matplotlib: bodies, pairs with their witness points, excluded bodies, V_ex(gamma), convergence."""

from __future__ import annotations

import base64
import io
import math
from typing import Any, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats, Poses, as_poses
from ._hull import faces_of
from .bodies import Body, BodyLike, as_body

_BLUE, _ORANGE, _GREY = "#3b6fb6", "#d9822b", "#7a7a7a"
_POWERS = (2**11, 2**12, 2**13, 2**14, 2**15, 2**16, 2**17, 2**18, 2**19, 2**20)
_LIGHT = np.array([0.35, -0.55, 0.75]) / np.linalg.norm([0.35, -0.55, 0.75])


def body(body: BodyLike, *, ax: Any = None, pose: Optional[Poses] = None, color: str = _BLUE, alpha: float = 1.0,
         n_around: int = 48) -> Any:
    """Draws a body.

    Parameters
    ----------
    ax
        A 3-D axes of matplotlib; a new figure's unless given.
    pose
        Where it is drawn, as queries take one pose; in its own frame unless given.
    n_around
        Of what is curved: how many points around.

    Returns
    -------
    the axes.
    """
    solids = _Solids()
    solids.add_body(as_body(body), *_placed(pose), color, alpha, n_around)
    return solids.drawn(_axes(ax))


def pair(a: BodyLike, b: BodyLike, pose: Poses, *, ax: Any = None, alpha: float = 0.45) -> Any:
    """Draws two bodies, B at a pose in A's frame, with the points where they are nearest, or deepest in each other.

    The line between them is the distance or the penetration depth, along the normal.
    """
    from .queries import signed_distance
    solids = _Solids()
    solids.add_body(as_body(a), np.eye(3), np.zeros(3), _BLUE, alpha, 48)
    solids.add_body(as_body(b), *_placed(pose), _ORANGE, alpha, 48)
    ax = solids.drawn(_axes(ax))
    found = signed_distance(a, b, pose)
    found = found if found.ndim == 0 else found[0]
    line = np.stack([found["point_a"], found["point_b"]])
    ax.plot(*line.T, color="black", linewidth=1.6, zorder=10)
    ax.scatter(*line.T, color="black", s=18, depthshade=False, zorder=11)
    value = float(found["value"])
    ax.set_title("touching" if value == 0.0 else f"distance {value:.6g}" if value > 0.0 else
                 f"penetration depth {-value:.6g}", fontsize=10)
    return ax


def excluded_volume(a: BodyLike, b: BodyLike, rotation: Optional[npt.ArrayLike] = None, *, ax: Any = None,
                    n_around: int = 64) -> Any:
    """Draws A, and the surface that B's origin may not enter at one orientation: A - B, the Minkowski difference.

    Parameters
    ----------
    rotation
        B's, (3, 3) or a quaternion (4,) w, x, y, z; none unless given. B is drawn once, where it touches A.
    """
    a, b = as_body(a), as_body(b)
    turn = np.eye(3) if rotation is None else _rotation(rotation)
    # B where its origin is on the surface, to the right.
    direction = np.array([1.0, 0.5, 0.35])
    at = a.support(direction) - turn @ b.support(-turn.T @ direction)
    solids = _Solids()
    solids.add_body(a, np.eye(3), np.zeros(3), _BLUE, 1.0, n_around)
    solids.add_body(b, turn, at, _ORANGE, 1.0, n_around)
    surface = _difference(a, b, turn, n_around)
    if surface:
        solids.add_polygons(surface, None, _GREY, 0.16, "none")
    ax = solids.drawn(_axes(ax))
    ax.scatter(*at, color="black", s=18, depthshade=False, zorder=11)
    return ax


def excluded_volume_of_angle(a: BodyLike, b: Optional[BodyLike] = None, *, n: int = 37, ax: Any = None,
                             label: Optional[str] = None, seed: int = 1) -> Any:
    """Draws V_ex(gamma), the angle between the two bodies' axes from 0 to 180 degrees, with its standard error."""
    from .average import excluded_volume_of_angle as values_of
    import matplotlib.pyplot as plt
    if ax is None:
        ax = plt.figure(figsize=(5.0, 3.4), layout="constrained").add_subplot()
    a = as_body(a)
    b = a if b is None else as_body(b)
    angles = np.linspace(0.0, 180.0, n)
    found = values_of(a, b, angles, seed=seed)
    ax.errorbar(angles, found["value"], found["error"], label=label)
    ax.set_xlabel("angle between the axes γ, degrees")
    ax.set_ylabel("$V_{ex}(γ)$")
    ax.set_xticks(np.arange(0, 181, 30))
    if label is not None:
        ax.legend()
    return ax


def convergence(a: BodyLike, b: Optional[BodyLike] = None, *, trials: Sequence[int] = _POWERS,
                ax: Any = None, **settings: Any) -> Any:
    """Draws the estimate of <V_ex> with its error against the number of trials, and the known value as a line.

    Parameters
    ----------
    settings
        As of `vex.excluded_volume`: `estimator`, `law`, `seed`, ...
    """
    from .average import excluded_volume as run
    import matplotlib.pyplot as plt
    if ax is None:
        ax = plt.figure(figsize=(5.0, 3.4), layout="constrained").add_subplot()
    results = [run(a, b, trials=n, **settings) for n in trials]
    n_made = [result.trials for result in results]
    ax.errorbar(n_made, [r.value for r in results], [r.std_error for r in results], fmt="o", markersize=3.5,
                color=_BLUE, label=results[-1].estimator)
    reference = results[-1].reference
    if reference is not None:
        ax.axhline(reference.value, color=_ORANGE, label=reference.kind)
    ax.set_xscale("log")
    ax.set_xlabel("trials")
    ax.set_ylabel("⟨$V_{ex}$⟩")
    ax.legend()
    return ax


# What the above is made of.

def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt
    figure = plt.figure(figsize=(4.2, 4.0), layout="constrained")
    ax = figure.add_subplot(projection="3d", computed_zorder=False)
    ax.set_axis_off()
    ax.view_init(elev=22.0, azim=-58.0)
    return ax


def _rotation(rotation: npt.ArrayLike) -> Floats:
    array = np.asarray(rotation, dtype=float)
    if array.shape == (4,):
        return _placed(np.concatenate([np.zeros(3), array]))[0]
    if array.shape != (3, 3):
        raise _vex.UsageError(f"rotation: an array of shape {array.shape} - give (3, 3), or a quaternion (4,)")
    return _placed((array, np.zeros(3)))[0]


def _placed(pose: Optional[Poses]) -> Tuple[Floats, Floats]:
    """R and t of one pose."""
    if pose is None:
        return np.eye(3), np.zeros(3)
    rows, translations, _ = as_poses(pose)
    if len(rows) != 1:
        raise _vex.UsageError("pose: a picture is of one pose - give one")
    rotation, translation = _vex.placed(rows, translations)
    return rotation[0], translation[0]


def _surface_points(body: Body, n_around: int) -> Tuple[Floats, bool]:
    """Points of a body with curved parts, no two of them one but for rounding, and whether it is a line."""
    if body._core.exact_form() is None:
        return _grid(body.support(_directions(n_around)), 1e-6), False
    points, is_line = _vex.picture_points(body._core, n_around)
    return np.unique(points, axis=0), is_line


def _directions(n_around: int) -> Floats:
    n = n_around * n_around // 2
    k = np.arange(n) + 0.5
    cos = 1.0 - 2.0 * k / n
    sin = np.sqrt(1.0 - cos * cos)
    azimuth = math.pi * (1.0 + math.sqrt(5.0)) * k
    return np.ascontiguousarray(np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), cos], axis=1))


def _difference(a: Body, b: Body, turn: Floats, n_around: int) -> List[Floats]:
    """The boundary of A - R B in polygons: of polytopes the hull of differences of vertices, otherwise of support
    points."""
    of_a, of_b = a.vertices, b.vertices
    if 0 < len(of_a) * len(of_b) <= 20000:
        points = _grid((of_a[:, None, :] - (of_b @ turn.T)[None, :, :]).reshape(-1, 3), 2.0**-44)
        return [points[face] for face in faces_of(points)]
    around = _directions(4)
    directions = np.concatenate([_directions(n_around)] + [
        normal + 1e-4 * around for normal in np.concatenate([_face_normals(a), -_face_normals(b) @ turn.T])])
    points = _grid(a.support(directions) - b.support(-(directions @ turn)) @ turn.T, 2.0**-22)
    return [points[face] for face in faces_of(points, 1e-6)]


def _grid(points: Floats, grain: float) -> Floats:
    """Points that are one but for rounding become one."""
    grain = grain * float(np.abs(points).max())
    return np.ascontiguousarray(np.unique(np.round(points / grain) * grain, axis=0))


def _face_normals(body: Body) -> Floats:
    """Along which a body may have a flat part: its faces, or its axes."""
    vertices, faces = body.vertices, body.faces
    normals: List[Floats] = [np.eye(3), -np.eye(3)]
    if 0 < len(faces) <= 200:
        corners = np.stack([vertices[face[:3]] for face in faces])
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals.append(across / np.linalg.norm(across, axis=1, keepdims=True))
    return np.concatenate(normals)


def _polygon_normals(polygons: List[Floats]) -> Floats:
    across = np.stack([np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(axis=0) for p in polygons])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return across / np.where(length > 0.0, length, 1.0)


class _Solids:
    """Polygons of several bodies, sorted together by their depth when they are drawn."""

    def __init__(self) -> None:
        self._polygons: List[Floats] = []
        self._faces: List[Floats] = []
        self._edges: List[Any] = []
        self._lines: List[Tuple[Floats, str]] = []

    def add_body(self, body: Body, rotation: Floats, translation: Floats, color: str, alpha: float,
                 n_around: int) -> None:
        if not 8 <= n_around <= 512 or n_around != int(n_around):
            raise _vex.UsageError(f"n_around: {n_around!r} - give a whole number from 8 to 512")
        points = body.vertices
        is_curved = len(points) == 0
        if is_curved:
            points, is_line = _surface_points(body, n_around)
        else:
            is_line = len(points) == 2
        placed = points @ rotation.T + translation
        if is_line:
            self._lines.append((placed, color))
            return
        faces = faces_of(points, 1e-6 if is_curved else 1e-9)
        polygons = [placed[face] for face in faces]
        normals = _polygon_normals(polygons)
        if len(polygons) == 2 and np.allclose(normals[0], -normals[1]):  # both sides of what is flat: the one that is lit
            lit = 0 if normals[0] @ _LIGHT > 0.0 else 1
            polygons, normals = polygons[lit:lit + 1], normals[lit:lit + 1]
        outline = (0.0, 0.0, 0.0, 0.7)
        self.add_polygons(polygons, normals, color, alpha,
                          outline if not is_curved and len(points) <= 400 else "face" if alpha == 1.0 else "none")

    def add_polygons(self, polygons: List[Floats], normals: Optional[Floats], color: str, alpha: float,
                     edge: Any) -> None:
        from matplotlib.colors import to_rgb
        shade = 0.62 + 0.38 * ((_polygon_normals(polygons) if normals is None else normals) @ _LIGHT)
        colors = np.clip(shade[:, None] * np.array(to_rgb(color)) + 0.18 * np.clip(shade - 0.75, 0.0, 1.0)[:, None],
                         0.0, 1.0)
        faces = np.concatenate([colors, np.full((len(colors), 1), alpha)], axis=1)
        self._polygons += polygons
        self._faces += list(faces)
        if edge == "face":
            self._edges += list(faces)
        else:
            self._edges += [(0.0, 0.0, 0.0, 0.0) if edge == "none" else edge] * len(polygons)

    def drawn(self, ax: Any) -> Any:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection
        if self._polygons:
            ax.add_collection3d(Poly3DCollection(self._polygons, facecolors=self._faces, edgecolors=self._edges,
                                                 linewidths=0.4))
        for points, color in self._lines:
            ax.plot(*points.T, color=color, linewidth=2.0)
        _fit(ax, np.concatenate(self._polygons + [points for points, _ in self._lines]))
        return ax


def _fit(ax: Any, points: Floats) -> None:
    """Equal scales on all axes, around all that was drawn."""
    seen = getattr(ax, "_vex_bounds", None)
    lower, upper = points.min(axis=0), points.max(axis=0)
    if seen is not None:
        lower, upper = np.minimum(lower, seen[0]), np.maximum(upper, seen[1])
    ax._vex_bounds = (lower, upper)
    middle, half = 0.5 * (lower + upper), 0.5 * float((upper - lower).max()) or 1.0
    for k, set_limits in enumerate((ax.set_xlim, ax.set_ylim, ax.set_zlim)):
        set_limits(middle[k] - half, middle[k] + half)
    ax.set_box_aspect((1.0, 1.0, 1.0), zoom=1.2)


def _html_of(made: Body) -> str:
    """A table of what a body is, with a picture where matplotlib is there."""
    rows = [("volume", made.volume), ("surface area", made.surface_area),
            ("integrated mean curvature", made.integrated_mean_curvature), ("circumradius", made.circumradius)]
    cells = "".join(f"<tr><td>{name}</td><td>{value:.8g}</td></tr>" for name, value in rows)
    name = repr(made).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return f"<div style='display:flex;align-items:center'>{_picture_of(made)}<table><caption>{name}</caption>{cells}</table></div>"


def _picture_of(made: Body) -> str:
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(1.9, 1.9), dpi=100)
    FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0), projection="3d", computed_zorder=False)
    ax.set_axis_off()
    ax.view_init(elev=22.0, azim=-58.0)
    body(made, ax=ax, n_around=32)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", transparent=True)
    return f"<img src='data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}' alt=''>"
