#!/usr/bin/env bash
# Runs all tests: formatting and lints, Rust, the models, then the C, C++ and FCL tests (with valgrind), the examples and
# the planners against the library as installed into a prefix, and the Python package from its wheel.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh test

# A release is optimized as one unit, on one core: the other one meanwhile compiles what the Rust tests need.
mkdir -p build
setsid scripts/install.sh >build/install.log 2>&1 &
install=$!
trap 'kill -- "-$install" 2>/dev/null || true' EXIT

echo "== formatting and lints"
cargo fmt --all -- --check
cargo clippy --quiet --locked --workspace --all-targets -- -D warnings

echo "== Rust tests"
cargo test --locked --workspace --no-fail-fast
cargo run --quiet --locked --example generate_models -- --check

echo "== the installed library"
installed=0
wait "$install" || installed=$?
trap - EXIT
cat build/install.log
[ "$installed" = 0 ] || exit "$installed"
scripts/fetch_puma560.sh || echo "SKIPPED: the Puma 560 meshes could not be fetched" >&2
scripts/fetch_motion_bench_maker.sh >/dev/null || echo "SKIPPED: MotionBenchMaker's problems could not be fetched" >&2
scripts/fetch_pinocchio.sh >/dev/null || echo "SKIPPED: Pinocchio and the robots it comes with could not be fetched" >&2
build_and_test() {
  cmake -S "$1" -B "$2" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PWD/local" >/dev/null
  cmake --build "$2" -j "$(nproc)"
  ctest --test-dir "$2" --output-on-failure --no-tests=error -j "$(nproc)"
}
build_and_test examples-c build/examples
build_and_test capi-tests build/capi-tests
build_and_test planners build/planners
build_and_test integrations/ompl build/ompl

echo "== Python"
scripts/python_tests.sh --fast

echo "== the reference pages"
mkdir -p build/doxygen
doxygen docs/Doxyfile && echo "build/doxygen/html: no warnings"
