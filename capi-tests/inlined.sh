#!/bin/sh
# No instruction of the processor is left as a function of its own: inlined.sh LIBRARY. The compiler leaves one where a closure around it
# was not compiled for the processor; each use is then a call, and what should be fast takes twice as long.
set -eu
names=$(nm -C "$1" 2>/dev/null || true)
if [ -z "$names" ]; then
    echo "SKIPPED: $1 has no names of functions"
    exit 77
fi
left=$(echo "$names" | grep -E 'core_arch::(x86|aarch64|arm_shared)' | grep -v xgetbv || true)
if [ -n "$left" ]; then
    echo "left as functions:"
    echo "$left"
    exit 1
fi
echo "all instructions are inlined"
