#!/usr/bin/env bash
# Builds the wheel of python/, installs it into a clean virtual environment, and runs its tests and examples there, and its tests
# once more on PyPy. The peers that answers are compared with (python-fcl, coal) come from PyPI; where one cannot be had, its tests are
# skipped and counted.
#
# --fast compiles the library with few optimizations and on all cores (a release is optimized as one unit, on one core); answers do
# not depend on it.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh python
work=$PWD/build/python
mkdir -p "$work"
export CARGO_TARGET_DIR=$work/target PIP_DISABLE_PIP_VERSION_CHECK=1
if [ "${1:-}" = --fast ]; then
  export CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 CARGO_PROFILE_RELEASE_OPT_LEVEL=1
fi

rm -rf "$work/wheels" "$work/venv"
python3 -m venv "$work/venv"
venv=$work/venv/bin
"$venv/pip" wheel --quiet --no-deps --wheel-dir "$work/wheels" ./python
echo "wheel: $(ls "$work/wheels")"
"$venv/pip" install --quiet "$work"/wheels/cstk-*.whl
# As a user has it: nothing but the wheel and what it asks for.
(cd / && "$venv/python" -c 'import cstk; cstk.Query()')
"$venv/pip" install --quiet pytest matplotlib mypy
for peer in python-fcl coal==3.0.3; do
  "$venv/pip" install --quiet --only-binary :all: "$peer" || echo "SKIPPED: $peer could not be installed" >&2
done

# The same wheel on PyPy meanwhile: each of the two takes one core.
on_pypy() {
  rm -rf "$work/pypy"
  pypy3 -m venv "$work/pypy"
  "$work/pypy/bin/pip" install --quiet --only-binary :all: pytest "$work"/wheels/cstk-*.whl
  run_tests "$work/pypy/bin/python"
}
# A test that hangs is ended, and pytest then says where it hung.
run_tests() { timeout --signal=ABRT 900 "$1" -m pytest -q -rs -p no:cacheprovider python/tests; }
(set -e; on_pypy) >"$work/pypy.log" 2>&1 &
pypy=$!
trap 'kill "$pypy" 2>/dev/null || true' EXIT

"$venv/python" -m mypy --config-file python/pyproject.toml -p cstk
run_tests "$venv/python"
for example in python/examples/*.py; do
  echo "== $example"
  MPLBACKEND=Agg "$venv/python" "$example" "$work/pictures"
done

echo "== the same wheel on $(pypy3 --version 2>&1 | grep PyPy)"
passed=0
wait "$pypy" || passed=$?
cat "$work/pypy.log"
exit "$passed"
