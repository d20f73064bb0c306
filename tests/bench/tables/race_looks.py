"""race_looks.py RENDER SCENE... -o FILE [--runs N]: times of a frame of one sample in each look on the host, 512 x 512 pixels, the looks
in turn. JSON: a list of {case, look, ms: [of each run], commit, date}; ms are those of tracing."""

import argparse
import datetime
import json
import pathlib
import subprocess
import tempfile

LOOKS = ("paper", "ao", "scan", "lit")


def trace_ms(render, scene, look, folder):
    picture, stats = pathlib.Path(folder, "picture.exr"), pathlib.Path(folder, "stats.json")
    command = [render, scene, "--device", "cpu", "--look", look, "--resolution", "512x512", "--samples", "1", "--quiet"]
    subprocess.run([*command, "-o", picture, "--stats-json", stats], check=True)
    read = json.loads(stats.read_text())
    picture.unlink()
    stats.unlink()
    return read["times_ms"]["trace"], read["commit"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("render")
    parser.add_argument("scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    records = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            times = {look: [] for look in LOOKS}
            for _ in range(options.runs):
                for look in LOOKS:
                    ms, commit = trace_ms(options.render, scene, look, folder)
                    times[look].append(ms)
            day = datetime.date.today().isoformat()
            records += [{"case": scene.stem, "look": look, "ms": ms, "commit": commit, "date": day} for look, ms in times.items()]
    options.output.write_text(json.dumps(records))


if __name__ == "__main__":
    main()
