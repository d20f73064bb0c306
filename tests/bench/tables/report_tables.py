"""The report's tables, as Markdown."""

import math

from report_records import ON_CURVE, splats_text

#: Goradia et al. 2010, Table I, GTX 275: frames per second at 512x512 without and with one shadow ray per pixel.
PAPER_TABLE_1 = {"David": (1.0, 19.5, 13.8), "Dragon": (1.3, 16.7, 12.5)}
#: Table II: splats in millions, seconds at 512x512 with 16 samples per pixel.
PAPER_TABLE_2 = {
    "Refractive Dragon": (0.44, 1.57),
    "Buddha": (0.54, 0.36),
    "Teapot Scene": (1.33, 1.98),
    "Room Scene": (1.05, 0.46),
}


def number(value, digits=3):
    """Three significant digits, no powers of ten; a dash where nothing was measured."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if value != 0 and abs(value) < 1e-3:
        return f"{value:.{digits - 1}e}"
    text = f"{value:.{digits}g}"
    return f"{float(text):,.0f}" if "e" in text or abs(value) >= 1000 else text


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def drop_empty_columns(head, rows):
    """Leaves out columns in which nothing was measured."""
    kept = [i for i in range(len(head)) if any(row[i] != "–" for row in rows)]
    return [head[i] for i in kept], [[row[i] for i in kept] for row in rows]


def holes_text(run):
    if not run.holes:
        return "–"
    low, high = number(run.holes["low"], 2), number(run.holes["high"], 2)
    return f"{number(run.holes['value'])} ({low}–{high})"


def short(device):
    """llvmpipe (LLVM 15.0.6, 256 bits) -> llvmpipe."""
    return device.split(" (")[0]


def targets_table(lines):
    rows = [(t.what, t.wanted, t.measured, "yes" if t.reached else "**no**") for t in lines]
    return table(("what", "wanted", "measured", "reached"), rows)


def work_table(records):
    """Speed and work of the default settings."""
    rows = []
    for run in records.choose(method=("window",), varied=("", "splats")):
        if run.get("tests_per_ray") is None:
            continue
        keys = ("tests_per_ray", "steps_per_ray", "leaves_per_ray", "bytes_per_splat", "growth", "overlap", "build_s")
        rate = number(run.get("rays_per_s") / 1e6) if run.get("rays_per_s") else "–"
        rows.append(
            (run.case, short(run.device), splats_text(run.get("splats")), number(run.ms), rate)
            + tuple(number(run.get(key)) for key in keys)
        )
    head = "case,device,splats,ms,Mray/s,tests/ray,node words/ray,leaves/ray,bytes/splat,growth,overlap,build s"
    return table(head.split(","), rows)


def growth_table(records):
    """What the insertion policies cost and lose."""
    rows = []
    for case in records.unique("case", varied="insertion"):
        runs = records.choose(case=case, method="window", device=records.devices()[0], varied=("", "insertion"))
        for run in runs:
            keys = ("growth", "bytes_per_splat", "tests_per_ray", "ms", "normal_p99_deg")
            values = tuple(number(run.get(key) if key != "ms" else run.ms) for key in keys)
            differ = number(run.get("mismatch_ppm")) if run.get("truth") == "brute force" else "–"
            rows.append((case, run.get("insertion")) + values + (holes_text(run), differ))
    head = ("case", "policy", "growth", "bytes/splat", "tests/ray", "ms", "normals p99, °")
    return table(head + ("holes, ppm (95 %)", "hits unlike brute force, ppm"), rows)


def knob_value(run):
    """What the varied knob is set to."""
    value = run.get(run.varied)
    if run.varied == "radius_rule":
        return f"{value} ×{run.get('radius_scale'):g}"
    if isinstance(value, bool):
        return "on" if value else "off"
    return number(value) if isinstance(value, (int, float)) else value


def ratio(value, base):
    return f"×{number(value / base)}" if value is not None and base else "–"


KNOB_COLUMNS = {
    "normal_rms_deg": "normals rms, °",
    "jump_p999_deg": "jump p99.9, °",
    "depth_bias_r": "depth bias, r",
    "mismatch_ppm": "mismatch, ppm",
    "wrong_bounces_ppm": "wrong bounces, ppm",
    "leaks_ppm": "leaks, ppm",
    "psnr_db": "PSNR, dB",
    "bytes_per_splat": "bytes/splat",
}


def knobs_table(records, case):
    """One knob at a time: how time and errors change against the default's."""
    device = records.devices()[0]
    default = records.choose(case=case, device=device, varied="", method="window")[0]
    rows = []
    for run in records.choose(case=case, device=device):
        name = "**default**" if run is default else f"{run.varied} {knob_value(run)}"
        if run.varied == "splats":
            name += f", {run.method}"
        times = (number(run.ms), ratio(run.ms, default.ms))
        normals = (number(run.get("normal_p99_deg")), ratio(run.get("normal_p99_deg"), default.get("normal_p99_deg")))
        rest = tuple(number(run.get(key)) for key in KNOB_COLUMNS)
        rows.append((name,) + times + normals + (holes_text(run),) + rest)
    head = ("knob", "ms", "to default", "normals p99, °", "to default", "holes, ppm (95 %)")
    return table(*drop_empty_columns(head + tuple(KNOB_COLUMNS.values()), rows))


