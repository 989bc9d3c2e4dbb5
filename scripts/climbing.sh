#!/bin/sh
# The picture of climbing plants in docs/species.md: `scripts/climbing.sh PROGRAM PYTHON`, a Python with Pillow.
set -eu
program=$1 python=$2 folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" grow ivy --age 16 --obstacle wall:3x2.2x0.2@0,0,-0.3 --view three-quarter --size 480x480 -o "$folder/1.png"
"$program" grow clematis --age 10 --obstacle trellis:1.5x2@0,0,-0.25 --size 480x480 -o "$folder/2.png"
"$program" grow oak --age 14 --obstacle wall:6x3x0.2@0,0,-0.6 --view side --size 480x480 -o "$folder/3.png"
"$python" - "$folder" docs/images/climbing.png <<'PYTHON'
import sys
from PIL import Image
folder, out = sys.argv[1:]
sheet = Image.new("RGB", (1440, 480))
for column in range(3):
    sheet.paste(Image.open(f"{folder}/{column + 1}.png").convert("RGB"), (480 * column, 0))
sheet.quantize(256).save(out, optimize=True)
PYTHON
