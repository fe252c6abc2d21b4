"""Convex bodies: named ones, mesh files, hulls of points, and your own."""

from __future__ import annotations

import math
import os
import warnings
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats, as_floats, as_number, as_rows

#: What functions take as a body: a Body, a text such as "box:1,2,3", or any object with `vertices` (and `faces`).
BodyLike = Union["Body", str, "os.PathLike[str]", Any]


class UnconfinedWarning(UserWarning):
    """The process that read a mesh file could not be confined, though its limits held (docs/security.md)."""


class Body:
    """A convex body.

    Parameters
    ----------
    source
        A text that names a body, ``"capsule:1,0.25"`` or ``"rounded:0.1,box:1,1,1"`` (`named_shapes` lists them), or a
        mesh file, ``"hull:FILE"`` or ``"points:FILE"`` for the convex hull of its points; or any object with ``vertices`` (N, 3) and, where it has them, ``faces``: trimesh's and coxeter's
        shapes. An object without faces is the hull of its vertices.
    hull
        Of a mesh: its convex hull, whatever its surface is. Otherwise it must be closed and convex.
    scale, unit_volume
        Every length is multiplied by `scale`; with `unit_volume` after the body was scaled to volume 1. About the
        origin.
    convex_tolerance, weld, unit, format
        Of a mesh, as for `vex_mesh`: how far it may be from convex and which points become one, both fractions of its
        size; the unit to convert to; what to read the file as.
    require_confinement
        Of a file that assimp reads, in a process of its own: it is refused where the system does not let that process
        be confined. Otherwise an `UnconfinedWarning` tells of it, once (docs/security.md).

    Raises
    ------
    InputError
        What is given is no convex body. The message says where, and by how much.
    UsageError
        The text is malformed.

    Notes
    -----
    A body never changes. Bodies are equal where their exact forms are the same numbers: vertices, centres, semi-axes,
    radii. They can be pickled; a body of one's own where its function can.
    """

    __slots__ = ("_core", "_recipe", "_key", "__weakref__")

    _core: "_vex.Body"
    _recipe: Tuple[Any, ...]

    def __init__(self, source: BodyLike, *, hull: bool = False, scale: float = 1.0, unit_volume: bool = False,
                 convex_tolerance: Optional[float] = None, weld: Optional[float] = None, unit: str = "",
                 format: str = "", require_confinement: bool = False) -> None:
        mesh = {"hull": bool(hull), "convex_tolerance": convex_tolerance, "weld": weld, "unit": unit,
                "scale": as_number(scale, "scale"), "unit_volume": bool(unit_volume)}
        if isinstance(source, Body):
            if scale != 1.0 or unit_volume:
                made = source.scaled(scale, unit_volume=unit_volume)
                self._set(made._core, made._recipe)
            else:
                self._set(source._core, source._recipe)
        elif isinstance(source, (str, os.PathLike)):
            self._set(*_of_text(os.fspath(source), mesh, format, bool(require_confinement)))
        else:
            made = Body._from_recipe(("mesh", _surface_of(source, mesh), mesh))
            radius = _rounding_radius_of(source)
            if radius > 0.0:  # of the shape as it is scaled
                made = made.rounded(radius * (made.volume / Body._from_recipe(
                    ("mesh", made._recipe[1], dict(mesh, scale=1.0, unit_volume=False))).volume) ** (1.0 / 3.0))
            self._set(made._core, made._recipe)

    def _set(self, core: "_vex.Body", recipe: Tuple[Any, ...]) -> None:
        self._core = core
        self._recipe = recipe

    @classmethod
    def _from_recipe(cls, recipe: Tuple[Any, ...]) -> "Body":
        body = cls.__new__(cls)
        body._set(*_of_recipe(recipe))
        return body

    # What it is.

    @property
    def kind(self) -> str:
        """The name of its shape: "box", "capsule", ...; "polyhedron" of a mesh or hull, "body" of one's own."""
        return self._core.kind

    @property
    def volume(self) -> float:
        """V, length^3; NaN of a body of one's own, as the other measures are."""
        return self._core.volume

    @property
    def surface_area(self) -> float:
        """S, length^2. A flat body counts both of its sides."""
        return self._core.surface_area

    @property
    def integrated_mean_curvature(self) -> float:
        """M, the mean curvature integrated over the surface, length: 4 pi R of a sphere."""
        return self._core.integrated_mean_curvature

    @property
    def mean_radius(self) -> float:
        """M / 4 pi, length: R of a sphere. coxeter calls it `mean_curvature`."""
        return self._core.integrated_mean_curvature / (4.0 * math.pi)

    @property
    def centre(self) -> Floats:
        """The point (3,) of the body that `circumradius` and `inradius` are about."""
        return np.array(self._core.centre)

    @property
    def circumradius(self) -> float:
        """The body is in a ball of this radius about its centre, which need not be the least such ball."""
        return self._core.circumradius

    @property
    def inradius(self) -> float:
        """The body holds a ball of this radius about its centre, which need not be the largest."""
        return self._core.inradius

    @property
    def is_polytope(self) -> bool:
        """Whether it is the convex hull of its `vertices`."""
        return len(self._core.vertices) > 0

    @property
    def vertices(self) -> Floats:
        """Vertices (N, 3) of a polytope, exactly: the stored doubles. Of a body with curved parts (0, 3)."""
        return self._core.vertices

    @property
    def faces(self) -> List[npt.NDArray[np.intp]]:
        """Faces of a polytope: indices into `vertices`, counter-clockwise seen from outside. None of a curved body.

        Corners that are within 1e-9 of the size of one plane are one face.
        """
        from ._hull import faces_of
        return faces_of(self.vertices)

    @property
    def centroid(self) -> Floats:
        """The centre of mass (3,) at uniform density."""
        return self._moments()[1]

    @property
    def moment_of_inertia(self) -> Floats:
        """The tensor (3, 3) about the centroid, of unit density, length^5: the mass is `volume`."""
        second = self._moments()[2]
        x, y, z = np.diag(second)  # of sums, not of what is left of a trace: nothing cancels
        return np.diag([y + z, x + z, x + y]) - (second - np.diag([x, y, z]))

    def _moments(self) -> Tuple[float, Floats, Floats]:
        moments = _vex.moments(self._core)
        if moments is None:
            raise _vex.UsageError(f"moments of {self!r} are not known - they are of solid polytopes and of the named "
                                  "bodies that are neither flat nor rounded by `rounded:`")
        volume, centroid, second = moments
        return volume, centroid[0], second

    @property
    def reach(self) -> float:
        """No point of the body is farther from the origin of its frame, length."""
        return self._core.reach

    @property
    def ball_radius(self) -> float:
        """The body is another one, its core, with a ball of this radius about each of its points; 0 of most."""
        return self._core.ball_radius

    @property
    def support_error(self) -> float:
        """How far rounding can put a point of `support` off, length."""
        return self._core.support_error

    @property
    def report(self) -> Optional[Dict[str, Any]]:
        """Of a mesh or hull: what was found and done on the way from the file to the body."""
        return self._core.report

    @property
    def notes(self) -> List[str]:
        """What reading the mesh has to tell."""
        report = self._core.report
        return [] if report is None else report["notes"]

    def support(self, directions: npt.ArrayLike) -> Floats:
        """The farthest points along directions.

        Parameters
        ----------
        directions
            (N, 3) or (3,), of any length but 0.

        Returns
        -------
        array of the same shape: points of the body, off by at most `support_error`.
        """
        rows, single = as_rows(directions, 3, "directions")
        points = self._core.support(rows)
        return points[0] if single else points

    def validate(self, *, n_directions: int = 1000, seed: int = 1) -> List[str]:
        """What the body claims of itself and does not keep, in sentences; asked along random and hard directions.

        An empty list proves nothing; whatever is in it is wrong.
        """
        return self._core.violations(n_directions, seed)

    # Others made of it.

    def scaled(self, factor: Union[float, Sequence[float], Floats], *, unit_volume: bool = False) -> "Body":
        """Every length times `factor`, after scaling to volume 1 where `unit_volume`; about the origin.

        Parameters
        ----------
        factor
            A number above 0; or three of them, along the body's own axes, of which negative ones mirror. What the body
            is exactly stays exact: vertices, semi-axes and radii times the factors, each product rounded once, are the
            body. Where not all of them have one magnitude, surface area and integrated mean curvature are known of
            boxes and ellipsoids alone, and NaN otherwise.

        Raises
        ------
        UsageError
            The one factor is not a finite number above 0.
        InputError
            One of three factors is 0, not finite or out of range, or a size becomes so.
        """
        if np.ndim(factor) > 0:
            factors = _three(factor, "factors")
            return (self.scaled(1.0, unit_volume=True) if unit_volume else self)._stretched(factors)
        return self._evenly_scaled(as_number(factor, "factor"), unit_volume)

    def _stretched(self, factors: Tuple[float, float, float]) -> "Body":
        body = self
        if {abs(factor) for factor in factors} == {1.0} and self._recipe[0] == "scaled":
            # A mirror image of a mirror image is exact.
            x, y, z = (factor * before for factor, before in zip(factors, self._recipe[1]))
            factors, body = (x, y, z), self._recipe[2]
        return body if factors == (1.0, 1.0, 1.0) else Body._from_recipe(("scaled", factors, body))

    def _evenly_scaled(self, factor: float, unit_volume: bool) -> "Body":
        if not factor > 0.0 or not math.isfinite(factor):
            raise _vex.UsageError(f"a scale is a finite number above 0 ({factor!r}) - `mirrored`, and three factors, mirror")
        kind = self._recipe[0]
        if kind == "named":
            _, text, scale, unit = self._recipe
            if unit_volume:
                return Body._from_recipe(("named", text, factor, True))
            return Body._from_recipe(("named", text, scale * factor, unit))
        if kind == "mesh":
            options = dict(self._recipe[2])
            options.update(scale=factor if unit_volume else options["scale"] * factor,
                           unit_volume=unit_volume or options["unit_volume"])
            return Body._from_recipe(("mesh", self._recipe[1], options))
        if unit_volume:
            if not self.volume > 0.0:
                raise _vex.InputError("a body without a known volume cannot be scaled to volume 1")
            factor = factor / self.volume ** (1.0 / 3.0)
        if kind == "hull":
            return Body._from_recipe(("hull", self._recipe[1] * factor))
        if kind == "rounded":
            return Body._from_recipe(("rounded", self._recipe[1] * factor, self._recipe[2].scaled(factor)))
        return Body._from_recipe(("scaled", (factor, factor, factor), self))

    def mirrored(self) -> "Body":
        """The mirror image in the plane x = 0, exactly."""
        return self.scaled((-1.0, 1.0, 1.0))

    def mapped(self, matrix: npt.ArrayLike) -> "Body":
        """A polytope under a linear map (3, 3): its vertices go to ``matrix @ vertex``, each operation rounded, and
        those are the body exactly. Of its measures the volume alone is known.

        Raises
        ------
        InputError
            The body is no polytope, or the matrix is not finite or has, to rounding, no determinant.
        """
        rows = as_floats(matrix, "matrix")
        if rows.shape != (3, 3):
            raise _vex.UsageError(f"matrix: an array of shape {rows.shape} - give one of shape (3, 3)")
        return Body._from_recipe(("mapped", tuple(map(tuple, rows.tolist())), self))

    def rounded(self, radius: float) -> "Body":
        """The body with a ball of this radius, above 0, about each of its points. Of a body of one's own its measures
        stay unknown."""
        radius = as_number(radius, "radius")
        if not radius > 0.0 or not math.isfinite(radius):
            raise _vex.UsageError(f"radius: {radius!r} - give a finite length above 0")
        return Body._from_recipe(("rounded", radius, self))

    # As Python's objects are.

    def _exact_key(self) -> Tuple[Any, ...]:
        try:
            return self._key
        except AttributeError:
            pass
        form = self._core.exact_form()
        if form is None:
            self._key: Tuple[Any, ...] = _own_key(self._recipe)
        else:
            points, pieces, radius = form
            points = points + 0.0  # no -0
            order = np.lexsort(points.T[::-1])
            plain = tuple(sorted((tuple(x + 0.0 for x in c), tuple(s), dome) for c, s, dome in pieces))
            self._key = (np.unique(points[order], axis=0).tobytes(), plain, radius)
        return self._key

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Body):
            return NotImplemented
        return bool(self._exact_key() == other._exact_key())

    def __hash__(self) -> int:
        return hash(self._exact_key())

    def __reduce__(self) -> Tuple[Any, ...]:
        return _body_from_recipe, (self._recipe,)

    def __repr__(self) -> str:
        kind = self._recipe[0]
        if kind == "named":
            _, text, scale, unit_volume = self._recipe
            more = (", unit_volume=True" if unit_volume else "") + (f", scale={scale!r}" if scale != 1.0 else "")
            return f"vex.Body({text!r}{more})"
        if kind in ("rounded", "scaled"):
            return f"{self._recipe[2]!r}.{kind}({self._recipe[1]!r})"
        if kind == "mapped":
            return f"{self._recipe[2]!r}.mapped({[list(row) for row in self._recipe[1]]!r})"
        if kind == "own":
            return f"<vex.Body of one's own, circumradius {self.circumradius:.6g}>"
        return f"<vex.Body: {len(self.vertices)} vertices, volume {self.volume:.6g}>"

    def _repr_html_(self) -> str:
        from . import plot
        return plot._html_of(self)

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """A picture of the body: see `vex.plot.body`."""
        from . import plot
        return plot.body(self, ax=ax, **options)


