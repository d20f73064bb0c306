"""What the guard measures: each part yields cases by name, each with its figures, of all of which less is better."""

import csv
import json
import math
import os
import pathlib
import random
import statistics
import struct
import subprocess
import zipfile

QUICK_MODELS = ("bunny", "dragon", "fandisk", "gears", "igea", "turbine_blade")
MESH_POINTS = 1000000
# Into the interiors: eye, target, up.
INSIDE = {"sibenik": [((8, 1.7, 0), (19, 1.7, 1), (0, 1, 0)), ((8, 1.7, 0), (2, 4, 0), (0, 1, 0)), ((19, 1.7, 1), (10, 5, -2), (0, 1, 0))],
          "ice_cave": [((0, -0.5, 8), (0, -0.5, 0), (0, -1, 0)), ((0, -0.5, 8), (5, -0.5, 8), (0, -1, 0)), ((0, -0.5, 8), (0, -1, 15), (0, -1, 0))]}
# Where a ring scanner saw the cave: its rings are from 25 degrees below to 15 above.
RINGS = [((0, -0.5, 8), (0, 0.4, -2), (0, -1, 0)), ((0, -0.5, 8), (10, 0.4, 8), (0, -1, 0)), ((0, -0.5, 8), (0, 0.4, 18), (0, -1, 0))]
RINGS_FOV, INSIDE_FOV = 36, 75  # degrees
ROOM = [((-0.3, 0.2, 1.6), (4.0, 1.0, 1.2), (0, 0, 1)), ((-0.3, 0.2, 1.6), (-4.0, -2.0, 1.0), (0, 0, 1))]
THICKNESSES = (10, 20, 50, 100, 200)  # mm
WALL_PLACES = 40  # where its thickness is measured
COST_RUNS = 3
ROOMS = pathlib.Path(__file__).parents[2] / "light/mitsuba/rooms.json"
LIGHT_POINTS = 60000


class Programs:
    """The programs that are measured, and what measures them."""

    def __init__(self, programs, tool, work, data, quick, only, sheet, last_sheet):
        self.bin, self.tool, self.work, self.data, self.quick, self.only = programs, tool, work, data, quick, only
        self.sheet, self.last_sheet = sheet, last_sheet

    def wanted(self, name):
        return self.only in name

    def run(self, program, *words):
        """Runs a program to its end: its exit code, CPU seconds and most megabytes."""
        with open(self.work / "errors.txt", "w") as errors:
            process = subprocess.Popen([str(self.bin / program), *map(str, words)], stdout=subprocess.DEVNULL, stderr=errors)
            _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0

    def must(self, program, *words):
        result = self.run(program, *words)
        if result[0] != 0:
            raise SystemExit(f"guard: error: {program} {' '.join(map(str, words))}: {(self.work / 'errors.txt').read_text().strip()}")
        return result

    def make(self, *words):
        subprocess.run([self.tool, *map(str, words)], check=True)

    def measure(self, *words):
        found = json.loads(subprocess.run([self.tool, *map(str, words)], check=True, capture_output=True, text=True).stdout)
        return {name: math.nan if value is None else value for name, value in found.items()} if isinstance(found, dict) else found

    def build(self, source, *options):
        self.must("splatray-preprocess", source, "-o", self.work / "scene.soct", *options)
        return self.work / "scene.soct"

    def render(self, scene, picture, camera, size, *options):
        self.must("splatray-render", scene, "-o", picture, "--camera", camera, "--resolution", f"{size}x{size}", "--device", "cpu", "--quiet", *options)
        return picture

    def pictures(self, mesh, scene, cameras):
        """Measures pictures of a scene beside the mesh."""
        given = []
        for number, camera in enumerate(cameras):
            given += [camera, self.render(scene, self.work / f"picture{number}.exr", camera, 512, "--look", "paper", "--aov", "depth,normal")]
        return self.measure("picture", mesh, *given)

    def cameras(self, name, views, fov=INSIDE_FOV):
        """Files of cameras by eye, target and up."""
        files = []
        for number, (eye, target, up) in enumerate(views):
            files.append(self.work / f"camera_{name}_{number}.json")
            files[-1].write_text(json.dumps({"eye": eye, "target": target, "up": up, "fov_y_deg": fov}))
        return files

    def points(self, scan, truth):
        """Measures what is drawn of a scan beside what is true of its points."""
        self.must("splatray-preprocess", scan, "-o", self.work / "drawn.ply")
        figures = self.measure("points", scan, truth, self.work / "drawn.ply")
        return {f"points' {name}" if name.startswith("normals") else name: value for name, value in figures.items()}


