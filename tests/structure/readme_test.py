"""readme_test.py REPOSITORY PROGRAMS: what README.md and the pages of app/guide say is so. In a folder with small inputs of the names that
they use (page_inputs.py), pictures being 16 x 16 and of two samples, their blocks behind the comment <!-- run --> run, the guide's with
SPLATRAY_TEST_ALL set (tests/run --all): one of commands (sh) ends well, one of a terminal (console) shows the lines below each command, "..." standing for any text. Every option that a line of these and
of other pages gives to a program of splatray is one that its --help lists; links lead to files. The gallery's commands (data/gallery.md)
are understood, and its pictures are there. CONTRIBUTING.md names tests that exist. README.md stays short."""

import functools
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import page_inputs

RUN = "README.md", "app/guide/*.md"
RUN_PAGES = RUN if "SPLATRAY_TEST_ALL" in os.environ else RUN[:1]  # the guide's blocks take a minute of the CPUs
READ = *RUN, "*.md", "app/*/README.md", "app/*/*/README.md", "data/*.md", "data/figures/README.md"
GALLERY = "data/gallery.md"
GALLERY_PICTURES = 12
MOST_PICTURE_BYTES = 250_000
MOST_LINES, MOST_COLUMNS = 80, 130  # of README.md
INPUT_UNREADABLE = 3
# Options behind a command's own, of which the last one holds; and behind those that name one of these.
SMALLER = {"splatray-render": "--resolution=16x16 --samples=2", "splatray-preprocess": ""}
# Vulkan takes seconds to start with sanitizers, the CPU device a fifth of that.
DEVICE = " --device=cpu"
SMALLER_IF = {"splatray-render": {"--mesh-points": "--mesh-points=2000", "--error": "--time=0.2", "--time": "--time=0.2", "--turntable": "--frames=0-1",
                                  "vase.ply": "--mesh-points=2000", "bunny.ply": "--mesh-points=2000"},
              "splatray-preprocess": {"--mesh-points": "--mesh-points=2000"}}
# In place of both, behind those that name one of these: a sheet has a size of its own.
INSTEAD_IF = {"splatray-render": {"--sheet": "--samples=2"}}
# Sheets of few pixels: of keys given twice the last one holds.
COARSE = ('n=$#; while [ $n -gt 0 ]; do a=$1; shift; n=$((n - 1)); case "$a" in plan:*\\;*) a="${a%%;*},dpi=20;${a#*;}";; '
          'plan:*|section:*|elevation:*) a="$a,dpi=20";; esac; '
          'set -- "$@" "$a"; done\n')


def blocks(text, language):
    """(runs, body) of each block."""
    for mark, body in re.findall(rf"(<!-- run -->\s*)?```{language}\n(.*?)```", text, re.DOTALL):
        yield bool(mark), body


def transcripts(body):
    """(command, lines shown) of each command of a terminal's block."""
    for part in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
        command, *shown = part.rstrip("\n").split("\n")
        yield command, shown


def words_of(line):
    return shlex.split(line, comments=True)


@functools.cache
def help_of(program):
    return subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout


def unknown_options(page, body, programs):
    """The options that a program's help does not list."""
    for line in body.replace("\\\n", " ").splitlines():
        words = words_of(line)
        program = next((pathlib.Path(word).name for word in words if re.search(r"(^|/)splatray-\w+$", word)), None)
        if program is None or not (programs / program).exists():
            continue
        for word in words:
            name = word.split("=")[0]
            if re.fullmatch(r"--?[a-z][\w-]*", name) and name != "--help" and not re.search(rf"(?<![\w-]){name}(?![\w-])",
                                                                                           help_of(programs / program)):
                yield f"{page}: found '{line}', expected an option of {program} in place of {name}"


def make_programs(folder, programs):
    """build/release/bin with the programs, those in SMALLER made quick."""
    target = folder / "build/release/bin"
    target.mkdir(parents=True)
    for program in programs.iterdir():
        if program.name not in SMALLER:
            (target / program.name).symlink_to(program)
            continue
        more = "".join(f'case "$*" in *{option}[=\\ ]*) more="$more {smaller}";; esac\n' for option, smaller in SMALLER_IF[program.name].items())
        more += "".join(f'case "$*" in *{option}[=\\ ]*) more="{instead}";; esac\n' for option, instead in INSTEAD_IF.get(program.name, {}).items())
        if program.name == "splatray-render":
            more += f'case "$*" in *--device[=\\ ]*) ;; *) more="$more{DEVICE}";; esac\n'
        (target / program.name).write_text(f'#!/bin/sh\ncase "$*" in *--list-devices*|*--help*) exec {program} "$@";; esac\n'
                                           f'{COARSE}more="{SMALLER[program.name]}"\n{more}exec {program} "$@" $more\n')
        (target / program.name).chmod(0o755)


def run(command, folder):
    path = f"{folder / 'build/release/bin'}:{os.environ['PATH']}"
    return subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=folder, capture_output=True, text=True,
                          env=os.environ | {"PATH": path})


def missing_line(shown, output):
    """The first of the lines shown that the output has not behind the one before; None where all are there."""
    lines = iter(output.split("\n"))
    for expected in shown:
        pattern = ".*".join(re.escape(part) for part in expected.strip().split("..."))
        if not any(re.fullmatch(pattern, line.strip()) for line in lines):
            return expected
    return None


