#!/bin/sh
# golden.sh: compares a program with the golden cases, or rewrites named ones. golden/README.md is the contract.
#
#   tools/golden.sh compare PROGRAM [GOLDEN_DIR]         all cases; status 0 only if every stage of every case is equal
#   tools/golden.sh update PROGRAM CASE...               rewrites these cases and golden/corpus.csv; status 2 always
#
# PROGRAM is anything that answers `PROGRAM stage NAME PART` with the text of that stage on standard output.
here=$(cd "$(dirname "$0")/.." && pwd)
mode=$1 program=$2
[ $# -ge 2 ] || { sed -n '2,7s/^# *//p' "$0" >&2; exit 2; }
shift 2
golden=$here/golden
[ "$mode" = compare ] && [ $# -gt 0 ] && golden=$1
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
stages="mesh costs naive tilted graphcut graph turning-points trace labels statistics"

part_of() { ls "$golden/cases/$1"/*.obj "$golden/cases/$1"/*.mesh 2>/dev/null | head -n 1; }
file_of() { echo "$golden/cases/$1/$(echo "$stages" | tr ' ' '\n' | grep -nx "$2" | cut -d: -f1 | sed 's/^.$/0&/')-$2.txt"; }
run() { "$program" stage "$2" "$(part_of "$1")" >"$scratch/actual" 2>"$scratch/error"; }

# One row of corpus.csv, from the stages as they are in the files.
row() {
    statistics=$(file_of "$1" statistics) labels=$(file_of "$1" labels)
    set -- "$1" $(cat "$statistics" | tr -dc '0-9 \n' | sed 's/^ *//')
    echo "$1,$(wc -l <"$labels" | tr -d ' '),$2,$3,$4,$5,$6,$7,$8,$9,${15},$(cksum <"$labels" | cut -d' ' -f1)"
}
head="case,facets,charts,invalid_charts,boundaries,invalid_boundaries,non_monotone_boundaries,corners,invalid_corners,turning_points,fidelity_avg_millionths,labels_cksum"
table() {
    echo "$head"
    for case in "$golden"/cases/*/; do row "$(basename "$case")"; done
}

failed=0 passed=0
check() {
    for stage in $stages; do
        expected=$(file_of "$1" "$stage")
        if [ ! -f "$expected" ]; then echo "$1: stage $stage: no golden file"; return 1; fi
        if ! run "$1" "$stage"; then echo "$1: stage $stage: the program failed: $(head -n 1 "$scratch/error")"; return 1; fi
        tr -d '\r' <"$expected" | sed -e '$a\' >"$scratch/expected"
        tr -d '\r' <"$scratch/actual" | sed -e '$a\' >"$scratch/lines"
        cmp -s "$scratch/expected" "$scratch/lines" && continue
        line=$(cmp "$scratch/expected" "$scratch/lines" 2>/dev/null | sed 's/.*line //')
        if [ -z "$line" ]; then line=$(($(cat "$scratch/expected" "$scratch/lines" | wc -l) / 2 + 1)); fi
        echo "$1: stage $stage differs first at line $line"
        echo "  expected: $(sed -n "${line}p" "$scratch/expected")"
        echo "  found:    $(sed -n "${line}p" "$scratch/lines")"
        echo "  see all:  $program stage $stage $(part_of "$1") | diff $expected -"
        return 1
    done
}

case $mode in
compare)
    [ -d "$golden/cases" ] || { echo "$golden/cases: no golden cases"; exit 1; }
    for case in "$golden"/cases/*/; do
        if check "$(basename "$case")"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    done
    table 2>/dev/null | cmp -s - "$golden/corpus.csv" || { echo "$golden/corpus.csv does not say what the cases say"; failed=$((failed + 1)); }
    echo "golden: $passed cases equal, $failed different"
    [ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
    ;;
update)
    [ $# -gt 0 ] || { echo "update: name the cases" >&2; exit 2; }
    for case in "$@"; do
        [ -n "$(part_of "$case")" ] || { echo "$case: no input (.obj or .mesh)" >&2; exit 2; }
        for stage in $stages; do
            file=$(file_of "$case" "$stage")
            run "$case" "$stage" || { cat "$scratch/error" >&2; exit 2; }
            if [ ! -f "$file" ]; then echo "$case: stage $stage is new"; elif ! cmp -s "$file" "$scratch/actual"; then
                echo "$case: stage $stage: $(diff "$file" "$scratch/actual" | grep -c '^>') lines differ"
            fi
            cp "$scratch/actual" "$file"
        done
    done
    table >"$golden/corpus.csv"
    echo "rewritten, not verified: read the differences, then run make golden"
    exit 2
    ;;
*) echo "expected compare or update, found $mode" >&2; exit 2 ;;
esac
