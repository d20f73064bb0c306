"""large.py TOWN.copc.laz --bin BIN -o FILE.md: what pictures of a large scan take, and which are the same pixels (tests/bench/large)."""

import argparse
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "remote"))
from make_town import places  # noqa: E402
from serve import Server  # noqa: E402

KILLS = 20
READ = re.compile(r"read (\d+) of (\d+) points")


class Run:
    """A program that ran: seconds by the clock and of the CPUs, most memory in bytes, and what it said."""

    def __init__(self, command):
        with tempfile.TemporaryFile() as said:
            begin = time.monotonic()
            process = subprocess.Popen([str(word) for word in command], stdout=said, stderr=said)
            _, status, usage = os.wait4(process.pid, 0)
            self.seconds, self.cpu_s, self.peak_bytes = time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024
            said.seek(0)
            self.said = said.read().decode()
        if status != 0:
            sys.exit(f"{' '.join(str(word) for word in command)} failed:\n{self.said}")
        found = READ.search(self.said)
        self.points = int(found[1]) if found else 0


def pixels_of(picture):
    """The compressed pixels of a PNG, without what its other chunks say of how it was made."""
    data, at, pixels = picture.read_bytes(), 8, b""
    while at < len(data):
        length = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            pixels += data[at + 8:at + 8 + length]
        at += 12 + length
    return zlib.decompress(pixels)


def digests_of(folder):
    """What each file below a folder holds."""
    return {path.relative_to(folder): hashlib.md5(path.read_bytes()).hexdigest() for path in folder.rglob("*") if path.is_file()}


class Table:
    def __init__(self, town, programs, memory, work):
        self.town, self.programs, self.memory, self.work, self.lines = town, programs, memory, work, []
        text = subprocess.run([programs / "splatray-info", "--head", town], capture_output=True, text=True, check=True).stdout
        self.edge_m = float(re.search(r"edge ([\d.]+)", text)[1])
        self.places = places(self.edge_m)

    def render(self, place, name, *options, source=None):
        camera = [word for key, numbers in self.places[place].items() for word in (f"--{key}", ",".join(map(str, numbers)))]
        picture = self.work / (name if name.endswith(".exr") else f"{name}.png")
        picture.unlink(missing_ok=True)
        run = Run([self.programs / "splatray-render", source or self.town, *camera, "--fov", "45", "--device", "cpu", "--look", "scan", *options,
                   "-o", picture])
        return run, picture

    def speed(self):
        self.lines += ["| picture | seconds | CPU s | peak MB | points read |", "| --- | --- | --- | --- | --- |"]
        large = ("--resolution", "1920x1080", "--samples", "16", "--max-memory", self.memory)
        for name, place, options in (("first, cold: 480x270, 1 sample, `--lod 4`", "above", ("--resolution", "480x270", "--samples", "1", "--lod", "4")),
                                     ("from above, 1920x1080, 16 samples", "above", large), ("in a street, the same", "street", large)):
            with open(self.town, "rb") as file:
                os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)
            run, picture = self.render(place, "speed", *options)
            if options is large:
                picture.replace(self.town.parent / f"{place}.png")
            self.lines.append(f"| {name} | {run.seconds:.1f} | {run.cpu_s:.1f} | {run.peak_bytes / 1e6:.0f} | {run.points} |")

    def same_pixels(self):
        small = ("--resolution", "480x270", "--samples", "4", "--lod", "2", "--keep-noise")
        _, whole = self.render("above", "whole", *small)
        truth = pixels_of(whole)
        self.lines += ["", "| the same pixels as `--lod 2`, 480x270, 4 samples, from above | differ |", "| --- | --- |"]
        server = Server(self.town.parent)
        ways = {"--max-memory 1G": ("--max-memory", "1G"), "--max-memory 8G": ("--max-memory", "8G"), "--threads 1": ("--threads", "1"),
                "--threads 2": ("--threads", "2")}
        pictures = {name: self.render("above", "other", *small, *options)[1].rename(self.work / f"{len(name)}{name[-1]}.png") for name, options in ways.items()}
        pictures["from a server on this machine"] = self.render("above", "server", *small, source=f"{server.url}/parts/{self.town.name}")[1]
        pictures["two tiles, merged"] = self.merged(small)
        for name, picture in pictures.items():
            other = pixels_of(picture)
            differ = sum(a != b for a, b in zip(truth, other)) if len(truth) == len(other) else len(truth)
            self.lines.append(f"| {name} | {differ} bytes |")

    def levels(self):
        """Levels of one's own, as of a file that has none; then the same from runs that are killed, each later than the last."""
        whole, killed = self.work / "levels", self.work / "killed"
        run = Run([self.programs / "splatray-preprocess", self.town, "-o", whole / "ept.json"])
        points, nodes = (int(word) for word in re.search(r"^(\d+) points.* (\d+) nodes", run.said, re.MULTILINE).groups())
        self.lines += ["", "| levels of one's own (`splatray-preprocess -o ept.json`) | |", "| --- | --- |",
                       f"| points; nodes | {points}; {nodes} |", f"| seconds; CPU s; peak MB | {run.seconds:.0f}; {run.cpu_s:.0f}; {run.peak_bytes / 1e6:.0f} |"]
        kills = 0
        while not (killed / "ept.json").exists():
            process = subprocess.Popen([self.programs / "splatray-preprocess", self.town, "-o", killed / "ept.json"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            try:
                process.wait(run.seconds * (0.05 + 0.05 * kills) if kills < KILLS else None)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills += 1
        expected, found = digests_of(whole), digests_of(killed)
        differ = sum(digest != found.get(name) for name, digest in expected.items())
        self.lines.append(f"| killed {kills} times and resumed | {differ} of {len(expected)} files differ |")

    def merged(self, options):
        tiles = [self.render("above", f"tile{i}.exr", *options, "--tile", f"{i}/2")[1] for i in (1, 2)]
        picture = self.work / "merged.png"
        subprocess.run([self.programs / "splatray-merge", *tiles, "-o", picture], check=True, capture_output=True)
        return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("town", type=pathlib.Path)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--memory", default="8G")
    parser.add_argument("-o", type=pathlib.Path, required=True)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=asked.town.parent) as work:
        table = Table(asked.town, asked.bin, asked.memory, pathlib.Path(work))
        table.speed()
        table.same_pixels()
        table.levels()
    asked.o.write_text("\n".join(table.lines) + "\n")
    print("\n".join(table.lines))


if __name__ == "__main__":
    main()
