#!/usr/bin/env bash
# bench.sh PROGRAM SUBDIVIDE: CPU time and peak memory per model and stage, as CSV on standard output and in a table.
# From the environment: CORPUS=DIR surfaces (also in its folders) instead of the golden cases; GROWTH=FILE that surface,
# subdivided up to LEVELS (3) times; BASE=PROGRAM another build's bench, run in turn with this one; REPEATS=N (5); CSV=FILE.
set -euo pipefail
program=$1 subdivide=$2 repeats=${REPEATS:-5}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

if [ -n "${GROWTH:-}" ]; then
    parts=("$GROWTH")
    for ((level = 1; level <= ${LEVELS:-3}; level++)); do
        "$subdivide" "${parts[-1]}" "$scratch/subdivided_$level.obj"
        parts+=("$scratch/subdivided_$level.obj")
    done
elif [ -n "${CORPUS:-}" ]; then
    mapfile -t parts < <(find "$CORPUS" -name '*.obj' -o -name '*.mesh' -o -name '*.stl' | sort)
else
    parts=(golden/cases/*/*.obj)
fi

for part in "${parts[@]}"; do
    name=$(basename "$(dirname "$part")")/$(basename "$part")
    for ((repeat = 0; repeat < repeats; repeat++)); do
        for build in base this; do
            run=$program
            if [ "$build" = base ]; then run=${BASE:-}; fi
            [ -z "$run" ] || "$run" "$part" | sed "s|^|$name,$build,|; s| |,|g"
        done
    done
done >"$scratch/runs" || { echo "bench.sh: a run failed" >&2; exit 1; }

# Median, least and largest of the repeats. ns and bytes are per facet.
sort -t, -k1,1 -k3,3 -k2,2 -k4,4n "$scratch/runs" | awk -F, '
    $3 == "facets" { facets[$1] = $4; next }
    { key = $1 "," $3 "," $2; if (!(key in n)) order[++keys] = key; ms[key, ++n[key]] = $4; if ($5 > peak[key]) peak[key] = $5 }
    END {
        print "model,facets,stage,build,median_ms,least_ms,largest_ms,ns_per_facet,peak_kB,bytes_per_facet"
        for (k = 1; k <= keys; k++) {
            key = order[k]; split(key, part, ","); f = facets[part[1]]; m = ms[key, int((n[key] + 1) / 2)]
            printf "%s,%d,%s,%s,%.3f,%.3f,%.3f,%.0f,%d,%.0f\n", part[1], f, part[2], part[3], m, ms[key, 1], ms[key, n[key]],
                1e6 * m / f, peak[key], 1024 * peak[key] / f
        }
    }' >"${CSV:-$scratch/csv}"
column -s, -t <"${CSV:-$scratch/csv}"
