"""exactness.py EXACTNESS.json: writes EXACTNESS.md beside it, what splatray-bench exact counted: a table of kinds of rays, summed over
scenes, and one of scenes, for each commit and device."""

import json
import pathlib
import sys

NUMBERS = ("rays", "hits", "hit_or_miss", "first_splat", "ties", "members", "normals")
HEAD = ("rays", "hits", "hit or miss differs", "first splat differs", "ties", "cluster differs", "normal differs")

NOTES = """
Answers are compared with brute force in float64. It tests the splats that a hierarchy of boxes in float64, written apart from the
octree, finds near the ray ([brute_force_tree.h](../../trace/brute_force_tree.h)); that its answers are those of the search over
all splats, bit for bit, is tested by `tests/run -R BruteForceTree`. A tie is a ray that meets two discs at the same t to 2^-44 of
the distance. Normals differ by more than 0.01 degree. Shadow rays are asked for their nearest hit here, as the others are.
"""


def table(first, rows):
    """Rows are a name and sums by number."""
    lines = ["| " + " | ".join((first, *HEAD)) + " |", "| --- " + "| ---: " * len(HEAD) + "|"]
    lines += ["| " + " | ".join((name, *(f"{sums[key]:,}" for key in NUMBERS))) + " |" for name, sums in rows]
    return "\n".join(lines) + "\n"


def sums_by(records, key):
    sums = {}
    for record in records:
        entry = sums.setdefault(key(record), dict.fromkeys(NUMBERS, 0))
        for number in NUMBERS:
            entry[number] += record[number]
    return list(sums.items())


def text_of(records):
    parts = ["# Hits that differ from brute force\n", NOTES.strip() + "\n"]
    runs = dict.fromkeys((r["commit"], r["device"]["name"], r["device"]["driver"]) for r in records)
    for run in runs:
        own = [r for r in records if (r["commit"], r["device"]["name"], r["device"]["driver"]) == run]
        parts.append(f"## {run[1]}, {run[2]}, commit {run[0]}, {own[-1]['date']}\n")
        parts.append(table("kind of rays", sums_by(own, lambda r: r["kind"])))
        parts.append(table("scene", sums_by(own, lambda r: f"{r['scene']}, {r['splats']:,} splats")))
    return "\n".join(parts)


def main():
    path = pathlib.Path(sys.argv[1])
    path.with_suffix(".md").write_text(text_of(json.loads(path.read_text())))


if __name__ == "__main__":
    main()
