"""What was asked for, beside what was measured: every line, those that are missed too."""

import re
from dataclasses import dataclass

MESHES = ("bunny", "armadillo", "dragon", "igea")
#: Most error of the normals' 95th percentile at the meshes' own vertices, degrees.
VERTEX_P95_DEG = {"bunny": 3.0, "armadillo": 6.0, "dragon": 4.5, "igea": 2.0}
#: Sum of the discs' areas over the surface's, of even samples and of meshes' own vertices.
CLOSED_OVERLAP = 2.2
#: Rays of each kind that "no hit differs" is asked of.
EXACT_RAYS, EXACT_RAYS_ADVERSARIAL = 10_000_000, 1_000_000
EXACT_KINDS = ("primary", "shadow", "mirrored", "refracted", "random")
SHAPES = ("sphere even", "sphere random", "torus")


@dataclass
class Target:
    """One line: what, at most (or least) how much, and what it is."""

    what: str
    wanted: str
    measured: str
    reached: bool


def at_most(what, limit, unit, value):
    return Target(what, f"at most {limit:g}{unit}", f"{value:.3g}{unit}", value <= limit)


def at_least(what, limit, unit, value):
    return Target(what, f"at least {limit:g}{unit}", f"{value:.3g}{unit}", value >= limit)


def default_run(records, **wanted):
    """The window run with all knobs at their defaults, on the first device; None when there is none."""
    runs = records.choose(method="window", varied=("", "splats"), device=records.devices()[0], **wanted)
    return max(runs, key=lambda run: run.get("splats")) if runs else None


def mesh_targets(records):
    for mesh in MESHES:
        run = default_run(records, scene=mesh, sampling="even")
        if run and run.get("splats") > 900_000:
            name = f"{mesh}, 1M even samples: "
            yield at_most(name + "normals p95", 1.5, "°", run.get("normal_p95_deg"))
            yield at_most(name + "normals p99", 3.5, "°", run.get("normal_p99_deg"))
            yield at_most(name + "median depth error / diagonal", 1e-5, "", run.get("depth_abs_median"))
            yield at_most(name + "hit or miss differs", 300, " ppm", run.get("mismatch_ppm"))
            yield at_least(name + "PSNR", 42, " dB", run.get("psnr_db"))
        run = default_run(records, scene=mesh, sampling="vertices")
        if run:
            yield at_most(f"{mesh}, vertices: normals p95", VERTEX_P95_DEG[mesh], "°", run.get("normal_p95_deg"))
            yield from closed_targets(f"{mesh}, vertices", run, CLOSED_OVERLAP)


def tree_targets(records):
    runs = [r for r in records.choose(case="brute force", device=records.devices()[0]) if r.get("insertion") == "overlap"]
    if runs:
        worst = max(run.get("mismatch_ppm") for run in runs)
        sizes = ", ".join(str(size) for size in sorted({run.get("leaf_size") for run in runs}))
        what = f"hits that differ from brute force, leaf sizes {sizes}"
        yield Target(what, "0", f"{worst:g} ppm", worst == 0)


def closed_targets(name, run, most_overlap):
    """Holes and overlap of a closed shape."""
    holes = run.holes
    if holes:
        measured = f"{holes['value']:.3g} ppm (95 %: below {holes['high']:.2g}) of {holes['rays']:,} rays"
        yield Target(f"{name}: holes", "0", measured, holes["value"] == 0)
    if run.get("overlap") is not None:
        yield at_most(f"{name}: overlap", most_overlap, "", run.get("overlap"))


def shape_targets(records):
    for scene in SHAPES:
        run = default_run(records, scene=scene)
        if run:
            yield from closed_targets(run.case, run, 5.0 if run.get("sampling") == "random" else CLOSED_OVERLAP)
    for case in [c for c in records.unique("case", method="window") if c.startswith(SHAPES) and c.endswith("r/R 0.011")]:
        run = default_run(records, case=case)
        if run.get("jump_p999_deg") is not None:
            yield at_most(f"{case}: jump of the normal, p99.9", 0.05, "°", run.get("jump_p999_deg"))
        nearest = records.choose(case=case, method="embree nearest", normal_fields=False)
        if nearest and run.get("normal_rms_deg"):
            ratio = run.get("normal_rms_deg") / nearest[0].get("normal_rms_deg")
            yield at_most(f"{case}: rms of the normals / nearest flat disc's", 0.1, "", ratio)
        if run.get("depth_bias_r") is not None and "sphere" in case:
            yield at_most(f"{case}: depth bias, median radii", 0.001, " r", abs(run.get("depth_bias_r")))


def path_targets(records):
    for run in records.choose(method="window", varied="", device=records.devices()[0]):
        if run.get("wrong_bounces_ppm") is not None:
            value = run.get("wrong_bounces_ppm")
            yield Target(f"{run.case}: wrong bounces", "0", f"{value:.3g} ppm", value == 0)
        if run.get("leaks_ppm") is not None:
            yield Target(f"{run.case}: leaks", "0", f"{run.get('leaks_ppm'):.3g} ppm", run.get("leaks_ppm") == 0)


def exact_targets(counts):
    """`counts`: what splatray-bench exact counted, of which those of the last commit and device are reported. A kind with fewer rays
    than asked for is not reached."""
    kinds = {}
    for record in counts:
        if any(record[key] != counts[-1][key] for key in ("commit", "device")):
            continue
        rays, different = kinds.get(record["kind"], (0, 0))
        kinds[record["kind"]] = rays + record["rays"], different + record["hit_or_miss"] + record["first_splat"]
    for kind, (rays, different) in kinds.items():
        wanted = EXACT_RAYS if kind in EXACT_KINDS else EXACT_RAYS_ADVERSARIAL
        reached = different == 0 and rays >= wanted
        yield Target(f"{kind} rays: hits unlike brute force", f"0 of {wanted:,}", f"{different} of {rays:,}", reached)


def hard_rows(text):
    """(test, compared, count, exceptions) of each row of the table that hard_test writes."""
    row = re.compile(r"^\| (\S+) \| (.*?) \| (\d+) [^|]*\| (\d+) \|", re.MULTILINE)
    return [(test, compared, int(count), int(found)) for test, compared, count, found in row.findall(text)]


def hard_targets(text):
    """Lines that only the hard cases measure; `text` is their table. What is reported as "measured" or "at most" there was asked to
    be 0."""
    unbiased = 0
    for test, compared, count, exceptions in hard_rows(text):
        measured = f"{exceptions} of {count:,}"
        if test.startswith("Watertight.") and "Missing" not in test:
            reached = exceptions == 0 and count >= EXACT_RAYS
            yield Target(f"{test.removeprefix('Watertight.')}: holes", f"0 of {EXACT_RAYS:,}", measured, reached)
        if test.startswith("Corner/Wedge.BouncesAreExact/"):
            name = test.removeprefix("Corner/Wedge.BouncesAreExact/")
            yield Target(f"wedge {name}: wrong {compared}", "0", measured, exceptions == 0)
        unbiased += count if test.startswith("Glass.") and "exact paths" in compared and "Noticed" not in compared else 0
    if unbiased:
        measured = "not measured: the tests allow 4 standard errors and 0.004"
        yield Target("radiance through glass: unbiased", "within 3 standard errors", measured, False)


def targets(records, counts=(), hard=""):
    """All lines for which there are records."""
    lines = []
    for part in (tree_targets, mesh_targets, shape_targets, path_targets):
        lines += list(part(records))
    return lines + list(exact_targets(counts)) + list(hard_targets(hard))
