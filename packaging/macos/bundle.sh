#!/usr/bin/env bash
# Makes Penstemon.app: packaging/macos/bundle.sh PROGRAM FOLDER
#
# The icon is made with the tools of macOS; elsewhere the bundle has none. The bundle is signed ad hoc, so that it runs on
# the Mac that made it; to give it to others it must be signed and notarised with a developer's own certificate.
set -euo pipefail
program=$(realpath "$1")
folder=$(realpath "$2")
cd "$(dirname "$0")/../.."
bundle=$folder/Penstemon.app/Contents
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)

rm -rf "$folder/Penstemon.app"
mkdir -p "$bundle/MacOS" "$bundle/Resources"
cp "$program" "$bundle/MacOS/penstemon"
cp LICENSE-MIT LICENSE-APACHE "$bundle/Resources"
sed "s/@VERSION@/$version/" packaging/macos/Info.plist >"$bundle/Info.plist"

if command -v iconutil >/dev/null 2>&1; then
    icons=$(mktemp -d)/penstemon.iconset
    mkdir "$icons"
    for size in 16 32 128 256; do
        sips -z $size $size assets/desktop/penstemon-256.png --out "$icons/icon_${size}x${size}.png" >/dev/null
    done
    iconutil -c icns "$icons" -o "$bundle/Resources/penstemon.icns"
    codesign --force --sign - "$folder/Penstemon.app"
else
    echo "no iconutil here: $folder/Penstemon.app has no icon and no signature" >&2
fi
