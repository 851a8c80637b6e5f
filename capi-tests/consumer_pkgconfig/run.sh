#!/bin/sh
# Builds and runs a C and a C++ program with what pkg-config says, shared and static:
# run.sh PREFIX FOLDER
set -eu
prefix=$1
folder=$2
sources=$(cd "$(dirname "$0")/../consumer_cmake" && pwd)
mkdir -p "$folder"
cd "$folder"

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name cstk.pc | head -n 1)")
export PKG_CONFIG_PATH
version=$(pkg-config --modversion cstk)
cflags=$(pkg-config --cflags cstk)
libdir=$(pkg-config --variable=libdir cstk)
# -lcstk would take the shared library, where both are installed.
static="$libdir/libcstk.a $(pkg-config --static --libs-only-l cstk | sed 's/-lcstk//')"

build_and_run() {
    echo "$*"
    "$@"
    ./app "$version"
}

uses_shared() {
    readelf -d app | grep -q 'NEEDED.*\[libcstk\.so'
}

# The words of $cflags and of the others are arguments of their own.
# shellcheck disable=SC2046,SC2086
for language in c cpp; do
    compiler=${CC:-cc}
    [ $language = c ] || compiler="${CXX:-c++} -std=c++17"
    build_and_run $compiler $cflags "$sources/app.$language" -o app \
        $(pkg-config --libs cstk) -lm "-Wl,-rpath,$libdir"
    uses_shared
    build_and_run $compiler $cflags "$sources/app.$language" -o app $static
    if uses_shared; then
        echo "the static program needs the shared library"
        exit 1
    fi
done
