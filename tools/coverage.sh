#!/bin/sh
# coverage.sh DIR: after tests built with config=coverage, prints for each source whose object is in DIR the share of its
# lines that ran, and their sum. Lines marked "// unreachable" count like others. Needs gcov.
for object in "$1"/*.o; do
    gcov -n -s "$PWD" -r "$object" 2>/dev/null
done | awk -F"['%: ]+" '
    /^File/ { file = $2 }
    /^Lines executed/ && file ~ /^src\// { split($0, part, " of "); sub(/^.*executed:/, "", part[1])
        printf "%-32s %7s of %d lines\n", file, part[1], part[2]
        ran += part[1] * part[2] / 100; all += part[2] }
    /^Lines executed/ { file = "" }
    END { if (all) printf "%-32s %6.2f%% of %d lines\n", "all", 100 * ran / all, all }'
