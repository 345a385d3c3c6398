#!/bin/sh
# dropin_corpus.sh: the drop-in commands, called as pipelines of the published code call them, against what that code gave.
#
#   tests/dropin_corpus.sh POLYLAB CORPUS
#
# CORPUS: a folder per model with surface.obj and any of naive.txt, graphcut.txt, reference.txt, each with NAME.stats.json;
# tet.mesh with surface_map.txt. Labels that are the same have to be the same bytes, as have maps and volume labels; statistics
# have the same lines, counts are equal and other numbers within 1e-6; surfaces have the same facets and feature edges in the
# same order. Last line: passed, failed.
[ $# -eq 2 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2; }
program=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
corpus=$(cd "$2" && pwd) || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
bin=$scratch/bin
mkdir "$bin"
for name in automatic_polycube labeling_stats naive_labeling graphcut_labeling extract_surface volume_labeling mesh_stats to_glTF \
    polycube_distortion; do
    ln -s "$program" "$bin/$name"
done

passed=0 failed=0 same=0 other=0
check() {   # what, then a command that has to succeed
    what=$1
    shift
    if "$@" >"$scratch/said" 2>&1; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "failed: $what"; cat "$scratch/said"; fi
}
# As many lines, and no newline at the end.
same_shape() { [ "$(wc -l <"$1")" -eq "$(wc -l <"$2")" ] && [ -n "$(tail -c 1 "$1")" ]; }
# Other labels are no failure, the same ones in other bytes are.
same_labels() {
    if cmp -s "$1" "$2"; then same=$((same + 1)); return 0; fi
    other=$((other + 1))
    same_shape "$1" "$2" && [ "$(tr -s '\n ' ' ' <"$1")" != "$(tr -s '\n ' ' ' <"$2")" ]
}
same_statistics() {
    awk -v other="$2" '
        function number(line) { sub(/^[^:]*: */, "", line); sub(/,$/, "", line); return line }
        { if ((getline theirs <other) <= 0) { print FNR ": more lines"; bad = 1; exit }
          a = $0; b = theirs; gsub(/: [-0-9.e]+/, ": N", a); gsub(/: [-0-9.e]+/, ": N", b)
          if (a != b) { print FNR ": " $0 " / " theirs; bad = 1 }
          x = number($0); y = number(theirs)
          if (x ~ /^[-0-9.]/) { d = x - y; if (d < 0) d = -d; if (x ~ /[.e]/ ? d > 1e-6 : x != y) { print FNR ": " $0 " / " theirs; bad = 1 } } }
        END { if (!bad && (getline theirs <other) > 0) { print "fewer lines"; bad = 1 }; exit bad }' "$1"
}
# But for blanks at the ends of lines.
elements() { sed -n "/^$2 /s/ *\$//p" "$1"; }
same_elements() { elements "$1" "$3" >"$scratch/a"; elements "$2" "$3" >"$scratch/b"; cmp "$scratch/a" "$scratch/b"; }
# The labels of the facets of all tetrahedra, from those of the surface.
expected_volume() {
    awk -v map="$2" '
        BEGIN { getline line <map; getline line <map; n = 4 * line }
        { getline at <map; label[at] = $1 }
        END { for (i = 0; i < n; i++) print i in label ? label[i] : -1 }' "$1"
}

for model in "$corpus"/*/; do
    model=${model%/} name=$(basename "$model") out=$scratch/out
    [ -e "$model/surface.obj" ] || continue
    rm -rf "$out" && mkdir "$out"
    surface=$model/surface.obj
    if [ -e "$model/naive.txt" ]; then
        check "$name: naive_labeling" "$bin/naive_labeling" "$surface" "$out/naive.txt"
        check "$name: labels of naive_labeling" same_labels "$out/naive.txt" "$model/naive.txt"
    fi
    if [ -e "$model/graphcut.txt" ]; then
        check "$name: graphcut_labeling" "$bin/graphcut_labeling" "$surface" compactness=1 fidelity=3 sensitivity=1e-9 \
            angle_of_rotation=0.05 gui=false output="$out/graphcut.txt"
        check "$name: labels of graphcut_labeling" same_labels "$out/graphcut.txt" "$model/graphcut.txt"
        check "$name: automatic_polycube" "$bin/automatic_polycube" "$surface" "$model/graphcut.txt" gui=false output="$out/surface_labeling.txt"
        check "$name: its labels, one per line" same_shape "$out/surface_labeling.txt" "$model/graphcut.txt"
    fi
    for method in naive graphcut reference; do
        [ -e "$model/$method.stats.json" ] || continue
        check "$name: labeling_stats of $method" "$bin/labeling_stats" "$surface" "$model/$method.txt" "$out/$method.json"
        check "$name: statistics of $method" same_statistics "$out/$method.json" "$model/$method.stats.json"
    done
    check "$name: mesh_stats" "$bin/mesh_stats" "$surface" "$out/surface.stats.json"
    check "$name: as many facets" grep -q "\"nb\": $(grep -c '^f' "$surface")," "$out/surface.stats.json"
    check "$name: to_glTF" "$bin/to_glTF" "$surface" "$out/labeled_mesh.glb" labeling="$model/naive.txt"
    [ -e "$model/tet.mesh" ] || continue
    check "$name: extract_surface" "$bin/extract_surface" "$model/tet.mesh" "$out/surface.obj" "$out/surface_map.txt"
    check "$name: its map" cmp "$out/surface_map.txt" "$model/surface_map.txt"
    check "$name: its facets" same_elements "$out/surface.obj" "$surface" f
    check "$name: its feature edges" same_elements "$out/surface.obj" "$surface" l
    check "$name: its vertices" test "$(grep -c '^v ' "$out/surface.obj")" -eq "$(grep -c '^v ' "$surface")"
    cp "$surface" "$out/theirs.obj"
    check "$name: a map for their surface" "$bin/extract_surface" "$model/tet.mesh" "$out/theirs.obj" "$out/again.txt"
    check "$name: the same map, and their surface stays" sh -c "cmp '$out/again.txt' '$model/surface_map.txt' && cmp '$out/theirs.obj' '$surface'"
    check "$name: volume_labeling" "$bin/volume_labeling" "$model/graphcut.txt" "$model/surface_map.txt" "$out/volume_labeling.txt"
    expected_volume "$model/graphcut.txt" "$model/surface_map.txt" >"$out/expected.txt"
    check "$name: volume labels" cmp "$out/volume_labeling.txt" "$out/expected.txt"
    check "$name: mesh_stats of tetrahedra" "$bin/mesh_stats" "$model/tet.mesh" "$out/tet_mesh.stats.json"
    check "$name: as many tetrahedra" grep -q "\"tetrahedra\": $(sed -n '2s/ .*//p' "$model/surface_map.txt")\$" "$out/tet_mesh.stats.json"
done
echo "label files: $same the same bytes, $other other labelings"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
