"""The report's pictures. Every function writes one PNG of 1280 pixels across, made to be read at 800."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

from report_records import ON_CURVE, OURS, PEERS, front, splats_text

#: Colours that colour-blind people can distinguish (Okabe and Ito 2008), and markers.
STYLE = {
    "window": ("#0072B2", "o"),
    "paper": ("#E69F00", "s"),
    "nearest": ("#009E73", "^"),
    "embree window": ("#CC79A7", "D"),
    "embree nearest": ("#D55E00", "v"),
    "embree flat": ("#56B4E9", "h"),
    "embree user": ("#8C6D46", "P"),
    "embree mesh": ("#000000", "*"),
}
DPI = 160

plt.rcParams.update(
    {"font.size": 9, "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.6, "axes.axisbelow": True}
)


def save(figure, path):
    figure.savefig(path, dpi=DPI, facecolor="white")
    plt.close(figure)


def plain(axis):
    """Numbers such as 0.05 and 300 at a log axis' ticks, not powers; few enough to be read."""
    low, high = axis.get_view_interval()
    decades = math.log10(high / low)
    between = "234568" if decades < 0.8 else "25" if decades < 2 else "3" if decades < 3 else ""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(
        FuncFormatter(lambda value, _: f"{value:g}" if value > 0 and f"{value:e}"[0] in between else "")
    )


class Panel:
    """Time against one error, for the runs of a scene on one device and, if `peers`, theirs."""

    def __init__(self, axes, records, scene, device, error_of, peers):
        self.axes, self.records, self.scene, self.error_of = axes, records, scene, error_of
        self.devices = [device] + (records.peer_devices() if peers else [])

    def runs(self, methods):
        return [
            run
            for run in self.records.choose(scene=self.scene, method=methods, device=tuple(self.devices))
            if run.ms and self.error_of(run) is not None and self.records.uses_all_threads(run)
        ]

    def curve(self, method):
        runs = [run for device in self.devices for run in self.records.curve(self.scene, method, device)]
        return [run for run in runs if self.error_of(run) is not None]

    def points(self, runs):
        return [(self.error_of(run), run.ms) for run in runs]

    def draw_method(self, method):
        """The curve over splat counts, and hollow markers for what lies off it."""
        color, marker = STYLE[method]
        curve = self.points(self.curve(method))
        if curve:
            self.axes.plot(*zip(*curve), "-", color=color, marker=marker, markersize=6, linewidth=1.4, zorder=3)
        others = [point for point in self.points(self.runs(method)) if point not in curve]
        if others:
            style = {"color": color, "markersize": 4.5, "markerfacecolor": "white", "zorder": 2}
            self.axes.plot(*zip(*others), marker, **style)

    def draw_mesh(self):
        """A line at the time of the mesh, whose error is rounding alone."""
        times = [run.ms for run in self.runs("embree mesh")]
        if times:
            self.axes.axhline(min(times), color=STYLE["embree mesh"][0], linestyle=":", linewidth=1.2)

    def draw_front(self):
        """Steps between our runs that no other run of ours betters in both time and error."""
        best = front([(ms, error) for error, ms in self.points(self.runs(OURS))])
        if len(best) > 1:
            times, errors = zip(*best)
            self.axes.step(errors, times, where="post", color=STYLE["window"][0], linewidth=4, alpha=0.25, zorder=1)

    def label_splats(self):
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.4}
        for run in self.curve("window"):
            where = (self.error_of(run), run.ms)
            text = splats_text(run.get("splats"))
            place = {"textcoords": "offset points", "ha": "right", "va": "top"}
            self.axes.annotate(text, where, (-6, -3), fontsize=8, bbox=box, zorder=4, **place)

    def draw(self):
        self.draw_front()
        for method in OURS + PEERS:
            if method != "embree mesh":
                self.draw_method(method)
        self.draw_mesh()
        self.axes.set_yscale("log")
        plain(self.axes.yaxis)

    def log_errors(self):
        """A log axis over the curves' errors and up to three times their largest."""
        errors = [error for method in OURS + PEERS[:4] for error, _ in self.points(self.runs(method))]
        on_curves = [error for method in OURS for error, _ in self.points(self.curve(method) or self.runs(method))]
        most = 3.0 * max(on_curves)
        self.axes.set_xscale("log")
        self.axes.set_xlim(min(errors) / 1.5, min(max(errors) * 1.5, most))
        plain(self.axes.xaxis)

    def symmetric_errors(self):
        """A log axis with 0 at its left end."""
        self.axes.set_xscale("symlog", linthresh=1.0)
        self.axes.set_xlim(left=-0.3, right=max(10.0, 3.0 * max(self.axes.dataLim.x1, 1.0)))
        self.axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def second_error(records, scene):
    """Holes where runs differ in them, else pixels that hit in one and miss in the other: label, function."""
    runs = records.choose(scene=scene)
    if any(run.holes and run.holes["value"] > 0 for run in runs):
        return "holes, per million rays (0: none found)", lambda run: run.holes and run.holes["value"]
    return "pixels that hit where the truth misses or the reverse, ppm", lambda run: run.get("mismatch_ppm")


