"""The picture of the report of scale: time and work of primary rays over the number of splats."""

import math

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter

from report_plots import STYLE, plain, save
from report_records import splats_text
from scale_records import PEERS, exponent, line_fit

STYLES = STYLE | {
    "embree user 1": STYLE["embree user"],
    "embree user 8": ("#56B4E9", "h"),
    "embree user 32": ("#999999", "8"),
}
NAMES = {"window": "splatray window", "nearest": "splatray nearest"} | PEERS


def splats_axis(axes):
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: splats_text(value)))
    axes.xaxis.set_minor_formatter(FuncFormatter(lambda value, _: ""))
    axes.set_xlabel("splats")


def draw_times(axes, races):
    for method, name in NAMES.items():
        points = races.curve(method)
        if not points:
            continue
        color, marker = STYLES[method]
        law = exponent(points)
        label = f"{name}: N^{law[0]:.2f}" if law else name
        width = 2.0 if method == "window" else 1.2
        axes.plot(*zip(*points), "-", color=color, marker=marker, markersize=5, linewidth=width, label=label)
    axes.set_yscale("log")
    splats_axis(axes)
    plain(axes.yaxis)
    axes.set_ylabel("time of a frame of primary rays, ms")


def draw_work(axes, races):
    """Work per ray of splatray; a law of the logarithm is a straight line here."""
    for key, name, marker, color in (
        ("steps_per_ray", "node words", "o", "#0072B2"),
        ("leaves_per_ray", "leaves", "^", "#009E73"),
        ("tests_per_ray", "splat tests", "s", "#E69F00"),
    ):
        points = [(splats, races.own(splats).get(key)) for splats, _ in races.curve("window")]
        fit = line_fit([(math.log2(splats), value) for splats, value in points])
        label = f"{name}: {fit[0]:+.2f} for each doubling" if fit else name
        axes.plot(*zip(*points), marker, color=color, markersize=5, label=label)
        if fit:
            ends = (points[0][0], points[-1][0])
            axes.plot(ends, [fit[0] * math.log2(x) + fit[1] for x in ends], "--", color=color, linewidth=1)
    axes.set_ylim(bottom=0)
    splats_axis(axes)
    axes.set_ylabel("per primary ray")


def plot_growth(races, path):
    """Writes the picture; the laws fitted stand below the panels."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 5.1))
    draw_times(left, races)
    draw_work(right, races)
    figure.tight_layout(rect=(0, 0.27, 1, 1))
    for axes, where in ((left, (0.08, 0.28)), (right, (0.58, 0.28))):
        figure.legend(*axes.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=where, frameon=False, fontsize=8.5)
    save(figure, path)
