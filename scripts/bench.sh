#!/usr/bin/env bash
# Runs a benchmark and prints its tables: bench.sh hierarchies [--csv FILE] [--quick].
set -euo pipefail
from=$PWD
cd "$(dirname "$0")/.."
case "${1:-}" in
  hierarchies) ;;
  *) echo "usage: bench.sh hierarchies [--csv FILE] [--quick]" >&2; exit 2 ;;
esac
name=$1
shift
arguments=()
while [ $# -gt 0 ]; do
  if [ "$1" = --csv ]; then
    # Relative to where the caller stands.
    case "${2:?--csv needs a file}" in /*) file=$2 ;; *) file=$from/$2 ;; esac
    arguments+=(--csv "$file")
    shift
  else
    arguments+=("$1")
  fi
  shift
done
scripts/setup.sh bench
cargo bench --quiet --locked --bench "$name" -- "${arguments[@]}"
