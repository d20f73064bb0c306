"""plan.py BUILD [CTEST OPTION...]: what tests/run builds and runs for these options, in three lines: the files, below BUILD, that the tests
which ctest chooses need; and, where -R names no test but cases of GoogleTest programs, a pattern of the programs' tests and a filter of
the cases. Ends with a sentence where nothing is chosen."""

import json
import pathlib
import re
import subprocess
import sys

CASE = re.compile(r"^(?:TYPED_)?TEST(_F|_P)?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)


def chosen(build, options):
    """ctest's tests by name, each with the files that it needs."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *options], capture_output=True, text=True)
    if shown.returncode != 0:
        sys.exit(shown.stderr.strip())
    tests = json.loads(shown.stdout)["tests"]
    properties = {test["name"]: {item["name"]: item["value"] for item in test["properties"]} for test in tests}
    return {name: found.get("REQUIRED_FILES", []) for name, found in properties.items()}


def cases(sources):
    """The names of a program's cases as --gtest_filter has them, read from its sources: a list with the program's folder first."""
    folder, *names = sources.read_text().split()
    for name in names:
        text = (pathlib.Path(folder) / name).read_text(errors="replace")
        for kind, suite, case in CASE.findall(text):
            yield f"*{suite}.{case}/*" if kind == "_P" else f"{suite}.{case}"


def named_cases(build, pattern):
    """The cases that match, by program."""
    found = {}
    for sources in sorted((build / "tests").glob("*.sources")):
        names = [case for case in cases(sources) if re.search(pattern, case)]
        if names:
            found[sources.stem] = names
    return found


def plan(build, options):
    """The three lines."""
    tests = chosen(build, options)
    if tests:
        return sorted({pathlib.Path(file).relative_to(build) for files in tests.values() for file in files}), "", ""
    pattern = options[options.index("-R") + 1] if "-R" in options[:-1] else None
    programs = named_cases(build, pattern) if pattern else {}
    if not programs:
        sys.exit(f"tests/run {' '.join(options)}: found no test and no case, expected one of `ctest --preset dev -N`")
    names = f"^({'|'.join(programs)})$"
    return sorted({pathlib.Path(file).relative_to(build) for files in chosen(build, ["-R", names]).values() for file in files}), names, ":".join(sum(programs.values(), []))


def main():
    files, names, cases_only = plan(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
    print(*files)
    print(names)
    print(cases_only)


if __name__ == "__main__":
    main()
