#!/usr/bin/env bash
# Builds Penstemon and opens its window: ./run.sh [ARGUMENTS FOR penstemon] | ./run.sh --install [PREFIX]
#
# Needs a Rust toolchain; installs missing system packages. Without a display it builds the sample drawing to GLB, OBJ
# and a picture of drawing and plant, and says where they are. --install puts the program, its icon, its menu entry and
# the file type below PREFIX (~/.local if not given).
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
# What the window loads when it opens.
need '/usr/lib*/*/libxkbcommon.so.0' libxkbcommon0 libxkbcommon libxkbcommon
need '/usr/lib*/*/libxkbcommon-x11.so.0' libxkbcommon-x11-0 libxkbcommon-x11 libxkbcommon-x11
need '/usr/lib*/*/libX11-xcb.so.1' libx11-xcb1 libX11-xcb libx11
need '/usr/lib*/*/libXcursor.so.1' libxcursor1 libXcursor libxcursor
need '/usr/lib*/*/libXi.so.6' libxi6 libXi libxi
install_needed

cargo build --release --quiet
program=${CARGO_TARGET_DIR:-target}/release/penstemon

install_for_desktop() {
    local prefix=$1 share=$1/share
    install -Dm755 "$program" "$prefix/bin/penstemon"
    install -Dm644 assets/desktop/org.penstemon.Penstemon.desktop -t "$share/applications"
    install -Dm644 assets/desktop/org.penstemon.Penstemon.metainfo.xml -t "$share/metainfo"
    install -Dm644 assets/desktop/org.penstemon.Penstemon.mime.xml "$share/mime/packages/org.penstemon.Penstemon.xml"
    install -Dm644 assets/desktop/penstemon.svg "$share/icons/hicolor/scalable/apps/org.penstemon.Penstemon.svg"
    install -Dm644 assets/desktop/penstemon-256.png "$share/icons/hicolor/256x256/apps/org.penstemon.Penstemon.png"
    command -v update-mime-database >/dev/null && update-mime-database "$share/mime" || true
    command -v update-desktop-database >/dev/null && update-desktop-database "$share/applications" || true
    echo "installed below $prefix; start it with $prefix/bin/penstemon or from the applications menu"
}

if [ "${1:-}" = --install ]; then
    install_for_desktop "${2:-$HOME/.local}"
    exit
fi
if [ $# -gt 0 ] || [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    exec "$program" "$@"
fi

out=out/sample
mkdir -p "$out"
sketch=assets/sketches/sample.penstemon
"$program" build "$sketch" -o "$out/sample.glb" -o "$out/sample.obj" --stats
"$program" render "$sketch" -o "$out/sample.png" --size 1400x900 --with-drawing
echo "No display was found. The sample drawing became:"
printf '  %s\n' "$out"/sample.{glb,obj,png}
