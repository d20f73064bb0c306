"""The small files that the commands of README.md and of app/guide name as the reader's own: meshes, a survey, a room's scan, an environment
and a camera path, written byte by byte."""

import math
import struct


def mesh_ply(rings, height):
    """A closed mesh like an egg, its vertices without normals."""
    vertices, faces, sectors = [], [], 2 * rings
    for ring in range(rings + 1):
        polar = math.pi * ring / rings
        for sector in range(sectors):
            turn = 2 * math.pi * sector / sectors
            vertices.append(f"{math.sin(polar) * math.cos(turn)} {height * math.cos(polar)} {-math.sin(polar) * math.sin(turn)}")
    for ring in range(rings):
        for sector in range(sectors):
            a, b = ring * sectors + sector, ring * sectors + (sector + 1) % sectors
            faces += [f"3 {a} {a + sectors} {b}", f"3 {b} {a + sectors} {b + sectors}"]
    return "\n".join(["ply", "format ascii 1.0", f"element vertex {len(vertices)}", "property float x", "property float y",
                      "property float z", f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header",
                      *vertices, *faces, ""])


def las(points, feet_high=False):
    """LAS 1.2, point format 2, steps of a thousandth, of (x, y, z, class, (r, g, b)); colours of 16 bits. `feet_high`: it says that x and y
    are metres and z is feet, by the keys of GeoTIFF."""
    lows, highs = ([pick(point[axis] for point in points) for axis in range(3)] for pick in (min, max))
    records = b"".join(struct.pack("<3iHBBBBH3H", *(round(1000 * (value - low)) for value, low in zip(place, lows)), 0, 9, kind, 0, 0, 0, *color)
                       for *place, kind, color in points)
    box = [value for axis in range(3) for value in (highs[axis], lows[axis])]
    keys = struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 1, 3076, 0, 1, 9001, 4099, 0, 1, 9002) if feet_high else b""
    if keys:
        keys = struct.pack("<H16sHH32x", 0, b"LASF_Projection", 34735, len(keys)) + keys
    head = b"LASF" + bytes(20) + b"\1\2" + bytes(68) + struct.pack("<HIIBHI", 227, 227 + len(keys), len(keys) > 0, 2, 26, len(points))
    return head + struct.pack("<5I", len(points), 0, 0, 0, 0) + struct.pack("<12d", *[0.001] * 3, *lows, *box) + keys + records


def survey(side=60, feet_high=False):
    """A hill of grass with a house on it, a point a metre, at the coordinates of a survey; the heights in feet where that is asked for."""
    points = []
    for i in range(side * side):
        x, y = i % side, i // side
        house = 20 < x < 32 and 20 < y < 30
        z = 300 + 6 * math.exp(-((x - 30) ** 2 + (y - 30) ** 2) / 300) + 5 * house
        color = (45000, 20000, 15000) if house else (18000 + 300 * (i % 17), 30000, 12000)
        points.append((500000 + x, 4000000 + y, z / 0.3048 if feet_high else z, 6 if house else 2, color))
    return las(points, feet_high)


