#!/bin/sh
# The picture of barks in docs/species.md: `scripts/bark.sh PROGRAM PYTHON`, a Python with Pillow.
set -eu
program=$1 python=$2 folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for tree in oak pine birch cherry beech apple ash; do
    "$program" grow "$tree" --age 30 --season winter --size 4000x3000 -o "$folder/$tree.png"
done
"$python" - "$folder" docs/images/bark.png <<'PYTHON'
import sys
from PIL import Image
folder, out = sys.argv[1:]
trees = ["oak", "pine", "birch", "cherry", "beech", "apple", "ash"]
sheet = Image.new("RGB", (200 * len(trees), 400))
for column, tree in enumerate(trees):
    picture = Image.open(f"{folder}/{tree}.png").convert("RGB")
    top = int(0.8 * picture.height)
    # The trunk is what differs most from the paper, the middle colour of a row.
    row = picture.crop((0, top + 200, picture.width, top + 201)).convert("L").tobytes()
    paper = sorted(row)[len(row) // 2]
    trunk = [x for x, light in enumerate(row) if abs(light - paper) > 40 and abs(x - picture.width // 2) < 400]
    middle = trunk[len(trunk) // 2] if trunk else picture.width // 2
    sheet.paste(picture.crop((middle - 100, top, middle + 100, top + 400)), (200 * column, 0))
sheet.quantize(256, kmeans=8).save(out, optimize=True)
PYTHON