def outside_views(folder):
    return [folder / "front.json", folder / "back.json", folder / "oblique.json"]


def models(programs):
    """Models of the folder of data: their vertices with and without normals, and sampled from the mesh."""
    for mesh in sorted((programs.data or pathlib.Path("/nonexistent")).glob("models/*.ply")):
        name = mesh.stem
        if programs.quick and name not in QUICK_MODELS or not programs.wanted(name):
            continue
        folder = programs.work / "models" / name
        if not (folder / "oblique.json").exists():
            programs.make("model", mesh, folder)
        views = programs.cameras(name, INSIDE[name]) if name in INSIDE else outside_views(folder)
        yield f"{name}, mesh", programs.pictures(mesh, programs.build(mesh, "--mesh-points", MESH_POINTS), views)
        yield f"{name}, vertices", programs.pictures(mesh, programs.build(folder / "bare.ply"), views)
        if not programs.quick:
            yield f"{name}, vertices with normals", programs.pictures(mesh, programs.build(folder / "normals.ply"), views)


def raw_scans(programs):
    """Raw scans joined, with and without normals, beside the mesh that was scanned."""
    sources = {"body": "body"}
    if programs.data:
        sources["bunny"] = programs.data / "models/bunny.ply"
        dragon, folder = programs.data / "models/dragon.ply", programs.work / "models/dragon"
        if not (folder / "oblique.json").exists():
            programs.make("model", dragon, folder)
        merged = programs.data / "scans/dragon_stand_merged.ply"
        bare = programs.work / "dragon_raw.ply"
        if not bare.exists():
            programs.make("bare", merged, bare)
        for name, source in (("normals", merged), ("bare", bare)):
            if programs.wanted(f"dragon raw, {name}"):
                yield f"dragon raw, {name}", programs.pictures(dragon, programs.build(source), outside_views(folder))
    for name, mesh in sources.items():
        folder = programs.work / "raw" / name
        if not (folder / "mesh.obj").exists():
            programs.make("raw", mesh, folder)
        for kind in ("normals", "bare"):
            if programs.wanted(f"{name} raw, {kind}"):
                yield f"{name} raw, {kind}", programs.pictures(folder / "mesh.obj", programs.build(folder / f"{kind}.ply"), outside_views(folder))


def simulated(programs):
    """Scans of scanners that were simulated: pictures and points."""
    folder = programs.work / "room"
    if not (folder / "room/normal.npy").exists():
        programs.make("room", folder)
    cases = [("room, stations", folder / "room.ptx", folder / "room", folder / "room.obj", ROOM, INSIDE_FOV),
             ("room, bare", folder / "room_bare.ply", folder / "room", folder / "room.obj", ROOM, INSIDE_FOV)]
    if programs.data:
        for name, file, mesh, views, fov in (("church", "sim_sibenik_tls.e57", "sibenik", INSIDE["sibenik"], INSIDE_FOV),
                                             ("cave rings", "sim_rings.ply", "ice_cave", RINGS, RINGS_FOV)):
            scan, truth = programs.data / "scans" / file, programs.work / "truth" / mesh
            if not truth.exists():
                zipfile.ZipFile(scan.with_name(scan.stem + ".truth.npz")).extractall(truth)
            cases.append((name, scan, truth, programs.data / f"models/{mesh}.ply", views, fov))
        room, truth = programs.data / "scans/vaulted_room.laz", programs.work / "truth/vaulted_room"
        if not truth.exists():
            programs.make("colours", room, truth)
        if programs.wanted("vaulted room"):
            yield "vaulted room", programs.points(room, truth)
    for name, scan, truth, mesh, views, fov in cases:
        if not programs.wanted(name):
            continue
        cameras = programs.cameras(name.replace(", ", "_"), views, fov)
        yield name, {**programs.pictures(mesh, programs.build(scan), cameras), **programs.points(scan, truth)}


