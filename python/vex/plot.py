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
from .bodies import Body, BodyLike, as_body

_BLUE, _ORANGE, _GREY = "#3b6fb6", "#d9822b", "#7a7a7a"
_POWERS = (2**11, 2**12, 2**13, 2**14, 2**15, 2**16, 2**17, 2**18, 2**19, 2**20)
_LIGHT = np.array([0.35, -0.55, 0.75]) / np.linalg.norm([0.35, -0.55, 0.75])


def body(body: BodyLike, *, ax: Any = None, pose: Optional[Poses] = None, color: str = _BLUE, alpha: float = 1.0,
         n_around: int = 48, edges: bool = True) -> Any:
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
    ax = _axes(ax)
    made = as_body(body)
    rotation, translation = _placed(pose)
    points, normals, triangles, is_line = _mesh(made, n_around)
    points = points @ rotation.T + translation
    if is_line:
        ax.plot(*points.T, color=color, linewidth=2.0, alpha=alpha)
    else:
        _add_triangles(ax, points, normals @ rotation.T, triangles, color, alpha)
        if edges:
            _add_edges(ax, made, rotation, translation, alpha)
    _fit(ax, points)
    return ax


def pair(a: BodyLike, b: BodyLike, pose: Poses, *, ax: Any = None, alpha: float = 0.45) -> Any:
    """Draws two bodies, B at a pose in A's frame, with the points where they are nearest, or deepest in each other.

    The line between them is the distance or the penetration depth, along the normal.
    """
    from .queries import signed_distance
    ax = _axes(ax)
    body(a, ax=ax, color=_BLUE, alpha=alpha)
    body(b, ax=ax, pose=pose, color=_ORANGE, alpha=alpha)
    found = signed_distance(a, b, pose)
    found = found if found.ndim == 0 else found[0]
    point_a, point_b = found["point_a"], found["point_b"]
    line = np.stack([point_a, point_b])
    ax.plot(*line.T, color="black", linewidth=1.6, zorder=10)
    ax.scatter(*line.T, color="black", s=18, depthshade=False, zorder=11)
    value = float(found["value"])
    ax.set_title(f"distance {value:.6g}" if value > 0.0 else f"penetration depth {-value:.6g}", fontsize=10)
    return ax


def excluded_volume(a: BodyLike, b: BodyLike, rotation: Optional[npt.ArrayLike] = None, *, ax: Any = None,
                    n_around: int = 64) -> Any:
    """Draws A, and the surface that B's origin may not enter at one orientation: A - B, the Minkowski difference.

    Parameters
    ----------
    rotation
        B's, (3, 3) or a quaternion (4,) w, x, y, z; none unless given. B is drawn once, where it touches A.
    """
    ax = _axes(ax)
    a, b = as_body(a), as_body(b)
    turn = np.eye(3) if rotation is None else _rotation(rotation)
    points, triangles = _difference(a, b, turn, n_around)
    _add_triangles(ax, points, None, triangles, _GREY, 0.18)
    body(a, ax=ax, color=_BLUE, alpha=0.9)
    # B where its origin is on the surface, away from the eye's side.
    direction = np.array([1.0, -0.6, 0.35])
    at = a.support(direction) - turn @ b.support(-turn.T @ direction)
    body(b, ax=ax, pose=(turn, at), color=_ORANGE, alpha=0.9)
    ax.scatter(*at, color="black", s=18, depthshade=False, zorder=11)
    _fit(ax, points)
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
    return array


def _placed(pose: Optional[Poses]) -> Tuple[Floats, Floats]:
    """R and t of one pose."""
    if pose is None:
        return np.eye(3), np.zeros(3)
    rows, translations, _ = as_poses(pose)
    if len(rows) != 1:
        raise _vex.UsageError("pose: a picture is of one pose - give one")
    if translations is not None:
        return rows[0], translations[0]
    x, y, z, qw, qx, qy, qz = rows[0]
    w, i, j, k = np.array([qw, qx, qy, qz]) / np.linalg.norm([qw, qx, qy, qz])
    return np.array([[1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j)],
                     [2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i)],
                     [2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j)]]), np.array([x, y, z])


