"""Compares grown plants whose foliage is cards with the same plants with leaves, as pictures without perspective.

    python3 scripts/cards.py [--program PROGRAM] [--size PIXELS] [SPECIES:AGE...]

For front, side and top it prints what cards cover as a share of what leaves cover, the overlap of both (intersection over union, of
alpha), and the distance of the mean colours in CIELAB. PROGRAM is the program, a release
build without it. Needs a Vulkan driver and Python 3 with numpy and Pillow."""

import argparse
import json
import os
import struct
import subprocess
import tempfile

import numpy as np
from PIL import Image

TREES = ["oak:20", "birch:20", "maple:20", "spruce:20", "cherry:20", "ash:10", "spruce:12"]
# Share of a picture that stays free (src/render/studio.rs).
MARGIN = 0.1
VIEWS = {"front": (0, 1), "side": (2, 1), "top": (0, 2)}


def bounds(path):
    """Corners of the box of all meshes below the first scene, whose nodes are only moved."""
    data = open(path, "rb").read()
    document = json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    waiting = [(node, np.zeros(3)) for node in document["scenes"][0]["nodes"]]
    while waiting:
        index, origin = waiting.pop()
        node = document["nodes"][index]
        origin = origin + np.array(node.get("translation", [0, 0, 0]))
        waiting += [(child, origin) for child in node.get("children", [])]
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                accessor = document["accessors"][primitive["attributes"]["POSITION"]]
                low, high = np.minimum(low, origin + accessor["min"]), np.maximum(high, origin + accessor["max"])
    return low, high


def picture(program, model, view, size):
    """Linear colours and alpha."""
    out = model + ".png"
    call = [program, "render", model, "-o", out, "--size", f"{size}x{size}", "--view", view, "--orthographic", "--transparent"]
    subprocess.run(call, check=True, capture_output=True)
    pixels = np.asarray(Image.open(out).convert("RGBA")) / 255.0
    colour = np.where(pixels[..., :3] <= 0.04045, pixels[..., :3] / 12.92, ((pixels[..., :3] + 0.055) / 1.055) ** 2.4)
    return colour, pixels[..., 3]


def lab(colour):
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ colour
    share = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(share > 0.008856, np.cbrt(share), 7.787 * share + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def compared(program, whole, cards, view, size):
    """Share of the silhouette, overlap, distance of colours."""
    axes = list(VIEWS[view])
    (low, high), (cards_low, cards_high) = bounds(whole), bounds(cards)
    extent, cards_extent = (high - low)[axes].max(), (cards_high - cards_low)[axes].max()
    # Each picture is framed by its own box: equally many pixels to the metre, and then moved.
    cards_size = round(size * cards_extent / extent)
    a, alpha_a = picture(program, whole, view, size)
    b, alpha_b = picture(program, cards, view, cards_size)
    right, up = (0.5 * (cards_low + cards_high) - 0.5 * (low + high))[axes] * (1 - MARGIN) * size / extent
    right, up = (-right if view == "side" else right), (-up if view == "top" else up)
    margin = max(size, cards_size)
    def placed(alpha, by):
        canvas = np.zeros((3 * margin, 3 * margin))
        side = alpha.shape[0]
        x, y = (round((3 * margin - side) / 2 + offset) for offset in by)
        canvas[y:y + side, x:x + side] = alpha
        return canvas
    one, other = placed(alpha_a, (0, 0)), placed(alpha_b, (right, -up))
    overlap = np.minimum(one, other).sum() / np.maximum(one, other).sum()
    means = [(colour * alpha[..., None]).sum((0, 1)) / alpha.sum() for colour, alpha in [(a, alpha_a), (b, alpha_b)]]
    return alpha_b.sum() / alpha_a.sum(), overlap, np.linalg.norm(lab(means[0]) - lab(means[1]))


def grown(program, species, age, out, *options):
    call = [program, "grow", species, "--age", age, "--seed", "1", "--stats", "-o", out, *options]
    stats = json.loads(subprocess.run(call, check=True, capture_output=True, text=True).stdout)
    return stats, os.path.getsize(out) / 1e6


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", default="target/release/penstemon")
    arguments.add_argument("--size", type=int, default=200)
    arguments.add_argument("plants", nargs="*", default=TREES)
    given = arguments.parse_args()
    print("| | triangles | with cards | GLB, MB | silhouette | overlap | ΔE |\n| --- | --- | --- | --- | --- | --- | --- |")
    for plant in given.plants:
        species, age = plant.split(":")
        with tempfile.TemporaryDirectory() as folder:
            whole, cards = f"{folder}/whole.glb", f"{folder}/cards.glb"
            leaves, leaves_mb = grown(given.program, species, age, whole)
            few, cards_mb = grown(given.program, species, age, cards, "--leaves", "card")
            rows = np.array([compared(given.program, whole, cards, view, given.size) for view in VIEWS])
            row = lambda values, digits: ", ".join(f"{value:.{digits}f}" for value in values)
            print(f"| {species} {age} | {leaves['triangles']:,} | {few['triangles']:,} | {leaves_mb:.1f} → {cards_mb:.1f} | "
                  f"{row(rows[:, 0], 2)} | {row(rows[:, 1], 2)} | {row(rows[:, 2], 1)} |", flush=True)


main()
