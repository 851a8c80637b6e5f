"""Maps against single queries at the middles of their cells, and as numpy reads them."""

import gc
import itertools

import numpy as np
import pytest
from conftest import PlanarArm

import cstk

NAN = float("nan")
AXES = cstk.MapAxis(0, -1.0, 3.0, 40), cstk.MapAxis(1, -2.0, 2.0, 30)


@pytest.fixture(scope="module")
def arm():
    return PlanarArm(2.2)


@pytest.fixture(scope="module")
def classes(arm):
    return cstk.Map.build(arm.cobject, [0, 0], AXES)


def middles(axis):
    """As the header says."""
    return [axis.low + (axis.high - axis.low) * ((i + 0.5) / axis.cells) for i in range(axis.cells)]


def test_classes_are_those_of_single_queries(arm, query, classes):
    values = classes.values
    assert values.shape == classes.shape == (40, 30) and values.dtype == np.uint8
    assert classes.kind == cstk.MapKind.CLASSES and classes.axes == tuple(axis._replace(end=axis.cells) for axis in AXES)
    for axis in AXES:
        assert axis.middles().tolist() == middles(axis)
    for (i, a), (j, b) in itertools.product(enumerate(middles(AXES[0])), enumerate(middles(AXES[1]))):
        assert values[i, j] == query.classify(arm.cobject, [a, b])
        assert (values[i, j] == cstk.Class.INSIDE) == (arm.clearance([a, b]) <= 0)
    assert 0 < (values == cstk.Class.INSIDE).sum() < values.size


def test_fine_maps_ask_few_cells(arm):
    fine = cstk.Map.build(arm.cobject, [0, 0], [axis._replace(cells=100) for axis in AXES])
    assert 0 < fine.proofs and 0 < fine.questions < fine.values.size / 4


def test_distances(arm, query):
    found = cstk.Map.build(arm.cobject, [0, 0], AXES, kind=cstk.MapKind.DISTANCES, max_distance=0.8, threads=2)
    singles = [[query.distance(arm.cobject, [a, b], 0.8).distance for b in middles(AXES[1])] for a in middles(AXES[0])]
    assert found.values.dtype == np.float64 and found.values.tobytes() == np.array(singles).tobytes()
    assert np.isinf(found.values).any() and (found.values == 0).any() and found.questions == found.values.size


def test_cells_are_proved(arm, query):
    axes = [cstk.MapAxis(0, 0.5, 2.5, 12), cstk.MapAxis(1, -1.0, 1.0, 10)]
    found = cstk.Map.build(arm.cobject, [0, 0], axes, kind=cstk.MapKind.CELLS, max_boxes=256)
    edges = [np.linspace(axis.low, axis.high, axis.cells + 1) for axis in axes]
    for i, j in np.ndindex(found.shape):
        truth = {
            arm.clearance([a, b]) <= 0
            for a in np.linspace(*edges[0][i : i + 2], 5)
            for b in np.linspace(*edges[1][j : j + 2], 5)
        }
        outcome = cstk.RegionOutcome(int(found.values[i, j]))
        if outcome in (cstk.RegionOutcome.FREE, cstk.RegionOutcome.INSIDE):
            assert truth == {outcome == cstk.RegionOutcome.INSIDE}
    assert {cstk.RegionOutcome.FREE, cstk.RegionOutcome.INSIDE} <= set(found.values.flat)


def test_other_coordinates_are_held(arm, query):
    found = cstk.Map.build(arm.cobject, [9, 0.3], [(0, -1, 3, 17)])
    assert found.shape == (17,)
    assert found.values.tolist() == [query.classify(arm.cobject, [a, 0.3]) for a in middles(found.axes[0])]
    swapped = cstk.Map.build(arm.cobject, [0, 0], AXES[::-1])
    assert (swapped.values == cstk.Map.build(arm.cobject, [0, 0], AXES).values.T).all()


def test_parts_have_the_values_of_the_whole(arm, classes):
    for kind in cstk.MapKind:
        whole = cstk.Map.build(arm.cobject, [0, 0], AXES, kind=kind).values
        part = cstk.Map.build(arm.cobject, [0, 0], [AXES[0]._replace(first=7, end=18), AXES[1]._replace(first=20)], kind=kind)
        assert part.shape == (11, 10) and part.values.tobytes() == whole[7:18, 20:].tobytes()
        assert part.axes[0].middles().tolist() == AXES[0].middles()[7:18].tolist()


def test_saved_for_numpy(arm, classes, tmp_path):
    classes.save(tmp_path / "classes.npy")
    loaded = np.load(tmp_path / "classes.npy")
    assert loaded.dtype == classes.values.dtype and loaded.shape == classes.shape and (loaded == classes.values).all()
    distances = cstk.Map.build(arm.cobject, [0, 0], AXES, kind=cstk.MapKind.DISTANCES)
    distances.save(str(tmp_path / "distances.npy"))
    loaded = np.load(tmp_path / "distances.npy")
    assert loaded.shape == classes.shape and loaded.tobytes() == distances.values.tobytes()
    with pytest.raises(cstk.IoError):
        classes.save(tmp_path / "nowhere" / "classes.npy")


