"""Puts PNG pictures side by side: sheet.py COLUMNS OUT.png [--size WxH] PICTURE.png... Needs Pillow.

Without --size all have one size; with it each is scaled to fit into its place, on white."""

import sys
from PIL import Image

columns, out, paths = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
place = None
if paths[0] == "--size":
    place, paths = tuple(int(side) for side in paths[1].split("x")), paths[2:]
pictures = [Image.open(path).convert("RGB") for path in paths]
if place:
    fitted = []
    for picture in pictures:
        picture.thumbnail((place[0] - 8, place[1] - 8), Image.LANCZOS)
        cell = Image.new("RGB", place, "white")
        cell.paste(picture, ((place[0] - picture.width) // 2, (place[1] - picture.height) // 2))
        fitted.append(cell)
    pictures = fitted
width, height = pictures[0].size
rows = -(-len(pictures) // columns)
sheet = Image.new("RGB", (columns * width, rows * height), "white" if place else pictures[0].getpixel((0, 0)))
for k, picture in enumerate(pictures):
    sheet.paste(picture, (k % columns * width, k // columns * height))
sheet.save(out, optimize=True)