def distances(programs, scene, pairs):
    """Distance and half of its interval of each pair of rays; of those that meet nothing there are none."""
    table = programs.work / "wall.csv"
    table.unlink(missing_ok=True)
    code, _, _ = programs.run("splatray-measure", scene, *[word for pair in pairs for word in ("--distance", pair)], "-o", table)
    if code != 0:
        return [found for pair in pairs for found in distances(programs, scene, [pair])] if len(pairs) > 1 else []
    with open(table) as file:
        return [(float(row["value"]), float(row["within_95"])) for row in csv.DictReader(file) if row["quantity"] == "distance"]


def thickness_figures(programs, scene, millimetres):
    """How far thicknesses are off, by rays from both sides at places of the wall, how often their intervals miss the truth, and how
    wide these are."""
    draw = random.Random(1)
    places = [(draw.uniform(-1.2, 1.2), draw.uniform(0.3, 1.8)) for _ in range(WALL_PLACES)]
    found = distances(programs, scene, [f"{x:.4f},-2,{z:.4f}>0,1,0;{x:.4f},2,{z:.4f}>0,-1,0" for x, z in places])
    off = [1000.0 * value - millimetres for value, _ in found]
    missed = WALL_PLACES - sum(abs(error) <= 1000.0 * half for error, (_, half) in zip(off, found))
    if not found:
        return {"thickness off, mm": math.nan, "outside, %": 100.0, "within, mm": math.nan}
    return {"thickness off, mm": abs(statistics.median(off)), "outside, %": 100.0 * missed / WALL_PLACES,
            "within, mm": 1000.0 * statistics.median(half for _, half in found)}


def walls(programs):
    """Walls of several thicknesses, from one side and from both."""
    folder = programs.work / "walls"
    if not (folder / "wall_200_2/normal.npy").exists():
        programs.make("walls", folder)
    views = [((0.0, -4.0, 1.5), (0.0, 0.0, 1.0), (0, 0, 1)), ((0.0, 4.0, 1.5), (0.0, 0.0, 1.0), (0, 0, 1))]
    for thickness in THICKNESSES:
        for stations in (1, 2):
            name = f"{thickness} mm, {stations} station{'s' if stations > 1 else ''}"
            if not programs.wanted(name):
                continue
            file = folder / f"wall_{thickness}_{stations}"
            figures = programs.points(file.with_suffix(".ptx"), file)
            scene = programs.build(file.with_suffix(".ptx"))
            figures.update(programs.pictures(folder / f"wall_{thickness}.obj", scene, programs.cameras("wall", views[:stations], fov=45)))
            if stations > 1:
                figures.update(thickness_figures(programs, scene, thickness))
            yield name, figures


def las_box(path):
    with open(path, "rb") as file:
        file.seek(179)
        values = struct.unpack("<6d", file.read(48))
    return values[1::2], values[0::2]