def crc32c(page):
    crc = 0xFFFFFFFF
    for byte in page:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def e57(points, place):
    """One scan of float x, y, z and intensity, in the frame of a scanner at `place` (ASTM E2807)."""
    names, page, content = ("cartesianX", "cartesianY", "cartesianZ", "intensity"), 1024, 1020

    def physical(at):
        return at // content * page + at % content

    packets = b""
    for first in range(0, len(points), 1000):
        streams = [struct.pack(f"<{len(column)}f", *column) for column in zip(*points[first:first + 1000])]
        body = struct.pack(f"<{len(streams)}H", *map(len, streams)) + b"".join(streams)
        body += bytes(-(6 + len(body)) % 4)
        packets += struct.pack("<BBHH", 1, 0, 6 + len(body) - 1, len(streams)) + body
    section = struct.pack("<B7xQQQ", 1, 32 + len(packets), physical(48 + 32), 0) + packets
    fields = "".join(f'<{name} type="Float" precision="single"/>' for name in names)
    pose = "".join(f'<{axis} type="Float">{value}</{axis}>' for axis, value in zip("xyz", place))
    xml = ('<?xml version="1.0" encoding="UTF-8"?><e57Root type="Structure" xmlns="http://www.astm.org/COMMIT/E57/2010-e57-v1.0">'
           '<formatName type="String">ASTM E57 3D Imaging Data File</formatName><guid type="String">{f}</guid>'
           '<versionMajor type="Integer">1</versionMajor><versionMinor type="Integer">0</versionMinor>'
           '<data3D type="Vector" allowHeterogeneousChildren="1"><vectorChild type="Structure"><guid type="String">{g}</guid>'
           f'<pose type="Structure"><translation type="Structure">{pose}</translation></pose>'
           '<intensityLimits type="Structure"><intensityMinimum type="Float">0</intensityMinimum>'
           '<intensityMaximum type="Float">1</intensityMaximum></intensityLimits>'
           f'<points type="CompressedVector" fileOffset="{physical(48)}" recordCount="{len(points)}">'
           f'<prototype type="Structure">{fields}</prototype><codecs type="Vector" allowHeterogeneousChildren="1"></codecs></points>'
           '</vectorChild></data3D><images2D type="Vector" allowHeterogeneousChildren="1"></images2D></e57Root>').encode()
    logical = bytes(48) + section + xml
    pages = -(-len(logical) // content)
    head = b"ASTM-E57" + struct.pack("<IIQQQQ", 1, 0, pages * page, physical(48 + len(section)), len(xml), page)
    logical = (head + logical[48:]).ljust(pages * content, b"\0")
    return b"".join(part + struct.pack(">I", crc32c(part)) for part in (logical[at:at + content] for at in range(0, len(logical), content)))


def room(place, count=6000):
    """What a scanner at eye height sees of an empty room of 6 x 4 x 2.6 m, as rays over the whole sphere."""
    half, points = (3.0, 2.0, 1.3), []
    for i in range(count):
        z, turn = 1 - (2 * i + 1) / count, 1 + i * math.pi * (3 - math.sqrt(5))
        ray = (math.sqrt(1 - z * z) * math.cos(turn), math.sqrt(1 - z * z) * math.sin(turn), z)
        t = min((math.copysign(half[axis], ray[axis]) - place[axis]) / ray[axis] for axis in range(3))
        points.append((*(t * value for value in ray), 0.5 + 0.4 * math.sin(6 * turn)))
    return e57(points, place)


def make_inputs(folder):
    for name, height in (("bunny", 1.2), ("dragon", 0.8), ("floor", 0.1), ("vase", 1.5)):
        (folder / f"{name}.ply").write_text(mesh_ply(100, height))
    (folder / "survey.laz").write_bytes(survey())  # a reader takes it for what it is, whatever its name says
    (folder / "feet.laz").write_bytes(survey(feet_high=True))
    (folder / "rooms").mkdir()
    for name, place in (("hall", (-0.8, 0.3, 0.2)), ("kitchen", (1.0, -0.4, 0.2))):
        (folder / "rooms" / f"{name}.e57").write_bytes(room(place))
    scan = room((-0.8, 0.3, 0.2))
    (folder / "room.e57").write_bytes(scan)
    (folder / "cut.e57").write_bytes(scan[:len(scan) // 2])
    (folder / "points.txt").write_text("".join(["Rechtswert;Hochwert;Lage;Intensität\n"] + [
        f"{500000 + i % 40}.5;{4000000 + i // 40}.5;{300 + math.sin(i % 40 / 9):.3f};{i % 200}\n".replace(".", ",") for i in range(1600)]), encoding="utf-8")
    (folder / "sky.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + bytes([128, 128, 128, 129]) * (16 * 8))
    keys = ",".join(f'{{"eye": [{x}, 1, 4], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 30}}' for x in range(3))
    (folder / "fly.json").write_text(f'{{"keys": [{keys}]}}')
