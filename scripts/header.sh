#!/usr/bin/env bash
# Rewrites include/cstk.h from the Rust sources.
set -euo pipefail
cd "$(dirname "$0")/.."
CSTK_UPDATE_HEADER=1 cargo test --quiet --test repo_rules header_is_current
