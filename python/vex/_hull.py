"""Faces of a polytope, for pictures and for whoever writes meshes."""

from __future__ import annotations

from typing import Dict, List, Tuple

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats

_ONE_PLANE = 1e-9  # of the size


def faces_of(vertices: Floats, one_plane: float = _ONE_PLANE) -> List[npt.NDArray[np.intp]]:
    """Faces of the convex hull of points that are all its corners, counter-clockwise seen from outside.

    Triangles of the hull whose planes are one, to within 1e-9 of the size and less of a thin body, are one face. Of
    points in one plane two faces, one for each side; of two points none.
    """
    if len(vertices) < 3:
        return []
    points = vertices - vertices.mean(axis=0)
    size = float(np.abs(points).max())
    singular, axes = np.linalg.svd(points / size, full_matrices=False)[1:]
    try:
        triangles = _vex.hull_triangles(vertices).astype(np.intp)
    except _vex.InputError:  # of no volume, by exact signs
        if len(vertices) < 3 or not singular[1] > 0.0 or np.linalg.matrix_rank(points / size) < 2:
            return []
        face = np.argsort(np.arctan2(points @ axes[1], points @ axes[0]))
        if np.cross(axes[0], axes[1]) @ axes[2] < 0.0:
            face = face[::-1]
        return [face, face[::-1]]

    one_plane = min(one_plane, 1e-3 * float(singular[2]) / np.sqrt(len(points)))
    edges: Dict[Tuple[int, int], int] = {}
    for t, (i, j, k) in enumerate(triangles.tolist()):
        edges[i, j] = edges[j, k] = edges[k, i] = t
    corner = points[triangles] / size
    normals = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(lengths > 0.0, lengths, 1.0)

    # From the largest triangle of a face outwards: a neighbour all of whose corners are in its plane is of it.
    faces: List[npt.NDArray[np.intp]] = []
    face_of = np.full(len(triangles), -1)
    for seed in np.argsort(-lengths[:, 0], kind="stable"):
        if face_of[seed] >= 0:
            continue
        face_of[seed] = len(faces)
        members, todo = [int(seed)], [int(seed)]
        while todo:
            i, j, k = triangles[todo.pop()].tolist()
            for a, b in ((i, j), (j, k), (k, i)):
                other = edges[b, a]
                if face_of[other] >= 0:
                    continue
                off = (corner[other] - corner[seed, 0]) @ normals[seed]
                if np.abs(off).max() <= one_plane:
                    face_of[other] = len(faces)
                    members.append(other)
                    todo.append(other)
        following = {}
        for t in members:
            i, j, k = triangles[t].tolist()
            for a, b in ((i, j), (j, k), (k, i)):
                if face_of[edges[b, a]] != len(faces):
                    following[a] = b
        start = min(following)
        loop = [start]
        while following[loop[-1]] != start:
            loop.append(following[loop[-1]])
        faces.append(np.array(loop, dtype=np.intp))
    return faces
