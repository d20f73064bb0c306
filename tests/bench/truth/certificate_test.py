"""certificate_test.py BIN [--scenes N] [--build SOURCE]: what --lod-error says of a picture's cut, by 20 parts of it, against the whole picture of all points: the
truth lies in at least 90 of 100 intervals (20 scenes, 5 seeds each), of the mean's bias and of the PSNR alike. The truth is of four pictures, two
of the cut and two of all points, with other samples each, so that noise cancels. Makes its own scenes: hills, houses, trees, patches of colour.
--build makes BIN, the folder bin of a build folder, of the sources first, optimised: with sanitizers all takes seven times as long."""

import argparse
import array
import math
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import zlib

POINTS, SEEDS, EDGE_M = 280_000, 5, 120.0
PICTURE = ("--resolution", "320x192", "--look", "scan", "--color-by", "rgb", "--up", "0,0,1", "--fov", "40", "--tone", "none", "--keep-noise",
           "--samples", "8", "--quiet")
SAID = re.compile(r"mean ([-+][\d.]+) % \(([-+][\d.]+) to ([-+][\d.]+)\), PSNR ([\d.]+|inf) dB \(([\d.]+|inf) to ([\d.]+|inf)\)")


def scene_points(seed):
    """Places in metres and colours of 8 bits."""
    dice = random.Random(seed)
    height, length, patch_m = dice.uniform(1.0, 12.0), dice.uniform(15.0, 60.0), dice.uniform(0.7, 9.0)
    houses = [(dice.uniform(10, EDGE_M - 10), dice.uniform(10, EDGE_M - 10), dice.uniform(3, 8), dice.uniform(3, 12)) for _ in range(dice.randrange(2, 14))]
    trees = [(dice.uniform(5, EDGE_M - 5), dice.uniform(5, EDGE_M - 5), dice.uniform(1.5, 5.0)) for _ in range(dice.randrange(0, 40))]
    ground = lambda x, y: height * math.sin(x / length) * math.cos(y / (0.8 * length))
    of_trees = min(0.4, 0.012 * len(trees))
    for _ in range(POINTS):
        shade = dice.gauss(0.0, 6.0)
        if dice.random() < of_trees:
            x, y, radius = trees[dice.randrange(len(trees))]
            turn, up, out = dice.uniform(0, 2 * math.pi), dice.uniform(-1, 1), radius * dice.uniform(0.6, 1.0)
            level = math.sqrt(1 - up * up)
            yield (x + out * level * math.cos(turn), y + out * level * math.sin(turn), ground(x, y) + 1.8 * radius + out * up), (60 + shade, 90 + 2 * shade, 40 + shade)
            continue
        x, y = EDGE_M * dice.random(), EDGE_M * dice.random()
        house = next((h for h in houses if abs(x - h[0]) < h[2] and abs(y - h[1]) < h[2]), None)
        if house:
            roof = ground(house[0], house[1]) + house[3] + 0.6 * (house[2] - abs(x - house[0]))
            z = roof if dice.random() < 0.6 else ground(x, y) + (roof - ground(x, y)) * dice.random()
            if z < roof:  # a wall
                x = house[0] + math.copysign(house[2], x - house[0])
            yield (x, y, z), (170 + shade, 110 + shade, 90 + shade)
        else:
            bright = 30.0 if math.sin(x / patch_m) * math.sin(y / patch_m) > 0 else 0.0
            yield (x, y, ground(x, y)), (100 + bright + shade, 110 + bright + shade, 80 + shade)


def las_of(points):
    """A LAS 1.2 file of coloured points in millimetres."""
    stored = [([round(1000 * v) for v in place], [257 * max(0, min(255, round(c))) for c in color]) for place, color in points]
    low, high = [min(p[i] for p, _ in stored) for i in range(3)], [max(p[i] for p, _ in stored) for i in range(3)]
    header = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"test", b"test", 1, 2026, 227, 227, 0, 2, 26,
                         len(stored), len(stored), 0, 0, 0, 0)
    header += struct.pack("<12d", *(0.001,) * 3, 0, 0, 0, *(0.001 * v for i in range(3) for v in (high[i], low[i])))
    return header + b"".join(struct.pack("<iiiHBBbBHHHH", *p, 0, 9, 2, 0, 0, 0, *c) for p, c in stored)


