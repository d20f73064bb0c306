"""remote_test.py BIN: scans on servers are those in files, byte for byte, and no more is fetched than a picture needs; what servers do
wrong is a sentence, and leaves nothing behind. BIN holds the programs. Makes its own scans; those of the tests' corpus are tiles."""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

from serve import Server

CORPUS = pathlib.Path(__file__).parent.parent / "fuzz" / "corpus" / "las"


def run(*command, **environment):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, env={**os.environ, **environment})
    return done.returncode, done.stdout, done.stderr


def require(what, holds, found=""):
    if not holds:
        sys.exit(f"{what}: {found}")


def las_of(points):
    """A LAS 1.2 file of points in millimetres."""
    low, high = [min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]
    header = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"test", b"test", 1, 2026, 227, 227, 0, 0, 20,
                         len(points), len(points), 0, 0, 0, 0)
    header += struct.pack("<12d", *(0.001,) * 3, 0, 0, 0, *(0.001 * v for i in range(3) for v in (high[i], low[i])))
    return header + b"".join(struct.pack("<iiiHBBbBH", *p, 0, 9, 2, 0, 0, 0) for p in points)


def hills(side):
    return [(100 * x, 100 * y, (x * x + 3 * x * y + 7 * y) % 97) for x in range(side) for y in range(side)]


def pictures_are_equal(programs, server, folder):
    """Of a file of several megabytes, by all kinds of servers that give parts."""
    render = [programs / "splatray-render", "--resolution", "96x64", "--samples", "1", "--quiet", "-o"]
    pictures = []
    for number, place in enumerate([folder / "hills.las", f"{server.url}/parts/hills.las", f"{server.url}/moved/hills.las",
                                    f"{server.url}/busy/hills.las?key=1"]):
        picture = folder / f"{number}.exr"
        code, _, error = run(*render, picture, place)
        require(f"{place} is read", code == 0, error)
        reading = folder / f"{number}.ply"
        require("points are kept", run(programs / "splatray-preprocess", place, "-o", reading)[0] == 0)
        pictures.append(reading.read_bytes().split(b"end_header\n")[1])
    require("the same points", len(set(pictures)) == 1)


def tiles_are_equal(programs, server, folder):
    """Entwine's, and a list of tiles that lies on the server."""
    for name in ("ept.json", "all.vpc"):
        said = [run(programs / "splatray-info", "--json", place) for place in (folder / name, f"{server.url}/parts/{name}")]
        require(f"{name} is read", all(code == 0 for code, _, _ in said), said)
        near, far = ([{key: file[key] for key in ("points", "box")} for file in json.loads(text)] for _, text, _ in said)
        require(f"{name} has the same points", near == far and near[0]["points"] > 0, (near, far))


def little_is_fetched(programs, server, folder):
    """The head of a large file is one block."""
    server.asked.clear()
    code, _, error = run(programs / "splatray-info", "--head", f"{server.url}/parts/hills.las")
    require("the head is read", code == 0, error)
    require("it is one block", [part for _, _, part in server.asked] == [(0, 65535)], server.asked)


def requests_wait_together(programs, server, folder):
    """For a tile of six megabytes, whose answers take long; its bytes come in order."""
    tile = folder / "tile"
    (tile / "ept-data").mkdir(parents=True)
    (tile / "ept-hierarchy").mkdir()
    points = hills(700)
    (tile / "ept-data" / "0-0-0-0.bin").write_bytes(b"".join(struct.pack("<iii", *p) for p in points))
    (tile / "ept-hierarchy" / "0-0-0-0.json").write_text(json.dumps({"0-0-0-0": len(points)}))
    schema = [{"name": name, "type": "signed", "size": 4, "scale": 0.001} for name in "XYZ"]
    (tile / "ept.json").write_text(json.dumps({"bounds": [0, 0, 0, 128, 128, 128], "dataType": "binary", "schema": schema, "version": "1.0.0"}))
    read = []
    server.most_waiting = 0
    for place in (tile / "ept.json", f"{server.url}/slow/tile/ept.json"):
        code, _, error = run(programs / "splatray-preprocess", place, "-o", folder / "tile.ply")
        require("a tile is read", code == 0, error)
        read.append((folder / "tile.ply").read_bytes().split(b"end_header\n")[1])
    require("a tile is the same", read[0] == read[1])
    require("several requests wait at a time", 2 <= server.most_waiting <= 8, server.most_waiting)


def faults_are_sentences(programs, server, folder):
    cases = {"parts/none.las": "no such file on this server", "whole/hills.las": "gives no parts of files", "ring/hills.las": "more than 5 redirects",
             "changes/hills.las": "has changed on its server", "gone/hills.las": "does not answer", "shut/hills.las": "HTTP 403",
             "parts/empty.las": "is empty"}
    picture = folder / "fault.png"
    for place, sentence in cases.items():
        code, _, error = run(programs / "splatray-render", "--quiet", f"{server.url}/{place}", "-o", picture)
        require(f"{place} is refused as unreadable", code == 3 and sentence in error and error.count("\n") == 1, (code, error))
        require(f"{place} leaves nothing", not picture.exists())
    code, _, error = run(programs / "splatray-info", "http://localhost:1/a.las")
    require("no server is a sentence", code == 3 and "does not answer" in error, (code, error))


def certificates_are_checked(programs, folder):
    if shutil.which("openssl") is None:
        print("skipped: no certificate can be made (Debian's package openssl)")
        return
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", certificate, "-days", "1", "-subj",
                    "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"], check=True, capture_output=True)
    server = Server(folder, certificate, key)
    code, _, error = run(programs / "splatray-info", f"{server.url}/parts/hills.las")
    require("a certificate that no one knows is refused", code == 3 and "cannot be trusted" in error, (code, error))
    code, _, error = run(programs / "splatray-info", f"{server.url}/parts/hills.las", CURL_CA_BUNDLE=str(certificate))
    require("one that is known is not", code == 0, error)


def main():
    programs = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "hills.las").write_bytes(las_of(hills(300)))
        (folder / "empty.las").write_bytes(b"")
        (folder / "ept-data").mkdir()
        shutil.copy(CORPUS / "pf8_items_v3.laz", folder / "ept-data" / "0-0-0-0.laz")
        (folder / "ept-hierarchy").mkdir()
        (folder / "ept-hierarchy" / "0-0-0-0.json").write_text('{"0-0-0-0": 40}')
        (folder / "ept.json").write_text('{"bounds": [0, 0, 0, 64, 64, 64], "dataType": "laszip", "version": "1.0.0"}')
        (folder / "all.vpc").write_text('{"features": [{"assets": {"data": {"href": "./hills.las"}}}]}')
        server = Server(folder)
        pictures_are_equal(programs, server, folder)
        tiles_are_equal(programs, server, folder)
        little_is_fetched(programs, server, folder)
        requests_wait_together(programs, server, folder)
        faults_are_sentences(programs, server, folder)
        certificates_are_checked(programs, folder)


if __name__ == "__main__":
    main()
