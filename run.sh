#!/usr/bin/env bash
# Builds Penstemon and shows what it does: ./run.sh [ARGUMENTS FOR penstemon]
#
# Needs a Rust toolchain; installs missing system packages. Without arguments it builds the sample drawing to GLB, OBJ
# and a picture of drawing and plant, and says where they are.
set -euo pipefail
cd "$(dirname "$0")"

if ! command -v cargo >/dev/null 2>&1; then
    echo "Penstemon needs Rust: install it from https://rustup.rs, then run this again." >&2
    exit 1
fi
. scripts/packages.sh
need cc gcc gcc gcc
need '/usr/share/vulkan/icd.d/*' mesa-vulkan-drivers mesa-vulkan-drivers vulkan-swrast
need '/usr/lib*/*/libvulkan.so.1' libvulkan1 vulkan-loader vulkan-icd-loader
install_needed

cargo build --release --quiet
program=${CARGO_TARGET_DIR:-target}/release/penstemon
if [ $# -gt 0 ]; then
    exec "$program" "$@"
fi

out=out/sample
mkdir -p "$out"
sketch=assets/sketches/sample.penstemon
"$program" build "$sketch" -o "$out/sample.glb" -o "$out/sample.obj" --stats
"$program" render "$sketch" -o "$out/sample.png" --size 1400x900 --with-drawing
echo "The sample drawing became:"
printf '  %s\n' "$out"/sample.{glb,obj,png}
