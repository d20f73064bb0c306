"""race.py FOLDER: the report of tests/bench/race, FOLDER/race.md, from the records that lie there: race_rays.json, race_looks.json, race_python.json and
race_light.json. A part without records is left out."""

import argparse
import json
import pathlib
import statistics

from report_records import splats_text
from report_tables import number, table
from report_targets import Target, at_least, at_most
from report_tables import targets_table

#: Kinds of rays (race_rays.h) as the table heads them, with the most that splatray's time over Embree's best may be.
KINDS = {
    "frame": ("window", "a frame", 0.8),
    "nearest": ("nearest", "`nearest`", None),
    "four": ("window", "4 samples a pixel", 0.5),
    "mirrored": ("window", "mirrored", 1.3),
    "random": ("window", "random", 1.0),
    "shadow": ("window", "towards a light, any hit", 1.3),
    "occluded": ("window", "random, any hit", 1.3),
}
WANTED_ON_ANY = 1.0
WANTED_GROWTH = 1.3
WANTED_THREADS = 1.9
WANTED_AVX2 = 1.3
MILLION = (900_000, 1_100_000)

NOTES = """
- A ratio is splatray's time over that of Embree's best settings (discs or clusters of 32, calls of 1, 8 or 16 rays, medium or high quality, the
  least median), both medians of frames in turn; splatray's are those of its dispatches and include shading, Embree's are wall times of
  tracing alone on all threads. Embree's secondary rays start a median radius off the surface; splatray's know the sheet that they leave.
- Unlike: rays that hit in one and miss in the other, or are more than a tenth of a thousandth of their depth apart: Embree's discs end at no
  clip lines (fandisk, gears, turbine_blade have these) and know no constant terms of normal fields, which raise or lower a surface.
- Through Python one core is used; the mesh has about as many triangles as splatray has splats.
- Light: seconds times squared noise, of one picture each of the same scene; noise is half of what two pictures differ by.
"""


def median(values):
    return statistics.median(values)


def time_of(record):
    return median(record["ms"])


class Rays:
    """The records of one scene."""

    def __init__(self, records, case):
        self._records = [record for record in records if record["case"] == case]
        self.splats = self._records[0]["splats"]

    def _choose(self, kind):
        blend = KINDS[kind][0]
        rays = "frame" if kind == "nearest" else kind
        return [r for r in self._records if r["rays"] == rays and r["method"].split()[-1] == blend]

    def own(self, kind="frame", **settings):
        return next((r for r in self._choose(kind) if not r["method"].startswith("embree") and r["settings"] == settings), None)

    def peer(self, kind):
        return min((r for r in self._choose(kind) if r["method"].startswith("embree")), key=time_of)

    def ratio(self, kind):
        return time_of(self.own(kind)) / time_of(self.peer(kind))

    def share(self, **settings):
        """splatray's time with these settings over its time without them; None where that was not measured."""
        own = self.own(**settings)
        return time_of(own) / time_of(self.own()) if own else None

    def unlike_ppm(self):
        return max(self.peer(kind)["unlike_ppm"] for kind in KINDS)


def is_million(rays):
    return MILLION[0] <= rays.splats <= MILLION[1]


def models_of(records):
    """Of each scene, those of a million first."""
    cases = {case: Rays(records, case) for case in dict.fromkeys(record["case"] for record in records)}
    return dict(sorted(cases.items(), key=lambda item: (not is_million(item[1]), item[1].splats if not is_million(item[1]) else 0)))


def peer_text(rays):
    best = rays.peer("frame")
    return f"{best['method'].split()[1]}, {best['settings']['width']}, {best['settings']['quality']}"


def rays_parts(models):
    head = ["scene", "splats", "ms a frame"] + [KINDS[kind][1] for kind in KINDS] + ["1 thread", "AVX2", "unlike, ppm", "Embree's best of a frame"]
    rows = []
    for case, rays in models.items():
        shares = [rays.share(threads=1), rays.share(vector_bits=256)]
        rows.append((case.rsplit("_", 1)[0], splats_text(rays.splats), number(time_of(rays.own())), *[number(rays.ratio(kind), 2) for kind in KINDS],
                     *[number(share, 3) for share in shares], number(rays.unlike_ppm()), peer_text(rays)))
    million = [rays for rays in models.values() if is_million(rays)]
    if million:
        rows.append(("**median of a million**", "", "", *[f"**{number(median([rays.ratio(kind) for rays in million]), 2)}**" for kind in KINDS], "", "", "", ""))
    return ["## Rays beside Embree at its best\n", table(head, rows)]


def ray_targets(models):
    million = [rays for rays in models.values() if is_million(rays)]
    for kind, (_, text, wanted) in KINDS.items():
        if million and wanted:
            yield at_most(f"{text}: of Embree's best, median of models of a million", wanted, "", median([rays.ratio(kind) for rays in million]))
    if million:
        yield at_most("a frame, on any of them", WANTED_ON_ANY, "", max(rays.ratio("frame") for rays in million))
        threads = [rays.share(threads=1) for rays in million if rays.share(threads=1)]
        narrow = [rays.share(vector_bits=256) for rays in million if rays.share(vector_bits=256)]
        if threads:
            yield at_least("a frame by one thread, of that by all, median", WANTED_THREADS, "", median(threads))
            yield at_most("a frame by AVX2, of that by AVX-512, median", WANTED_AVX2, "", median(narrow))
    grown = [rays.ratio("frame") for case, rays in models.items() if not is_million(rays) or case.startswith("dragon")]
    if len(grown) > 1:
        yield at_most("a frame from the fewest splats to the most: largest ratio over the least", WANTED_GROWTH, "", max(grown) / min(grown))


