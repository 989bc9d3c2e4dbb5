#!/usr/bin/env bash
# Does the program compile for Windows and macOS? Checks it, its tests and all its libraries for both, with lints, from any
# system. Nothing is linked or run: .github/workflows/platforms.yml does that there.
#
# Needs the standard libraries of both targets, which rustup fetches, and no compiler for C: one that makes empty files
# stands in for it. Exit code 77: not checked, because a standard library is out of reach or there is no time left.
#
# Usage: scripts/other_systems.sh [SECONDS_GONE]
#
# It is not begun when more than LATE seconds are gone: no check is worth a test run that does not end.
set -euo pipefail
cd "$(dirname "$0")/.."
LATE=2100
if [ "${1:-0}" -gt "$LATE" ]; then
    echo "other systems: not checked: the checks before took ${1} s; run scripts/other_systems.sh by itself" >&2
    exit 77
fi
stand_in=$PWD/scripts/empty_object.sh
# One after the other: in one call a library for one system would have the features that the other asks for.
for target in x86_64-pc-windows-msvc aarch64-apple-darwin; do
    if ! rustup target list --installed 2>/dev/null | grep -qx "$target" && ! rustup target add "$target"; then
        echo "other systems: not checked: rustup has no standard library of $target" >&2
        exit 77
    fi
    name=${target//-/_}
    export "CC_$name=$stand_in" "CXX_$name=$stand_in" "AR_$name=$stand_in"
    cargo clippy --quiet --target "$target" --lib --bins --tests -- -D warnings
done
