#!/usr/bin/env python3
"""orbit_test.py RENDER FOLDER: the page of an orbit, opened from its file in headless Chromium, shows the pictures that splatray-render
makes, turns, and measures by double click. Exit 77: there is no Chromium."""
import base64
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys

render, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
SIZE, COLUMNS = (240, 180), 4

# Runs in the page: double clicks two places, turns by keys, and leaves what came of it in the document's title.
PROBE = """
<script>
addEventListener('load', () => setTimeout(() => {
  const box = canvas.getBoundingClientRect();
  const tap = (x, y) => { for (let i = 0; i < 2; ++i) for (const kind of ['pointerdown', 'pointerup'])
    canvas.dispatchEvent(new PointerEvent(kind, { clientX: x, clientY: y, pointerId: 1, bubbles: true })); };
  canvas.setPointerCapture = () => {};
  view.rise = rows - 1;
  load(data.pictures[index()], 'depth');
  setTimeout(() => {
    const { scale, x, y } = place();
    const at = place => project(data.pictures[index()], place);
    for (const corner of CORNERS) { const [px, py] = at(corner); tap((x + px * scale) / devicePixelRatio, (y + py * scale) / devicePixelRatio); }
    const marked = points.map(p => p.slice());
    const first = index();
    dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));
    const pixel = pen.getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data;
    document.body.innerHTML = '<pre id="answer">' + JSON.stringify({ marked, said: said.textContent, turned: index() !== first,
      pixel: [...pixel], pictures: data.pictures.length }) + '</pre>';
  }, 600);
}, 1500));
</script>
"""


def box_ply(path, low, high, step=0.04):
    """Points with normals on a box's sides."""
    lines = []
    for axis in range(3):
        others = [a for a in range(3) if a != axis]
        counts = [max(2, round((high[a] - low[a]) / step)) for a in others]
        for side, value in ((-1, low[axis]), (1, high[axis])):
            for i in range(counts[0]):
                for j in range(counts[1]):
                    p, n = [0.0] * 3, [0.0] * 3
                    p[axis], n[axis] = value, side
                    for a, index, count in zip(others, (i, j), counts):
                        p[a] = low[a] + (high[a] - low[a]) * (index + 0.5) / count
                    lines.append(" ".join(f"{v:.5f}" for v in (*p, *n)))
    names = "".join(f"property float {n}\n" for n in ("x", "y", "z", "nx", "ny", "nz"))
    path.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(lines)}\n{names}end_header\n" + "\n".join(lines) + "\n")


def check_pictures_without_denoiser(scan):
    """A page's distances do not come from the denoiser: pictures that need none have them too."""
    for i, options in enumerate((["--keep-noise"], ["--samples", "1"], ["--look", "paper"], ["--look", "lit", "--despeckle"])):
        page = folder / f"plain{i}.html"
        subprocess.run([render, "--quiet", scan, "-o", page, "--orbit", "2", "--up", "0,0,1", "--resolution", "64x48", *options], check=True)
        data = json.loads(re.search(r"const data = (.*);\n", page.read_text())[1])
        assert 0 < data["near"] < data["far"], f"{options}: found distances from {data['near']} to {data['far']}"


def main():
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    box_ply(folder / "box.ply", (-1, -0.5, 0), (1, 0.5, 1.2))
    page = folder / "box.html"
    subprocess.run([render, "--quiet", folder / "box.ply", "-o", page, "--orbit", f"{COLUMNS}x2", "--up", "0,0,1", "--samples", "4",
                    "--resolution", f"{SIZE[0]}x{SIZE[1]}", "--background", "1,1,1"], check=True)
    text = page.read_text()
    assert not re.search(r'(src|href)="?https?:', text), "the page needs other files"
    data = json.loads(re.search(r"const data = (.*);\n", text)[1])
    assert len(data["pictures"]) == 2 * COLUMNS
    for picture in data["pictures"]:
        assert base64.b64decode(picture["image"].split(",")[1])[:2] == b"\xff\xd8"
    check_pictures_without_denoiser(folder / "box.ply")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        print("skipped: there is no Chromium")
        sys.exit(77)
    # Two places on the top, away from its edges: their distance is known.
    corners = [(-0.7, -0.2, 1.2), (0.7, 0.2, 1.2)]
    probed = folder / "probed.html"
    probed.write_text(text.replace("</body>", PROBE.replace("CORNERS", json.dumps(corners)) + "</body>"))
    shown = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=800,600",
                            f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=8000", "--dump-dom", f"file://{probed.resolve()}"],
                           capture_output=True, text=True, timeout=120)
    answer = re.search(r'<pre id="answer">(.*?)</pre>', shown.stdout, re.DOTALL)
    assert answer, f"the page did not answer: {shown.stderr[-500:]}"
    found = json.loads(answer[1])
    print(found)
    assert found["pictures"] == 2 * COLUMNS and found["turned"], "it does not turn"
    assert len(found["marked"]) == 2, "double clicks mark nothing"
    true, length = math.dist(*corners), math.dist(*found["marked"])
    assert abs(length - true) < 0.03, f"measured {length}, expected {true}"
    assert "Distance" in found["said"]
    assert found["pixel"][3] == 255, "nothing is drawn"


main()
