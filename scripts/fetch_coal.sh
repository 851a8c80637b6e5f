#!/usr/bin/env bash
# Fetches the headers and the library of Coal 3, and the libraries it needs, from the PyPI packages libcoal and coal into
# a folder (default build/coal). Prints the folder; fails loudly where a package cannot be had or the library does not
# load. What is there already is not fetched again.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/coal}
packages=(libcoal==3.0.3 coal==3.0.3 cmeel-assimp==6.0.5 cmeel-boost==1.90.0 cmeel-octomap==1.10.0 cmeel-qhull==8.0.2.1
  cmeel-zlib==1.3.2)
if [ ! -e "$folder/lib/libcoal.so" ]; then
  mkdir -p "$folder"
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  echo "fetching ${packages[*]} (60 MB) for Coal" >&2
  python3 -m pip download --quiet --no-deps --only-binary :all: --dest "$work" "${packages[@]}" >&2
  python3 - "$work" "$folder" <<'PY'
import glob, os, shutil, sys, zipfile
work, folder = sys.argv[1:]
prefix, unpacked = "cmeel.prefix/", os.path.join(work, "unpacked")
wheels = glob.glob(os.path.join(work, "*.whl"))
# Everything under the prefix is kept but Python modules; the library itself comes last, since its presence means done.
wheels.sort(key=lambda path: os.path.basename(path).startswith("libcoal-"))
for path in wheels:
    wheel = zipfile.ZipFile(path)
    for entry in wheel.infolist():
        name = entry.filename
        if not name.startswith((prefix + "include/", prefix + "lib/", prefix + "lib64/")) or name.endswith("/"):
            continue
        name = name[len(prefix):].replace("lib64/", "lib/", 1)
        if "/python" in name or name.endswith(".a"):
            continue
        target = os.path.join(folder, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target + ".part", "wb") as out:
            shutil.copyfileobj(wheel.open(entry), out)
        os.replace(target + ".part", target)
PY
fi
for file in include/coal/collision.h lib/libcoal.so; do
  [ -e "$folder/$file" ] || { echo "fetch_coal.sh: no $file in $folder" >&2; exit 1; }
done
if missing=$(ldd "$folder/lib/libcoal.so" | grep "not found"); then
  echo "fetch_coal.sh: libcoal.so lacks libraries:" "$missing" >&2
  exit 1
fi
echo "$folder"
