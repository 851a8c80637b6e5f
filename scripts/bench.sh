#!/usr/bin/env bash
# Runs a benchmark and prints its tables: bench.sh hierarchies | kernel | instructions | objects | robots | shapes | builds |
# motion | planners [--csv FILE] | batches | python | slides | accuracy. hierarchies also takes [--quick] [--clouds], the last for clouds
# of points alone; robots, builds and slides [--quick] [--seed N]; kernel, objects, shapes, motion, planners and batches [--quick]
# [--seed N] [--only TEXT], the last for the scenes whose names hold a text (of objects and batches, for the rows whose scene and name do;
# of shapes, for the rows whose group, bodies, poses and query do: "shapes box and box random collide"); planners [--samples N], for
# judging paths; python [--items N] [--passes N] [--seed N], for both of its tables: batches beside C, and pairs of bodies beside the
# Python modules of Coal and FCL; accuracy [PAIRS [SEED]].
set -euo pipefail
from=$PWD
cd "$(dirname "$0")/.."
case "${1:-}" in
  hierarchies | kernel | instructions | objects | robots | shapes | builds | motion | planners | batches | python | slides | accuracy) ;;
  *) echo "usage: bench.sh hierarchies | kernel | instructions | objects | robots | shapes | builds | motion | planners [--csv FILE] [--quick] [--clouds] [--seed N] [--only TEXT] | batches [--quick] [--seed N] [--only TEXT] | python [--items N] [--passes N] [--seed N] | slides [--quick] [--seed N] | accuracy [PAIRS [SEED]]" >&2; exit 2 ;;
esac
name=$1
shift
if [ "$name" = accuracy ]; then
  scripts/setup.sh test
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cmake -S capi-tests -B build/capi-tests -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
  cmake --build build/capi-tests --target accuracy >/dev/null
  exec build/capi-tests/accuracy "${1:-1000000}" "${2:-1}"
fi
if [ "$name" = slides ]; then
  robots=$(scripts/fetch_pinocchio.sh) || { echo "SKIPPED: the robots of example-robot-data could not be fetched" >&2; exit 77; }
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cmake -S benches/slides -B build/slides -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
  cmake --build build/slides -j2 >/dev/null
  exec build/slides/slides "$robots" "$@"
fi
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
if [ "$name" = objects ]; then
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cmake -S benches/objects -B build/objects -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
  cmake --build build/objects -j2 >/dev/null
  exec build/objects/objects "${arguments[@]}"
fi
if [ "$name" = builds ]; then
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  coal=$(scripts/fetch_coal.sh) || coal=
  cmake -S benches/builds -B build/builds -DCMAKE_PREFIX_PATH="$PWD/local" ${coal:+-DCOAL_FOLDER="$PWD/$coal"} >/dev/null
  cmake --build build/builds -j2 >/dev/null
  exec build/builds/builds "${arguments[@]}"
fi
if [ "$name" = motion ]; then
  # The program names the scenes that are left out.
  puma=$(scripts/fetch_puma560.sh) || puma=
  robots=$(scripts/fetch_pinocchio.sh) || robots=
  coal=$(scripts/fetch_coal.sh) || coal=
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cargo run --quiet --locked --release -p cstk-scenes --example write_scenes -- build/motion_models
  cmake -S benches/motion -B build/motion -DCMAKE_PREFIX_PATH="$PWD/local" ${coal:+-DCOAL_FOLDER="$PWD/$coal"} >/dev/null
  cmake --build build/motion -j2 >/dev/null
  exec build/motion/motion --models build/motion_models ${puma:+--puma "$puma"} ${robots:+--robots "$robots"} "${arguments[@]}"
fi
if [ "$name" = planners ]; then
  # The program names what is left out.
  puma=$(scripts/fetch_puma560.sh) || puma=
  panda=$(scripts/fetch_motion_bench_maker.sh) || panda=
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cmake -S benches/planners -B build/planners_bench -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
  cmake --build build/planners_bench -j2 --target planners >/dev/null
  exec build/planners_bench/planners ${puma:+--puma "$puma"} ${panda:+--panda "$panda"} "${arguments[@]}"
fi
if [ "$name" = batches ]; then
  # The program names what is left out.
  puma=$(scripts/fetch_puma560.sh) || puma=
  panda=$(scripts/fetch_motion_bench_maker.sh) || panda=
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  robots=$(scripts/fetch_pinocchio.sh) || robots=
  coal=$(scripts/fetch_coal.sh) || coal=
  cmake -S benches/batches -B build/batches -DCMAKE_PREFIX_PATH="$PWD/local" ${robots:+-DPINOCCHIO_FOLDER="$PWD/$robots"} \
    ${coal:+-DCOAL_FOLDER="$PWD/$coal"} >/dev/null
  cmake --build build/batches -j2 --target batches >/dev/null
  exec build/batches/batches ${puma:+--puma "$puma"} ${panda:+--panda "$panda"} "${arguments[@]}"
fi
if [ "$name" = python ]; then
  scripts/setup.sh python
  work=$PWD/build/python_bench
  export CARGO_TARGET_DIR=$work/target PIP_DISABLE_PIP_VERSION_CHECK=1
  rm -rf "$work/venv"
  python3 -m venv "$work/venv"
  "$work/venv/bin/pip" install --quiet ./python
  # The program names the peers that are left out.
  for peer in python-fcl coal==3.0.3; do
    "$work/venv/bin/pip" install --quiet --only-binary :all: "$peer" || echo "SKIPPED: $peer could not be installed" >&2
  done
  cc -O2 -shared -fPIC -Wall -Wextra -Iinclude benches/python/c_call.c -o "$work/c_call.so"
  status=0
  "$work/venv/bin/python" benches/python/batch_time.py "$work/c_call.so" models "${arguments[@]}" || status=$?
  "$work/venv/bin/python" benches/python/pair_peers.py "${arguments[@]}" || status=$?
  exit "$status"
fi
if [ "$name" = robots ]; then
  robots=$(scripts/fetch_pinocchio.sh) || { echo "SKIPPED: Pinocchio and its robots could not be fetched" >&2; exit 77; }
  coal=$(scripts/fetch_coal.sh) || { echo "SKIPPED: Coal could not be fetched" >&2; exit 77; }
  CARGO_TERM_QUIET=true scripts/install.sh >/dev/null
  cmake -S benches/robots -B build/robots -DCMAKE_PREFIX_PATH="$PWD/local" -DPINOCCHIO_FOLDER="$PWD/$robots" \
    -DCOAL_FOLDER="$PWD/$coal" >/dev/null
  cmake --build build/robots -j2 >/dev/null
  exec build/robots/robots "$robots" "${arguments[@]}"
fi
if [ "$name" != hierarchies ] && [ "$name" != shapes ]; then
  # A peer or a model that cannot be had is left out, and named.
  scripts/fetch_puma560.sh >/dev/null || true
fi
if [ "$name" = kernel ] || [ "$name" = shapes ]; then
  coal=$(scripts/fetch_coal.sh) || coal=
  cmake -S benches/peers -B build/peers ${coal:+-DCOAL_FOLDER="$PWD/$coal"} >/dev/null
  cmake --build build/peers -j2 >/dev/null
fi
cargo bench --quiet --locked --bench "$name" -- "${arguments[@]}"
