"""scale.py FOLDER: the report of scale, FOLDER/scale.md with its picture, from the records that lie there: scale_rays.json,
scale_features.json, scale_coverage.json and scale_startup.json. A part without records is left out. Needs matplotlib."""

import argparse
import itertools
import json
import math
import pathlib

import scale_plot
from report import machine_lines, picture
from report_records import Records, splats_text
from report_tables import number, table, targets_table
from report_targets import Target, at_least, at_most
from scale_records import PEERS, Races, cost, exponent, line_fit, sizes_of

BLENDINGS = ("window", "nearest")
WANTED_FPS = 20.0
WANTED_FPS_COVERAGE = 0.3
WANTED_MRAYS = 4.0
WANTED_TESTS = 12.0
WANTED_BLENDING = 1.25
WANTED_BYTES = 64.0
WANTED_START_MS = 500.0
#: Stages of a program's start that are the driver's: it is opened, and makes the pipelines. Tracing is not.
DRIVER_STAGES = ("device", "render_besides_trace")

CLASSES = {
    "primary": "one ray through each pixel's centre",
    "shadow": "one ray to a directional light from each hit that faces it: a frame with them less one without",
    "mirror": "4 mirrored rays after each pixel's, inside the sphere as a mirror: a frame with them less one without",
    "random": "rays from all around in no order, all of which meet the sphere",
}

NOTES = """
- Times are medians over rounds in which splatray and one peer trace one frame each in turn; a ratio is that of the two in
  the same rounds. splatray's are those of the dispatches and include shading, Embree's are wall times of tracing alone on
  all threads. Shadow rays stop at any hit in both.
- Embree's shadow and mirrored rays start 0.1 median radii off the surface; splatray's know the sheet that they leave.
  Embree's rays are traced in bundles of eight, declared incoherent in the random class; race.md has it at its best.
- Errors are measured in the same run: of primary rays against the exact sphere's picture, of random rays against the
  exact sphere, of mirrored rays by further paths of 16 bounces (a bounce is wrong that misses or ends more than 2 median
  radii off), of shadow rays by those that are blocked, as truly none is. "Unlike" are answers that differ from splatray's
  in hit or miss or by more than 0.1 median radii in depth.
- A feature "unused" is in the scene but not in view: it belongs to a cap on the far side of the sphere, or is a light from
  behind, white colours, flat normal fields, or a texture of one colour. Its picture must be that without the feature.
- "First frame" of a program's start is its first dispatch, in which llvmpipe compiles what its cache does not hold;
  "pipeline" is what else its render call does. "Load program" is the time of its --help.
"""


def versus(pair):
    """The peer's time, and splatray's over it."""
    if pair is None:
        return "–"
    return f"{number(cost(pair[1]))} (×{number(cost(pair[0]) / cost(pair[1]), 2)})"


def rays_table(records, rays):
    """A line for each number of splats: splatray, and each peer with splatray's time over its."""
    races = Races(records, rays)
    peers = [peer for peer in PEERS if races.curve(peer)]
    rows = []
    for splats in sizes_of(records):
        own = races.own(splats)
        row = (splats_text(splats), number(cost(own)), number(own.get("rays_per_s") / 1e6))
        rows.append(row + tuple(versus(races.pair(splats, peer)) for peer in peers))
    return table(["splats", "splatray, ms", "Mray/s"] + [f"{PEERS[peer]}, ms (splatray / it)" for peer in peers], rows)


ERRORS = {
    "mismatch_ppm": "mismatch, ppm",
    "normal_p99_deg": "normals p99, °",
    "normal_rms_deg": "normals rms, °",
    "depth_bias_r": "depth bias, r",
    "false_shadows_ppm": "false shadows, ppm",
    "wrong_bounces_ppm": "wrong bounces, ppm",
    "unlike_ppm": "unlike splatray, ppm",
}


def errors_table(records):
    """Errors of every run, and the memory it took."""
    rows, seen = [], set()
    for rays in CLASSES:
        for splats in sizes_of(records):
            for run in Races(records, rays).all(splats):
                name = run.data["method"] if not run.is_ours else f"splatray {run.data['method']}"
                if (rays, splats, name) in seen:
                    continue
                seen.add((rays, splats, name))
                values = tuple(number(run.get(key)) for key in ERRORS)
                rows.append((rays, splats_text(splats), name, number(run.get("bytes_per_splat"))) + values)
    return table(["rays", "splats", "method", "bytes/splat"] + list(ERRORS.values()), rows)


