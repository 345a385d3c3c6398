#!/usr/bin/env bash
# make_cases.sh [NAME...]: remakes golden/cases/NAME/in.obj, or all of them. Shapes come from tools/make_shapes.cpp, CAD parts
# from in.geo by gmsh (https://gmsh.info, version 4.8.4; another version makes other triangles). Only remaking needs gmsh:
# the tests take the files as they are. Environment: builddir=DIR for the library, as for make.
set -euo pipefail
cd "$(dirname "$0")/.."
builddir=${builddir:-build}
cases=golden/cases
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

make --no-print-directory builddir="$builddir"
"${CXX:-g++}" -std=c++17 -O2 -ffp-contract=off -Iinclude -o "$scratch/make_shapes" tools/make_shapes.cpp tests/shapes.cpp "$builddir/libpolylab.a"

from_geo() {
    gmsh "$1" -2 -nt 1 -format mesh -o "$scratch/part.mesh" >"$scratch/log" 2>&1 || { cat "$scratch/log"; return 1; }
    "$scratch/make_shapes" convert "$scratch/part.mesh" "$2"
}

shapes=$("$scratch/make_shapes")
parts=$(for geo in "$cases"/*/in.geo; do basename "$(dirname "$geo")"; done)
status=0
for name in ${*:-$shapes $parts}; do
    mkdir -p "$cases/$name"
    if [ -e "$cases/$name/in.geo" ]; then
        from_geo "$cases/$name/in.geo" "$cases/$name/in.obj"
    else
        "$scratch/make_shapes" "$name" >"$scratch/in.obj"
        cp "$scratch/in.obj" "$cases/$name/in.obj"
    fi
    if [ ! -s "$cases/$name/about.txt" ]; then
        echo "$cases/$name/about.txt: expected one sentence that says what the case is there for" >&2
        status=1
    fi
done
exit $status
