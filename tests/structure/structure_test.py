"""structure_test.py REPOSITORY: includes go one way, folders have at most 30 entries and source files at most 400 lines of code.
Each finding is one line on stderr. First it shows, on made-up repositories, that each rule can fail."""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

# A file may include those of its own room and of the rooms before it. A file's room is the longest name here that its path begins with:
# every folder has a rank of its own, a folder that only its parent knows has its parent's.
ROOMS = ["shaders", "shaders/lang", "shaders/primitive", "shaders/scene", "shaders/trace", "shaders/light", "shaders/stage", "shaders/display",
         "engine/base", "engine/table", "engine/scene", "engine/file", "engine/light", "engine/image", "engine/device", "engine/cpu", "engine/device/host", "engine/device/vulkan", "engine/device/open_device.cpp", "engine/gpu",
         "preprocess/points.h", "preprocess/build_stats.h", "preprocess/base", "preprocess/mesh", "preprocess/surface",
         "preprocess/scan", "preprocess/tree", "preprocess/read", "preprocess",
         "app/library/codec", "app/library", "app/library/request", "app/library/measure", "app/library/cut", "app/library/shot", "app/library/sheet", "app/library/picture", "app/library/picture/series", "app/library/api", "app/cli", "app/farm", "app/python", "app/package",
         "app/view/model", "app/view/ui", "app/view/display", "app/view/window", "app/view/thread", "app/view", "data", "tests"]
# Rooms that only some may look into: programs, viewer and Python trace by app/library.
# The viewer makes pictures ready for a screen, and shows them, by Vulkan itself.
ONLY_FOR = {"engine/gpu": ("engine/gpu", "app/library/shot", "app/library/picture", "tests"),
            # What decides what was not asked: in one place.
            "engine/image/scan_kind.h": ("engine/image", "app/library/shot", "tests"),
            # A model says in its scene file which way it stands.
            "engine/image/upright.h": ("engine/image", "preprocess/build.cpp", "app/library/shot", "tests"),
            "app/library/shot/sheet_placement.h": ("app/library/shot", "tests"),
            "engine/device/vulkan": ("engine/device/vulkan", "engine/device/open_device.cpp", "app/view/display", "app/view/window", "tests"),
            "engine/device/host": ("engine/device/host", "engine/device/open_device.cpp", "tests"),
            "engine/cpu": ("engine/cpu", "engine/device/host", "tests")}
# Rooms that look into one after them only for what is named.
ALSO = {"data": {"app/cli/option_types.h"}}
# Includes that close a circle and are let through: none, and none comes in.
OPEN_CIRCLES = set()
NOT_COUNTED = ("tests/fuzz/corpus", "tests/bench/results", "data")
MOST_ENTRIES = 30
MOST_LINES = 400
# What makes the kernels many, as of today: more is a decision, made here.
MOST_MODULES = 6
MOST_FLAGS = 1
MOST_CONSTANTS = 11
MOST_FEATURES = 29
# What knows how splats are stored, as of today: these numbers may only fall. Who reads splats does so by engine/scene/scene_splat.h.
DECODING = re.compile(r"\bunpack_(?:splat|center|radius_squared|stored_normal)\(")
WHOLE_POOL = re.compile(r"(?:\.|->|::)(?:node|slab|reference|data|color|field|clip)_pool\b")
# Where what a request leaves open is chosen: who calls what chooses; CHOOSERS define it.
CHOSEN = {"view": (r"\bchoose_viewpoint\(", {"app/library/shot/scene_facts.cpp"}),
          "up direction": (r"\bupright\(scene\)|\bupright_model\(", {"app/library/shot/resolve.cpp", "preprocess/build.cpp"}),
          "look": (r"\bresolve_look\(", {"app/library/shot/resolve.cpp", "app/library/shot/lights.cpp"}),
          "colours": (r"\bresolve_(?:color_by|colors)\(", {"app/library/shot/resolve.cpp"}),
          "exposure": (r"\bautomatic_exposure_ev\(", {"app/library/shot/picture_lights.cpp"}),
          "noise": (r"\bresolve_denoise\(|\bremove_noise\(", {"app/library/shot/resolve.cpp", "app/library/picture/make_picture.cpp",
                                                                       "app/view/thread/progressive.cpp"}),
          "lights": (r"\bdefault_lights\(|\bheadlight\(", {"app/library/shot/lights.cpp", "app/library/shot/picture_lights.cpp"}),
          "a drawing's place": (r"\bmake_sheet\(", {"app/library/shot/resolve.cpp", "app/library/shot/sheet_set.cpp"})}
