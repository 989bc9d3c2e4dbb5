#!/usr/bin/env bash
# Makes the sheets of docs/flowers.md anew: every species that flowers by itself, flowers opening, layers, a rose through the year,
# from three sides. Needs a Vulkan driver and Python 3 with Pillow. PROGRAM is the program, a release build without it.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -z "${PROGRAM:-}" ]; then
    cargo build --release --quiet
    PROGRAM=${CARGO_TARGET_DIR:-target}/release/penstemon
fi
mkdir -p docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture NAME VIEW SIZE VERB SPECIES [ARGUMENT…]: a plant as a picture of that name.
picture() {
    local name=$1 view=$2 size=$3
    shift 3
    "$PROGRAM" "$@" -o "$work/plant.glb"
    "$PROGRAM" render "$work/plant.glb" -o "$work/$name.png" --size "$size" --view "$view"
}

# Flowers alone, on one stem without leaves.
alone=(--set flower.clump.stems=1 --set flower.leaves.nodes=0 --set flower.leaves.rosette=0)

# Every flower from three-quarter view.
k=100
for species in peony rose camellia lotus water_lily chrysanthemum dahlia carnation ranunculus marigold tulip lily poppy \
    sunflower daisy lilac lavender lupin hydrangea dandelion wheat foxglove hyacinth allium; do
    picture "all-$((k += 1))" three-quarter 260x300 bloom "$species"
done
python3 scripts/sheet.py 8 docs/images/flowers.png "$work"/all-*.png

# Front, side and above of the full ones.
for view in front side top; do
    k=100
    for species in peony rose camellia lotus chrysanthemum carnation; do
        picture "$view-$((k += 1))" "$view" 260x260 bloom "$species" "${alone[@]}" --set flower.bloom.stem=1.2
    done
done
python3 scripts/sheet.py 6 docs/images/flowers-sides.png "$work"/front-*.png "$work"/side-*.png "$work"/top-*.png

# An orchid from three sides, and when it begins to flower.
for view in front side three-quarter; do
    picture "orchid-$view" "$view" 320x320 bloom orchid
done
picture orchid-young front 320x320 bloom orchid --open 0.3
python3 scripts/sheet.py 4 docs/images/orchid.png "$work"/orchid-{front,side,three-quarter,young}.png

# From bud to full bloom.
for species in peony rose camellia lotus; do
    for open in 0.0 0.2 0.4 0.6 0.8 1.0; do
        picture "open-$species-$open" three-quarter 260x260 bloom "$species" --open "$open" "${alone[@]}" --set flower.bloom.stem=1.5
    done
done
python3 scripts/sheet.py 6 docs/images/flowers-opening.png "$work"/open-*.png

# More and more layers.
for layers in 1 2 3 5 8 12 16 20; do
    picture "layers-$(printf %02d "$layers")" three-quarter 240x240 bloom chrysanthemum \
        --set "flower.layers.count=$layers" --set flower.bloom.stem=1.2
done
python3 scripts/sheet.py 8 docs/images/flowers-layers.png "$work"/layers-*.png

# A rose through the year, and others of its kind.
for season in 0 1 2 3 4 5; do
    picture "rose-$season" three-quarter 340x420 grow rose --seed 3 --season "$season"
done
python3 scripts/sheet.py 6 docs/images/rose-year.png "$work"/rose-?.png