def looks_parts(records):
    cases = dict.fromkeys(record["case"] for record in records)
    looks = list(dict.fromkeys(record["look"] for record in records))
    times = {(record["case"], record["look"]): time_of(record) for record in records}
    rows = [(case.rsplit("_", 1)[0], *[number(times[case, look]) for look in looks]) for case in cases]
    return ["## Looks: ms of a frame of one sample, 512x512\n", table(["scene"] + [f"`{look}`" for look in looks], rows)]


PYTHON_WANTED = {("camera", "embreex"): 1.0, ("camera", "open3d"): 0.8, ("random", "embreex"): 0.8, ("random", "open3d"): 0.45}
OCCLUDED_WANTED = 1.5


def python_parts(records):
    rates = {(r["rays"], r["program"]): r for r in records}
    programs = list(dict.fromkeys(r["program"] for r in records))
    rows = []
    for rays in dict.fromkeys(r["rays"] for r in records):
        own = median(rates[rays, "splatray"]["rate"])
        cells = [f"{number(median(rates[rays, p]['rate']))} (×{number(own / median(rates[rays, p]['rate']), 2)})" for p in programs if p != "splatray"]
        hits = ", ".join(f"{100 * rates[rays, p]['hits']:.1f}" for p in programs)
        rows.append((rays, number(own), *cells, hits))
    versions = [f"{p} {rates['camera', p]['version']}" for p in programs if p != "splatray"]
    size = f"{splats_text(records[0]['points'])} points beside {splats_text(records[0]['triangles'])} triangles, million rays a second on one core."
    head = ["rays", "splatray"] + [f"{version} (splatray / it)" for version in versions] + ["hit, %: each"]
    return ["## Rays through Python\n", size + "\n", table(head, rows)]


def python_targets(records):
    rates = {(r["rays"], r["program"]): median(r["rate"]) for r in records}
    for (rays, program), wanted in PYTHON_WANTED.items():
        yield at_least(f"{rays} rays through Python, of {program}'s", wanted, "", rates[rays, "splatray"] / rates[rays, program])
    yield at_least("`occluded` through Python, of `trace`", OCCLUDED_WANTED, "", rates["occluded", "splatray"] / rates["random", "splatray"])


LIGHT_WANTED = {"dragon": 1.0, "room with windows": 4.0, "Cornell box, emissive object": 5.0}


def light_parts(records):
    rows = [(r["scene"], f"{r['light']:.4f}", *[number(100 * n) for n in r["noise"]], *[number(s) for s in r["seconds"]], number(r["ratio"])) for r in records]
    head = ["scene", "light, of Mitsuba's", "noise, %", "Mitsuba's", "seconds", "Mitsuba's", "time to 2 %, of Mitsuba's"]
    return ["## Light beside Mitsuba 3.9.1 (LLVM) on the meshes\n", table(head, rows)]


def light_targets(records):
    for record in records:
        if record["scene"] in LIGHT_WANTED:
            yield at_most(f"{record['scene']}: time to 2 %, of Mitsuba's", LIGHT_WANTED[record["scene"]], "", record["ratio"])


def machine_lines(parts):
    """Each part's commits and days; the devices of the rays."""
    lines = []
    for name, records in parts.items():
        named = {f"commit {r['commit']}, {r['date']}" for r in records if "date" in r} or {f"commit {r['commit']}" for r in records}
        lines += [f"- {name}: {one}" for one in sorted(named)]
    devices = {f"{r['device']['name']}, {r['device']['driver']}" for r in parts.get("rays", [])}
    return lines + [f"- {device}" for device in sorted(devices)]


def read(folder, part):
    path = folder / f"race_{part}.json"
    return json.loads(path.read_text()) if path.exists() else []


def main():
    parser = argparse.ArgumentParser(description="Writes the report of the race with peers.")
    parser.add_argument("folder", type=pathlib.Path, help="holds the records; gets race.md")
    parser.add_argument("--commands", default="tests/bench/race", help="shown in the report")
    options = parser.parse_args()
    parts = {name: records for name in ("rays", "looks", "python", "light") if (records := read(options.folder, name))}
    models = models_of(parts.get("rays", []))
    makers = {
        "rays": lambda records: (rays_parts(models), ray_targets(models)),
        "looks": lambda records: (looks_parts(records), []),
        "python": lambda records: (python_parts(records), python_targets(records)),
        "light": lambda records: (light_parts(records), light_targets(records)),
    }
    made = [makers[name](records) for name, records in parts.items()]
    targets: list[Target] = [target for _, some in made for target in some]
    text = ["# The host beside its peers\n", "\n".join(machine_lines(parts)) + "\n", f"```sh\n{options.commands}\n```\n"]
    text += ["## Targets\n", targets_table(targets)] + [line for lines, _ in made for line in lines]
    (options.folder / "race.md").write_text("\n".join(text + ["## How to read it\n", NOTES.strip() + "\n"]))


if __name__ == "__main__":
    main()
