#!/usr/bin/env bash
# Makes the pictures of README.md anew: each drawing beside its plant, and the window. Needs a release build, a Vulkan
# driver, Python 3 with Pillow, and for the window Xvfb.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --quiet
program=${CARGO_TARGET_DIR:-target}/release/penstemon
mkdir -p docs/images
for name in daisy hepatica_red balloon_flower bouquet tree_round topiary; do
    "$program" render "assets/sketches/$name.penstemon" -o "docs/images/$name.png" --size 560x640 --with-drawing
done

# The drawings in the way of people, each beside its plant.
freehand=$(mktemp -d)
for drawing in assets/sketches/freehand_*.penstemon; do
    "$program" render "$drawing" -o "$freehand/$(basename "$drawing" .penstemon).png" --size 230x260 --with-drawing
done
python3 scripts/sheet.py 3 docs/images/freehand.png "$freehand"/*.png
rm -rf "$freehand"

# Drawings by people beside their plants.
people=$(mktemp -d)
cargo run --release --quiet --example draw_contact_sheets -- "$people" \
    tree/5,flower/10,cactus/0,house_plant/4,bush/12,flower/13,leaf/29,palm_tree/3,tree/15,grass/1,mushroom/1,house_plant/10
cp "$people/picked-01.png" docs/images/people.png
rm -rf "$people"

# Icons by designers beside their plants.
icons=$(mktemp -d)
number=10
for icon in icons_added/hugeicons_tree-01 icons/mynaui_trees icons_added/hugeicons_tulip icons_added/majesticons_flower-2-line \
    icons_added/lucidelab_flower-rose-single icons_added/lucide_wheat icons/tabler_cherry icons_added/lucide_clover icons/mynaui_sprout \
    icons_added/akar_plant icons_added/streamline_potted-cactus icons_added/iconoir_african-tree; do
    number=$((number + 1))
    "$program" render "tests/data/$icon.svg" -o "$icons/$number.png" --size 230x260 --with-drawing
done
python3 scripts/sheet.py 3 docs/images/icons.png "$icons"/*.png
rm -rf "$icons"

# Petal, leaf and bark from photographs, stage by stage, and what grows of them.
photographs=$(mktemp -d)
cargo run --release --quiet --example draw_photographs -- "$photographs"
for name in petal leaf; do
    "$program" render "$photographs/$name.penstemon" -o "$photographs/$name-5-plant.png" --size 880x1000
done
"$program" render assets/sketches/tree_round.penstemon --texture "stem=$photographs/bark-3-tile.png" \
    --texture "twig=$photographs/bark-3-tile.png" -o "$photographs/bark-5-plant.png" --size 880x1000
python3 scripts/sheet.py 5 docs/images/photographs.png --size 264x300 "$photographs"/{petal,leaf,bark}-?-*.png
rm -rf "$photographs"

# Trees that grow by themselves, side by side; what climbs has a wall, which is not in the picture.
grown=$(mktemp -d)
for species in $("$program" grow --list | grep -vx rose); do
    wall=
    case $species in ivy | clematis) wall="--obstacle wall:3x2x0.2@0,0,-0.3" ;; esac
    # shellcheck disable=SC2086
    "$program" grow "$species" $wall -o "$grown/$species.glb"
    "$program" render "$grown/$species.glb" -o "$grown/$species.png" --size 300x300
done
python3 scripts/sheet.py 5 docs/images/grown.png "$grown"/*.png
rm -rf "$grown"

# What light from one side, wind and years do to trees.
places=$(mktemp -d)
old() { "$program" grow "$1" --age "$2" --seed 3 --size 360x360 -o "$places/$1.png" "${@:3}"; }
old oak 18 --set habit.light.slant=1 --set habit.light.side=180
old birch 18 --set habit.wind=0.2
old pine 18 --set habit.wind=0.15
old spruce 30
python3 scripts/sheet.py 4 docs/images/places.png "$places"/{oak,birch,pine,spruce}.png
rm -rf "$places"

# One oak with all its triangles, and with as many as were asked for.
triangles=$(mktemp -d)
for count in 0 80000 25000; do
    "$program" grow oak --age 20 --set "model.budget.triangles=$count" -o "$triangles/$((1000000 - count)).glb"
    "$program" render "$triangles/$((1000000 - count)).glb" -o "$triangles/$((1000000 - count)).png" --size 500x460
done
python3 scripts/sheet.py 3 docs/images/triangles.png "$triangles"/{1000000,920000,975000}.png
rm -rf "$triangles"
# A tree of which only the trunk was drawn on the sheet: its branches in space from front, side and top, and what grew on them.
space=$(mktemp -d)
for years in -1 4; do
    for view in front side top; do
        "$program" render tests/fixtures/in_space.penstemon --set "growth.years=$years" --view "$view" \
            -o "$space/$((years + 1))-$view.png" --size 320x320
    done
done
python3 scripts/sheet.py 6 docs/images/in_space.png "$space"/*.png
rm -rf "$space"
# The same branches twice, with the crown of a maple and the strands of a willow painted on them.
brushes=$(mktemp -d)
for drawing in brushed brushed_willow; do
    for view in front side; do
        "$program" render "tests/fixtures/$drawing.penstemon" --view "$view" --size 400x460 \
            -o "$brushes/$drawing-$view.png"
    done
done
python3 scripts/sheet.py 4 docs/images/brushes.png "$brushes"/*.png
rm -rf "$brushes"
# A drawn flower, and the same with leaves and a copy of it painted on its stem and itself turned, from front and side.
painted=$(mktemp -d)
"$program" render assets/sketches/balloon_flower.penstemon --size 400x480 -o "$painted/1.png"
"$program" render tests/fixtures/painted_flower.penstemon --size 400x480 -o "$painted/2.png"
"$program" render tests/fixtures/painted_flower.penstemon --view side --size 400x480 -o "$painted/3.png"
python3 scripts/sheet.py 3 docs/images/painted_flower.png "$painted"/*.png
rm -rf "$painted"
# Drawn crowns, their plants from front and side, and from the side without learned depth.
sides=$(mktemp -d)
row() {
    local drawing=$1 at=$2 view
    shift 2
    for view in drawing front side; do
        "$program" render "$drawing" "$@" --view "$view" --size 400x380 -o "$sides/$at-1-$view.png"
    done
    "$program" render "$drawing" "$@" --set depth.learned.crown=0 --set depth.learned.branches=0 --view side --size 400x380 \
        -o "$sides/$at-2-by-rules.png"
}
row tests/fixtures/crowns/flat.svg 1 --species acacia
row tests/fixtures/crowns/round.svg 2 --species oak
row assets/sketches/freehand_tree.penstemon 3
python3 scripts/sheet.py 4 docs/images/learned_depth.png --size 300x285 "$sides"/*.png
rm -rf "$sides"

# Plants that grew into lobes, and the lobes.
lobes=$(mktemp -d)
for name in bonsai swan; do
    "$program" lobes "assets/lobes/$name.json" -o "$lobes/$name-lobes.obj"
done
"$program" grow pine --lobes assets/lobes/bonsai.json -o "$lobes/bonsai-grown.glb"
"$program" grow box --lobes assets/lobes/swan.json -o "$lobes/swan-grown.glb"
for model in "$lobes"/*.glb "$lobes"/*.obj; do
    for view in side three-quarter; do
        "$program" render "$model" -o "$model-$view.png" --size 330x330 --view "$view"
    done
done
python3 scripts/sheet.py 4 docs/images/lobes.png "$lobes"/*.png
rm -rf "$lobes"
# Two trees as they grow, with their foliage as pictures of shoots in as many triangles as were asked for, and as two pictures.
levels=$(mktemp -d)
for species in oak spruce; do
    "$program" grow "$species" --age 20 -o "$levels/whole.glb"
    "$program" render "$levels/whole.glb" -o "$levels/$species-0.png" --size 400x400 --view three-quarter
    "$program" grow "$species" --age 20 --lod 25000,8000,2000,billboards -o "$levels/$species.obj"
    for level in 0 1 2 3; do
        "$program" render "$levels/${species}_LOD$level.obj" -o "$levels/$species-$((level + 1)).png" --size 400x400 --view three-quarter
    done
done
python3 scripts/sheet.py 5 docs/images/levels.png "$levels"/oak-?.png "$levels"/spruce-?.png
rm -rf "$levels"
# The pictures in the window of those that only grow.
THUMBNAILS=write cargo test --release --quiet --test app -- every_species_looks_like_its_picture

# XWD, as Xvfb keeps its screen, to PNG.
png_of_screen() {
    python3 - "$1" "$2" <<'PYTHON'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
word = lambda i: struct.unpack_from(">I", data, 4 * i)[0]
start, width, height, stride = word(0) + 12 * word(19), word(4), word(5), word(12)
rows = (data[start + y * stride : start + y * stride + 4 * width] for y in range(height))
def rgb(row):
    out = bytearray(3 * width)
    out[0::3], out[1::3], out[2::3] = row[2::4], row[1::4], row[0::4]
    return b"\0" + bytes(out)
def chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
pixels = zlib.compress(b"".join(map(rgb, rows)), 9)
picture = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")
open(sys.argv[2], "wb").write(picture)
PYTHON
}

# window PICTURE DRAWING [SETTING…]: the window on a drawing, once it rests, with these lines in its settings.
window() {
    local picture=$1 drawing=$2 home server client calm=0 tries=0
    shift 2
    home=$(mktemp -d)
    mkdir -p "$home/.config/penstemon"
    printf '%s\n' "$@" >"$home/.config/penstemon/settings.toml"
    mkfifo "$home/display"
    : >"$home/told"
    Xvfb -displayfd 3 -nolisten tcp -dpi 96 -fbdir "$home" -screen 0 1280x800x24 3>"$home/display" 2>"$home/server" &
    server=$!
    env -u WAYLAND_DISPLAY -u DBUS_SESSION_BUS_ADDRESS DISPLAY=":$(head -n 1 "$home/display")" HOME="$home" \
        XDG_RUNTIME_DIR="$home" LANG=en_GB.UTF-8 NO_COLOR=1 \
        "$program" --verbose "assets/sketches/$drawing.penstemon" 2>"$home/told" &
    client=$!
    # The last word about the window is that it rests, and stays so.
    while [ "$calm" -lt 5 ] && [ "$((tries += 1))" -lt 600 ]; do
        sleep 0.2
        if grep 'app::window' "$home/told" | tail -n 1 | grep -q 'at rest'; then calm=$((calm + 1)); else calm=0; fi
    done
    png_of_screen "$home/Xvfb_screen0" "docs/images/$picture.png"
    kill "$client" "$server"
    wait "$client" "$server" 2>/dev/null || true
    rm -rf "$home"
}

window window daisy 'theme = "light"'
window window-dark hepatica_blue 'theme = "dark"' 'side_shown = false'
