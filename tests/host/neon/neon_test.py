"""neon_test.py PROGRAMS FOLDER: pictures and hits of `--device cpu` on ARM, by NEON under QEMU, beside those of all vectors of this processor:
the same bits, but for light on ARM, where the C library's acosf and atan2f are others: within LIGHT_STEP. The engine is built by Debian's compiler for arm64, which is unpacked in FOLDER with QEMU where it is not installed. Exit code 77
where neither can be had."""

import array
import os
import pathlib
import platform
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[3]
COMPILER, EMULATOR = "aarch64-linux-gnu-g++-12", "qemu-aarch64-static"
PACKAGES = ["binutils-aarch64-linux-gnu", "cpp-12-aarch64-linux-gnu", "gcc-12-aarch64-linux-gnu", "g++-12-aarch64-linux-gnu",
            "libgcc-12-dev-arm64-cross", "libstdc++-12-dev-arm64-cross", "libc6-dev-arm64-cross", "linux-libc-dev-arm64-cross",
            "qemu-user-static"]
# AVX-512, AVX2, SSE and any processor.
VECTOR_BITS = [512, 256, 128, 32]
NEON = "neon"
#: Most that a channel of light may differ on ARM: some steps of float32. 7e-7 was measured, in 0.1 to 0.2 % of the channels and 8 % of filtered ones.
LIGHT_STEP = 2e-6
GEOMETRY = {".hits", ".mirrored", ".seen"}


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def run(*command, **options):
    subprocess.run([str(part) for part in command], check=True, **options)


def unpack(folder):
    """Debian's packages in a folder of their own."""
    try:
        run(SOURCE / "tests" / "install" / "unpack_packages", "bookworm", folder, *PACKAGES)
    except subprocess.CalledProcessError as failure:
        skip(f"Debian's packages cannot be had: {failure}")


def tools(folder):
    """Compiler and emulator, and the environment that they run in."""
    environment = dict(os.environ)
    if shutil.which(COMPILER) and shutil.which(EMULATOR):
        return COMPILER, EMULATOR, environment
    programs = folder / "root" / "usr" / "bin"
    if not (programs / EMULATOR).exists():
        unpack(folder)
    environment["LD_LIBRARY_PATH"] = str(folder / "root" / "usr" / "lib" / "x86_64-linux-gnu")
    return programs / COMPILER, programs / EMULATOR, environment


def build(folder, compiler, emulator, environment):
    """processor_bits for arm64; without shared libraries, whose places in the linker's scripts are those of installed packages."""
    made = folder / "build"
    run("cmake", "-G", "Ninja", "-S", SOURCE / "tests" / "host" / "neon", "-B", made, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
        "-DCMAKE_SYSTEM_NAME=Linux", "-DCMAKE_SYSTEM_PROCESSOR=aarch64", f"-DCMAKE_CXX_COMPILER={compiler}",
        f"-DCMAKE_CROSSCOMPILING_EMULATOR={emulator}", "-DCMAKE_EXE_LINKER_FLAGS=-static", "-DVulkan_LIBRARY=none", env=environment)
    run("cmake", "--build", made, "--target", "processor_bits", env=environment)
    return made / "processor_bits"


def scenes(programs, folder):
    """Glass, mirrors and plain surfaces in a room; metal, and what sends out light; discs with normal fields; discs that end at edges."""
    made = []
    for model in ("room", "demo"):
        run(programs / "splatray-generate", model, "-o", folder / model, "--points", 20000)
        made.append((SOURCE / "data" / "scenes" / f"{model}.gltf", ["--data-path", folder]))
    run(programs / "splatray-generate", "torus", "-o", folder, "--points", 5000)
    made.append((folder / "torus.ply", []))
    made.append((SOURCE / "data" / "figures" / "cube.obj", ["--points", 5000]))
    paths = []
    for source, options in made:
        paths.append(folder / f"{source.stem}.soct")
        run(programs / "splatray-preprocess", source, *options, "-o", paths[-1])
    return paths


def words(path):
    return array.array("I", path.read_bytes())


def is_near(path, truth):
    """Whether light on ARM is as near as it can be; not a number is near nothing."""
    found, expected = (array.array("f", one.read_bytes()) for one in (path, truth))
    if path.parent.name != NEON or path.suffix in GEOMETRY or len(found) != len(expected):
        return False
    return all(abs(a - b) <= LIGHT_STEP for a, b in zip(found, expected))


def differences(folder, truth):
    """A line for each answer that is not the same."""
    names = sorted(path.name for path in truth.iterdir())
    if names != sorted(path.name for path in folder.iterdir()):
        yield f"{folder.name}: found other answers than in {truth.name}"
        return
    for name in names:
        found, expected = words(folder / name), words(truth / name)
        if found != expected and not is_near(folder / name, truth / name):
            count = sum(a != b for a, b in zip(found, expected)) + abs(len(found) - len(expected))
            yield f"{folder.name}/{name}: {count} of {len(expected)} words differ"


def main():
    programs, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    if platform.machine() != "x86_64":
        skip(f"found {platform.machine()}, expected x86_64, which is compared with")
    folder.mkdir(parents=True, exist_ok=True)
    compiler, emulator, environment = tools(folder)
    program = build(folder, compiler, emulator, environment)
    inputs = scenes(programs, folder)
    answers = []
    for bits in VECTOR_BITS:
        answers.append(folder / f"vectors_of_{bits}")
        shutil.rmtree(answers[-1], ignore_errors=True)
        run(programs / "processor_bits", bits, answers[-1], *inputs)
    answers.append(folder / NEON)
    shutil.rmtree(answers[-1], ignore_errors=True)
    run(emulator, program, 128, answers[-1], *inputs)
    found = [line for other in answers[1:] for line in differences(other, answers[0])]
    print("\n".join(found) or f"the same: {', '.join(other.name for other in answers)}, {len(list(answers[0].iterdir()))} answers each")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
