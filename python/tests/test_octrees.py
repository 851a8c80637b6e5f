"""Octrees against sets of cells, and clouds of points from files."""

import numpy as np
import pytest

import cstk


def test_cells_change_in_an_environment(query):
    ball = cstk.Body.sphere(0.25)
    octree = cstk.Octree(0.5)
    rng = np.random.default_rng(3)
    cells = rng.integers(-4, 4, (60, 3))
    middles = (cells + 0.5) * 0.5
    assert octree.set(middles) == len(np.unique(cells, axis=0)) == octree.cell_count
    assert octree.get(middles).all() and not octree.get([[100, 0, 0]])[0]
    cubes = octree.cubes()
    assert np.isclose((cubes[:, 3] ** 3).sum(), octree.cell_count * 0.125) and octree.resolution == 0.5
    world = cstk.Environment()
    octree.place(world, cstk.translation(1, 0, 0), data="map")
    assert octree.object_count == world.object_count > 0 and world.version == 1

    def distance(at):
        body = octree.build_body()
        return query.pair_distance(ball, cstk.translation(*at), body, cstk.identity()).distance

    def brute_force(at):
        low = cubes[:, :3]
        away = np.maximum(np.maximum(low - at, at - low - cubes[:, 3:]), 0)
        return max(np.linalg.norm(away, axis=1).min() - 0.25, 0)

    for at in rng.uniform(-4, 4, (50, 3)):
        assert abs(distance(at) - brute_force(at)) < 1e-12
    other = cstk.Octree(0.5)
    other.set([[9.1, 0, 0]])
    octree.insert(other)
    assert octree.set([[9.1, 0, 0]], False) == 1
    octree.move(cstk.identity())
    assert world.object_info(int(world.objects()[0])).data == "map"
    octree.remove()
    assert world.object_count == 0
    with pytest.raises(cstk.NotFoundError):
        octree.move(cstk.identity())
    with pytest.raises(cstk.InvalidArgumentError, match="point 1"):
        octree.set([[0, 0, 0], [1e9, 0, 0]])


def test_files(tmp_path):
    file = tmp_path / "one.bt"
    file.write_bytes(b"# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.5\ndata\n\x00\x80")
    octree = cstk.Octree.load(file)
    assert octree.cubes().tolist() == [[0, 0, 0, 2.0**14]]
    cloud = tmp_path / "points.pcd"
    cloud.write_text("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 3\nDATA ascii\n0 0 0\nnan 0 0\n1 2 3\n")
    builder = cstk.BodyBuilder()
    assert builder.add_cloud_file(cloud, 0.5, scale=2) == 1
    assert builder.build().vertices().tolist() == [[0, 0, 0], [2, 4, 6]]
    file.write_bytes(b"")
    with pytest.raises(cstk.ParseError, match="one.bt"):
        cstk.Octree.load(file)