def _own_key(recipe: Tuple[Any, ...]) -> Tuple[Any, ...]:
    """A function is the one that it is, whatever it says of being equal to others."""
    if recipe[0] in ("rounded", "scaled", "mapped"):
        return (recipe[0], recipe[1], recipe[2]._exact_key())
    if recipe[0] == "named":  # of a shape that has no exact form, its numbers
        radius, core = _vex.parse_rounded(recipe[1]) or (0.0, recipe[1])
        name, _, sizes = core.partition(":")
        return ("named", name, tuple(map(float, sizes.split(","))), radius) + recipe[2:]
    return ("own", id(recipe[1]), recipe[2])


def _body_from_recipe(recipe: Tuple[Any, ...]) -> Body:
    return Body._from_recipe(recipe)


def _of_recipe(recipe: Tuple[Any, ...]) -> Tuple["_vex.Body", Tuple[Any, ...]]:
    """The same recipe gives the same body, bit for bit: pickled bodies are recipes."""
    kind = recipe[0]
    if kind == "named":
        return _vex.named_body(*recipe[1:]), recipe
    if kind == "mesh":
        return _vex.mesh_body(recipe[1], **recipe[2]), recipe
    if kind == "hull":
        return _vex.hull_body(recipe[1]), recipe
    if kind == "rounded":
        return _vex.rounded_body(recipe[2]._core, recipe[1], repr(recipe[2])), recipe
    if kind == "scaled":
        return _vex.scaled_body(recipe[2]._core, recipe[1]), recipe
    if kind == "mapped":
        return _vex.mapped_body(recipe[2]._core, np.array(recipe[1])), recipe
    if kind == "own":
        function, claims = recipe[1], recipe[2]
        return _vex.callable_body(_asked_by_rows(function), *claims), recipe
    raise _vex.UsageError(f"no body is made by {kind!r}")


