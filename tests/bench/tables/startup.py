"""startup.py SCENE.soct --bin FOLDER -o STARTUP.json [--runs N]: what passes between a program's start and its first pixel,
for splatray-render and splatray-view as they are, with the driver's shader cache empty (cold) and filled (warm). Medians of
N runs of each, cold and warm in turn; each run's cache lies in a folder of its own (XDG_CACHE_HOME). The viewer needs Xvfb;
without it it is left out. JSON: a list of {"program", "cache", "runs", "commit", "date", "device": {"name", "driver"}, "ms": {stage: median}, "ms_min": {..}}. Stages in
milliseconds: load_program, from exec to the program's own code and back (its --help); what --stats-json reports; wall; and
other, the wall time that no stage reports."""

import argparse
import datetime
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import time

SIZE = "512x512"
#: The viewer shows its first picture within this time or is taken to hang, seconds.
VIEWER_SECONDS = 30


def run(words, environment, **options):
    """Wall time of a program, ms."""
    start = time.perf_counter()
    subprocess.run(words, env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
    return 1000.0 * (time.perf_counter() - start)


def measure_render(binaries, scene, environment, folder):
    """Stages of one picture."""
    program = str(binaries / "splatray-render")
    help_ms = run([program, "--help"], environment)
    stats = folder / "stats.json"
    words = [program, str(scene), "--quiet", "-o", str(folder / "a.png"), "--resolution", SIZE, "--samples", "1"]
    wall = run(words + ["--stats-json", str(stats)], environment)
    reported = json.loads(stats.read_text())
    times = reported["times_ms"]
    # `trace` is the dispatch, which compiles on its first use on some drivers; `render` is all of the frame.
    stages = {name: times[name] for name in ("device", "load", "upload", "trace", "write")}
    stages["render_besides_trace"] = times["render"] - times["trace"]
    rest = {"other": wall - help_ms - sum(stages.values()), "wall": wall}
    return {"load_program": help_ms} | stages | rest, reported


def measure_view(binaries, scene, environment, folder):
    """Time to the viewer's first picture, from its own start."""
    program = str(binaries / "splatray-view")
    help_ms = run([program, "--help"], environment)
    stats = folder / "view.json"
    words = [program, str(scene), "--resolution", SIZE, "--samples", "1", "--stats-json", str(stats)]
    viewer = subprocess.Popen(words, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        close_when_shown(environment)
        viewer.wait(VIEWER_SECONDS)
    finally:
        viewer.kill()
    reported = json.loads(stats.read_text())
    return {"load_program": help_ms, "first_picture": reported["first_picture_ms"]}, reported


def close_when_shown(environment):
    """Quits the viewer by its key once its window is there and has had time to draw."""
    find = ["xdotool", "search", "--sync", "--onlyvisible", "--name", "splatray"]
    subprocess.run(find, env=environment, check=True, stdout=subprocess.DEVNULL, timeout=VIEWER_SECONDS)
    time.sleep(3.0)
    subprocess.run(["xdotool", "key", "ctrl+q"], env=environment, check=True, timeout=VIEWER_SECONDS)


class Display:
    """An X server of its own for as long as the `with` block runs."""

    def __enter__(self):
        read, write = os.pipe()
        words = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
        self.server = subprocess.Popen(words, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as stream:
            return ":" + stream.readline().strip()

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def measure(program, runs, like=None):
    """Records of one program, cold and warm; `program` = name and a function of environment and folder. `like`: a record of the same
    build and device, for a program whose statistics do not name them."""
    name, stages_of = program
    times = {"cold": [], "warm": []}
    for _ in range(runs):
        with tempfile.TemporaryDirectory() as folder:
            environment = os.environ | {"XDG_CACHE_HOME": folder}
            for cache in ("cold", "warm"):
                stages, reported = stages_of(environment, pathlib.Path(folder))
                times[cache].append(stages)
    about = {
        "commit": (like or reported)["commit"],
        "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
        "device": {key: (like or reported)["device"][key] for key in ("name", "driver")},
    }
    records = []
    for cache, measured in times.items():
        record = {"program": name, "cache": cache, "runs": runs} | about
        for key, choose in (("ms", statistics.median), ("ms_min", min)):
            record[key] = {stage: choose([one[stage] for one in measured]) for stage in measured[0]}
        records.append(record)
    return records


def main():
    parser = argparse.ArgumentParser(description="Measures the start of splatray-render and splatray-view.")
    parser.add_argument("scene", type=pathlib.Path, help=".soct file")
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="JSON file to write")
    parser.add_argument("--runs", type=int, default=9, help="of each program and cache (default 9)")
    options = parser.parse_args()
    places = options.bin, options.scene
    records = measure(("splatray-render", lambda *where: measure_render(*places, *where)), options.runs)
    if shutil.which("Xvfb") and shutil.which("xdotool"):
        with Display() as display:
            os.environ["DISPLAY"] = display
            records += measure(("splatray-view", lambda *where: measure_view(*places, *where)), options.runs, records[0])
    else:
        print("splatray-view: left out, Xvfb or xdotool is not installed")
    options.output.write_text(json.dumps(records, indent=1) + "\n")


if __name__ == "__main__":
    main()
