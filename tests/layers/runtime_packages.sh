#!/bin/sh
# Fails unless the packages that the daemon's shared libraries come from are those of docker/packages.txt,
# section runtime, no fewer (the image would not start) and no more (it would carry dead weight).
set -eu
: "${SUBDIVD_DAEMON:?the program to look at}"
command -v dpkg >/dev/null || { echo "skipped: not a Debian system"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
libraries=$(objdump -p "$SUBDIVD_DAEMON" | awk '$1 == "NEEDED" { print $2 }')
for library in $libraries; do
  # the multiarch folder alone: a machine for two word sizes has the same names elsewhere
  dpkg --search "*-linux-gnu/$library" | sed 's/[:,].*//' | sort -u
done | sort -u >"$work/linked"
# What every image with a C++ program and debian:bookworm-slim has: see the dependencies of libosdcpu3.5.0.
printf '%s\n' libc6 libgcc-s1 libstdc++6 >"$work/given"
sort -u "$work/given" >"$work/given.sorted"
sh docker/packages.sh runtime | sort -u >"$work/listed"

comm -23 "$work/linked" "$work/given.sorted" >"$work/wanted"
if ! diff "$work/wanted" "$work/listed" >"$work/difference"; then
  echo "docker/packages.txt, section runtime (>), differs from what the program is linked to (<):"
  cat "$work/difference"
  exit 1
fi