def _asked_by_rows(function: Callable[..., Any]) -> Callable[[Floats], Floats]:
    def support(directions: Floats) -> Floats:
        return as_floats(function(directions), "the support function's points")
    return support


def _three(values: npt.ArrayLike, what: str) -> Tuple[float, float, float]:
    array = as_floats(values, what)
    if array.shape != (3,):
        raise _vex.UsageError(f"{what}: an array of shape {array.shape} - give three numbers, along x, y and z")
    x, y, z = array.tolist()
    return x, y, z


def _read(path: str, format: str, require_confinement: bool) -> "_vex.Surface":
    surface = _vex.read_surface(path, format, require_confinement)
    if surface.unconfined:
        warnings.warn(f"the process that read {path} was not confined ({surface.unconfined}) - require_confinement=True "
                      "refuses such files", UnconfinedWarning, stacklevel=4)
    return surface


def _of_text(text: str, mesh: Dict[str, Any], format: str,
             require_confinement: bool) -> Tuple["_vex.Body", Tuple[Any, ...]]:
    scale, unit_volume = mesh["scale"], mesh["unit_volume"]
    core, radius = text, 0.0
    rounded = _vex.parse_rounded(text)
    if rounded is not None:
        radius, core = rounded
    is_file = os.path.exists(core)
    if core.startswith(("hull:", "points:")):
        kind, _, path = core.partition(":")
        if not path or _vex.names_a_shape(path):
            raise _vex.UsageError(f"no file to take the hull of ({text}) - write hull:FILE or points:FILE")
        mesh = dict(mesh, hull=True)
        if kind == "points" and not format and not _vex.names_a_mesh_format(path):
            format = ".txt"
        if not radius > 0.0:
            return _of_recipe(("mesh", _read(path, format, require_confinement), mesh))
        core = path
    elif _vex.names_a_shape(core) or (not is_file and ":" in core[2:]):
        given = [name for name in ("hull", "convex_tolerance", "weld", "unit") if mesh[name]]
        given += (["format"] if format else []) + (["require_confinement"] if require_confinement else [])
        if given:
            raise _vex.UsageError(f"{', '.join(given)}: of meshes alone, and {text!r} is none - leave it out")
        return _of_recipe(("named", text, scale, unit_volume))
    elif not is_file and _vex.names_a_shape(core + ":"):
        parameters = {name: parameters for name, parameters, _ in _vex.named_shapes()}[core]
        raise _vex.UsageError(f"a body without its sizes ({core}) - write {core}:{parameters}")
    if not radius > 0.0:
        return _of_recipe(("mesh", _read(core, format, require_confinement), mesh))
    if unit_volume:
        as_it_is = Body(core, format=format, require_confinement=require_confinement,
                        **dict(mesh, scale=1.0, unit_volume=False))
        scale = scale / float(np.cbrt(as_it_is.rounded(radius).volume))
    return _of_recipe(("rounded", radius * scale, Body(core, format=format, require_confinement=require_confinement,
                                                       **dict(mesh, scale=scale, unit_volume=False))))