def channels_of(picture):
    """R, G and B of an OpenEXR of half or float in blocks that ZIP packs, all values of a channel in a list."""
    data, at, attributes = picture.read_bytes(), 8, {}
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name], at = data[at + 4:at + 4 + size], at + 4 + size
    x0, y0, x1, y1 = struct.unpack("<4i", attributes[b"dataWindow"])
    width, height, packing = x1 - x0 + 1, y1 - y0 + 1, attributes[b"compression"][0]
    channels, rest = [], attributes[b"channels"]
    while rest[0]:
        name, _, rest = rest.partition(b"\0")
        channels.append((name.decode(), rest[0]))
        rest = rest[16:]
    rows = {0: 1, 2: 1, 3: 16}[packing]
    values = {name: array.array("f") for name, _ in channels}
    for offset in struct.unpack_from(f"<{(height + rows - 1) // rows}Q", data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        lines = min(rows, height - (y - y0))
        raw = data[offset + 8:offset + 8 + size]
        if size < lines * width * sum(2 if kind == 1 else 4 for _, kind in channels):
            packed, last = bytearray(zlib.decompress(raw)), 0
            for i, byte in enumerate(packed):
                packed[i] = last = (byte + last - 128) & 255 if i else byte
            raw, half = bytearray(len(packed)), (len(packed) + 1) // 2
            raw[0::2], raw[1::2] = packed[:half], packed[half:]
        place = 0
        for _ in range(lines):
            for name, kind in channels:
                values[name].extend(struct.unpack_from(f"<{width}{'e' if kind == 1 else 'f'}", raw, place))
                place += width * (2 if kind == 1 else 4)
    return [value for name in "RGB" for value in values[name]]


def shown(value):
    """What a display is sent, without a tone curve (IEC 61966-2-1)."""
    value = min(max(value, 0.0), 1.0)
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def build(source, folder):
    """The programs of the preset `picture` in a build folder of their own."""
    programs = ("splatray-preprocess", "splatray-render")
    for command in (("cmake", "--preset", "picture", "-B", folder, "-Wno-dev"), ("cmake", "--build", folder, "--target", *programs)):
        done = subprocess.run(command, cwd=source, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout[-4000:])


class Trials:
    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder
        self.bias_in = self.psnr_in = self.trials = 0

    def render(self, scan, *options):
        picture = self.folder / "picture.exr"
        done = subprocess.run([self.programs / "splatray-render", scan, *PICTURE, *options, "-o", picture], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        return picture

    def truth(self, scan, view):
        cut, whole = ([channels_of(self.render(scan, *view, "--lod", lod, "--seed", str(seed))) for seed in (101, 102)] for lod in ("2", "0"))
        sums = [sum(map(math.fsum, pictures)) for pictures in (cut, whole)]
        differences = [[shown(a) - shown(b) for a, b in zip(cut[i], whole[i])] for i in (0, 1)]
        squares = sum(a * b for a, b in zip(*differences)) / len(differences[0])
        return 100.0 * (sums[0] / sums[1] - 1.0), -10.0 * math.log10(max(squares, 1e-12))

    def scene(self, seed):
        las, scan = self.folder / f"{seed}.las", self.folder / str(seed) / "ept.json"
        las.write_bytes(las_of(list(scene_points(seed))))
        subprocess.run([self.programs / "splatray-preprocess", las, "-o", scan], check=True, capture_output=True)
        turn, rise = 2.4 * seed, 0.4 + 0.045 * (seed % 20)
        eye = [EDGE_M * (0.5 + 0.75 * math.cos(turn)), EDGE_M * (0.5 + 0.75 * math.sin(turn)), EDGE_M * rise]
        view = ("--eye=" + ",".join(map(str, eye)), f"--target={EDGE_M / 2},{EDGE_M / 2},0", "--exposure", "0")
        bias, psnr = self.truth(scan, view)
        for trial in range(1, SEEDS + 1):
            picture = self.render(scan, *view, "--lod", "2", "--lod-error", "--seed", str(trial))
            said = SAID.search(picture.read_bytes()[:20000].decode("latin-1"))
            if not said:
                sys.exit(f"scene {seed}: no certificate in the picture")
            numbers = [float(word) for word in said.groups()]
            self.trials += 1
            # The numbers are rounded to half of the last figure.
            self.bias_in += numbers[1] - 0.005 <= bias <= numbers[2] + 0.005
            self.psnr_in += numbers[4] - 0.05 <= psnr <= numbers[5] + 0.05
            print(f"scene {seed}: bias {bias:+.2f} %, PSNR {psnr:.1f} dB; said {said[0]}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--build", type=pathlib.Path)
    asked = parser.parse_args()
    if asked.build:
        build(asked.build, asked.bin.resolve().parent)
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(asked.bin, pathlib.Path(folder))
        for seed in range(1, asked.scenes + 1):
            trials.scene(seed)
    print(f"of {trials.trials} intervals {trials.bias_in} hold the bias and {trials.psnr_in} the PSNR")
    if min(trials.bias_in, trials.psnr_in) < 0.9 * trials.trials:
        sys.exit("expected at least 90 of 100")


if __name__ == "__main__":
    main()
