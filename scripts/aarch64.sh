#!/usr/bin/env bash
# Builds the library and its tests for aarch64 and runs the tests under qemu: aarch64.sh [SECONDS]. A program of tests is
# stopped after so many seconds (default 120): those of its tests that have not answered by then are named and counted as
# skipped. Campaigns are reduced by their environment variables. C tests, against the shared library, follow the Rust tests.
# The standard library for aarch64 comes from rustup, or, where rustup cannot fetch it, with Debian's own Rust.
set -euo pipefail

# As the runner of cargo: one program, its tests all at once, so that slow ones hold up no others.
if [ "${1:-}" = --program ]; then
  shift
  emulated=(qemu-aarch64 -L /usr/aarch64-linux-gnu "$@")
  case $1 in */deps/*) emulated+=(--test-threads 16) ;; esac
  said=$(mktemp)
  trap 'rm -f "$said"' EXIT
  code=0
  timeout "$CSTK_PROGRAM_SECONDS" "${emulated[@]}" >"$said" 2>&1 || code=$?
  cat "$said"
  [ $code = 124 ] || exit $code
  passed=$(grep -c '^test .* \.\.\. ok$' "$said" || true)
  failed=$(grep -c '^test .* \.\.\. FAILED$' "$said" || true)
  left=0
  while read -r name; do
    grep -qE "^test ${name//[.]/\\.}( - should panic)? \.\.\. (ok|FAILED|ignored.*)$" "$said" && continue
    echo "SKIPPED: ${1##*/} $name: no answer within $CSTK_PROGRAM_SECONDS s"
    left=$((left + 1))
  done < <("${emulated[@]}" --list | sed -n 's/: test$//p')
  echo "test result: stopped. $passed passed; $failed failed; $left ignored"
  [ "$failed" = 0 ]
  exit
fi

cd "$(dirname "$0")/.."
scripts/setup.sh aarch64
target=aarch64-unknown-linux-gnu
folder=build/aarch64
cargo=cargo
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER="$PWD/scripts/aarch64.sh --program"
export CSTK_PROGRAM_SECONDS=${1:-120} CSTK_OVERLAP_PAIRS=5000 CSTK_STRESS_SECONDS=2
if ! timeout 60 rustup target add "$target" >/dev/null 2>&1; then
  echo "rustup has no standard library for $target: Debian's Rust is taken" >&2
  scripts/setup.sh aarch64-rust
  cargo=/usr/bin/cargo
  export RUSTC=/usr/bin/rustc RUSTDOC=/usr/bin/rustdoc
fi

echo "== Rust tests for $target"
mkdir -p "$folder"
"$cargo" test --no-run --quiet --locked --workspace --target "$target" --target-dir "$folder"
log=$folder/tests.log
failed_programs=0
"$cargo" test --no-fail-fast --locked --workspace --target "$target" --target-dir "$folder" >"$log" 2>&1 || failed_programs=1
shown='^SKIPPED|^ +(Running|Doc-tests) |^test .*(FAILED|ignored)|panicked at|^test result|process didn.t exit|^error'
grep -E "$shown" "$log" || true

echo "== C tests for $target"
built=$folder/$target/debug/deps
c=$folder/c
mkdir -p "$c"
cp "$built/libcstk.so" "$c/libcstk.so.0.1"
ln -sf libcstk.so.0.1 "$c/libcstk.so"
c_passed=0
c_failed=0
for name in pure_sets environment predicates files threads; do
  aarch64-linux-gnu-gcc -std=c99 -D_POSIX_C_SOURCE=200809L -O1 -Wall -Wextra -Iinclude \
    capi-tests/{"$name",fixture,bodies,robots,cube}.c -L"$c" -Wl,-rpath,"$PWD/$c" -lcstk -lm -pthread -o "$c/$name"
  code=0
  (cd "$c" && timeout "$CSTK_PROGRAM_SECONDS" qemu-aarch64 -L /usr/aarch64-linux-gnu "./$name") || code=$?
  if [ $code = 0 ]; then
    echo "$name: passed"
    c_passed=$((c_passed + 1))
  else
    echo "$name: FAILED, exit code $code"
    c_failed=$((c_failed + 1))
  fi
done

# Programs without a closing line ended badly: each counts as a failure.
awk -v passed="$c_passed" -v failed="$c_failed" '
  /^ +Running .*\(.*\)$|^ +Doc-tests / { programs++ }
  /^test result: / { results++; gsub(/[^0-9 ]/, ""); split($0, n, " "); passed += n[1]; failed += n[2]; skipped += n[3] }
  END {
    if (programs > results) { print "programs without a result: " programs - results; failed += programs - results }
    printf "%d passed, %d failed, %d skipped\n", passed, failed, skipped
    exit failed > 0
  }' "$log" && [ $failed_programs = 0 ]
