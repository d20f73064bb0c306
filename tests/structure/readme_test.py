"""readme_test.py REPOSITORY PROGRAMS: README.md's command blocks say what is so. Every option that a line gives to a program of
splatray is one that its --help lists; a block behind the comment <!-- run --> runs in a folder with small inputs of the names it uses
(make_inputs), pictures being 16 x 16 and of one sample."""

import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SMALLER = {"splatray-render": "--resolution=16x16 --samples=1"}  # given twice, the last one holds
SMALLER_POINTS = "--points=2000"


def blocks(text):
    """(runs, lines) of each ```sh block."""
    for mark, body in re.findall(r"(<!-- run -->\s*)?```sh\n(.*?)```", text, re.DOTALL):
        yield bool(mark), body


def words_of(line):
    return shlex.split(line, comments=True)


def unknown_options(body, programs):
    """The options that a program's help does not list."""
    for line in body.splitlines():
        words = words_of(line)
        program = next((pathlib.Path(word).name for word in words if re.search(r"(^|/)splatray-\w+$", word)), None)
        if program is None or not (programs / program).exists():
            continue
        known = subprocess.run([programs / program, "--help"], capture_output=True, text=True, check=True).stdout
        for word in words:
            name = word.split("=")[0]
            if re.fullmatch(r"--?[a-z][\w-]*", name) and name != "--help" and not re.search(rf"(?<![\w-]){name}(?![\w-])", known):
                yield f"README.md: found '{line}', expected an option of {program} in place of {name}"


def mesh_ply(rings, height):
    """A closed mesh like an egg, its vertices without normals."""
    vertices, faces, sectors = [], [], 2 * rings
    for ring in range(rings + 1):
        polar = math.pi * ring / rings
        for sector in range(sectors):
            turn = 2 * math.pi * sector / sectors
            vertices.append(f"{math.sin(polar) * math.cos(turn)} {height * math.cos(polar)} {-math.sin(polar) * math.sin(turn)}")
    for ring in range(rings):
        for sector in range(sectors):
            a, b = ring * sectors + sector, ring * sectors + (sector + 1) % sectors
            faces += [f"3 {a} {a + sectors} {b}", f"3 {b} {a + sectors} {b + sectors}"]
    return "\n".join(["ply", "format ascii 1.0", f"element vertex {len(vertices)}", "property float x", "property float y",
                      "property float z", f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header",
                      *vertices, *faces, ""])


def make_programs(folder, programs):
    """build/release/bin with the programs, those in SMALLER made quick."""
    target = folder / "build/release/bin"
    target.mkdir(parents=True)
    for program in programs.iterdir():
        smaller = SMALLER.get(program.name)
        if smaller is None:
            (target / program.name).symlink_to(program)
            continue
        (target / program.name).write_text(
            f'#!/bin/sh\ncase "$*" in\n*--list-devices*) exec {program} "$@";;\n'
            f'*--points*) exec {program} "$@" {smaller} {SMALLER_POINTS};;\n*) exec {program} "$@" {smaller};;\nesac\n')
        (target / program.name).chmod(0o755)


def make_inputs(folder, programs):
    """The files that README.md's blocks name as the reader's own."""
    for name, height in (("bunny", 1.2), ("dragon", 0.8), ("floor", 0.1)):
        (folder / f"{name}.ply").write_text(mesh_ply(100, height))
    pixels = bytes([128, 128, 128, 129]) * (16 * 8)
    (folder / "sky.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + pixels)
    keys = ",".join(f'{{"eye": [{x}, 1, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 30}}' for x in range(3))
    (folder / "fly.json").write_text(f'{{"keys": [{keys}]}}')
    subprocess.run([programs / "splatray-preprocess", "dragon.ply", "floor.ply", "-o", "scene.soct"], cwd=folder, check=True,
                   capture_output=True)


def failures(text, programs):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_programs(folder, programs)
        make_inputs(folder, programs)
        for runs, body in blocks(text):
            yield from unknown_options(body, programs)
            if not runs:
                continue
            result = subprocess.run(["bash", "-euo", "pipefail", "-c", body], cwd=folder, capture_output=True, text=True)
            if result.returncode != 0:
                yield f"README.md: a block ended with exit code {result.returncode}: {result.stderr.strip()}"


def main():
    root, programs = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    broken = ("<!-- run -->\n```sh\nbuild/release/bin/splatray-render missing.ply -o a.png\n```\n"
              "```sh\nbuild/release/bin/splatray-render bunny.ply --no-such-option\n```\n")
    if len(list(failures(broken, programs))) != 2:
        sys.exit("A file that is missing and an option that does not exist were not both noticed")
    text = (root / "README.md").read_text()
    if not any(runs for runs, _ in blocks(text)):
        sys.exit("README.md: found no block behind <!-- run -->, expected some")
    found = list(failures(text, programs))
    print("\n".join(found), file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    # As tests/cli/child_process.cpp does.
    os.environ["ASAN_OPTIONS"] = os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"
    main()