def growth_table(records):
    """Exponents of time over the number of splats."""
    rows = []
    for rays in CLASSES:
        races = Races(records, rays)
        for method, name in scale_plot.NAMES.items():
            law = exponent(races.curve(method)) if races.curve(method) else None
            if law:
                rows.append((rays, name, f"{law[0]:.3f}", f"×{number(law[1])}"))
    return table(["rays", "method", "exponent", "farthest from the law"], rows)


def steps_sentence(races):
    """How the work of a ray grows; empty for one number of splats."""
    points = [(math.log2(splats), races.own(splats).get("steps_per_ray")) for splats, _ in races.curve("window")]
    fit = line_fit(points)
    if not fit:
        return ""
    slope, start = fit
    worst = max(abs(slope * x + start - y) for x, y in points)
    return (
        f"A primary ray reads {number(slope)} more node words with each doubling of the splats; the straight line over "
        f"log2 N is off by at most {number(worst)} of them.\n"
    )


def rays_parts(records, folder):
    parts = ["## Rays, side by side\n"]
    for rays, text in CLASSES.items():
        parts += [f"### {rays}: {text}\n", rays_table(records, rays)]
    races = Races(records, "primary")
    scale_plot.plot_growth(races, folder / "scale.png")
    parts += ["## Growth with the number of splats\n", picture("scale.png", "time and work over the number of splats")]
    parts += [steps_sentence(races), growth_table(records)]
    return parts + ["## Errors of the same runs\n", errors_table(records)]


def use_text(run, absent):
    if run is None:
        return "–"
    return f"{number(run.ms)} (×{number(run.ms / absent.ms)})" if run is not absent else number(run.ms)


def features_parts(records):
    """A line for each feature: times of its uses, work of a ray, and whether the unused one changes the picture."""
    runs = {}
    for run in records.all:
        runs.setdefault(run.data["feature"], {})[run.data["use"]] = run
    rows = []
    for feature, uses in runs.items():
        absent, unused, used = (uses.get(use) for use in ("absent", "unused", "used"))
        work = tuple(
            " / ".join(number(run.get(key)) if run else "–" for run in (absent, unused, used))
            for key in ("rays", "steps_per_ray", "tests_per_ray")
        )
        differs = number(unused.get("differs_ppm")) if unused else "–"
        rows.append((feature,) + tuple(use_text(run, absent) for run in (absent, unused, used)) + work + (differs,))
    head = ["feature", "absent, ms", "unused, ms", "used, ms", "rays", "node words/ray", "tests/ray"]
    size = records.all[0]
    view = f"{splats_text(size.get('splats'))} splats, {size.get('width')}x{size.get('height')}, every pixel hits."
    return ["## Features\n", view + "\n", table(head + ["pixels changed by the unused, ppm"], rows)]


def coverage_runs(records):
    """(case, coverage, runs) of each case and coverage; runs by blending and whether there are shadow rays."""
    for case in records.unique("case"):
        for coverage in dict.fromkeys(run.get("coverage") for run in records.choose(case=case)):
            runs = records.choose(case=case, coverage=coverage)
            yield case, coverage, {(run.method, run.get("shadows")): run for run in runs}


def blending_cost(runs, shadows):
    """A shaded frame's time blended by window over that by nearest, both with one shadow ray or without."""
    return runs["window", shadows].ms / runs["nearest", shadows].ms


def coverage_parts(records):
    rows = []
    for case, _, runs in coverage_runs(records):
        fps = [number(1000.0 / runs[key].ms) for key in itertools.product(BLENDINGS, (False, True))]
        window = runs["window", True]
        errors = number(max(run.get("mismatch_ppm") for run in runs.values()))
        share = f"{100 * window.data['coverage']:.1f} %"
        costs = [number(blending_cost(runs, shadows)) for shadows in (False, True)]
        rows.append((case, share, *fps, *costs, number(window.get("bytes_per_splat")), errors))
    head = ["scene", "pixels that hit", "`window`, frames/s", "one shadow ray", "`nearest`, frames/s", "one shadow ray"]
    head += ["`window` / `nearest`, ms", "one shadow ray", "bytes/splat", "hits unlike brute force, ppm"]
    return ["## Frames by coverage\n", table(head, rows)]


