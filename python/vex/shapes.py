"""The named bodies as functions: axis z, centre at the origin, sizes full or half as the names say."""

from __future__ import annotations

from .bodies import Body


def _named(name: str, *sizes: float) -> Body:
    return Body(name + ":" + ",".join(repr(float(size)) for size in sizes))


def sphere(radius: float) -> Body:
    """A ball."""
    return _named("sphere", radius)


def box(a: float, b: float, c: float) -> Body:
    """A box of these full edges along x, y, z."""
    return _named("box", a, b, c)


def ellipsoid(a: float, b: float, c: float) -> Body:
    """An ellipsoid of these semi-axes along x, y, z."""
    return _named("ellipsoid", a, b, c)


def capsule(length: float, radius: float) -> Body:
    """A straight part of this length along z, with a ball about each of its points: longer by two radii in all."""
    return _named("capsule", length, radius)


def cylinder(length: float, radius: float) -> Body:
    """A cylinder of this full length along z."""
    return _named("cylinder", length, radius)


def cone(height: float, radius: float) -> Body:
    """A cone along z, its base of this radius at z = -height/2."""
    return _named("cone", height, radius)


def frustum(height: float, radius_1: float, radius_2: float) -> Body:
    """A truncated cone along z, `radius_1` at z = -height/2."""
    return _named("frustum", height, radius_1, radius_2)


def hemisphere(radius: float) -> Body:
    """Half a ball, its flat face in z = 0, its dome upwards."""
    return _named("hemisphere", radius)


def disc(radius: float) -> Body:
    """A disc in z = 0, without thickness."""
    return _named("disc", radius)


def plate(a: float, b: float) -> Body:
    """A rectangle in z = 0 of these full edges, without thickness."""
    return _named("plate", a, b)


def needle(length: float) -> Body:
    """A segment of this length along z."""
    return _named("needle", length)


def tetrahedron(edge: float) -> Body:
    """A regular tetrahedron, its centroid at the origin."""
    return _named("tetrahedron", edge)


def octahedron(edge: float) -> Body:
    """A regular octahedron."""
    return _named("octahedron", edge)


def dodecahedron(edge: float) -> Body:
    """A regular dodecahedron."""
    return _named("dodecahedron", edge)


def icosahedron(edge: float) -> Body:
    """A regular icosahedron."""
    return _named("icosahedron", edge)


def prism(n_sides: int, edge: float, height: float) -> Body:
    """A right prism along z on a regular polygon of this edge, a side towards +x."""
    return _named("prism", n_sides, edge, height)


def antiprism(n_sides: int, edge: float, height: float) -> Body:
    """Two regular polygons of this edge at z = -height/2 and height/2, the upper one turned by half a side."""
    return _named("antiprism", n_sides, edge, height)


def pyramid(n_sides: int, edge: float, height: float) -> Body:
    """A right pyramid along z, its base, a regular polygon of this edge, at z = -height/2."""
    return _named("pyramid", n_sides, edge, height)


def truncated_tetrahedron(edge: float) -> Body:
    """A truncated tetrahedron: 4 hexagons and 4 triangles."""
    return _named("truncated-tetrahedron", edge)


def cuboctahedron(edge: float) -> Body:
    """A cuboctahedron: 8 triangles and 6 squares."""
    return _named("cuboctahedron", edge)


def truncated_cube(edge: float) -> Body:
    """A truncated cube: 6 octagons and 8 triangles."""
    return _named("truncated-cube", edge)


def truncated_octahedron(edge: float) -> Body:
    """A truncated octahedron: 8 hexagons and 6 squares."""
    return _named("truncated-octahedron", edge)


def rhombicuboctahedron(edge: float) -> Body:
    """A rhombicuboctahedron: 18 squares and 8 triangles."""
    return _named("rhombicuboctahedron", edge)


def truncated_cuboctahedron(edge: float) -> Body:
    """A truncated cuboctahedron: 6 octagons."""
    return _named("truncated-cuboctahedron", edge)


def snub_cube(edge: float) -> Body:
    """A snub cube: 6 squares and 32 triangles."""
    return _named("snub-cube", edge)


def icosidodecahedron(edge: float) -> Body:
    """An icosidodecahedron: 12 pentagons and 20 triangles."""
    return _named("icosidodecahedron", edge)


def truncated_dodecahedron(edge: float) -> Body:
    """A truncated dodecahedron: 12 decagons and 20 triangles."""
    return _named("truncated-dodecahedron", edge)


def truncated_icosahedron(edge: float) -> Body:
    """A truncated icosahedron: 12 pentagons and 20 hexagons."""
    return _named("truncated-icosahedron", edge)


def rhombicosidodecahedron(edge: float) -> Body:
    """A rhombicosidodecahedron: 12 pentagons."""
    return _named("rhombicosidodecahedron", edge)


def truncated_icosidodecahedron(edge: float) -> Body:
    """A truncated icosidodecahedron: 12 decagons."""
    return _named("truncated-icosidodecahedron", edge)


def snub_dodecahedron(edge: float) -> Body:
    """A snub dodecahedron: 12 pentagons and 80 triangles."""
    return _named("snub-dodecahedron", edge)


def lens(radius: float, thickness: float) -> Body:
    """What two equal balls have in common, its rim of this radius in z = 0."""
    return _named("lens", radius, thickness)


def cut_sphere(radius: float, below: float, above: float) -> Body:
    """A ball between the planes z = -below and z = above; where that is the radius there is no flat face."""
    return _named("cut-sphere", radius, below, above)


def spindle(length: float, radius: float) -> Body:
    """What a segment of a circle sweeps about its chord along z, of this length; `radius` is that of the equator."""
    return _named("spindle", length, radius)


def egg(radius: float, below: float, above: float) -> Body:
    """Two half spheroids of one equator in z = 0, of these heights."""
    return _named("egg", radius, below, above)


def superball(exponent: float, radius: float) -> Body:
    """|x|^2P + |y|^2P + |z|^2P <= R^2P, P from 0.5: octahedron, ball (1), and towards a cube of edges 2 R."""
    return _named("superball", exponent, radius)


def superellipsoid(a: float, b: float, c: float, exponent_across: float, exponent_along: float) -> Body:
    """(|x/a|^2P + |y/b|^2P)^(Q/P) + |z/c|^2Q <= 1, P across the z axis and Q along it."""
    return _named("superellipsoid", a, b, c, exponent_across, exponent_along)
