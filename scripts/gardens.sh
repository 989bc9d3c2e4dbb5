#!/usr/bin/env bash
# Makes the pictures of docs/gardens.md anew: a bed of roses, a cottage garden, roses on a slope in three densities, a painted garden,
# and a field of nine thousand roses.
# Needs a Vulkan driver and Python 3 with Pillow. PROGRAM is the program, a release build without it.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ -z "${PROGRAM:-}" ]; then
    cargo build --release --quiet
    PROGRAM=${CARGO_TARGET_DIR:-target}/release/penstemon
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$PROGRAM" garden assets/gardens/roses.toml -o "$work/bed.png" --size 1600x760

"$PROGRAM" garden assets/gardens/cottage.toml -o "$work/cottage.png" --outdoors --size 1600x760

"$PROGRAM" build tests/fixtures/painted_garden.penstemon -o "$work/painted.png" --size 1800x1080 --view three-quarter

cat > "$work/slope.toml" <<'SLOPE'
area = "16x10"
spacing = 0.55
variants = 6
map = "density.png"

[ground]
map = "hills.png"
high = 2.0

[[plants]]
species = "rose"
triangles = 3000
SLOPE
python3 - "$work" << 'MAPS'
import math
import sys
from PIL import Image

width, height = 256, 160
density, hills = Image.new('L', (width, height)), Image.new('L', (width, height))
for y in range(height):
    for x in range(width):
        u, v = x / width, y / height
        density.putpixel((x, y), [80, 160, 255][x * 3 // width])
        rise = 0.35 * math.sin(5 * u) * math.cos(4 * v) + 0.15 * math.sin(11 * u + 7 * v)
        hills.putpixel((x, y), int(255 * (0.5 + rise)))
density.save(sys.argv[1] + '/density.png')
hills.save(sys.argv[1] + '/hills.png')
MAPS
"$PROGRAM" garden "$work/slope.toml" -o "$work/slope.png" --size 1600x800

"$PROGRAM" render tests/fixtures/painted_garden.penstemon --walk 9 -o "$work/walk.png" --size 2000x1000
mv "$work/walk-004.png" "$work/walk.png"

cat > "$work/field.toml" <<'FIELD'
area = "60x40"
density = 4.2
variants = 16

[[plants]]
species = "rose"

[[paths]]
points = [[-30, 0], [30, 0]]
width = 2

[[paths]]
points = [[0, -20], [0, 20]]
width = 2

[ground]
cover = "soil"
FIELD
"$PROGRAM" garden "$work/field.toml" --walk 3 -o "$work/field.png" --size 1600x760
mv "$work/field-001.png" "$work/field.png"

# Smaller pictures have smoother edges.
python3 - "$work" << 'SMALLER'
import sys
from PIL import Image

for source, target, size in [('bed', 'garden', (1200, 570)), ('cottage', 'cottage', (1000, 475)), ('slope', 'garden-slope', (1000, 500)),
                             ('painted', 'painted_garden', (1100, 660)), ('walk', 'walk', (1000, 500)), ('field', 'rose_field', (1000, 475))]:
    picture = Image.open(f'{sys.argv[1]}/{source}.png').convert('RGB')
    picture.resize(size, Image.LANCZOS).save(f'docs/images/{target}.png', optimize=True)
SMALLER
