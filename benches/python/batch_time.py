"""How long a batch of classes takes from Python beside the same call from C: `scripts/bench.sh python`.

    batch_time.py C_CALL.so MODELS [--items N] [--passes N] [--seed N]

Both call one library, with the same C-object, configurations and number of threads, in turn; the least time of each counts. Ends with 1
where a class differs.
"""

import argparse
import ctypes
import sys
import time
from pathlib import Path

import numpy as np

import cstk
from cstk._native import ffi, lib
from cstk._options import options


def planar_arm():
    """Two capsules and a disc: items that cost little, so that the rest of a call shows."""
    link = cstk.Body.capsule([0, 0, 0], [1, 0, 0], 0.1, dimension=2)
    builder = cstk.RobotBuilder(2)
    first = builder.add_link(cstk.JointKind.REVOLUTE, body=link)
    builder.add_link(cstk.JointKind.REVOLUTE, body=link, parent=first, at=cstk.translation(1, 0, 0))
    environment = cstk.Environment()
    environment.add(cstk.Body.sphere(0.5, dimension=2), cstk.translation(0, 2.2, 0))
    return builder, environment, 2


def appendix_arm(models):
    """The arm of the report's Appendix A and its cylinder."""
    body = {name: cstk.Body.mesh_file(models / f"{name}.obj") for name in ("puma_shoulder", "puma_upper_arm", "puma_forearm", "cylinder")}
    places = [0, 0, 0, 0, 0, 0], [0, 2.875, 0, 0, 0, np.pi / 2], [6.5, 0, -2.125, 0, 0, 0]
    builder, parent = cstk.RobotBuilder(3), None
    for name, place in zip(list(body)[:3], places):
        parent = builder.add_link(cstk.JointKind.REVOLUTE, body=body[name], parent=parent, at=cstk.pose_from_euler(place))
    environment = cstk.Environment()
    environment.add(body["cylinder"], cstk.pose_from_euler([9.27, 10.06, -2.44, 1.11, 0.88, -0.8]))
    return builder, environment, 3


class CallFromC:
    """The batch as C asks it, with arrays that are kept from call to call."""

    def __init__(self, library, cobject, q, threads):
        self.batch, self.cobject, self.q = cstk.Batch(threads=threads), cobject, q
        self.options = options("batch_options", threads=threads)
        self.classes, self.statuses = np.empty(len(q), np.int32), np.empty(len(q), np.int32)
        self.call = ctypes.CDLL(library).c_call
        self.call.restype = ctypes.c_double

    def seconds(self):
        def address(pointer):
            return ctypes.c_void_p(int(ffi.cast("uintptr_t", pointer)))

        def array(values):
            return ctypes.c_void_p(values.ctypes.data)

        count, nq = (ctypes.c_size_t(side) for side in self.q.shape)
        taken = self.call(
            *map(address, (ffi.addressof(lib, "cstk_classify_batch"), self.batch._pointer, self.cobject._pointer)),
            array(self.q),
            count,
            nq,
            address(self.options),
            array(self.classes),
            array(self.statuses),
        )
        if taken < 0:
            raise RuntimeError("the call from C failed")
        return taken


def measured(scene, threads, given):
    """The least seconds from C and from Python, and whether all classes are equal."""
    builder, environment, nq = scene
    cobject = cstk.CObject.induced(cstk.Space(builder.build()), environment)
    q = np.random.default_rng(given.seed).uniform(-np.pi, np.pi, (given.items, nq))
    from_c, batch = CallFromC(given.c_call, cobject, q, threads), cstk.Batch(threads=threads)
    least_c = least_python = float("inf")
    for _ in range(given.passes):
        least_c = min(least_c, from_c.seconds())
        start = time.perf_counter()
        answers = batch.classify(cobject, q)
        least_python = min(least_python, time.perf_counter() - start)
    return least_c, least_python, np.array_equal(answers.classes, from_c.classes)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("c_call")
    parser.add_argument("models", type=Path)
    parser.add_argument("--items", type=int, default=100_000)
    parser.add_argument("--passes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    print("| arm | items | threads | C, ms | Python, ms | ratio | equal |\n|---|---|---|---|---|---|---|")
    all_equal = True
    scenes = {"planar, two capsules": planar_arm(), "of Appendix A, meshes": appendix_arm(given.models)}
    for name, scene in scenes.items():
        for threads in 1, 2:
            c, python, equal = measured(scene, threads, given)
            all_equal &= equal
            row = name, given.items, threads, f"{1e3 * c:.1f}", f"{1e3 * python:.1f}", f"{python / c:.3f}", "yes" if equal else "NO"
            print(f"| {' | '.join(map(str, row))} |", flush=True)
    sys.exit(0 if all_equal else 1)


if __name__ == "__main__":
    main()