CHOOSERS = {"app/library/display_image.cpp", "app/library/picture/denoise.cpp", "app/library/shot/sheet_placement.cpp",
            "engine/image/framing/framing.cpp", "engine/image/lights.cpp", "engine/image/upright.cpp"}
# Comments that begin with "Of", of a thing that they leave unsaid: as of today, and fewer.
OF_WHAT = re.compile(r"^\s*///? Of ", re.MULTILINE)
MOST_OF_WHAT = 7
MOST_DECODERS = 12
MOST_POOL_HOLDERS = 22


def tracked(root):
    """The files of the repository, those not yet added too; all files below a folder that is none."""
    git = subprocess.run(["git", "-C", root, "ls-files", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True)
    if git.returncode == 0:
        return [name for name in git.stdout.split("\n") if name and (root / name).is_file()]
    return [str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]


def rank(name):
    """The place of a file's room in ROOMS; None outside all of them."""
    found = [(len(room), place) for place, room in enumerate(ROOMS) if name == room or name.startswith(room + "/")]
    return max(found)[1] if found else None


def includes(root, files):
    """(file, included file) of all code, both as paths from the root; the shaders' are relative to shaders/."""
    known = set(files)
    for name in files:
        if not name.endswith((".cpp", ".h", ".glsl", ".comp")):
            continue
        for included in re.findall(r'^\s*#include "([^"]+)"', (root / name).read_text(), re.MULTILINE):
            yield name, next((place for place in (included, "shaders/" + included) if place in known), included)


def includes_upwards(root, files):
    for name, included in includes(root, files):
        own, other = rank(name), rank(included)
        if own is None or other is None or (name, included) in OPEN_CIRCLES:
            continue
        if name.startswith("data/") and included.startswith(("preprocess/", "app/")) and included not in ALSO["data"]:
            yield f"{name}: includes {included}, expected only {', '.join(ALSO['data'])} of the rooms after the engine"
        elif other > own:
            yield f"{name}: includes {included}, expected nothing of a room after its own"


def closed_rooms(root, files):
    """Includes of rooms that only some may look into."""
    for name, included in includes(root, files):
        for room, allowed in ONLY_FOR.items():
            if (included == room or included.startswith(room + "/")) and not name.startswith(allowed):
                yield f"{name}: includes {included}, expected that only of {', '.join(allowed)}"


def closed_circles(root, files):
    """What OPEN_CIRCLES names and no longer is."""
    found = set(includes(root, files))
    for name, included in sorted(OPEN_CIRCLES):
        if name in files and (name, included) not in found:
            yield f"{name}: no longer includes {included}, expected OPEN_CIRCLES without it"


def unranked(files):
    """Code in no room."""
    for name in files:
        if name.endswith((".cpp", ".h", ".glsl")) and rank(name) is None:
            yield f"{name}: found no room that it belongs to, expected one of ROOMS"


def reachable(graph, start):
    seen, todo = set(), [start]
    while todo:
        for folder in graph[todo.pop()] - seen:
            seen.add(folder)
            todo.append(folder)
    return seen


def circles(root, files):
    """Folders of the product that include each other, directly or by others; a folder and those inside it are one."""
    graph, by = collections.defaultdict(set), {}
    for name, included in includes(root, files):
        here, there = str(pathlib.PurePosixPath(name).parent), str(pathlib.PurePosixPath(included).parent)
        nested = here == there or (here + "/").startswith(there + "/") or (there + "/").startswith(here + "/")
        if not nested and not name.startswith(("tests/", "data/")) and (name, included) not in OPEN_CIRCLES:
            graph[here].add(there)
            by[here, there] = name
    for (here, there), name in sorted(by.items()):
        if here in reachable(graph, there):
            yield f"{name}: includes from {there}, from where one comes back to {here}, expected no circle of folders"


def torn_lines(root, files):
    """Declarations that clang-format tore in two before the comment behind them."""
    for name in files:
        if not name.endswith((".cpp", ".h")):
            continue
        lines = (root / name).read_text().split("\n")
        for i, line in enumerate(lines[1:], 1):
            before = lines[i - 1].strip()
            if "///<" not in line or line.strip()[:4] == "///<" or not before or "//" in before:
                continue
            code = line.split("///<")[0].strip()
            deeper = len(line) - len(line.lstrip()) > len(lines[i - 1]) - len(lines[i - 1].lstrip())
            in_braces = before.endswith("{") and code.endswith("};") and "{" not in code
            in_list = before.endswith(",") and code.endswith(";") and deeper
            if in_braces or in_list or not before.endswith((";", "{", "}", ",", ":")):
                yield f"{name}:{i + 1}: found a declaration torn before its comment, expected the comment above it"


def kernel_counts(root):
    """What multiplies kernels: modules, their flags, specialization constants, features."""
    variants, layout = root / "shaders/variants.cmake", root / "shaders/layout.h"
    if not variants.is_file() or not layout.is_file():
        return
    rows = re.findall(r"^add_variant\((.*)\)", variants.read_text(), re.MULTILINE)
    flags = {flag for row in rows for flag in row.split()[2:]}
    text = layout.read_text()
    pools = root / "shaders/pools.glsl"
    optional = re.findall(r"^SPLATRAY_OPTIONAL_POOL\(\d", pools.read_text(), re.MULTILINE) if pools.is_file() else []
    counts = {
        "modules": (len(rows), MOST_MODULES),
        "flags": (len(flags), MOST_FLAGS),
        "specialization constants": (len(re.findall(r"^SPLATRAY_CONST SPEC_(?!COUNT)\w+ =", text, re.MULTILINE)), MOST_CONSTANTS),
        "features": (len(re.findall(r"^SPLATRAY_CONST FEATURE_\w+ =", text, re.MULTILINE)) + len(optional), MOST_FEATURES),
    }
    for what, (count, most) in counts.items():
        if count > most:
            yield f"shaders: found {count} {what}, expected at most {most}"


def code_that_names(root, files, names):
    """The files of code outside tests in which the expression is found, comments aside."""
    code = (name for name in files if name.endswith((".cpp", ".h")) and not name.startswith("tests/"))
    return [name for name in code if names.search(re.sub(r"//.*", "", (root / name).read_text()))]


def readers_of_words(root, files):
    """Files that decode splats, or hold whole pools of a scene, themselves."""
    for what, names, most in (("decode splats", DECODING, MOST_DECODERS), ("name whole pools", WHOLE_POOL, MOST_POOL_HOLDERS)):
        count = len(code_that_names(root, files, names))
        if count > most:
            yield f"engine/scene/scene_splat.h: found {count} files that {what}, expected at most {most}"


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


def choosers(root, files):
    """Calls of what chooses, elsewhere than CHOSEN has them; its rows that choose nowhere."""
    for what, (names, places) in CHOSEN.items():
        named = set(code_that_names(root, files, re.compile(names)))
        for name in sorted(name for name in named - places - CHOOSERS if name.endswith(".cpp")):
            yield f"{name}: chooses the {what}, expected that of {', '.join(sorted(places))} alone"
        for name in sorted(place for place in places - named if place in files):
            yield f"{name}: chooses no {what}, expected CHOSEN without it"


def unsaid_subjects(root, files):
    code = [name for name in files if name.endswith((".cpp", ".h", ".glsl")) and not name.startswith("tests/")]
    count = sum(len(OF_WHAT.findall((root / name).read_text())) for name in code)
    if count > MOST_OF_WHAT:
        yield f"comments: found {count} that begin with 'Of', expected at most {MOST_OF_WHAT}: say of what is spoken"


def long_files(root, files):
    for name in files:
        if not name.endswith((".cpp", ".h", ".glsl")):
            continue
        lines = lines_of_code((root / name).read_text())
        if lines > MOST_LINES:
            yield f"{name}: found {lines} lines of code, expected at most {MOST_LINES}"


def findings(root):
    files = tracked(root)
    return [*includes_upwards(root, files), *unranked(files), *circles(root, files), *closed_circles(root, files), *closed_rooms(root, files),
            *full_folders(files), *long_files(root, files),
            *torn_lines(root, files), *kernel_counts(root), *readers_of_words(root, files), *choosers(root, files), *unsaid_subjects(root, files)]


def prove():
    """Each rule notices the one thing in a made-up repository that it forbids."""
    cases = {
        "includes upwards": {"engine/scene/a.h": '#include "preprocess/b.h"\n', "preprocess/b.h": ""},
        "includes a test": {"app/cli/a.cpp": '#include "tests/b.h"\n', "tests/b.h": ""},
        "folder": {f"engine/base/{i}.h": "" for i in range(MOST_ENTRIES + 1)},
        "long": {"engine/base/a.cpp": "int a();\n" * (MOST_LINES + 1)},
        "no room": {"elsewhere/a.h": ""},
        "two folders of a room": {"preprocess/tree/a.h": '#include "preprocess/read/b.h"\n', "preprocess/read/b.h": ""},
        "library above the command line": {"app/library/a.h": '#include "app/cli/b.h"\n', "app/cli/b.h": ""},
        "a room that only some look into": {"app/cli/a.cpp": '#include "engine/gpu/b.h"\n', "engine/gpu/b.h": ""},
        "past the devices' door": {"engine/gpu/a.cpp": '#include "engine/device/vulkan/b.h"\n', "engine/device/vulkan/b.h": ""},
        "the host's kernels past the door": {"engine/gpu/a.cpp": '#include "engine/cpu/b.h"\n', "engine/cpu/b.h": ""},
        "torn at a brace": {"engine/base/a.h": "struct A {\n  int a{\n      1};  ///< a number\n};\n"},
        "torn at a comma": {"engine/base/a.h": "constexpr int A = 1,\n              B = 2;  ///< numbers\n"},
        "torn": {"engine/base/a.h": "struct A {\n  int\n      a;  ///< a number\n};\n"},
        "modules": {"shaders/variants.cmake": "add_variant(A a.glsl CPU)\n" * (MOST_MODULES + 1), "shaders/layout.h": ""},
        "features": {"shaders/variants.cmake": "", "shaders/layout.h": "", "shaders/pools.glsl": "SPLATRAY_OPTIONAL_POOL(0u, A)\n" * (MOST_FEATURES + 1)},
        "decoders": {f"preprocess/read/{i}.cpp": "Splat splat = unpack_splat(words);\n" for i in range(MOST_DECODERS + 1)},
        "decoders of a part": {f"app/cli/{i}.h": "auto at = unpack_center(words);\n" for i in range(MOST_DECODERS + 1)},
        "comments without a subject": {"engine/base/a.h": "/// Of a point.\n" * (MOST_OF_WHAT + 1)},
        "a second place that chooses": {"app/cli/a.cpp": "const Viewpoint view = choose_viewpoint(scene);\n"},
        "a place that chooses no longer": {"app/library/shot/scene_facts.cpp": "int a();\n"},
        "pools": {f"app/cli/{i}.cpp": "f(scene.data_pool, scene->clip_pool);\n" for i in range(MOST_POOL_HOLDERS + 1)},
        "constants": {"shaders/variants.cmake": "", "shaders/layout.h": "SPLATRAY_CONST SPEC_A = 0u;\n" * (MOST_CONSTANTS + 1)},
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
    with tempfile.TemporaryDirectory() as folder:
        for here, there in ("ab", "bc", "ca"):
            path = pathlib.Path(folder) / f"engine/base/{here}/{here}.h"
            path.parent.mkdir(parents=True)
            path.write_text(f'#include "engine/base/{there}/{there}.h"\n')
        found = findings(pathlib.Path(folder))
        if len(found) != 3:
            sys.exit(f"a circle of three folders was found as {found}")


if __name__ == "__main__":
    prove()
    found = findings(pathlib.Path(sys.argv[1]).resolve())
    for finding in found:
        print(finding, file=sys.stderr)
    sys.exit(1 if found else 0)
