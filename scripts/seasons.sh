#!/bin/sh
# The pictures of seasons and fruits in docs/species.md: `scripts/seasons.sh PROGRAM PYTHON`, a Python with Pillow.
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
for of in apple:3.05 cherry:2.9 rowan:5 spruce:3.4; do
    "$program" grow "${of%:*}" --season "${of#*:}" --size 1600x1600 -o "$folder/${of%:*}.png"
done
"$python" - "$folder" docs/images/fruits.png <<'PYTHON'
import sys
from PIL import Image
folder, out = sys.argv[1:]
# Each plant whole, and a part of its crown below.
near = {"apple": (1010, 420), "cherry": (900, 150), "rowan": (820, 130), "spruce": (600, 180)}
sheet = Image.new("RGB", (1600, 800))
for column, (plant, (x, y)) in enumerate(near.items()):
    picture = Image.open(f"{folder}/{plant}.png").convert("RGB")
    sheet.paste(picture.resize((400, 400), Image.LANCZOS), (400 * column, 0))
    sheet.paste(picture.crop((x, y, x + 400, y + 400)), (400 * column, 400))
sheet.quantize(256, kmeans=8).save(out, optimize=True)
PYTHON
