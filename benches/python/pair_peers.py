"""How long pair queries take from Python beside those of Coal's and FCL's own Python modules: `scripts/bench.sh python`.

    pair_peers.py [--items N] [--passes N] [--seed N]

All libraries answer for the same poses on one thread, in turn; the median of the passes counts. Handles, requests, results, transforms
and objects are made before. Of each peer the fastest of its ways is shown, of yes-or-no answers among those that err least. A peer that
cannot be imported is left out, and named. Ends with 1 where a batch answers other than single calls.
"""

import argparse
import platform
import statistics
import sys
import time
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, Callable

import numpy as np
from pair_scenes import Box, scenes

import cstk

TOLERANCE = 1e-6
"""Distances differ where they are farther apart than this share of the larger one."""
DOUBT = 1e-6
"""Pairs at most this far apart, or of which no two primitives are deeper in one another, are not compared: solvers of peers end about
there.
"""
TRIED = 300
"""Of the pairs, so many are asked in all ways of a peer to choose its fastest."""
QUERIES = "collide", "distance"


@dataclass
class Way:
    """A way of a library to answer a query for all pairs of a scene."""

    library: str
    name: str
    run: Callable
    kept: Any = None
    """What lives as long as the way."""


def our_ways(scene, query_name):
    query, batch = cstk.Query(), cstk.Batch(threads=1)
    (a, b), (poses_a, poses_b) = scene.bodies, scene.poses
    pairs = list(zip(poses_a, poses_b))

    def collide(count):
        answers, ask = [], query.pair_within
        for at, other_at in pairs[:count]:
            answers.append(ask(a, at, b, other_at))
        return answers

    def distance(count):
        answers, ask = [], query.pair_distance
        for at, other_at in pairs[:count]:
            answers.append(ask(a, at, b, other_at).distance)
        return answers

    def collide_batch(count):
        return batch.pair_within(a, poses_a[:count], b, poses_b[:count]).within

    def distance_batch(count):
        return batch.pair_distance(a, poses_a[:count], b, poses_b[:count]).distances

    single, whole = (collide, collide_batch) if query_name == "collide" else (distance, distance_batch)
    return [Way("cstk", "", single), Way("cstk batch", "", whole)]


def coal_mesh(coal, kind, mesh):
    points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for vertex in mesh.vertices:
        points.append(vertex)
    for face in mesh.faces.tolist():
        triangles.append(coal.Triangle(*face))
    model = kind()
    model.beginModel(len(mesh.faces), len(mesh.vertices))
    model.addSubModel(points, triangles)
    model.endModel()
    return model


def coal_ways(coal, scene, query_name):
    """By the function, by objects at their poses, and by what keeps the pair; with each kind of GJK and first guess. Distances without a
    sign, so that no depth is computed, and collisions without contacts. Meshes have the volumes that the module has.
    """
    collides = query_name == "collide"
    transforms = [[coal.Transform3s(pose[:, :3], pose[:, 3]) for pose in poses] for poses in scene.poses]

    def way(name, call, pairs, request, geometries):
        """Results are used again, and cleared: they would hold the answer before. What keeps a pair does not keep its geometries."""
        result = (coal.CollisionResult if collides else coal.DistanceResult)()

        def run(count):
            answers, clear = [], result.clear
            for given in pairs[:count]:
                clear()
                answers.append(call(*given, request, result))
            return answers

        return Way("Coal", name, run, geometries)

    def ways_of(geometries, prefix, guesses):
        first, second = geometries
        kept = (coal.ComputeCollision if collides else coal.ComputeDistance)(first, second)
        function = coal.collide if collides else coal.distance
        placed = [[coal.CollisionObject(one, at) for at in ats] for one, ats in zip(geometries, transforms)]
        calls = {
            "": (function, [(first, at, second, other_at) for at, other_at in zip(*transforms)]),
            " objects": (function, list(zip(*placed))),
            " kept": (kept, list(zip(*transforms))),
        }
        for variant, gjk in ("DefaultGJK", "GJK"), ("PolyakAcceleration", "Polyak"), ("NesterovAcceleration", "Nesterov"):
            for guess, guess_name in guesses.items():
                request = (coal.CollisionRequest if collides else coal.DistanceRequest)()
                request.gjk_variant, request.gjk_initial_guess = getattr(coal.GJKVariant, variant), getattr(coal.GJKInitialGuess, guess)
                if collides:
                    # GJK may end as soon as anything lies between.
                    request.enable_contact, request.distance_upper_bound, request.break_distance = False, 0.0, 0.0
                else:
                    request.enable_signed_distance = False
                for call_name, (call, pairs) in calls.items():
                    yield way(prefix + gjk + guess_name + call_name, call, pairs, request, geometries)

    if isinstance(scene.shapes[0], Box):
        boxes = [coal.Box(*(2 * half for half in shape.half_extents)) for shape in scene.shapes]
        return list(ways_of(boxes, "", {"DefaultGuess": "", "BoundingVolumeGuess": " volumes' guess"}))
    ways = []
    # OBBs have no distances.
    for volume in ("OBBRSS", "OBB") if collides else ("OBBRSS",):
        meshes = [coal_mesh(coal, getattr(coal, f"BVHModel{volume}"), shape) for shape in scene.shapes]
        ways += ways_of(meshes, f"{volume} ", {"DefaultGuess": ""})
    return ways