def _rounding_radius_of(source: Any) -> float:
    """Of coxeter's spheropolyhedra, which have vertices and a radius, but no faces."""
    radius = getattr(source, "radius", None)
    if hasattr(source, "faces") or not isinstance(radius, (int, float)):
        return 0.0
    return as_number(radius, "radius")


def _surface_of(source: Any, mesh: Dict[str, Any]) -> "_vex.Surface":
    """Of an object with `vertices` and `faces`."""
    if not hasattr(source, "vertices"):
        if np.ndim(source) == 2:
            raise TypeError("not a body, but an array - vex.hull(points) is the convex hull of points (N, 3)")
        raise TypeError(f"not a body ({type(source).__name__}) - give a text such as 'box:1,2,3', a file, a vex.Body, "
                        "or an object with vertices and faces")
    points, _ = as_rows(source.vertices, 3, "vertices")
    faces = getattr(source, "faces", None)
    if faces is None or len(faces) == 0:
        mesh["hull"] = True
        faces = []
    sizes = np.array([len(face) for face in faces], dtype=np.uint32)
    corners = np.concatenate([np.asarray(face).ravel() for face in faces]) if len(faces) else np.empty(0)
    if len(corners) and corners.dtype.kind not in "iu":
        raise TypeError(f"faces: not indices of vertices (dtype {corners.dtype}) - give whole numbers")
    if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
        raise _vex.InputError("a face names a vertex that is not there - give indices from 0 on")
    return _vex.Surface(points, corners.astype(np.uint32), sizes)


