"""Puts PNG pictures of one size side by side: sheet.py COLUMNS OUT.png PICTURE.png... Needs Pillow."""

import sys
from PIL import Image

columns, out, pictures = int(sys.argv[1]), sys.argv[2], [Image.open(path).convert("RGB") for path in sys.argv[3:]]
width, height = pictures[0].size
rows = -(-len(pictures) // columns)
sheet = Image.new("RGB", (columns * width, rows * height), pictures[0].getpixel((0, 0)))
for k, picture in enumerate(pictures):
    sheet.paste(picture, (k % columns * width, k // columns * height))
sheet.save(out, optimize=True)
