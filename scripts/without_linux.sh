#!/usr/bin/env bash
# Compiles the program with everything that belongs to Linux or Unix alone switched off, as Windows and macOS see the code.
#
# It finds a name that only Linux has and a part without its stand-in. It does not see the code that only those systems
# compile inside the libraries: for that, .github/workflows/platforms.yml builds there.
set -euo pipefail
cd "$(dirname "$0")/.."
target=$(realpath "${CARGO_TARGET_DIR:-target}")
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
git ls-files -co --exclude-standard -z -- Cargo.toml Cargo.lock clippy.toml src shaders assets benches examples tests/common tests/kernel \
    tests/fixtures/reference | xargs -0 cp --parents -t "$copy"
grep -rlE 'target_os = "linux"|cfg\(.*unix' "$copy/src" |
    xargs sed -i -E 's/target_os = "linux"/target_os = "none"/g; s/(cfg\((all\([^)]*|not\()?)unix\b/\1target_os = "none"/g'
cd "$copy"
CARGO_TARGET_DIR=$target cargo clippy --quiet --lib --bins -- -D warnings