def as_body(body: BodyLike) -> Body:
    """A Body as it is; of anything else that `Body` takes the body."""
    return body if isinstance(body, Body) else Body(body)


def load(path: Union[str, "os.PathLike[str]"], *, hull: bool = False, scale: float = 1.0, unit_volume: bool = False,
         convex_tolerance: Optional[float] = None, weld: Optional[float] = None, unit: str = "",
         format: str = "", require_confinement: bool = False) -> Body:
    """The convex body of a mesh file: .obj .stl .ply .off .gltf .glb .dae .3mf .vtk .msh, points, and .gz of them.

    The file must hold one closed convex surface; it is refused otherwise, with the reason and the place, and `hull`
    takes the convex hull instead. Parameters as in `Body`.
    """
    mesh = {"hull": bool(hull), "convex_tolerance": convex_tolerance, "weld": weld, "unit": unit,
            "scale": as_number(scale, "scale"), "unit_volume": bool(unit_volume)}
    return Body._from_recipe(("mesh", _read(os.fspath(path), format, bool(require_confinement)), mesh))


def hull(points: npt.ArrayLike) -> Body:
    """The convex hull of points (N, 3) in any order, those inside included."""
    rows, _ = as_rows(points, 3, "points")
    return Body._from_recipe(("hull", rows.copy()))


