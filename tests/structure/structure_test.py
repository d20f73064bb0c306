"""structure_test.py REPOSITORY: includes go one way, folders have at most 30 entries and source files at most 400 lines of code.
Each finding is one line on stderr. First it shows, on made-up repositories, that each rule can fail."""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

# A file may include those of its own room and of the rooms before it.
ROOMS = ["shaders", "engine/base", "engine/scene", "engine/file engine/image", "engine/vulkan", "engine/gpu", "preprocess",
         "app/cli app/library", "app/view app/python", "data", "tests"]
# Rooms that look into one before them only for what is named.
ALSO = {"data": {"app/cli/option_types.h"}}
NOT_COUNTED = ("tests/fuzz/corpus", "tests/bench/results", "data")
MOST_ENTRIES = 30
MOST_LINES = 400


def tracked(root):
    """The files of the repository, those not yet added too; all files below a folder that is none."""
    git = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True)
    if git.returncode == 0:
        return [name for name in git.stdout.split("\n") if name and (root / name).is_file()]
    return [str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]


def rank(name):
    """The place of a file's room in ROOMS; None outside all of them."""
    for place, rooms in enumerate(ROOMS):
        if any(name.startswith(room + "/") for room in rooms.split()):
            return place
    return None


def includes_upwards(root, files):
    for name in files:
        own = rank(name)
        if own is None or not name.endswith((".cpp", ".h", ".glsl")):
            continue
        for included in re.findall(r'^\s*#include "([^"]+)"', (root / name).read_text(), re.MULTILINE):
            other = rank(included)
            room = name.split("/")[0]
            if room == "data" and included.startswith(("preprocess/", "app/")) and included not in ALSO["data"]:
                yield f"{name}: includes {included}, expected only {', '.join(ALSO['data'])} of the rooms after the engine"
            elif other is not None and other > own:
                yield f"{name}: includes {included}, expected nothing of a room after its own"


def full_folders(files):
    entries = collections.defaultdict(set)
    for name in files:
        path = pathlib.PurePosixPath(name)
        for parent in path.parents:
            entries[str(parent)].add(path.parts[len(parent.parts)])
    for folder, names in sorted(entries.items()):
        if len(names) > MOST_ENTRIES and not any(folder == free or folder.startswith(free + "/") for free in NOT_COUNTED):
            yield f"{folder}: found {len(names)} entries, expected at most {MOST_ENTRIES}"


def lines_of_code(text):
    """Lines that hold something other than a comment."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return sum(1 for line in text.split("\n") if line.strip() and not line.strip().startswith("//"))


def long_files(root, files):
    for name in files:
        if not name.endswith((".cpp", ".h", ".glsl")):
            continue
        lines = lines_of_code((root / name).read_text())
        if lines > MOST_LINES:
            yield f"{name}: found {lines} lines of code, expected at most {MOST_LINES}"


def findings(root):
    files = tracked(root)
    return [*includes_upwards(root, files), *full_folders(files), *long_files(root, files)]


def prove():
    """Each rule notices the one thing in a made-up repository that it forbids."""
    cases = {
        "includes upwards": {"engine/scene/a.h": '#include "preprocess/b.h"\n', "preprocess/b.h": ""},
        "includes a test": {"app/cli/a.cpp": '#include "tests/b.h"\n', "tests/b.h": ""},
        "folder": {f"engine/base/{i}.h": "" for i in range(MOST_ENTRIES + 1)},
        "long": {"engine/base/a.cpp": "int a();\n" * (MOST_LINES + 1)},
    }
    for rule, files in cases.items():
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            found = findings(pathlib.Path(folder))
            if len(found) != 1:
                sys.exit(f"the rule '{rule}' was broken once, found {found}")


if __name__ == "__main__":
    prove()
    found = findings(pathlib.Path(sys.argv[1]).resolve())
    for finding in found:
        print(finding, file=sys.stderr)
    sys.exit(1 if found else 0)
