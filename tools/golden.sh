#!/bin/sh
# golden.sh: compares a program with the golden cases, or rewrites named ones. golden/README.md is the contract.
#
#   tools/golden.sh compare PROGRAM [-d GOLDEN_DIR] [-u LAST_STAGE] [CASE...]   status 0 only if all stages are equal
#   tools/golden.sh update PROGRAM CASE...              rewrites these cases and golden/corpus.csv; status 2 always
#
# PROGRAM is anything that answers `PROGRAM stages PART DIR` by writing the stages into the files 01-mesh.txt …
# 10-statistics.txt of the folder DIR.
here=$(cd "$(dirname "$0")/.." && pwd)
mode=$1 program=$2
[ $# -ge 2 ] || { sed -n '2,8s/^# *//p' "$0" >&2; exit 2; }
shift 2
golden=$here/golden
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
stages="01-mesh 02-costs 03-naive 04-tilted 05-graphcut 06-graph 07-turning-points 08-trace 09-labels 10-statistics"

while [ $# -ge 2 ]; do
    case $1 in
    -d) golden=$2 ;;
    -u) stages="${stages%%"$2"*}$2" ;;
    *) break ;;
    esac
    shift 2
done

part_of() { ls "$golden/cases/$1"/*.obj "$golden/cases/$1"/*.mesh 2>/dev/null | head -n 1; }
run() {
    rm -rf "$scratch/stages" && mkdir "$scratch/stages" && "$program" stages "$(part_of "$1")" "$scratch/stages" 2>"$scratch/error"
}

# One row of corpus.csv, from the stages as they are in the files.
row() {
    statistics=$golden/cases/$1/10-statistics.txt labels=$golden/cases/$1/09-labels.txt
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
    if ! run "$1"; then echo "$1: the program failed: $(head -n 1 "$scratch/error")"; return 1; fi
    for stage in $stages; do
        expected=$golden/cases/$1/$stage.txt found=$scratch/stages/$stage.txt
        if [ ! -f "$expected" ]; then echo "$1: stage $stage: no golden file"; return 1; fi
        if [ ! -f "$found" ]; then echo "$1: stage $stage: the program wrote none"; return 1; fi
        if cmp -s "$expected" "$found"; then echo "$stage" >>"$scratch/equal"; continue; fi
        tr -d '\r' <"$expected" | sed -e '$a\' >"$scratch/expected"
        tr -d '\r' <"$found" | sed -e '$a\' >"$scratch/found"
        line=$(diff "$scratch/expected" "$scratch/found" | sed -n '1s/[^0-9].*//p')
        if [ -z "$line" ]; then echo "$stage" >>"$scratch/equal"; continue; fi
        if diff "$scratch/expected" "$scratch/found" | sed -n 1p | grep -q '^[0-9]*a'; then line=$((line + 1)); fi
        echo "$1: stage $stage differs first at line $line"
        echo "  expected: $(sed -n "${line}p" "$scratch/expected")"
        echo "  found:    $(sed -n "${line}p" "$scratch/found")"
        echo "  in all:   $(diff "$scratch/expected" "$scratch/found" | grep -c '^[<>]') lines that the other has not"
        return 1
    done
}

case $mode in
compare)
    [ -d "$golden/cases" ] || { echo "$golden/cases: no golden cases"; exit 1; }
    : >"$scratch/equal"
    whole=$([ $# -eq 0 ] && echo yes)
    [ $# -gt 0 ] || set -- $(ls "$golden/cases")
    for case in "$@"; do
        if check "$case"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    done
    if [ $failed -gt 0 ]; then
        for stage in $stages; do echo "equal up to $stage: $(grep -cx "$stage" "$scratch/equal") of $#"; done
    fi
    if [ -n "$whole" ] && ! table 2>/dev/null | cmp -s - "$golden/corpus.csv"; then
        echo "$golden/corpus.csv does not say what the cases say"
        failed=$((failed + 1))
    fi
    echo "golden: $passed cases equal, $failed different"
    [ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
    ;;
update)
    [ $# -gt 0 ] || { echo "update: name the cases" >&2; exit 2; }
    for case in "$@"; do
        [ -n "$(part_of "$case")" ] || { echo "$case: no input (.obj or .mesh)" >&2; exit 2; }
        run "$case" || { cat "$scratch/error" >&2; exit 2; }
        for stage in $stages; do
            file=$golden/cases/$case/$stage.txt new=$scratch/stages/$stage.txt
            if [ ! -f "$file" ]; then
                echo "$case: stage $stage is new"
            elif ! cmp -s "$file" "$new"; then
                echo "$case: stage $stage: $(diff "$file" "$new" | grep -c '^>') lines differ"
            fi
            cp "$new" "$file"
        done
    done
    table >"$golden/corpus.csv"
    echo "rewritten, not verified: read the differences, then run make golden"
    exit 2
    ;;
*) echo "expected compare or update, found $mode" >&2; exit 2 ;;
esac