def rounded(body: BodyLike, radius: float) -> Body:
    """The body with a ball of this radius about each of its points."""
    return as_body(body).rounded(radius)


def scaled(body: BodyLike, factors: Union[float, Sequence[float], Floats]) -> Body:
    """The body with every length times a number, or times three of them along its axes: see `Body.scaled`."""
    return as_body(body).scaled(factors)


def mirrored(body: BodyLike) -> Body:
    """The mirror image of a body in the plane x = 0, exactly."""
    return as_body(body).mirrored()


def mapped(polytope: BodyLike, matrix: npt.ArrayLike) -> Body:
    """A polytope under a linear map (3, 3): see `Body.mapped`."""
    return as_body(polytope).mapped(matrix)


def from_support(support: Callable[[Floats], npt.ArrayLike], *, circumradius: float, support_error: float,
                 centre: Sequence[float] = (0.0, 0.0, 0.0), inradius: float = 0.0, check: bool = True) -> Body:
    """A body of your own, by its support mapping.

    Parameters
    ----------
    support
        ``support(directions (N, 3)) -> points (N, 3)``: points of the body farthest along directions, which have any
        length but 0.
    circumradius, inradius, centre
        The body is in the ball of `circumradius` about `centre`, and holds that of `inradius`; 0 claims nothing.
    support_error
        How far rounding can put a point off, length. The proofs of every query rest on it.
    check
        Compare what it says with what it claims, along a thousand directions, and refuse it where they differ.

    Notes
    -----
    Right, but slow: the function is called for a direction at a time, some microseconds each, by one thread at a time.
    Its measures are not known, so there is no formula to compare with; and where double precision proves nothing a
    query says that it is undecided.
    """
    centre_ = tuple(float(x) for x in centre)
    if len(centre_) != 3:
        raise _vex.UsageError("centre: give three numbers")
    claims = (as_number(support_error, "support_error"), centre_, as_number(circumradius, "circumradius"),
              as_number(inradius, "inradius"))
    body = Body._from_recipe(("own", support, claims))
    if check:
        broken = body.validate(n_directions=250)
        if broken:
            raise _vex.InputError("the support function does not keep what is claimed: " + "; ".join(broken))
    return body


def named_shapes() -> List[Tuple[str, str, str]]:
    """Every body that has a name: (name, parameters, meaning)."""
    return _vex.named_shapes()
