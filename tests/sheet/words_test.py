#!/usr/bin/env python3
"""words_test.py RENDER FOLDER: the words of sheets as PDF, as pdfplumber finds them, cover no other word and lie on the page; those of
SVG are text. Exit 77: skipped."""
import itertools
import json
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

from pypi_python import PDFPLUMBER, pypi_python

render, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
LONG = "The north-western hall of the former municipal waterworks with its galleries and the pumping station " * 3
BLOCK = "project=Waterworks;number=WW-2026-0117;sheet=3/12;revision=c;author=N. N. and others;date=2026-11-28"
# Sheet, title and title block.
PAGES = [("plan:scale=50", "Hall", ""), ("plan:scale=20,paper=A3", LONG, BLOCK), ("plan:scale=200,portrait", "Hall", BLOCK),
         ("plan:scale=10,paper=A1,landscape", LONG, ""), ("elevation:south,scale=1000", "W" * 300, BLOCK),
         ("section:-1,0,1,0,scale=2", "Hall", BLOCK), ("plan:z=0.6,scale=20,level=0;section:-1,0,1,0;elevation:south;plan", LONG, BLOCK),
         ("plan:scale=100,paper=A4;elevation:west;elevation:12.5", "Hall", "")]

READ = """
import json, sys
import pdfplumber
pages = []
for name in sys.argv[1:]:
    with pdfplumber.open(name) as pdf:
        page, = pdf.pages
        words = [(w["text"], w["x0"], w["top"], w["x1"], w["bottom"]) for w in page.extract_words(use_text_flow=True, keep_blank_chars=False)]
        pages.append((float(page.width), float(page.height), words))
print(json.dumps(pages))
"""


def write_box(path):
    """Points on the sides of a box of 2 x 1 x 1.2."""
    with open(path, "w") as file:
        for i, j in itertools.product(range(40), repeat=2):
            u, v = (i + 0.5) / 40, (j + 0.5) / 40
            for x, y, z in ((u, v, 0), (u, v, 1), (u, 0, v), (u, 1, v), (0, u, v), (1, u, v)):
                file.write(f"{2 * x - 1:.4f} {y - 0.5:.4f} {1.2 * z:.4f}\n")


def meets(a, b):
    return a[1] < b[3] and b[1] < a[3] and a[2] < b[4] and b[2] < a[4]


def findings(page):
    width, height, words = page
    wrong = [f"{a[0]} covers {b[0]}" for a, b in itertools.combinations(words, 2) if meets(a, b)]
    return wrong + [f"{w[0]} leaves the page" for w in words if w[1] < 0 or w[2] < 0 or w[3] > width or w[4] > height]


def main():
    folder.mkdir(parents=True, exist_ok=True)
    python = pypi_python(folder.parent / "pdfplumber", *PDFPLUMBER)
    write_box(folder / "box.xyz")
    names = []
    for i, (sheet, title, block) in enumerate(PAGES):
        for extension in "pdf", "svg":
            names.append(folder / f"page{i}.{extension}")
            subprocess.run([render, "--quiet", folder / "box.xyz", "-o", names[-1], "--up", "0,0,1", "--samples", "1",
                            "--sheet", sheet.replace("scale=", "dpi=20,scale="), "--title", title, *(("--title-block", block) if block else ())], check=True)
    pdfs, svgs = names[::2], names[1::2]
    pages = json.loads(subprocess.run([python, "-c", READ, *pdfs], check=True, capture_output=True, text=True).stdout)
    for name, page, (_, title, block) in zip(pdfs, pages, PAGES):
        print(f"{name.name}: {page[0] / 72 * 25.4:.0f} x {page[1] / 72 * 25.4:.0f} mm, {len(page[2])} words")
        assert not findings(page), findings(page)
        text = "".join(w[0] for w in page[2])
        for part in [title] + [field.split("=")[1] for field in block.split(";") if field]:
            assert part.replace(" ", "") in text, f"{name.name} lacks '{part}'"
    # The check fails where it should.
    pages[0][2][0][1:] = pages[0][2][1][1:]
    assert findings(pages[0]), "a word on another was not noticed"
    for name, (_, title, _) in zip(svgs, PAGES):
        texts = "".join(text.text for text in xml.etree.ElementTree.parse(name).iter("{http://www.w3.org/2000/svg}text"))
        assert title.replace(" ", "") in texts.replace(" ", ""), f"{name.name} lacks its title as text"


main()
