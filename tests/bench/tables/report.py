"""report.py RECORDS... -o FOLDER: the report of speed against error, FOLDER/README.md with its pictures, from the
records that splatray-bench and splatray-bench peers wrote (JSON files or folders of them; the first device's are the
ones compared in detail, another machine's are added). Needs matplotlib."""

import argparse
import json
import pathlib

import report_plots as plots
import report_tables as tables
from report_records import OURS, Records
from report_targets import targets

NOTES = """
- Times are medians of at least 9 frames measured in rounds, one frame of every setting in turn; splatray's are those of the
  dispatches and include shading, Embree's are wall times of tracing alone, on all threads unless the table says
  otherwise. "Embree window" blends as splatray's default does, with the splats' normal fields, so that their errors are
  the same; "flat, Gaussian" are Embree's discs as they are usually blended. Both send one ray through each pixel's centre;
  splatray leaves out the pixels that no leaf projects to.
- Errors are measured on the same rays against the same truth: analytic shapes in float64, or the source mesh in
  float64. Holes, rms and jump of sphere and torus come from rays from all around that meet the surface at less than
  78 degrees from its normal.
- Normals' errors include silhouettes; mismatch counts pixels that hit where the truth misses or the reverse.
- Embree tests discs and triangles in float32 and does not cull back faces; here it hides them by splatray's rule
  where an object is one-sided. Its window ends at the first hit's window when the filter finds that hit; splatray's
  decides every hit exactly.
- Holes are rays inside the silhouette that miss, with the 95 % Wilson interval in brackets.
"""


def machine_lines(records):
    """Devices, drivers, commits and days of the records, once each."""
    lines = []
    for record in records.all:
        device = record.data["device"]
        threads = f", {record.get('threads')} threads" if record.get("threads") else ""
        day = f", {record.data['date']}" if "date" in record.data else ""
        line = f"- {device['name']}, {device['driver']}{threads}, commit {record.data['commit']}{day}"
        if line not in lines and records.uses_all_threads(record):
            lines.append(line)
    return lines


def picture(path, text):
    return f"![{text}]({path})\n"


def summary_lines(records, lines):
    """The report in three sentences."""
    reached = sum(target.reached for target in lines)
    text = [f"{reached} of {len(lines)} targets are reached."]
    ratios = []
    for device in records.devices():
        for case in records.unique("case", method="embree window"):
            ours = records.choose(case=case, method="window", varied="", device=device)
            theirs = [r for r in records.choose(case=case, method="embree window", varied="") if records.uses_all_threads(r)]
            if ours and theirs and ours[0].ms:
                ratios.append((device, ours[0].ms / theirs[0].ms))
    for device in records.devices():
        own = sorted(ratio for name, ratio in ratios if name == device)
        if own:
            text.append(
                f"On {tables.short(device)} a frame takes {tables.number(own[0], 2)} to {tables.number(own[-1], 2)} times as "
                f"long as Embree's oriented discs with the same blending of the same splats (median "
                f"{tables.number(own[len(own) // 2], 2)}); splatray alone leaves out the pixels that no leaf projects to, and its "
                f"time is that of the dispatches. The race without that, on real models and with wall times: scale.md."
            )
    return " ".join(text)


def read_counts(path):
    """What splatray-bench exact counted; nothing without the file."""
    return json.loads(path.read_text()) if path and path.exists() else []


def overview(records, folder, commands, lines):
    """What a person reads in a minute: sentences, machines, commands, two pictures, targets."""
    plots.plot_speed(records, folder / "speed.png")
    plots.plot_exactness(records, folder / "exactness.png")
    return [
        "# Speed against error\n",
        summary_lines(records, lines) + "\n",
        "\n".join(machine_lines(records)) + "\n",
        "```sh\n" + commands + "\n```\n",
        picture("speed.png", "time of a frame of each method"),
        picture("exactness.png", "normals' error over the number of splats"),
        "## Targets\n",
        tables.targets_table(lines),
    ] + (["## At the same error, how fast?\n", tables.same_error_table(records)] if records.peer_devices() else [])


def scenes(records, folder):
    """A figure for each scene, and how tight the radii are."""
    parts = ["## Each scene\n"]
    for scene in records.picture_scenes():
        name = scene.replace(" ", "_") + ".png"
        plots.plot_scene(records, scene, folder / name)
        parts.append(picture(name, f"{scene}: time against error"))
    if plots.plot_watertight(records, folder / "watertight.png"):
        parts += ["## Watertight: overlap against holes\n", picture("watertight.png", "holes against overlap")]
    return parts


def details(records):
    """Tables."""
    parts = []
    paper = tables.paper_table_1(records), tables.paper_table_2(records)
    if any(paper):
        parts += ["## The paper's Tables I and II (512x512; II: 16 samples)\n", *paper]
    parts += ["## Work and memory, default settings\n", tables.work_table(records)]
    parts += ["## Growth of each insertion policy\n", tables.growth_table(records)]
    parts.append("## One knob at a time\n")
    for case in records.unique("case", varied=("leaf_size", "kappa", "radius_rule", "side", "samples"), method=OURS):
        if records.choose(case=case, varied="", method="window", device=records.devices()[0]):
            parts += [f"### {case}\n", tables.knobs_table(records, case)]
    parts += ["## Every method at the default number of splats\n", tables.peers_table(records)]
    return parts + ["## How to read it\n", NOTES.strip() + "\n"]


def main():
    parser = argparse.ArgumentParser(description="Writes the report of speed against error.")
    parser.add_argument("records", nargs="+", help="JSON files, or folders of them")
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path, help="folder of README.md and its pictures")
    parser.add_argument("--commands", default="tests/bench/report", help="shown in the report")
    parser.add_argument("--exactness", type=pathlib.Path, help="counts of splatray-bench exact")
    parser.add_argument("--hard", type=pathlib.Path, help="table of hard_test")
    options = parser.parse_args()
    records = Records(options.records)
    if not records.devices():
        parser.error(f"found no records of splatray-bench in {', '.join(options.records)}, expected at least one")
    options.output.mkdir(parents=True, exist_ok=True)
    hard = options.hard.read_text() if options.hard else ""
    lines = targets(records, read_counts(options.exactness), hard)
    parts = overview(records, options.output, options.commands, lines) + scenes(records, options.output) + details(records)
    (options.output / "README.md").write_text("\n".join(parts))


if __name__ == "__main__":
    main()