def _mesh(body: Body, n_around: int) -> Tuple[Floats, Floats, npt.NDArray[Any], bool]:
    """Points, normals (of points), triangles, and whether it is a line."""
    if body._core.exact_form() is None:
        directions = _directions(n_around)
        points = body.support(directions)
        points = np.unique(np.round(points / (1e-6 * body.circumradius)) * (1e-6 * body.circumradius), axis=0)
        triangles = _vex.hull_triangles(points)
        return points, np.zeros_like(points), triangles, False
    points, normals, indices, _, is_line = _vex.picture_mesh(body._core, n_around)
    return points, normals, indices.reshape(-1, 2 if is_line else 3), is_line


def _directions(n_around: int) -> Floats:
    n = n_around * n_around // 2
    k = np.arange(n) + 0.5
    cos = 1.0 - 2.0 * k / n
    sin = np.sqrt(1.0 - cos * cos)
    azimuth = math.pi * (1.0 + math.sqrt(5.0)) * k
    return np.ascontiguousarray(np.stack([sin * np.cos(azimuth), sin * np.sin(azimuth), cos], axis=1))


def _difference(a: Body, b: Body, turn: Floats, n_around: int) -> Tuple[Floats, npt.NDArray[Any]]:
    """The boundary of A - R B: of polytopes the hull of differences of vertices, otherwise of support points."""
    of_a, of_b = a.vertices, b.vertices
    if 0 < len(of_a) * len(of_b) <= 20000:
        points = (of_a[:, None, :] - (of_b @ turn.T)[None, :, :]).reshape(-1, 3)
    else:
        directions = np.concatenate([_directions(n_around)] + [
            normals + 1e-4 * offset for normals in (_face_normals(a), -_face_normals(b) @ turn.T)
            for offset in _directions(4)])
        points = a.support(directions) - b.support(-(directions @ turn)) @ turn.T
    grain = 2.0**-22 * (a.circumradius + b.circumradius)
    points = np.unique(np.round(points / grain) * grain, axis=0)
    return points, _vex.hull_triangles(np.ascontiguousarray(points))


def _face_normals(body: Body) -> Floats:
    """Along which a body may have a flat part: its faces, or its axes."""
    vertices, faces = body.vertices, body.faces
    normals: List[Floats] = [np.eye(3), -np.eye(3)]
    if 0 < len(faces) <= 200:
        corners = np.stack([vertices[face[:3]] for face in faces])
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals.append(across / np.linalg.norm(across, axis=1, keepdims=True))
    return np.concatenate(normals)


def _add_triangles(ax: Any, points: Floats, normals: Optional[Floats], triangles: npt.NDArray[Any], color: str,
                   alpha: float) -> None:
    from matplotlib.colors import to_rgb
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    corners = points[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    unit = across / np.where(length > 0.0, length, 1.0)
    if normals is not None and len(normals):
        smooth = normals[triangles].sum(axis=1)
        length = np.linalg.norm(smooth, axis=1, keepdims=True)
        unit = np.where(length > 0.0, smooth / np.where(length > 0.0, length, 1.0), unit)
    shade = 0.62 + 0.38 * (unit @ _LIGHT)
    base = np.array(to_rgb(color))
    colors = np.clip(shade[:, None] * base + 0.18 * np.clip(shade - 0.75, 0.0, 1.0)[:, None], 0.0, 1.0)
    rgba = np.concatenate([colors, np.full((len(colors), 1), alpha)], axis=1)
    ax.add_collection3d(Poly3DCollection(corners, facecolors=rgba, edgecolors="none", antialiased=alpha == 1.0))


def _add_edges(ax: Any, body: Body, rotation: Floats, translation: Floats, alpha: float) -> None:
    from mpl_toolkits.mplot3d.art3d import Line3DCollection
    vertices = body.vertices
    if not 2 < len(vertices) <= 200:
        return
    placed = vertices @ rotation.T + translation
    edges = {tuple(sorted((int(i), int(j)))) for face in body.faces for i, j in zip(face, np.roll(face, -1))}
    ax.add_collection3d(Line3DCollection(placed[np.array(sorted(edges))], colors="black", linewidths=0.6,
                                         alpha=min(1.0, alpha + 0.2)))


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
    ax.set_box_aspect((1.0, 1.0, 1.0), zoom=1.35)


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
