#!/usr/bin/env bash
# Installs the Debian packages that the other scripts need and that are missing: setup.sh demo | test | bench | python |
# aarch64 | aarch64-rust.
set -euo pipefail

common=(cmake g++ make pkg-config)
case "${1:-}" in
  demo) packages=("${common[@]}" python3-pip f3d xvfb xauth imagemagick librsvg2-bin fonts-dejavu-core libyaml-cpp-dev) ;;
  bench) packages=("${common[@]}" python3-pip libfcl-dev libeigen3-dev libompl-dev libyaml-cpp-dev valgrind) ;;
  test) packages=("${common[@]}" python3-pip clang valgrind binutils doxygen libfcl-dev libeigen3-dev libompl-dev libyaml-cpp-dev
    libopenmpi-dev openmpi-bin procps) ;;
  python) packages=(python3-pip python3-venv pypy3 pypy3-venv) ;;
  aarch64) packages=(gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user) ;;
  aarch64-rust) packages=(rustc-web cargo-web libstd-rust-web-dev:arm64) ;;
  *) echo "usage: setup.sh demo|test|bench|python|aarch64|aarch64-rust" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "installing ${missing[*]}"
  as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  [ "$1" != aarch64-rust ] || "${as_root[@]}" dpkg --add-architecture arm64
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-remove --no-install-recommends \
    "${missing[@]}" >/dev/null
fi