def fcl_geometry(fcl, shape):
    if isinstance(shape, Box):
        return fcl.Box(*(2 * half for half in shape.half_extents))
    model = fcl.BVHModel()
    model.beginModel(len(shape.faces), len(shape.vertices))
    model.addSubModel(shape.vertices, shape.faces)
    model.endModel()
    return model


def fcl_ways(fcl, scene, query_name):
    """With each of its solvers. The result stays over a pass: what its function returns is of the pair alone."""
    collides = query_name == "collide"
    geometries = [fcl_geometry(fcl, shape) for shape in scene.shapes]
    placed = [
        [fcl.CollisionObject(one, fcl.Transform(pose[:, :3], pose[:, 3])) for pose in poses]
        for one, poses in zip(geometries, scene.poses)
    ]
    pairs = list(zip(*placed))

    def way(name, solver):
        call, request = (fcl.collide, fcl.CollisionRequest) if collides else (fcl.distance, fcl.DistanceRequest)
        kept_request = request(gjk_solver_type=solver)

        def run(count):
            answers, result = [], (fcl.CollisionResult if collides else fcl.DistanceResult)()
            for a, b in pairs[:count]:
                answers.append(call(a, b, kept_request, result))
            return answers

        return Way("FCL", name, run)

    solvers = fcl.GJKSolverType
    return [way("libccd", solvers.GST_LIBCCD), way("indep", solvers.GST_INDEP)]


def peers():
    """The modules that can be imported, with their ways."""
    found = {}
    for library, module, package, ways in ("Coal", "coal", "coal", coal_ways), ("FCL", "fcl", "python-fcl", fcl_ways):
        try:
            found[library] = __import__(module), version(package), ways
        except ImportError as error:
            print(f"SKIPPED: {library}: its Python module {module} cannot be imported: {error}", file=sys.stderr)
    return found


def timed(way, count):
    start = time.perf_counter()
    answers = way.run(count)
    return time.perf_counter() - start, answers


def as_answers(query_name, answers):
    """Peers count contacts, and give meeting bodies distances of 0 or less."""
    values = np.asarray(answers, float)
    return values > 0 if query_name == "collide" else np.maximum(values, 0)


def doubtful(scene):
    """Which pairs are so near contact that they are not compared."""
    query, (a, b) = cstk.Query(), scene.bodies

    def is_doubtful(at, other_at):
        distance = query.pair_distance(a, at, b, other_at).distance
        if distance > 0:
            return distance <= DOUBT
        deepest = query.pair_penetration(a, at, b, other_at, 1)
        return not deepest or deepest[0].depth <= DOUBT

    return np.array([is_doubtful(*poses) for poses in zip(*scene.poses)])


