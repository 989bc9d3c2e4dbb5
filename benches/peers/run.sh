#!/usr/bin/env bash
# Trees of ez-tree and of Penstemon in one run: processor time and triangles of each.
#
# Needs node and npm; ez-tree is installed below target/.
set -euo pipefail
cd "$(dirname "$0")/../.."
peers=$PWD/target/peers
mkdir -p "$peers"
cp benches/peers/ez_tree.mjs "$peers/"
(cd "$peers" && { [ -d node_modules/@dgreenheck/ez-tree ] || npm install --silent --no-fund @dgreenheck/ez-tree@1.1.0; })
echo "ez-tree 1.1.0, median of ${ROUNDS:-30}:"
(cd "$peers" && node ez_tree.mjs)
echo "Penstemon:"
cargo bench --quiet --bench growth -- tree
