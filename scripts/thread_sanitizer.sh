#!/usr/bin/env bash
# Runs the test of environments that change under queries with ThreadSanitizer: thread_sanitizer.sh [SECONDS]. It needs a nightly
# toolchain with rust-src (rustup toolchain install nightly -c rust-src), and builds the standard library with it.
set -euo pipefail
cd "$(dirname "$0")/.."
export CSTK_STRESS_SECONDS=${1:-20} RUSTFLAGS=-Zsanitizer=thread
target=$(rustc +nightly -vV | sed -n 's/^host: //p')
exec cargo +nightly test -Zbuild-std --target "$target" --target-dir target/tsan --test queries environment_threads -- --nocapture
