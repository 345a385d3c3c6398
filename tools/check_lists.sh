#!/bin/sh
# check_lists.sh: Makefile and CMakeLists.txt name every source in src/ and no other; a module includes only modules that
# come before it in the Makefile's list; all files state one version.
cd "$(dirname "$0")/.." || exit 2
status=0
on_disk=$(for file in src/*.cpp; do basename "$file" .cpp; done | grep -v '^main$' | sort)
in_make=$(sed -n '/^MODULES/ { :more; /\\$/ { N; b more; }; s/\\\n//g; s/^MODULES *= *//p; }' Makefile | tr -s ' ' '\n' | sort)
in_cmake=$(sed -n 's|^ *src/\([a-z_0-9]*\)\.cpp)*$|\1|p' CMakeLists.txt | sort)
for list in make cmake; do
    eval "listed=\$in_$list"
    for module in $(printf '%s\n' "$on_disk" "$listed" | sort | uniq -u); do
        echo "src/$module.cpp is only on disk or only in the list of $list" >&2
        status=1
    done
done
before=
for module in base vec3 labels marks $(sed -n '/^MODULES/ { :more; /\\$/ { N; b more; }; s/\\\n//g; s/^MODULES *= *//p; }' Makefile); do
    before="$before $module"
    for header in $(cat "include/polylab/$module.h" "src/$module.cpp" 2>/dev/null | sed -n 's|^ *# *include *"\(.*\.h\)".*|\1|p'); do
        name=${header#polylab/}
        case " $before " in
        *" ${name%.h} "*) ;;
        *) echo "$module includes $header, which is not below it" >&2; status=1 ;;
        esac
    done
done
version=$(sed -n 's/.*kVersion = "\(.*\)".*/\1/p' include/polylab/polylab.h)
grep -q "^project(polylab VERSION $version " CMakeLists.txt || { echo "CMakeLists.txt: expected version $version" >&2; status=1; }
grep -q "^version: $version\$" CITATION.cff || { echo "CITATION.cff: expected version $version" >&2; status=1; }
exit $status
