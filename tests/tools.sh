#!/bin/sh
# tools.sh: tools/cad2labels and tools/dataset on small parts. usage: tools.sh POLYLAB. Last line: passed, failed, skipped.
here=$(cd "$(dirname "$0")/.." && pwd)
POLYLAB=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
export POLYLAB
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0 skipped=0
check() {   # what, then a command that has to succeed
    what=$1
    shift
    if "$@" >"$scratch/said" 2>&1; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $what"; cat "$scratch/said"; fi
}
# A command that has to end with status 2 and one line that holds a text.
refused() {
    text=$1
    shift
    "$@" >"$scratch/refusal" 2>&1
    [ $? -eq 2 ] && [ "$(wc -l <"$scratch/refusal")" -eq 1 ] && grep -q -e "$text" "$scratch/refusal" || { cat "$scratch/refusal"; return 1; }
}
lines() { test "$(wc -l <"$1")" -eq "$2"; }

cad=$scratch/cad
mkdir -p "$cad"
cp "$here/golden/cases/gear/in.geo" "$cad/gear 1.geo"
echo 'no geometry' >"$cad/broken.step"
check "cad2labels: a file that is not there" refused "can't be read" "$here/tools/cad2labels" "$cad/none.step"
check "cad2labels: a file that is not CAD" refused "expected .step" "$here/tools/cad2labels" "$here/README.md"
check "cad2labels: a size that is no number" refused "above 0, found '0.0'" "$here/tools/cad2labels" "$cad/broken.step" --size 0.0
mkdir "$scratch/bin" && ln -s "$(command -v dirname)" "$(command -v readlink)" "$(command -v sed)" "$scratch/bin"
check "cad2labels: gmsh is missing" refused "apt-get install gmsh" env PATH="$scratch/bin" /bin/sh "$here/tools/cad2labels" "$cad/broken.step"
if command -v gmsh >/dev/null; then
    check "cad2labels: from CAD to labels" "$here/tools/cad2labels" "$cad/gear 1.geo" --size 1
    folder="$cad/gear 1.labeled"
    triangles=$(sed -n '1s/ triangles//p' "$folder/surface_map.txt") tets=$(sed -n '2s/ tetrahedra//p' "$folder/surface_map.txt")
    check "cad2labels: a label per triangle" lines "$folder/surface_labeling.txt" "$triangles"
    check "cad2labels: four per tetrahedron" lines "$folder/volume_labeling.txt" $((4 * tets))
    check "cad2labels: a report" grep -q '<title>gear 1.labeled/surface.obj' "$folder/report.html"
    check "cad2labels: a broken file" sh -c "! '$here/tools/cad2labels' '$cad/broken.step' && ! test -e '$cad/broken.labeled/tet.mesh'"
    rm -rf "$folder" "$cad/broken.labeled"
else
    echo "skipped: gmsh is not here (apt-get install gmsh): 5 tests"
    skipped=$((skipped + 5))
fi

if command -v snakemake >/dev/null; then
    parts=$scratch/parts
    mkdir -p "$parts/Basic" "$parts/Medium" "$parts/Simple"
    cp "$here/golden/cases/cube_12/in.obj" "$parts/Basic/B1.obj"
    cp "$here/golden/cases/roof/in.obj" "$parts/Basic/B10.obj"
    cp "$here/golden/cases/cube_45/in.obj" "$parts/Simple/S1.obj"
    head -n 20 "$here/golden/cases/gear/in.obj" >"$parts/Medium/M1.obj"
    check "dataset: no part" refused "expected parts" "$here/tools/dataset" "$scratch/bin" -o "$scratch/none"
    check "dataset: three parts, and one that fails" "$here/tools/dataset" "$parts" -o "$scratch/out" -j 2
    check "dataset: subsets in the paper's order" test "$(sed -n 's/ ([0-9]*),graph-cut.*//p' "$scratch/out/table.csv" | tr '\n' ' ')" = "Basic Simple Medium all "
    check "dataset: the part that fails is a quarter" grep -q '^all (4),polylab,.*,25.0 %,100.0 %,' "$scratch/out/table.csv"
    check "dataset: and says why" grep -q '^Medium/M1,Medium,polylab,failed,.*M1.obj' "$scratch/out/models.csv"
    check "dataset: each other has its picture on the page" test "$(grep -c '<img ' "$scratch/out/index.html")" -eq 3
    check "dataset: and its report" test -s "$scratch/out/models/Basic/B10/report.html"
    rm "$scratch/out/models/Basic/B1/row.json" "$scratch/out/index.html"   # as if the run had been ended before its end
    touch -r "$scratch/out/models/Basic/B10/row.json" "$scratch/mark"
    check "dataset: started again" "$here/tools/dataset" "$parts" -o "$scratch/out" -j 2
    check "dataset: what was missing is there" test -s "$scratch/out/models/Basic/B1/row.json"
    check "dataset: what is done is not done again" sh -c "! test '$scratch/out/models/Basic/B10/row.json' -nt '$scratch/mark'"
else
    echo "skipped: snakemake is not here (apt-get install snakemake): 10 tests"
    skipped=$((skipped + 10))
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
