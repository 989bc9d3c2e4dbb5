#!/usr/bin/env bash
# Builds Penstemon and opens its window: ./run.sh [ARGUMENTS FOR penstemon] | ./run.sh --install [PREFIX]
# Lets the user at this machine open tablets: ./run.sh --install-udev
#
# Needs a Rust toolchain; installs missing system packages. Without a display it builds the sample drawing to GLB, OBJ
# and a picture of drawing and plant, and says where they are. --install puts the program, its icon, its menu entry and
# the file type below PREFIX (~/.local if not given).
set -euo pipefail
cd "$(dirname "$0")"

# Puts the rules for tablets where udev reads them, and has udev apply them to what is plugged in. Asks for sudo only if
# the folder is not writable. PENSTEMON_UDEV_FOLDER takes another folder, and then udev is left alone.
install_udev() {
    local rules=udev/70-penstemon.rules folder=${PENSTEMON_UDEV_FOLDER:-/etc/udev/rules.d} as_root=()
    local target=$folder/${rules##*/}
    if [ "$(id -u)" -ne 0 ] && ! { [ -d "$folder" ] && [ -w "$folder" ]; }; then
        if ! command -v sudo >/dev/null 2>&1; then
            echo "Only root may write to $folder and there is no sudo: run this as root, or copy $rules there." >&2
            return 1
        fi
        as_root=(sudo)
    fi
    if cmp -s "$rules" "$target"; then
        echo "$target is up to date"
    else
        "${as_root[@]}" install -Dm644 "$rules" "$target"
        echo "installed $target"
    fi
    if [ -n "${PENSTEMON_UDEV_FOLDER:-}" ]; then
        return
    elif ! command -v udevadm >/dev/null 2>&1 || [ ! -S /run/udev/control ]; then
        echo "udev does not run here; the rules take effect when it does"
    elif [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null 2>&1; then
        echo "Only root may have udev read its rules again: plug the tablet in again after the next start." >&2
    else
        [ "$(id -u)" -eq 0 ] || as_root=(sudo)
        "${as_root[@]}" udevadm control --reload
        "${as_root[@]}" udevadm trigger --subsystem-match=hidraw --subsystem-match=usb --action=change
        echo "udev has read the rules and applied them to what is plugged in; if a tablet stays silent, plug it in again"
    fi
}
if [ "${1:-}" = --install-udev ]; then
    install_udev
    exit
fi

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