def forest(programs):
    """A forest from the air and its thinned copies: how much light and cover they lose or gain, percent of the whole one's."""
    if not programs.data:
        return
    folder = programs.work / "forest"
    if not (folder / "10.las").exists():
        programs.make("thinned", programs.data / "scans/classified_drone.laz", folder)
    low, high = las_box(folder / "1.las")
    middle = [0.5 * (a + b) for a, b in zip(low, high)]
    size = math.dist(low, high)
    eye = [middle[0] - 0.4 * size, middle[1] - 0.7 * size, middle[2] + 0.6 * size]
    camera = programs.cameras("forest", [(eye, middle, (0, 0, 1))], fov=40)[0]
    whole = None
    for part in (1, 2, 5, 10):
        scene = programs.build(folder / f"{part}.las")
        picture = programs.render(scene, programs.work / "forest.exr", camera, 384, "--look", "scan", "--samples", 8, "--keep-noise")
        found = programs.measure("light", picture)
        whole = whole or found
        if part > 1:
            yield f"1/{part} of the points", {f"{name} off, %": 100.0 * abs(found[name] / whole[name] - 1.0) for name in ("light", "cover")}


def light(programs):
    """Rooms in path tracing beside Mitsuba's stored means of their pictures' parts (noise.py --store, there)."""
    kept = json.loads(ROOMS.read_text())
    folder = programs.work / "light"
    folder.mkdir(exist_ok=True)
    for name, room in kept["scenes"].items():
        if not programs.wanted(name):
            continue
        (folder / "room.gltf").write_text(json.dumps(room["gltf"]))
        scene = programs.build(folder / "room.gltf", "--mesh-points", LIGHT_POINTS)
        picture = folder / "room.exr"
        programs.must("splatray-render", scene, "-o", picture, *room["options"], "--resolution", "100x100", "--samples", 64, "--device", "cpu")
        means = programs.measure("parts", picture, len(room["means"]))
        off = sorted(100.0 * abs(ours / theirs - 1.0) for rows in zip(means, room["means"]) for ours, theirs in zip(*rows) if theirs > 0.0)
        total, wanted = (sum(map(sum, rows)) for rows in (means, room["means"]))
        yield name, {"light off, %": 100.0 * abs(total / wanted - 1.0), "parts off p50, %": off[len(off) // 2], "parts off p90, %": off[len(off) * 9 // 10]}


def cost(programs):
    """CPU seconds (the least of COST_RUNS), memory and bytes of building scans."""
    for name in ("vaulted_room", "north_carolina") if programs.data else ():
        if not programs.wanted(name):
            continue
        scene, stats = programs.work / "scene.soct", programs.work / "stats.json"
        runs = [programs.must("splatray-preprocess", programs.data / f"scans/{name}.laz", "-o", scene, "--stats-json", stats)
                for _ in range(1 if programs.quick else COST_RUNS)]
        splats = json.loads(stats.read_text())["splats"]
        yield name, {"CPU s": min(run[1] for run in runs), "peak MB": min(run[2] for run in runs), "bytes a point": scene.stat().st_size / splats}


def sheet(programs):
    """All scans of the folder of data with no option, side by side; tiles are compared with those of the last sheet, if there is one."""
    if not programs.data:
        return
    tiles, names = [], []
    folder = programs.work / "tiles"
    folder.mkdir(exist_ok=True)
    for scan in sorted((programs.data / "scans").iterdir()):
        if scan.suffix == ".npz" or scan.name == "dragon_stand_posed.csv":
            continue
        tile = folder / f"{scan.name}.png"
        tile.unlink(missing_ok=True)
        code, _, _ = programs.run("splatray-render", scan, "-o", tile, "--resolution", "160x120", "--samples", 4, "--device", "cpu", "--quiet")
        if code != 0:
            yield scan.name, {"failed": 1.0}
            continue
        tiles.append(tile)
        names.append(scan.name)
    for name, off in zip(names, programs.measure("sheet", programs.last_sheet, programs.sheet, *tiles)):
        yield name, {"failed": 0.0} | ({"tile differs": off} if programs.last_sheet.exists() else {})


PARTS = {"models": models, "raw": raw_scans, "simulated": simulated, "walls": walls, "forest": forest, "light": light, "cost": cost, "sheet": sheet}
