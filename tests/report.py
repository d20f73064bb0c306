"""report.py LOG BUILD: after ctest has written LOG (LastTest.log): how many cases ran, those that took longest, what each entry took of the
CPUs, the build too (BUILD: a file with cpu_seconds' line of it) and together, against what a landing may take, and what was skipped, with
the reason. Where CI=true, what is skipped for a package that .ci/packages lists ends it with 1."""

import os
import re
import sys

LONGEST = 20
ENTRY = re.compile(r"^\d+/\d+ Test: (?P<name>\S+)\n(?P<text>.*?)(?=^\d+/\d+ Test: |\Z)", re.MULTILINE | re.DOTALL)
CASE = re.compile(r"^\[       OK \] (\S+) \((\d+) ms\)", re.MULTILINE)
SKIPPED_CASE = re.compile(r"^(?:.*: Skipped\n(?P<reason>.*)\n)?(?:.*\n)?\[  SKIPPED \] (?P<name>\S+) \(\d+ ms\)", re.MULTILINE)
SKIPPED_ENTRY = re.compile(r"^skipped: (?P<reason>.*)", re.MULTILINE)
CPU_SECONDS = re.compile(r"^CPU seconds: ([\d.]+) \+ ([\d.]+)$", re.MULTILINE)
LANDING_SECONDS = 1750  # of the CPUs: 15 minutes of two, which are idle for some of it
SHOWN_SECONDS = 5
PACKAGE_MISSING = re.compile(r"\(Debian's package \S+\)")


def entries(log):
    """(name, output, seconds) of each entry."""
    for match in ENTRY.finditer(log):
        seconds = re.search(r"^Test time =\s*([\d.]+) sec", match["text"], re.MULTILINE)
        yield match["name"], match["text"], float(seconds[1]) if seconds else 0.0


def skips(name, text):
    """(name, reason) of what an entry left out."""
    for match in SKIPPED_ENTRY.finditer(text):
        yield name, match["reason"].strip()
    for match in SKIPPED_CASE.finditer(text):
        yield match["name"], (match["reason"] or "no reason given").strip()


def cpu_seconds(text):
    """What cpu_seconds' last line says, 0 without one."""
    found = CPU_SECONDS.findall(text)
    return sum(map(float, found[-1])) if found else 0.0


def cpu_lines(build, tests):
    """A table of what took most of the CPUs; `tests`: seconds by name."""
    total = build + sum(tests.values())
    rows = sorted([("the build", build), *tests.items()], key=lambda row: -row[1])
    shown = [(name, seconds) for name, seconds in rows if seconds >= SHOWN_SECONDS]
    lines = [f"{total:.0f} s of the CPUs, {build:.0f} of them for the build:"]
    lines += [f"  {seconds:7.1f}  {name}" for name, seconds in shown]
    lines += [f"  {sum(seconds for _, seconds in rows[len(shown):]):7.1f}  {len(rows) - len(shown)} others"]
    if total > LANDING_SECONDS and "SPLATRAY_TEST_ALL" not in os.environ:
        lines += [f"That is more than {LANDING_SECONDS} s, what tests/run may take (CONTRIBUTING.md): what has grown?"]
    return lines


def report(log, build):
    """The lines to print, and whether a package was missing."""
    cases, skipped, times, cpu = 0, [], [], {}
    for name, text, seconds in entries(log):
        found = CASE.findall(text)
        cases += max(len(found), 1)
        times += [(int(ms) / 1000, case) for case, ms in found] if len(found) > 1 else [(seconds, name)]
        skipped += skips(name, text)
        cpu[name] = cpu_seconds(text)
    lines = [f"{cases} cases; the longest, in seconds:"]
    lines += [f"  {seconds:7.1f}  {name}" for seconds, name in sorted(times, reverse=True)[:LONGEST]]
    lines += cpu_lines(build, cpu)
    lines += [f"{len(skipped)} skipped:" if skipped else "Nothing was skipped."]
    lines += [f"  {name}: {reason}" for name, reason in skipped]
    return lines, any(PACKAGE_MISSING.search(reason) for _, reason in skipped)


def prove():
    log = ("1/2 Testing: a\n1/2 Test: a\n[       OK ] A.B (1500 ms)\n[       OK ] A.C (10 ms)\nx.cpp:5: Skipped\nno models\n\n"
           "[  SKIPPED ] A.D (0 ms)\nCPU seconds: 1700.5 + 10.000\nTest time =   2.00 sec\n"
           "2/2 Testing: w\n2/2 Test: w\nskipped: no dpkg (Debian's package dpkg-dev)\nCPU seconds: 0.1 + 0.1\nTest time =   0.10 sec\n")
    lines, missing = report(log, 20.0)
    assert missing and lines[0].startswith("3 cases") and "      1.5  A.B" in lines[1] and lines[-2:] == ["  A.D: no models", "  w: no dpkg (Debian's package dpkg-dev)"], lines
    assert "1731 s of the CPUs, 20 of them for the build:" in lines and "   1710.5  a" in lines and "      0.2  1 others" in "\n".join(lines), lines
    slow = cpu_lines(LANDING_SECONDS, {"a": 1.0})[-1].startswith("That is more"), cpu_lines(LANDING_SECONDS - 2, {"a": 1.0})[-1].startswith("That is more")
    assert slow == ("SPLATRAY_TEST_ALL" not in os.environ, False), slow


def main():
    prove()
    with open(sys.argv[1], encoding="utf-8", errors="replace") as file, open(sys.argv[2]) as build:
        lines, missing = report(file.read(), cpu_seconds(build.read()))
    print("\n".join(lines))
    if missing and os.environ.get("CI") == "true":
        sys.exit("CI has all packages of .ci/packages: nothing may be skipped for one.")


if __name__ == "__main__":
    main()
