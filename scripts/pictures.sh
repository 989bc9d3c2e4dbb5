#!/usr/bin/env bash
# Makes the pictures of README.md anew: each drawing beside its plant. Needs a release build and a Vulkan driver.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --quiet
program=${CARGO_TARGET_DIR:-target}/release/penstemon
mkdir -p docs/images
for name in daisy hepatica_red balloon_flower bouquet tree_round; do
    "$program" render "assets/sketches/$name.penstemon" -o "docs/images/$name.png" --size 560x640 --with-drawing
done
