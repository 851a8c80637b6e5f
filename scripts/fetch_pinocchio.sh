#!/usr/bin/env bash
# Fetches Pinocchio's Python module, the libraries it needs, their headers (but Boost's, which fetch_coal.sh has), and the
# robots of example-robot-data (their URDF and SRDF files and collision meshes) from PyPI into a folder (default build/pinocchio).
# Prints the folder; fails loudly where a package cannot be had or the module does not load. What is there already is not
# fetched again, unless it is without headers or SRDF files.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/pinocchio}
packages=(pin==4.1.0 libpinocchio==4.1.0 coal==3.0.3 libcoal==3.0.3 eigenpy==3.13.0 numpy==2.4.6 cmeel-assimp==6.0.5
  cmeel-boost==1.90.0 cmeel-console-bridge==1.0.2.3 cmeel-octomap==1.10.0 cmeel-qhull==8.0.2.1 cmeel-tinyxml2==11.0.0
  cmeel-urdfdom==6.0.0 cmeel-urdfdom-headers==3.0.0 cmeel-zlib==1.3.2 example-robot-data==6.0.0)

# As Python finds the module: cmeel's wheels put theirs below cmeel.prefix.
check() {
  PYTHONDONTWRITEBYTECODE=1 python3 - "$1" <<'PY'
import os, sys
folder = os.path.abspath(sys.argv[1])
version = f"python{sys.version_info.major}.{sys.version_info.minor}"
modules = os.path.join(folder, "cmeel.prefix/lib", version, "site-packages")
robots = os.path.join(folder, "cmeel.prefix/share/example-robot-data/robots")
for needed in (modules, robots):
    if not os.path.isdir(needed):
        sys.exit(f"fetch_pinocchio.sh: no {needed}")
sys.path[:0] = [folder, modules]
import pinocchio
if not os.path.abspath(pinocchio.__file__).startswith(folder + os.sep):
    sys.exit(f"fetch_pinocchio.sh: the module found is {pinocchio.__file__}")
pinocchio.buildModelFromUrdf(os.path.join(robots, "panda_description/urdf/panda.urdf"))
PY
}

headers=$folder/cmeel.prefix/include/pinocchio
srdf=$folder/cmeel.prefix/share/example-robot-data/robots/panda_description/srdf
is_old() { [ -e "$folder/cmeel.prefix/share/example-robot-data" ] && { [ ! -e "$headers" ] || [ ! -e "$srdf" ]; }; }
if [ ! -e "$folder" ] || is_old; then
  work=$(mktemp -d)
  part=$folder.part.$$
  trap 'rm -rf "$work" "$part"' EXIT
  mkdir -p "$part"
  echo "fetching ${packages[*]} (220 MB) for Pinocchio" >&2
  python3 -m pip download --quiet --no-deps --no-cache-dir --only-binary :all: --dest "$work" "${packages[@]}" >&2
  python3 - "$work" "$part" <<'PY'
import glob, os, shutil, sys, zipfile
import xml.etree.ElementTree as ElementTree
work, folder = sys.argv[1:]
share = "cmeel.prefix/share/"
for path in glob.glob(os.path.join(work, "*.whl")):
    wheel = zipfile.ZipFile(path)
    robots = [name for name in wheel.namelist() if name.startswith(share) and name.endswith(".urdf")]
    wanted = set(robots)
    wanted |= {name for name in wheel.namelist() if name.startswith(share) and name.endswith(".srdf")}
    for robot in robots:
        for mesh in ElementTree.fromstring(wheel.read(robot)).iterfind(".//collision//mesh"):
            # package://example-robot-data/robots/...; one package goes by the name of its folder.
            name = mesh.get("filename").partition("://")[2].lstrip("/")
            wanted |= {share + name, share + "example-robot-data/robots/" + name}
    written = {}
    for entry in wheel.infolist():
        name = entry.filename
        is_kept = not name.startswith("cmeel.prefix/") or name.startswith(("cmeel.prefix/lib", "cmeel.prefix/include/"))
        is_left_out = not is_kept or name.startswith("cmeel.prefix/include/boost/")
        if name.endswith((".a", "/")) or "/tests/" in name or is_left_out and name not in wanted:
            continue
        target = os.path.join(folder, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        # A wheel holds a library once for each of its names.
        same = written.setdefault((entry.CRC, entry.file_size), target)
        if same is not target:
            os.link(same, target)
            continue
        with open(target, "wb") as out:
            shutil.copyfileobj(wheel.open(entry), out)
PY
  check "$part"
  if is_old; then rm -rf "$folder"; fi
  mv -T "$part" "$folder"
fi
check "$folder"
echo "$folder"
