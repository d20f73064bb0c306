"""Which figures of two of the guard's tables differ by more than their own noise.

The programs give the same bits each time, so figures have no noise of measuring but for CPU seconds. What they have is the noise of
which points there happen to be: any change of a rule draws that anew. It is known of each kind of figure: counts of pixels and points
scatter as counts do (Poisson), and of the others SHARES says what is taken for it."""

import dataclasses
import math

# Of two tables' difference, in standard deviations: of 400 figures whose points are drawn anew one seems worse.
SIGMAS = 3.0
# Counts, as shares in ppm of what `of` holds the number of.
COUNTS = {"wrong": "pixels", "holes": "pixels", "far": "pixels", "sides": "points", "lost": "points", "moved": "points"}
# Other figures: the share and the least difference that say something.
SHARES = {"normals": (0.03, 0.02), "depth": (0.03, 0.3), "strays": (0.03, 0.5), "bytes a point": (0.01, 1.0), "light": (0.02, 0.2), "parts": (0.05, 0.3),
          "cover": (0.02, 0.2), "thickness": (0.05, 0.05), "outside": (0.0, 5.0), "within": (0.05, 0.05), "tile": (0.0, 0.03),
          "failed": (0.0, 0.5), "peak MB": (0.05, 1.0)}
# What is a difference from the last table already.
DIFFERENCES = ("tile differs",)
# Of CPU seconds, which another load on the machine lengthens; of tables of other machines they are not compared.
CPU_SHARE = 0.15


@dataclasses.dataclass
class Change:
    part: str
    case: str
    figure: str
    before: float
    after: float
    noise: float  # the most that says nothing

    @property
    def worse(self):
        return not self.after <= self.before + self.noise

    @property
    def better(self):
        return self.after < self.before - self.noise


def noise_of(figure, before, after, sizes):
    """The largest difference of a figure that is no change."""
    if figure in COUNTS:
        number = max(sizes.get(COUNTS[figure], 1e6), 1.0)
        return SIGMAS * math.sqrt((before + after + 1e6 / number) * 1e6 / number)
    if figure == "CPU s":
        return CPU_SHARE * before
    share, least = next((noise for name, noise in SHARES.items() if figure.startswith(name)), (0.03, 0.0))
    return max(share * before, least)


def compare(before, after):
    """All figures that both tables have, and differences."""
    changes = []
    same_machine = before.get("machine") == after["machine"]
    for part, cases in after["parts"].items():
        for case, figures in cases.items():
            old = before["parts"].get(part, {}).get(case, {})
            for figure, value in figures.items():
                was = 0.0 if figure in DIFFERENCES else old.get(figure)
                if figure in COUNTS.values() or was is None or figure == "CPU s" and not same_machine:
                    continue
                changes.append(Change(part, case, figure, was, value, noise_of(figure, was, value, figures)))
    return changes


def number(value):
    return f"{value:.4g}"


def row(change):
    ratio = f"{change.after / change.before:.3f}" if change.before > 0.0 else "-"
    word = "WORSE" if change.worse else "better" if change.better else ""
    return [change.part, change.case, change.figure, number(change.before), number(change.after), ratio, word]


def table_text(rows):
    widths = [max(len(line[column]) for line in rows) for column in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in rows)


def report(before, after, changes, everything=False, only=""):
    """The table for people, and what got worse by name; `only` is in the names of the cases that were to be measured."""
    shown = [change for change in changes if everything or change.worse or change.better]
    lines = [f"before: {before['commit']}; after: {after['commit']}, {after['device']['name']}"]
    if shown:
        lines.append(table_text([["part", "case", "figure", "before", "after", "ratio", ""]] + [row(change) for change in shown]))
    worse = [change for change in changes if change.worse]
    better = sum(change.better for change in changes)
    lines.append(f"{len(changes)} figures compared: {len(worse)} worse, {better} better")
    lines += [f"not measured: {part}, {case}" for part, cases in before["parts"].items() if part in after["parts"]
              for case in cases if only in case and case not in after["parts"][part]]
    lines += [f"worse: {change.part}, {change.case}: {change.figure} {number(change.before)} -> {number(change.after)}" for change in worse]
    return "\n".join(lines)