STAGES = {
    "load_program": "load program",
    "device": "device",
    "load": "read scene",
    "upload": "upload",
    "render_besides_trace": "pipeline",
    "trace": "first frame",
    "write": "write",
    "other": "rest",
    "wall": "wall",
    "first_picture": "first picture",
}


def own_ms(record):
    """What of a start is not the driver's."""
    return record["ms"]["wall"] - sum(record["ms"][stage] for stage in DRIVER_STAGES)


def machine_line(record, part):
    """Device, driver, commit and day of a record of this part, in the form of machine_lines()."""
    device = record["device"]
    return f"- {device['name']}, {device['driver']}, commit {record['commit']}, {record['date']}, {part}"


def startup_parts(records):
    rows = []
    for record in records:
        values = tuple(number(record["ms"].get(stage)) for stage in STAGES)
        own = number(own_ms(record)) if "wall" in record["ms"] else "–"
        rows.append((record["program"], record["cache"]) + values + (own,))
    head = ["program", "shader cache"] + [f"{name}, ms" for name in STAGES.values()] + ["own, ms"]
    return ["## From a program's start to its first pixel\n", table(head, rows)]


def coverage_targets(records):
    for case, coverage, runs in coverage_runs(records):
        view = f"{case}, {100 * coverage:.0f} % coverage"
        window = runs["window", False]
        if coverage == WANTED_FPS_COVERAGE:
            for blend in BLENDINGS:
                what = f"{view}, {blend}, one shadow ray"
                yield at_least(what, WANTED_FPS, " frames/s", 1000.0 / runs[blend, True].ms)
        else:
            yield at_least(f"{view}, primary rays", WANTED_MRAYS, " M/s", window.get("rays_per_s") / 1e6)
            yield at_most(f"{view}, splat tests of a ray", WANTED_TESTS, "", window.get("tests_per_ray"))
        for shadows, rays in ((False, ""), (True, ", one shadow ray")):
            yield at_most(f"{view}, `window` / `nearest`{rays}", WANTED_BLENDING, "", blending_cost(runs, shadows))
    for case in records.unique("case"):
        yield at_most(f"{case}, bytes a splat", WANTED_BYTES, "", records.choose(case=case)[0].get("bytes_per_splat"))


def targets(coverage, startup):
    lines = list(coverage_targets(coverage)) if coverage else []
    for record in startup:
        if record["cache"] == "warm" and "wall" in record["ms"]:
            what = f"{record['program']}: start to picture less opening the driver and its pipelines"
            own = own_ms(record)
            lines.append(Target(what, f"below {WANTED_START_MS:g} ms", f"{own:.3g} ms", own < WANTED_START_MS))
    return lines


def read(folder, part):
    """The records of a part, or None."""
    path = folder / f"scale_{part}.json"
    records = Records([path]) if path.exists() else None
    return records if records and records.all else None


def main():
    parser = argparse.ArgumentParser(description="Writes the report of scale.")
    parser.add_argument("folder", type=pathlib.Path, help="holds the records; gets scale.md and scale.png")
    parser.add_argument("--commands", default="tests/bench/scale", help="shown in the report")
    options = parser.parse_args()
    rays, features, coverage = (read(options.folder, part) for part in ("rays", "features", "coverage"))
    path = options.folder / "scale_startup.json"
    startup = json.loads(path.read_text()) if path.exists() else []
    machines = [line for records in (rays, features, coverage) if records for line in machine_lines(records)]
    machines += [machine_line(record, "start of programs") for record in startup if "commit" in record]
    parts = ["# Scale\n", "\n".join(dict.fromkeys(machines)) + "\n", f"```sh\n{options.commands}\n```\n"]
    parts += ["## Targets\n", targets_table(targets(coverage, startup))]
    parts += rays_parts(rays, options.folder) if rays else []
    parts += features_parts(features) if features else []
    parts += coverage_parts(coverage) if coverage else []
    parts += startup_parts(startup) if startup else []
    (options.folder / "scale.md").write_text("\n".join(parts + ["## How to read it\n", NOTES.strip() + "\n"]))


if __name__ == "__main__":
    main()
