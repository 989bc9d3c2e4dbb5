#!/bin/sh
# The picture of seasons in docs/species.md: `scripts/seasons.sh PROGRAM PYTHON`, a Python with Pillow.
set -eu
program=$1 python=$2 folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for tree in oak beech birch cherry; do
    for season in spring summer autumn winter; do
        "$program" grow "$tree" --season "$season" --size 320x320 -o "$folder/$tree-$season.png"
    done
done
"$python" - "$folder" docs/images/seasons.png <<'PYTHON'
import sys
from PIL import Image
folder, out = sys.argv[1:]
sheet = Image.new("RGB", (1280, 1280))
for row, tree in enumerate(["oak", "beech", "birch", "cherry"]):
    for column, season in enumerate(["spring", "summer", "autumn", "winter"]):
        sheet.paste(Image.open(f"{folder}/{tree}-{season}.png").convert("RGB"), (320 * column, 320 * row))
sheet.quantize(256).save(out, optimize=True)
PYTHON
