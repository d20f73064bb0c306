"""Pictures of splatray beside Mitsuba 3's of the same discs as polygons, pixel by pixel.

Each renderer makes PICTURES pictures of SAMPLES samples. A pixel's means differ where their distance, in standard errors, has a chance of
less than 0.01 for all pixels of a picture together (Sidak's correction). Prints a table; the share of pixels that pass once more with all
light brighter by a few per cent, which must fail. Pixels that see nothing but the sky are left out: both show it without noise, but not to
the last bit."""

import argparse
import subprocess
import sys
import time
from statistics import NormalDist

import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("programs", help="folder of splatray's programs")
parser.add_argument("folder", help="folder to work in")
parser.add_argument("--data", help="folder of real models; without it there is no dragon")
parser.add_argument("--edge", type=int, default=128, help="pixels of a picture's edge")
parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba; llvm_ad_rgb is faster, and needs LLVM 16 to 19")
OPTIONS = parser.parse_args()
mi.set_variant(OPTIONS.variant)

from scenes import build, cornell, in_mitsuba, plates, scan  # noqa: E402  (needs a variant)

EDGE, PICTURES, SAMPLES = OPTIONS.edge, 16, 64
MORE_LIGHT = 1.05
# Discs that overlap hide light from each other; how much depends on how far from its disc a ray begins: from 0.0002 to 0.002, all else alike,
# the dragon's light grows by 0.7 %.
ALLOWED = 0.005
LEVEL = 0.01
ASKED = 0.9975


def splatray_pictures(programs, soct, options, folder):
    pictures, seconds = [], 0.0
    for seed in range(1, PICTURES + 1):
        command = [f"{programs}/splatray-render", soct, *options, f"--resolution={EDGE}x{EDGE}", f"--samples={SAMPLES}"]
        command += [f"--seed={seed}", "--blend=nearest", "--side=delta", "--delta=0.0005", "--quiet", "-o", f"{folder}/picture.exr"]
        start = time.time()
        subprocess.run(command, check=True)
        seconds += time.time() - start
        pictures.append(np.array(mi.Bitmap(f"{folder}/picture.exr")))
    pictures = np.array(pictures, float)
    return pictures[..., :3].mean(-1), pictures[..., 3].mean(0) > 0.0, seconds


def mitsuba_pictures(scene):
    start = time.time()
    pictures = [np.array(mi.render(scene, spp=SAMPLES, seed=seed)).mean(-1) for seed in range(PICTURES)]
    return np.array(pictures, float), time.time() - start


def passing(ours, theirs, seen):
    """The share of those pixels whose means are the same, and all distances in standard errors. Variances are smoothed over 3 x 3 pixels: few pictures say little about each."""

    def smooth(image):
        padded = np.pad(image, 1, mode="edge")
        return sum(padded[i : i + EDGE, j : j + EDGE] for i in range(3) for j in range(3)) / 9.0

    variance = sum(smooth(pictures.var(0, ddof=1)) / PICTURES for pictures in (ours, theirs))
    z = (ours.mean(0) - theirs.mean(0)) / np.sqrt(variance + 1e-12)
    level = 1.0 - (1.0 - LEVEL) ** (1.0 / z.size)
    return (np.abs(z) < NormalDist().inv_cdf(1.0 - level / 2.0))[seen].mean(), z


def compare(name, scene):
    """Prints a row of the table. Returns whether the scene passes, and would not with more light."""
    place = f"{OPTIONS.folder}/{name}"
    soct, options = build(scene, OPTIONS.programs, place)
    ours, seen, our_seconds = splatray_pictures(OPTIONS.programs, soct, options, place)
    theirs, their_seconds = mitsuba_pictures(in_mitsuba(scene, soct, EDGE))
    share, z = passing(ours, theirs, seen)
    wrong = passing(MORE_LIGHT * ours, theirs, seen)[0]
    totals = [pictures[:, seen].mean(1) for pictures in (ours, theirs)]
    spread = np.sqrt(sum(total.var(ddof=1) for total in totals) / PICTURES)
    apart = (totals[0].mean() - totals[1].mean()) / spread
    both = np.concatenate([ours.mean(0), theirs.mean(0), np.clip(z / 10 + 0.5, 0, 1)], 1)
    mi.Bitmap(both.astype(np.float32)).write(f"{place}/both.exr")
    light = totals[0].mean() / totals[1].mean()
    error = np.sqrt(ours.var(0, ddof=1)[seen].mean() / theirs.var(0, ddof=1)[seen].mean())
    columns = (name, f"{share:.4f}", f"{light:.5f} ({apart:+.1f})", f"{wrong:.4f}", f"{error:.2f}", f"{our_seconds:.1f}", f"{their_seconds:.1f}")
    print("| " + " | ".join(columns) + " |", flush=True)
    return share >= ASKED > wrong and (abs(apart) < 4.0 or abs(light - 1.0) < ALLOWED)


def main():
    scenes = {"cornell": cornell, "plates": plates}
    if OPTIONS.data:
        scenes["dragon"] = scan(f"{OPTIONS.data}/models/dragon.ply")
    print(f"| scene | pixels that pass | light (standard errors) | pass with {MORE_LIGHT} of it | error, of Mitsuba's | splatray, s | Mitsuba, s |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    good = [compare(name, make()) for name, make in scenes.items()]
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    main()
