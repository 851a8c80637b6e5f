#!/usr/bin/env bash
# Fetches the link meshes of the Puma 560 from the PyPI package rtb-data into a folder (default build/puma560). Prints
# the folder; fails loudly where the package cannot be had. What is there already is not fetched again.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/puma560}
if [ ! -e "$folder/link6.stl" ]; then
  mkdir -p "$folder"
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  echo "fetching rtb-data 2.0.0 (45 MB) for the Puma 560 meshes" >&2
  python3 -m pip download --quiet --no-deps --only-binary :all: --dest "$work" rtb-data==2.0.0 >&2
  python3 - "$work" "$folder" <<'PY'
import glob, os, sys, zipfile
work, folder = sys.argv[1:]
wheel = zipfile.ZipFile(glob.glob(os.path.join(work, "*.whl"))[0])
for link in range(7):
    data = wheel.read(f"rtbdata/meshes/UNIMATE/puma560/link{link}.stl")
    part = os.path.join(folder, f"link{link}.stl.part")
    with open(part, "wb") as out:
        out.write(data)
    os.replace(part, part[:-5])
PY
fi
echo "$folder"
