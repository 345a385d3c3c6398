#!/bin/sh
# get_doctest.sh COMPILER [FLAG...]: succeeds where <doctest/doctest.h> is found. Where it is missing and apt-get may be
# used (root), it is installed first. Speaks on standard error only.
has_doctest() { echo '#include <doctest/doctest.h>' | "$@" -x c++ -fsyntax-only - >/dev/null 2>&1; }
install_doctest() { DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends doctest-dev; }

has_doctest "$@" && exit 0
command -v apt-get >/dev/null 2>&1 && [ "$(id -u)" -eq 0 ] || exit 1
echo "doctest is not here: running apt-get install doctest-dev" >&2
{ install_doctest || { apt-get update && install_doctest; }; } >/dev/null 2>&1
has_doctest "$@"