def differing(query_name, ours, theirs, doubt):
    """Which answers differ, of pairs out of doubt."""
    differ = ours != theirs if query_name == "collide" else np.abs(ours - theirs) > TOLERANCE * np.maximum(ours, theirs)
    return differ & ~doubt[: len(differ)]


def fastest(ways, query_name, expected, doubt):
    """Of a peer's ways, the one that is measured."""
    count = min(TRIED, len(expected))

    def errors_and_time(way):
        errors = differing(query_name, expected[:count], as_answers(query_name, way.run(count)), doubt).sum()
        return errors if query_name == "collide" else 0, min(timed(way, count)[0] for _ in range(3))

    return min(ways, key=errors_and_time)


def row(scene, query_name, given, found, doubt):
    """Prints a row; whether the batch answers as single calls do."""
    ways = our_ways(scene, query_name)
    expected = as_answers(query_name, ways[0].run(given.items))
    for module, _, ways_of in found.values():
        ways.append(fastest(ways_of(module, scene, query_name), query_name, expected, doubt))
    seconds, answers = {way.library: [] for way in ways}, {}
    for _ in range(given.passes):
        for way in ways:
            taken, answers[way.library] = timed(way, given.items)
            seconds[way.library].append(taken)
    nanoseconds = {library: 1e9 * statistics.median(times) / given.items for library, times in seconds.items()}
    names = {way.library: way.name for way in ways}
    answers = {library: as_answers(query_name, some) for library, some in answers.items()}

    def time_of(library):
        if library not in names:
            return "-"
        return f"{nanoseconds[library]:.0f}" + (f" ({names[library]})" if names[library] else "")

    def count_of(one, other):
        if one not in names or other not in names:
            return "-"
        differ = differing(query_name, answers[one], answers[other], doubt)
        if query_name == "collide" or not differ.any():
            return differ.sum()
        return f"{differ.sum()}, by {np.abs(answers[one] - answers[other])[differ].max():.1g} at most"

    best = min((nanoseconds[library] for library in found), default=None)
    ratios = ["-" if best is None else f"{best / nanoseconds[library]:.2f}" for library in ("cstk", "cstk batch")]
    counts = [count_of(*pair) for pair in (("cstk", "Coal"), ("cstk", "FCL"), ("Coal", "FCL"))]
    cells = scene.name, query_name, *map(time_of, ("cstk", "cstk batch", "Coal", "FCL")), *ratios, *counts
    print(f"| {' | '.join(map(str, cells))} |", flush=True)
    return np.array_equal(answers["cstk"], answers["cstk batch"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--items", type=int, default=2000)
    parser.add_argument("--passes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    if given.items < 1 or given.passes < 1:
        parser.error("--items and --passes must be 1 or more")
    found = peers()
    versions = [f"cstk {version('cstk')}", *(f"{library} {number}" for library, (_, number, _) in found.items())]
    print(f"\n{', '.join(versions)}, Python {platform.python_version()}; {given.items} pairs a row, of {given.passes} passes the median\n")
    columns = "bodies", "query", "cstk one by one, ns", "cstk batch, ns", "Coal, ns", "FCL, ns", "best peer / one by one"
    columns += "best peer / batch", "cstk and Coal differ", "cstk and FCL differ", "Coal and FCL differ"
    print(f"| {' | '.join(columns)} |\n|{'---|' * len(columns)}")
    all_equal, notes = True, []
    for scene in scenes(given.items, given.seed):
        doubt = doubtful(scene)
        meet = cstk.Batch(threads=1).pair_within(scene.bodies[0], scene.poses[0], scene.bodies[1], scene.poses[1]).within
        notes.append(f"{scene.name}: {meet.sum()} of {given.items} pairs meet; {doubt.sum()} within {DOUBT:g} of contact, not compared.")
        for query_name in QUERIES:
            if not row(scene, query_name, given, found, doubt):
                all_equal = False
                notes.append(f"{scene.name}, {query_name}: THE BATCH DIFFERS FROM SINGLE CALLS.")
    print("", *notes, sep="\n")
    sys.exit(0 if all_equal else 1)


if __name__ == "__main__":
    main()
