"""man_page.py PROGRAM NAME VERSION OUTPUT: writes the gzipped man page of a program from what its --help says."""

import gzip
import os
import pathlib
import re
import subprocess
import sys


def escaped(text):
    """Text that troff shows as it is."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def entries(lines):
    """Pairs of an option or argument and what it does, which stands in the next line where the former is long."""
    found = []
    for line in lines:
        name, _, meaning = line.strip().partition("  ")
        if line.startswith("   "):
            found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
        else:
            found.append([name, meaning.strip()])
    return found


def sections(text):
    """The first sentence, the usage and, by their titles, the other parts of a help text."""
    head, *parts = re.split(r"\n\n+", text.strip("\n"))
    summary, usage = re.match(r"(.*)\nUsage: (.*)", head, re.DOTALL).groups()
    return summary, usage, {part.split("\n")[0].rstrip(":"): entries(part.split("\n")[1:]) for part in parts}


def page(name, version, text):
    summary, usage, parts = sections(text)
    out = [f'.TH {name.upper()} 1 "" "splatray {version}" "User Commands"', ".SH NAME",
           f"{escaped(name)} \\- {escaped(summary[0].lower() + summary[1:].rstrip('.'))}", ".SH SYNOPSIS", escaped(usage)]
    for title, pairs in parts.items():
        out.append(f".SH {title.upper()}")
        for option, meaning in pairs:
            out += [".TP", f".B {escaped(option)}", escaped(meaning)]
    out += [".SH EXIT STATUS",
            "0 done, 1 failed, 2 usage, 3 input unreadable, 4 no Vulkan device or display, 5 out of memory, 130 interrupted."]
    return "\n".join(out) + "\n"


def prove():
    """A small help text becomes the page that it should."""
    text = "Does it.\nUsage: it [OPTIONS]\n\nOptions:\n  -a,--all  everything\n  --long-option-name VALUE\n      .what it is\n"
    expected = [".TP", ".B \\-a,\\-\\-all", "everything", ".TP", ".B \\-\\-long\\-option\\-name VALUE", "\\&.what it is"]
    assert page("it", "1", text).split("\n")[6:12] == expected, page("it", "1", text)


if __name__ == "__main__":
    prove()
    program, name, version, output = sys.argv[1:]
    wide = os.environ | {"COLUMNS": "100000"}  # nothing is broken into lines
    text = subprocess.run([program, "--help"], check=True, capture_output=True, text=True, env=wide).stdout
    with pathlib.Path(output).open("wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
        packed.write(page(name, version, text).encode())
