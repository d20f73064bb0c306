"""farm_test.py PROGRAMS FARM: the templates of FARM make a turntable's frames in chunks, one of them ended in the middle and run again, and
each byte is that of one process's. What runs the templates is openjd-cli where that is installed; Slurm's script is run as Slurm would."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from install_test import run

FRAMES, CHUNK = 10, 4
CAMERA = f"--turntable={FRAMES}"
PICTURE = ["--resolution=64x36", "--samples=2"]


def pictures(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.glob("*.png"))}


def expect_same(made, whole, name):
    if made != whole:
        sys.exit(f"{name}: found {sorted(made)}, of which {[n for n in made if made[n] != whole.get(n)]} differ, expected those of one process")


def by_openjd(farm, work, scene, environment):
    if shutil.which("openjd", path=environment["PATH"]) is None:
        print("skipped: the Open Job Description is not run, openjd-cli (PyPI) is not installed")
        return None
    run("openjd", "check", farm / "frames.yaml", env=environment)
    folder = work / "openjd"
    folder.mkdir()
    values = {"Input": work / "cloud.xyz", "Scene": scene, "Output": folder / "f##.png", "Camera": CAMERA, "Frames": f"0-{FRAMES - 1}",
              "ChunkSize": CHUNK, "Samples": 2, "Resolution": "64x36"}
    words = [word for name, value in values.items() for word in ("-p", f"{name}={value}")]
    run("openjd", "run", farm / "frames.yaml", *words, env=environment)
    return pictures(folder)


def by_slurm_script(farm, folder, scene, environment, options=" ".join(PICTURE)):
    """The jobs of an array, one after the other."""
    folder.mkdir(exist_ok=True)
    job = environment | {"SCENE": str(scene), "OUTPUT": str(folder / "f##.png"), "CAMERA": CAMERA, "FRAMES": str(FRAMES),
                         "CHUNK": str(CHUNK), "OPTIONS": options}
    for task in range((FRAMES + CHUNK - 1) // CHUNK + 2):  # the last ones have no frames
        run("bash", farm / "frames.slurm", env=job | {"SLURM_ARRAY_TASK_ID": str(task)})
    return pictures(folder)


def end_slurm_script(farm, folder, scene, environment):
    """A job that Slurm signals at the end of its time leaves whole frames and asks to be queued again."""
    folder.mkdir()
    asked = folder / "asked"
    (folder / "scontrol").write_text(f'#!/bin/sh\necho "$*" >>{asked}\n')
    (folder / "scontrol").chmod(0o755)
    job = environment | {"SCENE": str(scene), "OUTPUT": str(folder / "f####.png"), "CAMERA": "--turntable=9000", "FRAMES": "9000", "CHUNK": "9000",
                         "OPTIONS": " ".join(PICTURE), "SLURM_ARRAY_TASK_ID": "0", "SLURM_JOB_ID": "77",
                         "PATH": f"{folder}:{environment['PATH']}"}
    script = subprocess.Popen(["bash", farm / "frames.slurm"], env=job)
    while not list(folder.glob("*.png")) and script.poll() is None:
        time.sleep(0.005)
    script.send_signal(signal.SIGTERM)
    code = script.wait(timeout=60)
    if code != 130 or not asked.exists() or asked.read_text() != "requeue 77\n":
        sys.exit(f"Slurm's script at the end of its time: found exit code {code} and {asked.exists()}, expected 130 and one 'scontrol requeue 77'")


def end_in_the_middle(render, folder, scene, environment):
    """Ends a worker by SIGTERM once it has made a frame; what is left must be whole frames, within 5 s and with 130."""
    folder.mkdir()
    worker = subprocess.Popen([render, scene, "-o", folder / "f##.png", CAMERA, "--quiet", *PICTURE], env=environment)
    while not (folder / "f00.png").exists() and worker.poll() is None:
        time.sleep(0.005)
    worker.send_signal(signal.SIGTERM)
    begin = time.monotonic()
    code = worker.wait(timeout=60)
    if code != 130 or time.monotonic() - begin > 5.0:
        sys.exit(f"a worker asked to end: found {code} after {time.monotonic() - begin:.1f} s, expected 130 within 5 s")


def main():
    programs, farm = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        scene = work / "cloud.soct"
        (work / "cloud.xyz").write_text("".join(f"{i % 20} {i // 20} {(i % 7) * 0.1}\n" for i in range(400)))
        run(programs / "splatray-preprocess", work / "cloud.xyz", "-o", scene)
        (work / "whole").mkdir()
        run(programs / "splatray-render", scene, "-o", work / "whole" / "f##.png", CAMERA, "--quiet", *PICTURE)
        whole = pictures(work / "whole")
        expect_same(by_slurm_script(farm, work / "slurm", scene, environment), whole, "Slurm's script")
        end_in_the_middle(programs / "splatray-render", work / "ended", scene, environment)
        some = pictures(work / "ended")
        if not 0 < len(some) < FRAMES:
            sys.exit(f"a worker ended in the middle left {len(some)} frames, expected some")
        expect_same(some, {name: whole[name] for name in some}, "a worker ended in the middle")
        expect_same(by_slurm_script(farm, work / "ended", scene, environment), whole, "Slurm's script after that")
        if by_slurm_script(farm, work / "other", scene, environment, "--resolution=64x36 --samples=3") == whole:
            sys.exit("pictures of 3 samples are those of 2: the comparison is blind")
        end_slurm_script(farm, work / "slurm_end", scene, environment)
        made = by_openjd(farm, work, scene, environment)
        if made is not None:
            expect_same(made, whole, "Open Job Description")


if __name__ == "__main__":
    main()
