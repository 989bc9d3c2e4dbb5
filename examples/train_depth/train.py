"""Trains the network that tells how deep drawn plants are, and writes its weights.

    python -m venv venv && venv/bin/pip install torch numpy
    cargo run --release --example train_depth -- set -o set.bin --plants 96
    venv/bin/python examples/train_depth/train.py set.bin -o assets/depth/plants.bin

A small U-Net on the processor. What it sees and what a row of the set holds: views.rs; what its numbers mean: src/learned_depth.
From a drawing nobody can tell which of two sides is the front: the plant mirrored in depth gives the same drawing. So it learns
sizes: half the depth of the crown, how far its middle strays, how far wood leaves the drawing's plane, each with the scale of a
Laplace distribution, and whether the area is a plant's at all. The same seed and number of threads give nearly the same weights.
"""

import argparse
import struct
import time
import zlib

import numpy as np
import torch
import torch.nn as nn
import torch.nn.functional as F

SIDE, CELLS = 128, 64
ROW = 5 * SIDE * SIDE + 3 * CELLS * CELLS + 2
WIDTHS = (24, 40, 64, 96, 128)
LEAST = 0.01


class Block(nn.Module):
    def __init__(self, inputs, outputs, stride=1):
        super().__init__()
        self.conv = nn.Conv2d(inputs, outputs, 3, stride, 1, bias=False)
        self.norm = nn.BatchNorm2d(outputs)

    def forward(self, x):
        return F.leaky_relu(self.norm(self.conv(x)), 0.1)


class Net(nn.Module):
    """Halves the picture five times and doubles it four times, so that answers have a quarter of its cells."""

    def __init__(self, habits, residual=True):
        super().__init__()
        a, b, c, d, e = WIDTHS
        self.down = nn.ModuleList([
            nn.Sequential(Block(7, 16, 2), Block(16, a)),
            nn.Sequential(Block(a, b, 2), Block(b, b)),
            nn.Sequential(Block(b, c, 2), Block(c, c)),
            nn.Sequential(Block(c, d, 2), Block(d, d)),
            nn.Sequential(Block(d, e, 2), Block(e, e)),
        ])
        self.habits = nn.Embedding(habits + 1, e)
        nn.init.normal_(self.habits.weight, std=0.1)
        self.bottom = Block(e, e)
        self.is_plant = nn.Linear(e, 1)
        self.up = nn.ModuleList([Block(e + d, d), Block(d + c, c), Block(c + b, b), Block(b + a, a)])
        self.head = nn.Conv2d(a, 4, 3, 1, 1)
        self.residual = residual

    def forward(self, x, habit):
        kept, y = [], x
        for down in self.down:
            y = down(y)
            kept.append(y)
        y = self.bottom(y + self.habits(habit)[:, :, None, None])
        is_plant = self.is_plant(y.mean((2, 3)))[:, 0]
        for up, skip in zip(self.up, kept[-2::-1]):
            y = F.interpolate(y, scale_factor=2, mode="bilinear", align_corners=False)
            y = up(torch.cat([y, skip], 1))
        out = self.head(y)
        if self.residual:
            half = F.avg_pool2d(x[:, 1:2], 2)
            out = torch.cat([out[:, :1] + half, out[:, 1:]], 1)
        return out, is_plant


def batch(rows, mirrored):
    rows = torch.from_numpy(np.ascontiguousarray(rows))
    n = len(rows)
    channels = rows[:, : 5 * SIDE * SIDE].view(n, 5, SIDE, SIDE)
    x = torch.empty(n, 7, SIDE, SIDE)
    x[:, :3] = channels[:, :3].float() / 255
    x[:, 3:5] = channels[:, 3:].view(torch.int8).float() / 127
    at = (torch.arange(SIDE) + 0.5) / SIDE
    x[:, 5] = at[:, None]
    x[:, 6] = 2 * (at - 0.5).abs()
    truth = rows[:, 5 * SIDE * SIDE : 5 * SIDE * SIDE + 3 * CELLS * CELLS].view(n, 3, CELLS, CELLS)
    known = truth > 0
    truth = (truth.float() - 128) / 127  # in halves of the picture's side
    habit = rows[:, -2].long()
    if mirrored:
        x, truth, known = x.flip(3), truth.flip(3), known.flip(3)
        x[:, 3] = -x[:, 3]
    return x.contiguous(memory_format=torch.channels_last), truth, known, habit


def shares(x, truth, known):
    """Half depth and middle of crowns where the drawing has one, and depth of lines."""
    crown = known[:, 0] & known[:, 1] & (F.avg_pool2d(x[:, :1], 2)[:, 0] > 0.4)
    half = 0.5 * (truth[:, 0] - truth[:, 1]).clamp(min=0)
    middle = 0.5 * (truth[:, 0] + truth[:, 1])
    line = known[:, 2]
    return crown, half, middle, line, truth[:, 2].abs()


def laplace(error, log_scale):
    log_scale = log_scale.clamp(min=float(np.log(LEAST)), max=1.0)
    return error * torch.exp(-log_scale) + log_scale


def loss_of(out, is_plant, x, truth, known, plant):
    crown, half, middle, line, away = shares(x, truth, known)
    mean = lambda values, mask: (values * mask).sum() / mask.sum().clamp(min=1)
    error = (out[:, 0] - half).abs()
    loss = 4 * mean(error, crown) + mean(laplace(error.detach(), out[:, 1]), crown)
    loss = loss + mean(laplace(middle.abs(), out[:, 2]), crown) + mean(laplace(away, out[:, 3]), line)
    return loss + F.binary_cross_entropy_with_logits(is_plant, plant.float())