def name_of(method):
    if method == "embree flat":
        return "Embree, flat, Gaussian"
    return f"splatray {method}" if method in OURS else method.replace("embree", "Embree")


def legend_of(figure, methods):
    """Below the panels."""
    handles = []
    for method in methods:
        color, marker = STYLE[method]
        if method == "embree mesh":
            handles.append(Line2D([], [], color=color, linestyle=":", label="Embree mesh (error 0)"))
        else:
            handles.append(Line2D([], [], color=color, marker=marker, label=name_of(method)))
    hollow = {"color": "#555555", "marker": "o", "markerfacecolor": "white", "linestyle": ""}
    handles.append(Line2D([], [], label="other knobs; a mesh's vertices", **hollow))
    handles.append(Line2D([], [], color=STYLE["window"][0], linewidth=4, alpha=0.25, label="splatray's front"))
    figure.legend(handles=handles, loc="lower center", ncol=4, frameon=False, fontsize=8.5)


def plot_scene(records, scene, path):
    """Time of a frame against the 99th percentile of the normals' error, and against holes; a row for each device."""
    devices = records.unique("device", scene=scene, method=OURS)
    height = 3.5 * len(devices) + 1.0
    figure, rows = plt.subplots(len(devices), 2, figsize=(8, height), sharey="row", squeeze=False)
    label, error_of = second_error(records, scene)
    for i, (device, (left, right)) in enumerate(zip(devices, rows)):
        normals = Panel(left, records, scene, device, lambda run: run.get("normal_p99_deg"), peers=i == 0)
        normals.draw()
        normals.log_errors()
        normals.label_splats()
        others = Panel(right, records, scene, device, error_of, peers=i == 0)
        others.draw()
        others.symmetric_errors()
        left.set_ylabel("time of a frame, ms")
        left.set_title(device.split(" (")[0], fontsize=9.5, loc="left")
    rows[-1][0].set_xlabel("normals, 99th percentile of the error, degrees")
    rows[-1][1].set_xlabel(label)
    figure.suptitle(f"{scene}: lower left is better; curves run over the number of splats", fontsize=10.5)
    legend_of(figure, [m for m in OURS + PEERS if records.choose(scene=scene, method=m)])
    figure.tight_layout(rect=(0, 0.65 / height, 1, 1))
    save(figure, path)


def draw_rules(axes, records, case):
    """A case's holes against overlap, one curve for each radius rule."""
    for rule, color, marker, offset in (("coverage", "#0072B2", "o", 7), ("knn", "#D55E00", "s", -15)):
        runs = records.choose(
            case=case,
            method="window",
            radius_rule=rule,
            device=records.devices()[0],
            varied=("", "radius_scale", "radius_rule"),
        )
        points = sorted((run.get("overlap"), run.holes["value"], run.get("radius_scale")) for run in runs)
        axes.plot([p[0] for p in points], [p[1] for p in points], "-", color=color, marker=marker, label=rule)
        for overlap, holes, scale in points:
            place = {"textcoords": "offset points", "ha": "center"}
            axes.annotate(f"×{scale:g}", (overlap, holes), (0, offset), fontsize=8, **place)


