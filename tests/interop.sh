#!/usr/bin/env bash
# Do other programs see our models as we do? Judges every OBJ and GLB of a folder with trimesh, MeshLab and the Khronos
# glTF validator, and compares with `penstemon check`.
#
#   tests/interop.sh [FOLDER]
#   tests/interop.sh --fetch
#
# --fetch only installs what the judges need.
# Without a folder, hand-made models, clean and broken, are written and judged. The program under test is $PENSTEMON,
# by default the debug build. Exit code 0: all agree; 1: a disagreement or defect; 77: not run, because a package source
# could not be reached, which is then named.
set -euo pipefail
cd "$(dirname "$0")/.."

cache=${PENSTEMON_INTEROP_CACHE:-target/interop}
mkdir -p "$cache"

not_run() {
    echo "interop: not run: $1" >&2
    exit 77
}

# Installs Debian packages unless all of them are there.
need_packages() {
    dpkg -s "$@" >/dev/null 2>&1 && return
    command -v apt-get >/dev/null || not_run "needs $* and there is no apt-get to install them"
    local as_root=()
    [ "$(id -u)" = 0 ] || as_root=(sudo -n)
    echo "interop: installing $*" >&2
    { "${as_root[@]}" apt-get update -qq && "${as_root[@]}" apt-get install -y -qq "$@"; } >"$cache/apt.log" 2>&1 ||
        not_run "Debian's packages are out of reach (see $cache/apt.log)"
}

command -v python3 >/dev/null && python3 -c 'import ensurepip' 2>/dev/null || need_packages python3 python3-venv
command -v npm >/dev/null || need_packages nodejs npm
# What MeshLab's library links to.
need_packages libgl1 libopengl0 libglu1-mesa libgomp1

python=$cache/venv/bin/python
if ! "$python" -c 'import trimesh, pymeshlab, scipy, networkx' 2>/dev/null; then
    rm -rf "$cache/venv"
    python3 -m venv "$cache/venv"
    "$python" -m pip install -q -r tests/interop/requirements.txt >"$cache/pip.log" 2>&1 ||
        not_run "PyPI is out of reach (see $cache/pip.log)"
fi
if [ ! -d "$cache/node/node_modules/gltf-validator" ]; then
    npm install --silent --no-audit --no-fund --prefix "$cache/node" gltf-validator@2.0.0-dev.3.10 \
        >"$cache/npm.log" 2>&1 || not_run "the npm registry is out of reach (see $cache/npm.log)"
fi

[ "${1:-}" != --fetch ] || exit 0

# Together with an example, so that the dependencies are those of the tests and need no second build.
[ -n "${PENSTEMON:-}" ] || cargo build --quiet --bin penstemon --example fixture_models
export PENSTEMON=${PENSTEMON:-${CARGO_TARGET_DIR:-target}/debug/penstemon}
models=${1:-}
if [ -z "$models" ]; then
    models=$(mktemp -d)
    trap 'rm -rf "$models"' EXIT
    cargo run --quiet --example fixture_models -- "$models"
fi

failed=0
"$python" tests/interop/judge.py "$models" || failed=1
NODE_PATH="$cache/node/node_modules" node tests/interop/validate.cjs "$models" || failed=1
exit "$failed"