def evaluate(net, rows, use_habit, unknown):
    net.eval()
    sums = {}
    def add(name, values, mask):
        s = sums.setdefault(name, [0.0, 0])
        s[0] += float(values[mask].double().sum()); s[1] += int(mask.sum())
    with torch.no_grad():
        for k in range(0, len(rows), 64):
            x, truth, known, habit = batch(rows[k : k + 64], False)
            plant = habit < 255
            asked = torch.where(plant, habit, unknown) if use_habit else torch.full_like(habit, unknown)
            out, is_plant = net(x, asked)
            crown, half, middle, line, away = shares(x, truth, known)
            crown, line = crown & plant[:, None, None], line & plant[:, None, None]
            poisson = F.avg_pool2d(x[:, 1:2], 2)[:, 0]
            constant = torch.full_like(half, 0.31)
            # Errors as shares of the picture's side.
            for name, guess in (("learned", out[:, 0]), ("poisson", poisson), ("constant", constant)):
                add("front, " + name, 0.5 * (truth[:, 0] - guess).abs(), crown)
                add("gap, " + name, (half - guess).abs(), crown)
            add("line, in the plane", 0.5 * away, line)
            add("line, how far", 0.5 * (torch.exp(out[:, 3]) - away).abs(), line)
            add("plant told", ((is_plant > 0) == plant).float(), torch.ones_like(plant))
    net.train()
    return {name: s / max(n, 1) for name, (s, n) in sums.items()}


def folded(block):
    scale = block.norm.weight / torch.sqrt(block.norm.running_var + block.norm.eps)
    return block.conv.weight * scale[:, None, None, None], block.norm.bias - block.norm.running_mean * scale


def write(net, names, path):
    """Weights as halves, in the order in which they are used; layout: src/learned_depth/network.rs."""
    net.eval()
    blocks = [block for down in net.down for block in down] + [net.bottom] + list(net.up)
    tensors = [t for block in blocks for t in folded(block)]
    tensors += [net.head.weight, net.head.bias, net.is_plant.weight, net.is_plant.bias, net.habits.weight]
    body = b"".join(t.detach().contiguous().numpy().astype("<f2").tobytes() for t in tensors)
    text = "\n".join(names).encode()
    payload = struct.pack("<I", len(text)) + text + body
    with open(path, "wb") as file:
        file.write(b"PENDEPTH" + struct.pack("<II", 1, zlib.crc32(payload)) + payload)


def main():
    ask = argparse.ArgumentParser()
    ask.add_argument("set")
    ask.add_argument("-o", "--out", required=True)
    ask.add_argument("--epochs", type=int, default=8)
    ask.add_argument("--threads", type=int, default=2)
    ask.add_argument("--plain", action="store_true", help="learn the depth itself, not its difference to Poisson's")
    ask.add_argument("--seed", type=int, default=1)
    args = ask.parse_args()
    torch.manual_seed(args.seed)
    torch.set_num_threads(args.threads)
    draw = np.random.default_rng(args.seed)
    rows = np.fromfile(args.set, np.uint8).reshape(-1, ROW)
    role, names = np.array(rows[:, -1]), open(args.set + ".names").read().split("\n")
    names = [name for name in names if name]
    train = np.flatnonzero(role == 0)
    tests = {"seeds": rows[np.flatnonzero(role == 1)[::2]], "habits": rows[np.flatnonzero(role == 2)[::6]]}
    net = Net(len(names), not args.plain).to(memory_format=torch.channels_last)
    print(sum(p.numel() for p in net.parameters()), "weights;", len(train), "rows", flush=True)
    size, unknown = 48, len(names)
    steps = args.epochs * (len(train) // size)
    optimiser = torch.optim.AdamW(net.parameters(), lr=2e-3, betas=(0.9, 0.98), weight_decay=1e-4)
    rate = torch.optim.lr_scheduler.OneCycleLR(optimiser, 2e-3, total_steps=steps + 1, pct_start=0.1)
    started, step = time.time(), 0
    for epoch in range(args.epochs):
        order, losses = draw.permutation(train), []
        for k in range(0, len(order) - size + 1, size):
            x, truth, known, habit = batch(rows[np.sort(order[k : k + size])], draw.random() < 0.5)
            plant = habit < 255
            dropped = torch.from_numpy(draw.random(size) < 0.3)
            asked = torch.where(plant & ~dropped, habit, unknown)
            out, is_plant = net(x, asked)
            loss = loss_of(out, is_plant, x, truth, known, plant)
            optimiser.zero_grad(set_to_none=True)
            loss.backward()
            nn.utils.clip_grad_norm_(net.parameters(), 5.0)
            optimiser.step()
            rate.step()
            losses.append(float(loss.detach()))
            step += 1
            if step % 100 == 0:
                print(f"{step}/{steps} {np.mean(losses[-100:]):.3f} {time.time() - started:.0f} s", flush=True)
        write(net, names, args.out)
        for name, test in tests.items():
            for use in (True, False):
                found = evaluate(net, test, use, unknown)
                line = ", ".join(f"{key} {value:.4f}" for key, value in sorted(found.items()))
                print(f"epoch {epoch + 1}, {name}, {'species known' if use else 'unknown'}: {line}", flush=True)


if __name__ == "__main__":
    main()