def plot_watertight(records, path):
    """Holes against overlap for the two radius rules. Returns whether there was anything to draw."""
    runs = records.choose(method="window", varied="radius_rule")
    cases = list(dict.fromkeys(run.case for run in runs if run.holes and run.get("overlap")))
    if not cases:
        return False
    width = min(len(cases), 3)
    rows = math.ceil(len(cases) / width)
    figure, panels = plt.subplots(rows, width, figsize=(8, 3.3 * rows + 0.4), sharey=True, squeeze=False)
    for axes in panels.flat[len(cases) :]:
        axes.set_visible(False)
    for axes, case in zip(panels.flat, cases):
        draw_rules(axes, records, case)
        axes.set_title(case, fontsize=10)
        axes.set_xlabel("overlap: area of discs / of surface")
        axes.set_yscale("symlog", linthresh=1.0)
        axes.set_ylim(-0.8, 3e6)
        axes.margins(x=0.12)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
    for row in panels:
        row[0].set_ylabel("holes, per million rays")
    panels[0][0].legend(title="radius rule", frameon=False, fontsize=8.5)
    figure.tight_layout()
    save(figure, path)
    return True


def largest_runs(records, scene):
    """Default runs at the scene's largest number of splats, by (method, device)."""
    runs = {}
    for run in records.choose(scene=scene, varied=ON_CURVE):
        if run.ms and run.method not in ("paper", "embree user", "embree flat") and records.uses_all_threads(run):
            best = runs.get((run.method, run.device))
            if best is None or run.get("splats") > best.get("splats"):
                runs[run.method, run.device] = run
    return runs


def plot_speed(records, path):
    """Time of a frame at each scene's largest number of splats, a marker for each method; hollow: another device."""
    scenes = records.picture_scenes()
    figure, axes = plt.subplots(figsize=(8, 1.6 + 0.36 * len(scenes)))
    labels = {}
    for i, scene in enumerate(scenes):
        for (method, device), run in largest_runs(records, scene).items():
            color, marker = STYLE[method]
            other = method in OURS and device != records.devices()[0]
            face = "white" if other else color
            name = name_of(method) + (f", {device.split(' (')[0]}" if other else "")
            point = axes.plot(run.ms, i, marker, color=color, markerfacecolor=face, markersize=7.5, linestyle="")[0]
            labels.setdefault(name, point)
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.set_xlim(low / 1.1, high * 1.1)
    plain(axes.xaxis)
    axes.set_ylim(len(scenes) - 0.4, -0.6)
    largest = {scene: max(run.get("splats") for run in largest_runs(records, scene).values()) for scene in scenes}
    axes.set_yticks(range(len(scenes)), [f"{scene}, {splats_text(largest[scene])}" for scene in scenes])
    size = next(f"{run.get('width')}x{run.get('height')}" for run in largest_runs(records, scenes[0]).values())
    axes.set_xlabel(f"time of a frame of {size} primary rays, all threads, ms: left is better")
    names = sorted(labels, key=lambda name: (name.startswith("Embree"), "," in name))
    figure.legend([labels[n] for n in names], names, loc="lower center", ncol=3, frameon=False, fontsize=8.5)
    figure.tight_layout(rect=(0, 0.16, 1, 1))
    save(figure, path)


def plot_exactness(records, path):
    """Normals' error against the number of splats: blended and nearest, one curve per scene, on the first device."""
    figure, panels = plt.subplots(1, 2, figsize=(8, 4.4), sharey=True)
    titles = {"window": "blended (window, the default)", "nearest": "nearest disc alone"}
    for axes, method in zip(panels, titles):
        for i, scene in enumerate(records.picture_scenes()):
            curve = records.curve(scene, method, records.devices()[0])
            points = {run.get("splats"): run.get("normal_p99_deg") for run in curve}
            if points:
                style = {"marker": "osv^DP*"[i % 7], "markersize": 5, "linewidth": 1.3, "color": f"C{i}"}
                axes.plot(*zip(*sorted(points.items())), "-", label=scene, **style)
        axes.set_xscale("log")
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: splats_text(value)))
        axes.xaxis.set_minor_formatter(FuncFormatter(lambda value, _: ""))
        axes.set_xlabel("splats")
        axes.set_title(titles[method], fontsize=10)
    panels[0].set_yscale("log")
    plain(panels[0].yaxis)
    panels[0].set_ylabel("normals, 99th percentile of the error, degrees")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=4, frameon=False, fontsize=8.5)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    save(figure, path)
