#!/usr/bin/env bash
# Installs the Debian packages that the other scripts need and that are missing: setup.sh demo | test | bench.
set -euo pipefail

common=(cmake g++ make pkg-config)
case "${1:-}" in
  demo) packages=("${common[@]}" python3-pip f3d xvfb xauth imagemagick librsvg2-bin fonts-dejavu-core) ;;
  bench) packages=("${common[@]}" python3-pip libfcl-dev libeigen3-dev valgrind) ;;
  test) packages=("${common[@]}" python3-pip clang valgrind binutils libfcl-dev) ;;
  *) echo "usage: setup.sh demo|test|bench" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "installing ${missing[*]}"
  as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" >/dev/null
fi
