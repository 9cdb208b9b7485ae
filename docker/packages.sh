#!/bin/sh
# Prints the packages of the named sections of packages.txt, one a line: docker/packages.sh build test
# Plain sh and awk, because it runs where nothing is installed yet.
set -eu
list=$(dirname "$0")/packages.txt
for section in "$@"; do
  awk -v wanted="[$section]" '
    /^\[/ { inside = ($1 == wanted); known = known || inside; next }
    inside && NF && !/^#/ { print $1 }
    END { if (!known) { print "packages.txt has no section " wanted > "/dev/stderr"; exit 1 } }
  ' "$list"
done