def paper_table_1(records):
    """Frames per second, without and with shadows; empty when there is no record."""
    rows = []
    for name, (splats, shading, shadows) in PAPER_TABLE_1.items():
        rows.append((name, "GTX 275 (paper)", f"{splats:g}M", number(shading), number(shadows)))
        for device in records.devices():
            runs = records.choose(case=f"Table I {name}", device=device)
            if runs:
                fps = {run.get("shadows"): 1000.0 / run.ms for run in runs}
                count = splats_text(runs[0].get("splats"))
                rows.append((name, short(device), count, number(fps.get(False)), number(fps.get(True))))
    head = ("scene", "device", "splats", "frames/s, shading", "frames/s, one shadow ray")
    return table(head, rows) if len(rows) > len(PAPER_TABLE_1) else ""


def paper_table_2(records):
    """Seconds of a frame with 16 samples; empty when there is no record."""
    rows = []
    for name, (splats, seconds) in PAPER_TABLE_2.items():
        rows.append((name, "GTX 275 (paper)", f"{splats:g}M", number(seconds)))
        for run in records.choose(case=f"Table II {name}"):
            rows.append((name, short(run.device), splats_text(run.get("splats")), number(run.ms / 1000.0)))
    return table(("scene", "device", "splats", "s"), rows) if len(rows) > len(PAPER_TABLE_2) else ""


def time_at_error(curve, error):
    """Time of a frame with this error of the normals on a curve over splat counts, log-log between its runs; None when no
    run is that exact."""
    points = sorted((run.get("normal_p99_deg"), run.ms) for run in curve)
    if not points or error < points[0][0] * (1 - 1e-3):
        return None
    for (low, ms_low), (high, ms_high) in zip(points, points[1:]):
        if low <= error <= high and high > low > 0:
            share = math.log(error / low) / math.log(high / low)
            return ms_low * (ms_high / ms_low) ** share
    return min(ms for e, ms in points if e <= error * (1 + 1e-3))


def same_error_table(records):
    """Our time at each number of splats, and Embree's where it is as exact: with our normal fields, and as it is known."""
    rows = []
    for scene in records.picture_scenes() if records.peer_devices() else ():
        peers = [records.curve(scene, method, records.peer_devices()[0]) for method in ("embree window", "embree flat")]
        for device in records.devices():
            for run in records.curve(scene, "window", device):
                error = run.get("normal_p99_deg")
                times = [time_at_error(curve, error) for curve in peers]
                texts = tuple(f"{number(ms)} (×{number(run.ms / ms, 2)})" if ms else "not reached" for ms in times)
                rows.append(
                    (scene, short(device), splats_text(run.get("splats")), number(error), number(run.ms)) + texts
                )
    head = ("scene", "device", "splats", "normals p99, °", "splatray, ms", "Embree window, ms (splatray / it)")
    return table(head + ("Embree, flat discs, Gaussian, ms",), rows)


def peers_table(records):
    """Each case's default number of splats: time, memory and error of every method."""
    rows = []
    for case in records.unique("case", method="embree window"):
        splats = min(run.get("splats") for run in records.choose(case=case, varied="", method="window"))
        for run in records.choose(case=case, splats=splats):
            if run.is_ours and run.varied not in ON_CURVE:
                continue
            name = run.method if not run.is_ours else f"splatray {run.method}, {short(run.device)}"
            if not run.is_ours and run.method != "embree mesh" and not run.get("normal_fields"):
                name = f"{run.data['method']}, flat discs, {run.get('kernel')} kernel"
            if run.method == "embree user":
                name += f", {run.get('leaf_size')} discs a box"
            keys = ("bytes_per_splat", "normal_p99_deg", "mismatch_ppm", "psnr_db", "flip_mean")
            values = tuple(number(run.get(key)) for key in keys)
            rows.append((case, name, run.get("threads") or "GPU", number(run.ms)) + values)
    head = ("case", "method", "threads", "ms", "bytes/splat", "normals p99, °", "mismatch, ppm", "PSNR, dB", "FLIP")
    return table(head, rows)
