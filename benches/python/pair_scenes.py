"""Pairs of bodies, about 1 across, and the poses that pair_peers.py asks about."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np

import cstk

GAPS = {"far": (0.5, 3.0), "near": (0.001, 0.1), "touching": (-1e-5, 1e-5), "overlapping": (-0.1, -0.001)}
"""How far one body is moved back from the place where it touches the other; below 0 it is moved on. A quarter of the pairs each."""
START = 2.0
"""From middle to middle, where a body starts to come in: bodies that are 1 across are apart there."""
TOUCH = 1e-6
"""Nearer than this counts as touching when a body comes in."""
MAX_STEPS = 200
"""Steps of a body that comes in; grazing ones take many, and may stop early."""


@dataclass
class Box:
    half_extents: Tuple[float, float, float]

    def body(self):
        return cstk.Body.box(self.half_extents)


@dataclass
class Mesh:
    """A surface, without inside."""

    vertices: np.ndarray
    faces: np.ndarray

    def body(self):
        return cstk.Body.mesh(self.vertices, self.faces)


@dataclass
class Scene:
    """Two shapes and their poses, (2, n, 3, 4)."""

    name: str
    shapes: tuple
    bodies: tuple
    poses: np.ndarray


def bumpy_sphere(rings, rng):
    """Triangles over a ball of radius 0.5 with 8 waves on it: 4 * rings * (rings - 1) of them."""
    sectors = 2 * rings
    latitude = np.pi * np.arange(1, rings) / rings
    longitude = 2 * np.pi * np.arange(sectors) / sectors
    z = np.repeat(np.cos(latitude), sectors)
    x, y = (np.outer(np.sin(latitude), side(longitude)).ravel() for side in (np.cos, np.sin))
    directions = np.vstack([np.stack([x, y, z], 1), [[0, 0, 1], [0, 0, -1]]])
    waves, phases = rng.uniform(3, 9, 8)[:, None] * unit_vectors(8, 3, rng), rng.uniform(0, 2 * np.pi, 8)
    radii = 0.5 * (1 + 0.03 * np.sin(directions @ waves.T + phases).sum(1))
    here = np.arange(sectors)
    after = (here + 1) % sectors
    top, bottom = len(directions) - 2, len(directions) - 1
    faces = [np.stack([np.full(sectors, top), here, after], 1)]
    for first in range(0, sectors * (rings - 2), sectors):
        a, b, c, d = first + here, first + after, first + sectors + here, first + sectors + after
        faces += [np.stack([a, c, d], 1), np.stack([a, d, b], 1)]
    last = sectors * (rings - 2)
    faces.append(np.stack([np.full(sectors, bottom), last + after, last + here], 1))
    return Mesh(radii[:, None] * directions, np.concatenate(faces))


def unit_vectors(count, dimension, rng):
    vectors = rng.normal(size=(count, dimension))
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def rotations(count, rng):
    """Uniform ones, (n, 3, 3)."""
    w, x, y, z = unit_vectors(count, 4, rng).T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), 2, 0).copy()


def random_poses(bodies, count, rng):
    """Each first body comes in along a line through the second one's middle until they touch, and is moved by a gap of GAPS."""
    batch = cstk.Batch(threads=1)
    at = np.empty((2, count, 3, 4))
    at[0, :, :, :3], at[1, :, :, :3] = rotations(count, rng), rotations(count, rng)
    at[1, :, :, 3] = rng.uniform(-1, 1, (count, 3))
    directions, away = unit_vectors(count, 3, rng), np.full(count, START)
    coming = np.arange(count)
    for _ in range(MAX_STEPS):
        at[0, :, :, 3] = at[1, :, :, 3] + away[:, None] * directions
        found = batch.pair_distance(bodies[0], at[0, coming], bodies[1], at[1, coming])
        found.check()
        # The other body is no nearer than this, so that no step passes it.
        away[coming] -= found.distances
        coming = coming[(found.distances > TOUCH) & (away[coming] > 0)]
        if not len(coming):
            break
    low, high = rng.permutation(np.resize(list(GAPS.values()), (count, 2))).T
    at[0, :, :, 3] = at[1, :, :, 3] + (away + rng.uniform(low, high))[:, None] * directions
    return at


def scenes(count, seed):
    rng = np.random.default_rng(seed)
    shapes = {
        "box and box": (Box((0.5, 0.4, 0.3)), Box((0.3, 0.35, 0.55))),
        "mesh and mesh": (bumpy_sphere(28, rng), bumpy_sphere(28, rng)),
    }
    for name, pair in shapes.items():
        bodies = tuple(shape.body() for shape in pair)
        yield Scene(name, pair, bodies, random_poses(bodies, count, rng))
