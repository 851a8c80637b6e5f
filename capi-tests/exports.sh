#!/bin/sh
# The shared library exports what the header declares and nothing else, and carries its SONAME: exports.sh LIBRARY HEADER
set -eu
library=$1
header=$2
exported=$(nm -D --defined-only "$library" | awk '{print $3}' | sort)
declared=$(sed -n 's/^[a-z].*[ *]\(cstk_[a-z_0-9]*\)(.*/\1/p' "$header" | sort)
if [ "$exported" != "$declared" ]; then
    echo "exported (<) and declared (>) differ:"
    echo "$exported" >/tmp/cstk_exported.$$
    echo "$declared" | diff /tmp/cstk_exported.$$ - || true
    rm -f /tmp/cstk_exported.$$
    exit 1
fi
version=$(sed -n 's/^#define CSTK_VERSION_\(MAJOR\|MINOR\) //p' "$header" | paste -sd.)
readelf -d "$library" | grep -q "SONAME.*\[libcstk.so.$version\]" || {
    echo "the SONAME is not libcstk.so.$version"
    exit 1
}
echo "$(echo "$exported" | wc -l) functions exported, all declared; SONAME libcstk.so.$version"