def failures(page, text, programs, inputs, runs_blocks=True):
    """What is not so in a page, whose blocks, if they run, do so one after the other in a folder of their own."""
    for _, body in blocks(text, "sh"):
        yield from unknown_options(page, body, programs)
    for _, body in blocks(text, "console"):
        yield from unknown_options(page, "\n".join(command for command, _ in transcripts(body)), programs)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "folder"
        shutil.copytree(inputs, folder, symlinks=True)
        for runs, body in blocks(text, "sh"):
            result = run(body, folder) if runs and runs_blocks else None
            if result and result.returncode != 0:
                yield f"{page}: a block ended with exit code {result.returncode}: {result.stderr.strip()}\n{body}"
        for runs, body in blocks(text, "console"):
            for command, shown in transcripts(body) if runs and runs_blocks else ():
                result = run(command, folder)
                missing = missing_line(shown, result.stderr + result.stdout)
                if missing is not None:
                    yield f"{page}: '{command}' did not show '{missing}' but\n{result.stderr}{result.stdout}"


def gallery_failures(root, programs):
    """Commands that are not understood (what they read is not there, which is found after that), pictures that are missing or large."""
    text = (root / GALLERY).read_text()
    commands = [body for _, body in blocks(text, "sh") if "-o OUT/" in body]
    pictures = re.findall(r"!\[.*?\]\((.*?)\)", text)
    if len(commands) != GALLERY_PICTURES or len(pictures) != GALLERY_PICTURES:
        yield f"{GALLERY}: found {len(commands)} commands and {len(pictures)} pictures, expected {GALLERY_PICTURES} of each"
    for picture in pictures:
        path = root / "data" / picture
        if not path.is_file() or path.stat().st_size > MOST_PICTURE_BYTES:
            yield f"{GALLERY}: expected {picture} to be there, of at most {MOST_PICTURE_BYTES} bytes"
    with tempfile.TemporaryDirectory() as folder:
        for body in commands:
            words = [word.replace("DATA/", "none/").replace("OUT/", f"{folder}/") for word in words_of(body.replace("\\\n", " "))]
            result = subprocess.run([programs / words[0], *words[1:]], cwd=folder, capture_output=True, text=True)
            if result.returncode != INPUT_UNREADABLE:
                yield f"{GALLERY}: found exit code {result.returncode}, expected {INPUT_UNREADABLE} without data: {body}{result.stderr}"


def unknown_tests(root, text):
    """The tests that CONTRIBUTING.md names and no list has."""
    lists = "".join(path.read_text() for path in root.glob("tests/*/CMakeLists.txt"))
    table = text.split("## Which test covers what")[1].split("##")[0]
    for row in re.findall(r"^\|[^|]*\|(.*)\|$", table, re.MULTILINE):
        for name in re.findall(r"[\w.]+", " ".join(re.findall(r"`(.*?)`", row))):
            if not re.search(rf"\b{re.escape(name)}", lists):
                yield f"CONTRIBUTING.md: found the test {name}, expected one of tests/*/CMakeLists.txt"


def broken_links(root, page):
    """Links to files that are not there."""
    for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", (root / page).read_text()):
        if not (root / page).parent.joinpath(link).exists():
            yield f"{page}: found a link to {link}, expected one to a file that is there"


def too_long(text):
    lines = text.rstrip("\n").split("\n")
    if len(lines) > MOST_LINES:
        yield f"README.md: found {len(lines)} lines, expected at most {MOST_LINES}"
    for number, line in enumerate(lines, 1):
        if len(line) > MOST_COLUMNS:
            yield f"README.md:{number}: found {len(line)} characters, expected at most {MOST_COLUMNS}"


def prove(root, programs, inputs):
    """Each rule notices what it is for."""
    if len(list(unknown_tests(root, "## Which test covers what\n| a folder | `test_host\\|no_such_test` | |\n"))) != 1:
        sys.exit("A test that does not exist was not found so")
    broken = ("<!-- run -->\n```sh\nsplatray-render missing.ply -o a.png\n```\n"
              "```sh\nsplatray-render bunny.ply \\\n  --no-such-option\n```\n"
              "<!-- run -->\n```console\n$ echo one two; echo three\none ...\nfour\n```\n")
    found = list(failures("broken", broken, programs, inputs))
    if len(found) != 3:
        sys.exit(f"A file that is missing, an option that does not exist and a line not shown were found as {found}")
    if len(list(too_long("a\n" * (MOST_LINES + 1) + "a" * (MOST_COLUMNS + 1)))) != 2:
        sys.exit("A README.md that is too long and too wide was not found so")
    (inputs / "page.md").write_text("[here](page.md#part), [nowhere](none.md), [elsewhere](https://example.org)")
    if len(list(broken_links(inputs, "page.md"))) != 1:
        sys.exit("A link to no file was not found so")


def main():
    root, programs = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as name:
        inputs = pathlib.Path(name)
        page_inputs.make_inputs(inputs)
        make_programs(inputs, programs)
        prove(root, programs, inputs)
        found = [*too_long((root / "README.md").read_text()), *gallery_failures(root, programs),
                 *unknown_tests(root, (root / "CONTRIBUTING.md").read_text())]
        pages = sorted({path for pattern in RUN for path in root.glob(pattern)})
        for page in pages:
            runs_blocks = any(page.relative_to(root).match(pattern) for pattern in RUN_PAGES)
            found += failures(page.relative_to(root), page.read_text(), programs, inputs, runs_blocks)
        read = sorted({path for pattern in READ for path in root.glob(pattern)})
        for page in read:
            found += broken_links(root, page.relative_to(root))
            for _, body in blocks(page.read_text(), "sh") if page not in pages else ():
                found += unknown_options(page.relative_to(root), body, programs)
    print("\n".join(found), file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    # As tests/cli/child_process.cpp does.
    os.environ["ASAN_OPTIONS"] = os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"
    main()
