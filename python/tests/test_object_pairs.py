"""Objects against objects, against closed forms."""

import numpy as np
import pytest

import cstk


@pytest.fixture
def spheres(rng):
    """Spheres at random, in two environments: their ids, centres and radii."""

    def scatter(count):
        environment = cstk.Environment()
        centres, radii = rng.uniform(-1, 1, (count, 3)), rng.uniform(0.02, 0.2, count)
        ids = [environment.add(cstk.Body.sphere(r), cstk.translation(*c), data=i) for i, (c, r) in enumerate(zip(centres, radii))]
        return environment, ids, centres, radii

    return scatter(60), scatter(30)


def gaps(a, b):
    between = np.linalg.norm(a[2][:, None] - b[2][None], axis=2)
    return between - a[3][:, None] - b[3][None]


def test_pairs_within_and_between(query, spheres):
    a, b = spheres
    for first, second in ((a, None), (a, b)):
        gap = gaps(first, second or first)
        if second is None:
            gap[np.tril_indices_from(gap)] = np.inf
        ids = (second or first)[1]
        expected = [(first[1][i], ids[j]) for i, j in np.argwhere(gap <= 0.1)]
        other = second and second[0]
        found = query.environment_pairs(first[0], other, 0.1, with_distances=True)
        assert [(pair.r_object, pair.s_object) for pair in found] == expected and len(expected) > 10
        for pair, measured in zip(found, found.distances):
            truth = gap[pair.r_data, pair.s_data]
            assert measured.distance == pytest.approx(max(truth, 0), abs=1e-12)
            assert (pair.pair_class == cstk.Class.INSIDE) == (truth <= 0)
        assert query.environment_pairs(first[0], other, 0.1, max_count=2).truncated
        assert query.environment_within(first[0], other, 0.1)
        nearest = query.environment_distance(first[0], other)
        assert nearest.distance == pytest.approx(max(gap.min(), 0), abs=1e-12)
        touching = query.environment_witnesses(first[0], other, 0.1)
        assert len(touching) == len(expected)


def test_filters(query, spheres):
    (environment, ids, *_), _ = spheres
    found = query.environment_pairs(environment, distance=10, filter=lambda r, s: r == ids[0])
    assert [(pair.r_object, pair.s_object) for pair in found] == [(ids[0], other) for other in ids[1:]]
    assert not query.environment_within(environment, threshold=10, filter=lambda r, s: False)

    def broken(r, s):
        raise KeyError("broken")

    with pytest.raises(cstk.CallbackFailedError) as caught:
        query.environment_distance(environment, filter=broken)
    assert isinstance(caught.value.__cause__, KeyError)
    with pytest.raises(TypeError, match="filter"):
        query.environment_within(environment, filter=3)
    with pytest.raises(TypeError, match="other"):
        query.environment_within(environment, query)
