"""reference_test.py SOURCE: the pages that app/package/reference makes of splatray.h have each name that is public in it. Exit 77 with a
sentence where Doxygen is missing."""

import pathlib
import re
import shutil
import sys
import tempfile

from install_test import run

MISSING = 77
# Words of the language, and names that stand for nothing a user writes.
NO_NAMES = set("""bool char class const default delete double enum explicit final float friend inline int namespace noexcept nodiscard operator
override private public return static struct this true false unsigned using void std splatray api impl""".split())


def public_names(header):
    """The names of types, functions, parameters, members and enumerators: what is left of the code without comments, texts, what is
    private (its members end in _), and the standard library."""
    code = re.sub(r"^#.*|//.*|\"[^\"]*\"", "", header, flags=re.MULTILINE)
    code = re.sub(r"private:.*?\n\};|struct Impl;", "};", code, flags=re.DOTALL)
    code = re.sub(r"std::(?:filesystem::)?\w+|SPLATRAY_API|(?<!\w)[\d.][\w.]*", "", code)
    return {name for name in re.findall(r"[A-Za-z_]\w*", code) if not name.endswith("_")} - NO_NAMES


def names_on(pages):
    """What the pages link or list as a name: not what is said of it, nor the header's listing."""
    names = set()
    for page in pages:
        if page.stem.endswith("_source"):
            continue
        for parts in re.findall(r'<a [^>]*>([^<]*)</a>|class="(?:mem|field|param)(?:name|type)">(.*?)</td>', page.read_text(), re.DOTALL):
            names |= set(re.findall(r"[A-Za-z_]\w*", re.sub(r"<[^>]*>", " ", " ".join(parts))))
    return names


def prove():
    """Names are found, and so is one that is missing."""
    header = ("#pragma once\n/// A kind.\nenum class Kind {\n  red,   ///< like blood\n};\nstruct SPLATRAY_API Light {\n  double size = 1e-3;\n"
              "  std::vector<float> t{};\n private:\n  int hidden_;\n};\n[[nodiscard]] SPLATRAY_API Light lamp(const Kind& kind,\n    int n = 1);\n")
    assert public_names(header) == {"Kind", "red", "Light", "size", "t", "lamp", "kind", "n"}, public_names(header)
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "a.html"
        page.write_text('<a href="x">lamp</a><p>size</p><td class="fieldname"><a id="y"></a>red&#160;</td>')
        assert names_on([page]) == {"lamp", "red"}, names_on([page])


def main():
    prove()
    source = pathlib.Path(sys.argv[1])
    if shutil.which("doxygen") is None:
        print("skipped: the C++ reference is not made (Debian's package doxygen)")
        sys.exit(MISSING)
    names = public_names((source / "app/library/splatray.h").read_text())
    if len(names) < 90:
        sys.exit(f"found {len(names)} public names in splatray.h, expected more: {sorted(names)}")
    with tempfile.TemporaryDirectory() as out:
        run(source / "app/package/reference", out)
        missing = sorted(names - names_on((pathlib.Path(out) / "cpp").rglob("*.html")))
        if missing:
            sys.exit(f"the reference has no {', '.join(missing)}, expected all public names of splatray.h")


if __name__ == "__main__":
    main()
