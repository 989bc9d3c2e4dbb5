#!/usr/bin/env bash
# Licences, sources and known faults of the dependencies, by cargo-deny with deny.toml. Exit status 77: it cannot run here.
#
# Usage: scripts/deny.sh [SECONDS_GONE]
#
# Where cargo-deny is not installed it is compiled from crates.io, once for all clones of this user: without optimisation, which
# makes that minutes shorter and the check a second longer, and without its optional parts. It is given TIME seconds, and
# not begun when that many are gone that the checks before it must have been slow: no check is worth a test run that does
# not end. Advisories are looked at where their database can be fetched.
set -uo pipefail
cd "$(dirname "$0")/.."
TIME=${DENY_SECONDS:-600}
LATE=2100

tools=${XDG_CACHE_HOME:-$HOME/.cache}/penstemon/tools
export PATH="$tools/bin:$PATH"
if ! command -v cargo-deny >/dev/null; then
    if [ "${1:-0}" -gt "$LATE" ]; then
        echo "cargo-deny is not installed and there is no time to compile it: cargo install --locked cargo-deny" >&2
        exit 77
    fi
    echo "compiling cargo-deny into $tools"
    CARGO_PROFILE_DEV_DEBUG=0 timeout "$TIME" cargo install --quiet --debug --locked --no-default-features \
        --root "$tools" --target-dir "$tools/build" cargo-deny@0.20.2 || exit 77
    rm -rf "$tools/build"
fi

cargo deny --all-features check --hide-inclusion-graph licenses bans sources || exit 1
if timeout 120 cargo deny fetch db >/dev/null 2>&1; then
    cargo deny --all-features check --disable-fetch advisories
else
    echo "the database of advisories cannot be reached; advisories were not looked at"
fi
