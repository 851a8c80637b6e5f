#!/usr/bin/env bash
# Fetches MotionBenchMaker's problems for the Panda (Chamzas et al., 2022; 7 scenes of 100 problems), with the robot's URDF, SRDF
# and collision meshes, from the source package of vamp-planner on PyPI into a folder (default build/motion_bench_maker). Prints
# the folder; fails loudly where the package cannot be had. What is there already is not fetched again.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/motion_bench_maker}
if [ ! -e "$folder" ]; then
  work=$(mktemp -d)
  part=$folder.part.$$
  trap 'rm -rf "$work" "$part"' EXIT
  mkdir -p "$part"
  echo "fetching vamp-planner 0.6.4 (65 MB) for MotionBenchMaker's problems" >&2
  python3 -m pip download --quiet --no-deps --no-cache-dir --no-binary vamp-planner --dest "$work" vamp-planner==0.6.4 >&2
  python3 - "$work" "$part" <<'PY'
import glob, io, os, sys, tarfile
work, folder = sys.argv[1:]
inside = "/resources/panda/"

def write(name, data):
    path = os.path.join(folder, name)
    if not os.path.abspath(path).startswith(os.path.abspath(folder) + os.sep):
        sys.exit(f"fetch_motion_bench_maker.sh: {name} leads out of the folder")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as out:
        out.write(data)

with tarfile.open(glob.glob(os.path.join(work, "*.tar.gz"))[0]) as package:
    for entry in package:
        name = entry.name.partition(inside)[2]
        if not entry.isfile():
            continue
        if name in ("panda.urdf", "panda.srdf") or name.startswith("meshes/collision/"):
            write(name, package.extractfile(entry).read())
        elif name == "problems.tar.bz2":
            with tarfile.open(fileobj=io.BytesIO(package.extractfile(entry).read())) as problems:
                for problem in problems:
                    if problem.isfile():
                        write(problem.name, problems.extractfile(problem).read())
PY
  for needed in panda.urdf panda.srdf meshes/collision/hand.obj problems/cage_panda/scene0100.yaml; do
    [ -s "$part/$needed" ] || { echo "fetch_motion_bench_maker.sh: no $needed in the package" >&2; exit 1; }
  done
  mv -T "$part" "$folder"
fi
echo "$folder"