def test_shown(arm, classes, tmp_path):
    picture = tmp_path / "map.png"
    classes.show(picture)
    image = pytest.importorskip("matplotlib.image").imread(picture)
    assert image.shape[:2] == (30, 40)
    white = (image[..., :3] == 1).all(axis=2)
    assert (white == (classes.values == cstk.Class.OUTSIDE).T[::-1]).all()
    with pytest.raises(cstk.UnsupportedError, match="axes"):
        cstk.Map.build(arm.cobject, [0, 0], AXES[:1]).show(picture)


def test_values_are_a_view_that_outlives_the_map(arm):
    with cstk.Map.build(arm.cobject, [0, 0], AXES) as made:
        values, copy = made.values, made.values.copy()
        assert values.ctypes.data == made.values.ctypes.data
    with pytest.raises(cstk.ReleasedError, match="the Map was released"):
        made.values
    del made
    gc.collect()
    cstk.Map.build(arm.cobject, [0, 0], AXES[::-1])
    assert (values == copy).all() and not values.flags.writeable
    with pytest.raises(ValueError):
        values[0, 0] = 1


def test_progress_hears_and_ends(arm):
    heard = []
    cstk.Map.build(arm.cobject, [0, 0], AXES, progress=heard.append)
    assert heard and heard == sorted(heard)
    for no in (False, np.False_):
        with pytest.raises(cstk.CancelledError):
            cstk.Map.build(arm.cobject, [0, 0], AXES, progress=lambda part: no)
    cstk.Map.build(arm.cobject, [0, 0], AXES, progress=lambda part: 0)
    with pytest.raises(ZeroDivisionError):
        cstk.Map.build(arm.cobject, [0, 0], AXES, progress=lambda part: 1 / 0)


CASES = [
    ("build(None, q, axes)", TypeError, "cobject must be a cstk.CObject"),
    ("build(cobject, [0], axes)", cstk.WrongSizeError, "1"),
    ("build(cobject, [[0, 0]], axes)", cstk.WrongSizeError, r"q has shape \(1, 2\)"),
    ("build(cobject, [0, NAN], axes)", cstk.NotFiniteError, "entry 1"),
    ("build(cobject, q, 3)", TypeError, "axes must be a sequence"),
    ("build(cobject, q, [])", cstk.Error, "axes"),
    ("build(cobject, q, [(0, 1, 2)])", cstk.WrongSizeError, r"axes\[0\] must be a cstk.MapAxis"),
    ("build(cobject, q, [(0, 1, 2, 3), 4])", cstk.WrongSizeError, r"axes\[1\] must be a cstk.MapAxis"),
    ("build(cobject, q, [('x', 1, 2, 3)])", TypeError, r"axes\[0\].coordinate"),
    ("build(cobject, q, [(0, 1, 2, 3.5)])", TypeError, r"axes\[0\].cells"),
    ("build(cobject, q, [(0, 1, 2, -1)])", cstk.InvalidArgumentError, r"axes\[0\].cells"),
    ("build(cobject, q, [(0, 1, 2, 0)])", cstk.Error, "cells"),
    ("build(cobject, q, [(0, 1, 2, 3, 3)])", cstk.InvalidArgumentError, "axis 0: there is no part of 3 cells from 3"),
    ("build(cobject, q, [(0, 1, 2, 3, 'x')])", TypeError, r"axes\[0\].first"),
    ("build(cobject, q, [(0, 1, 2, 3, 0, -1)])", cstk.InvalidArgumentError, r"axes\[0\].end"),
    ("build(cobject, q, [(0, 1, 2, 3, 2, 2)])", cstk.InvalidArgumentError, r"axes\[0\].end 2 is not beyond first 2"),
    ("build(cobject, q, [(0, 1, 2, 3, 0, 4)])", cstk.InvalidArgumentError, "axis 0: there is no part"),
    ("build(cobject, q, [(0, 'low', 2, 3)])", TypeError, r"axes\[0\].low"),
    ("build(cobject, q, [(0, 2, 1, 3)])", cstk.Error, "low"),
    ("build(cobject, q, [(0, 0, NAN, 3)])", cstk.NotFiniteError, "axis 0: end 1"),
    ("build(cobject, q, [(2, 0, 1, 3)])", cstk.Error, "coordinate"),
    ("build(cobject, q, [(0, 0, 1, 3), (0, 0, 1, 3)])", cstk.Error, "coordinate"),
    ("build(cobject, q, [(0, 0, 1, 2**62), (1, 0, 1, 2**62)])", cstk.WrongSizeError, "cells"),
    ("build(cobject, q, axes, kind=9)", ValueError, "9"),
    ("build(cobject, q, axes, threads=-1)", cstk.InvalidArgumentError, "threads"),
    ("build(cobject, q, axes, threads=5000)", cstk.InvalidArgumentError, "threads"),
    ("build(cobject, q, axes, kind=1, max_distance=NAN)", cstk.Error, "max_distance"),
    ("build(cobject, q, axes, max_boxes=0)", cstk.Error, "max_boxes"),
    ("build(cobject, q, axes).save(3)", TypeError, "file must be a path"),
    ("Map()", TypeError, "Map.build"),
]


@pytest.mark.parametrize("call, kind, says", CASES)
def test_the_culprit_is_named(arm, call, kind, says):
    names = {"build": cstk.Map.build, "Map": cstk.Map, "NAN": NAN, "cobject": arm.cobject, "q": [0, 0], "axes": AXES}
    with pytest.raises(kind, match=says):
        eval(call, names)
