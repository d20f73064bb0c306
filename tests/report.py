"""report.py LOG: after ctest has written LOG (LastTest.log): how many cases ran, the ones that took longest, and what was skipped, with
the reason. Where CI=true, what is skipped for a package that .ci/packages lists ends it with 1."""

import os
import re
import sys

LONGEST = 20
ENTRY = re.compile(r"^\d+/\d+ Test: (?P<name>\S+)\n(?P<text>.*?)(?=^\d+/\d+ Test: |\Z)", re.MULTILINE | re.DOTALL)
CASE = re.compile(r"^\[       OK \] (\S+) \((\d+) ms\)", re.MULTILINE)
SKIPPED_CASE = re.compile(r"^(?:.*: Skipped\n(?P<reason>.*)\n)?(?:.*\n)?\[  SKIPPED \] (?P<name>\S+) \(\d+ ms\)", re.MULTILINE)
SKIPPED_ENTRY = re.compile(r"^skipped: (?P<reason>.*)", re.MULTILINE)
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


def report(log):
    """The lines to print, and whether a package was missing."""
    cases, skipped, times = 0, [], []
    for name, text, seconds in entries(log):
        found = CASE.findall(text)
        cases += max(len(found), 1)
        times += [(int(ms) / 1000, case) for case, ms in found] if len(found) > 1 else [(seconds, name)]
        skipped += skips(name, text)
    lines = [f"{cases} cases; the longest, in seconds:"]
    lines += [f"  {seconds:7.1f}  {name}" for seconds, name in sorted(times, reverse=True)[:LONGEST]]
    lines += [f"{len(skipped)} skipped:" if skipped else "Nothing was skipped."]
    lines += [f"  {name}: {reason}" for name, reason in skipped]
    return lines, any(PACKAGE_MISSING.search(reason) for _, reason in skipped)


def prove():
    log = ("1/2 Testing: a\n1/2 Test: a\n[       OK ] A.B (1500 ms)\n[       OK ] A.C (10 ms)\nx.cpp:5: Skipped\nno models\n\n"
           "[  SKIPPED ] A.D (0 ms)\nTest time =   2.00 sec\n"
           "2/2 Testing: w\n2/2 Test: w\nskipped: no dpkg (Debian's package dpkg-dev)\nTest time =   0.10 sec\n")
    lines, missing = report(log)
    assert missing and lines[0].startswith("3 cases") and "      1.5  A.B" in lines[1] and lines[-2:] == ["  A.D: no models", "  w: no dpkg (Debian's package dpkg-dev)"], lines


def main():
    prove()
    with open(sys.argv[1], encoding="utf-8", errors="replace") as file:
        lines, missing = report(file.read())
    print("\n".join(lines))
    if missing and os.environ.get("CI") == "true":
        sys.exit("CI has all packages of .ci/packages: nothing may be skipped for one.")


if __name__ == "__main__":
    main()
