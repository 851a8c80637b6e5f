#!/usr/bin/env bash
# Builds the library and installs it into the prefix local/ (or the one given).
set -euo pipefail
case "${1:-}" in
  -*) echo "usage: install.sh [PREFIX]" >&2; exit 2 ;;
esac
cd "$(dirname "$0")/.."
prefix=${1:-$PWD/local}
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build build
cmake --install build --prefix "$prefix" >/dev/null
echo "installed into $prefix"
