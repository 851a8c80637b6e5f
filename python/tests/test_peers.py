"""The same questions to other libraries, where they can be installed: python-fcl and coal."""

import numpy as np
import pytest
from conftest import random_pose

import cstk


def soup(rng, count):
    """Triangles at random, so sparse that two of them apart are far from meeting."""
    vertices = rng.uniform(-1, 1, (count, 1, 3)) + 0.2 * rng.normal(size=(count, 3, 3))
    return vertices.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def shapes(rng):
    """Bodies of ours with what a peer makes them of."""
    half, radius, length = rng.uniform(0.2, 1, 3), rng.uniform(0.2, 0.6), rng.uniform(0.5, 2)
    yield cstk.Body.box(half), ("box", half)
    yield cstk.Body.sphere(radius), ("sphere", radius)
    yield cstk.Body.capsule([0, 0, -length / 2], [0, 0, length / 2], radius), ("capsule", radius, length)
    yield cstk.Body.mesh(*(mesh := soup(rng, 60))), ("mesh", *mesh)


def compare(query, rng, peer, tolerance):
    """Distances of pairs apart, and whether pairs meet, of all kinds in random poses."""
    apart = meeting = 0
    for _ in range(40):
        for a, made_a in shapes(rng):
            for b, made_b in shapes(rng):
                pose_a, pose_b = random_pose(rng, 1.6), random_pose(rng, 1.6)
                found = query.pair_distance(a, pose_a, b, pose_b).distance
                distance, meet = peer(made_a, pose_a, made_b, pose_b)
                if found > tolerance:
                    assert not meet
                    assert distance == pytest.approx(found, abs=tolerance), (made_a[0], made_b[0])
                    apart += 1
                elif found == 0:
                    # A capsule wholly in a mesh's inside meets none of its triangles in either library.
                    assert meet, (made_a[0], made_b[0])
                    meeting += 1
    assert apart > 200 and meeting > 50


def test_python_fcl_agrees(query, rng):
    fcl = pytest.importorskip("fcl", reason="python-fcl is not installed")

    def geometry(kind, *sizes):
        if kind == "mesh":
            model = fcl.BVHModel()
            model.beginModel(len(sizes[0]), len(sizes[1]))
            model.addSubModel(*sizes)
            model.endModel()
            return model
        if kind == "box":
            return fcl.Box(*(2 * sizes[0]))
        return fcl.Sphere(*sizes) if kind == "sphere" else fcl.Capsule(*sizes)

    def peer(made_a, pose_a, made_b, pose_b):
        a, b = (
            fcl.CollisionObject(geometry(*made), fcl.Transform(pose[:3, :3], pose[:3, 3]))
            for made, pose in ((made_a, pose_a), (made_b, pose_b))
        )
        meet = fcl.collide(a, b, fcl.CollisionRequest(), fcl.CollisionResult()) > 0
        return (0 if meet else fcl.distance(a, b, fcl.DistanceRequest(), fcl.DistanceResult())), meet

    compare(query, rng, peer, 2e-5)


def test_coal_agrees(query, rng):
    coal = pytest.importorskip("coal", reason="coal is not installed")

    def geometry(kind, *sizes):
        if kind == "mesh":
            model = coal.BVHModelOBBRSS()
            model.beginModel(len(sizes[1]), len(sizes[0]))
            points = coal.StdVec_Vec3s()
            for vertex in sizes[0]:
                points.append(vertex)
            triangles = coal.StdVec_Triangle()
            for face in sizes[1]:
                triangles.append(coal.Triangle(*(int(i) for i in face)))
            model.addSubModel(points, triangles)
            model.endModel()
            return model
        if kind == "box":
            return coal.Box(*(2 * sizes[0]))
        return coal.Sphere(*sizes) if kind == "sphere" else coal.Capsule(*sizes)

    def peer(made_a, pose_a, made_b, pose_b):
        a, b = geometry(*made_a), geometry(*made_b)
        places = [coal.Transform3s(pose[:3, :3], pose[:3, 3]) for pose in (pose_a, pose_b)]
        collision = coal.collide(a, places[0], b, places[1], coal.CollisionRequest(), coal.CollisionResult())
        if collision:
            return 0, True
        return coal.distance(a, places[0], b, places[1], coal.DistanceRequest(), coal.DistanceResult()), False

    compare(query, rng, peer, 2e-5)
