"""make_town.py POINTS -o FILE.copc.laz: a town on hills as an airborne scan, as COPC by copclib (PyPI): houses with gables, streets, gardens,
trees. Made tile by tile, so that memory does not grow with it; the same bytes for the same count. 20 points a square metre; coordinates in
metres, ground of about 0 to 60. It prints a camera's places as JSON: above the town, and standing in a street."""

import argparse
import json
import math
import pathlib

import copclib
import numpy

DENSITY = 20.0  # points a square metre of ground
LEAF_POINTS = 50_000
SCALE = 0.001
LOT_M, BLOCK_LOTS, STREET_M = 24.0, 4, 9.0
BLOCK_M = BLOCK_LOTS * LOT_M + STREET_M
GROUND, VEGETATION, BUILDING, ROAD = 2, 5, 6, 11
RECORD = numpy.dtype([("xyz", "<i4", 3), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"), ("class", "u1"), ("user", "u1"),
                      ("angle", "<i2"), ("source", "<u2"), ("time", "<f8"), ("rgb", "<u2", 3)])


def mixed(*numbers):
    """Numbers in [0, 1) that whole numbers choose (a hash by multiplications and shifts)."""
    state = numpy.uint64(0x9E3779B97F4A7C15)
    for number in numbers:
        state = (state ^ numpy.asarray(number).astype(numpy.int64).astype(numpy.uint64)) * numpy.uint64(0xBF58476D1CE4E5B9)
        state = state ^ (state >> numpy.uint64(31))
    return (state >> numpy.uint64(11)).astype(numpy.float64) / float(1 << 53)


def ground_m(x, y):
    """Hills of some hundred metres' length."""
    return 30.0 + 18.0 * numpy.sin(x / 410.0) * numpy.cos(y / 530.0) + 9.0 * numpy.sin((x + 1.7 * y) / 233.0) + 1.5 * numpy.sin(x / 41.0 + y / 57.0)


class Lots:
    """The lot of each place, and the house on it."""

    def __init__(self, x, y):
        block_x, block_y = numpy.floor(x / BLOCK_M), numpy.floor(y / BLOCK_M)
        in_x, in_y = x - block_x * BLOCK_M, y - block_y * BLOCK_M
        self.is_street = (in_x > BLOCK_LOTS * LOT_M) | (in_y > BLOCK_LOTS * LOT_M)
        lot_x, lot_y = numpy.floor(in_x / LOT_M), numpy.floor(in_y / LOT_M)
        self.key = (block_x * 8 + lot_x, block_y * 8 + lot_y)
        self.u, self.v = in_x - (lot_x + 0.5) * LOT_M, in_y - (lot_y + 0.5) * LOT_M  # from the lot's middle
        self.middle = ground_m(x - self.u, y - self.v)
        pick = lambda which: mixed(*self.key, which)
        self.has_house = (pick(1) < 0.82) & ~self.is_street
        self.half_u, self.half_v = 4.5 + 3.5 * pick(2), 4.0 + 3.0 * pick(3)
        self.eaves_m = 3.2 + 2.9 * numpy.floor(3.0 * pick(4) ** 2)
        self.pitch = 0.55 + 0.4 * pick(5)
        self.turned = pick(6) < 0.5
        self.tint = pick(7)

    def roof_m(self, u, v):
        """Height of the roof over the lot's ground."""
        across, half = numpy.where(self.turned, u, v), numpy.where(self.turned, self.half_u, self.half_v)
        return self.eaves_m + self.pitch * (half - numpy.abs(across))

    def in_house(self):
        return self.has_house & (numpy.abs(self.u) < self.half_u) & (numpy.abs(self.v) < self.half_v)


def roof_colors(lots):
    red, grey, dark = numpy.array([166, 84, 58]), numpy.array([142, 138, 134]), numpy.array([96, 72, 62])
    kind = lots.tint[:, None]
    return numpy.where(kind < 0.62, red, numpy.where(kind < 0.82, dark, grey)) * (0.85 + 0.3 * mixed(*lots.key, 8))[:, None]


def lots_near(random, low, edge_m, per_place):
    """Lots by random places of a tile, and of what is around it, as lots lie across its edges; `per_place`: of points of ground."""
    wide_m = edge_m + 2.0 * LOT_M
    count = int(per_place * DENSITY * wide_m * wide_m)
    return count, Lots(low[0] - LOT_M + wide_m * random.random(count), low[1] - LOT_M + wide_m * random.random(count))


def from_above(random, low, edge_m):
    """Ground, streets and roofs: one point for each place of the plan."""
    count = int(DENSITY * edge_m * edge_m)
    x, y = low[0] + edge_m * random.random(count), low[1] + edge_m * random.random(count)
    lots = Lots(x, y)
    house = lots.in_house()
    z = numpy.where(house, lots.middle + lots.roof_m(lots.u, lots.v), ground_m(x, y))
    patches = 0.5 + 0.5 * numpy.sin(x / 3.1) * numpy.sin(y / 2.7)
    color = numpy.array([92, 116, 62]) + patches[:, None] * numpy.array([26, 18, 10])
    color[lots.is_street] = [118, 116, 114]
    color[house] = roof_colors(lots)[house]
    kind = numpy.where(house, BUILDING, numpy.where(lots.is_street, ROAD, GROUND))
    return x, y, z, color, kind


def walls(random, low, edge_m):
    """Points on houses' walls, with windows: three times as dense as the ground, as from a scanner in the street."""
    count, lots = lots_near(random, low, edge_m, 2.0)
    # The place in the lot chooses the place on the walls.
    around, up = (lots.u / LOT_M + 0.5) * 4.0, lots.v / LOT_M + 0.5
    side, along = numpy.floor(around), 2.0 * (around % 1.0) - 1.0
    u = numpy.where(side == 0, lots.half_u, numpy.where(side == 1, -lots.half_u, along * lots.half_u))
    v = numpy.where(side == 2, lots.half_v, numpy.where(side == 3, -lots.half_v, along * lots.half_v))
    top = lots.roof_m(u, v)
    z = lots.middle - 0.4 + up * 12.0
    kept = lots.has_house & (z < lots.middle + top)
    x, y = (lots.key[0] // 8) * BLOCK_M + (lots.key[0] % 8 + 0.5) * LOT_M + u, (lots.key[1] // 8) * BLOCK_M + (lots.key[1] % 8 + 0.5) * LOT_M + v
    plaster = numpy.array([222, 212, 190]) - lots.tint[:, None] * numpy.array([30, 44, 60])
    story, place = ((z - lots.middle) % 2.9), (along * numpy.where(side < 2, lots.half_v, lots.half_u)) % 2.6
    is_window = (story > 0.9) & (story < 2.2) & (place > 0.7) & (place < 1.8)
    plaster[is_window] = [58, 66, 76]
    return tuple(a[kept] for a in (x, y, z, plaster, numpy.full(count, BUILDING)))


def trees(random, low, edge_m):
    """Crowns: leaves near the outside of ellipsoids, two a lot, and along streets."""
    count, lots = lots_near(random, low, edge_m, 1.1)
    corner = numpy.floor(2.0 * random.random(count))
    radius = 1.6 + 2.2 * mixed(*lots.key, corner, 21)
    u, v = numpy.where(corner > 0, 8.9, -8.7), numpy.where(mixed(*lots.key, corner, 22) < 0.5, 8.8, -8.8)
    direction = random.normal(size=(3, count))
    direction /= numpy.linalg.norm(direction, axis=0)
    depth = radius * (1.0 - 0.35 * random.random(count) ** 2)
    height = 2.0 + radius * (1.2 + 0.5 * mixed(*lots.key, corner, 23))
    x = (lots.key[0] // 8) * BLOCK_M + (lots.key[0] % 8 + 0.5) * LOT_M + u + depth * direction[0]
    y = (lots.key[1] // 8) * BLOCK_M + (lots.key[1] % 8 + 0.5) * LOT_M + v + depth * direction[1]
    z = lots.middle + height + 1.3 * depth * direction[2]
    kept = ~lots.is_street & (mixed(*lots.key, corner, 24) < 0.7) & (random.random(count) < radius / 8.0)
    green = numpy.array([58, 84, 40]) + (mixed(*lots.key, corner, 25)[:, None] - 0.3) * numpy.array([60, 40, 16])
    green = green * (0.75 + 0.35 * random.random(count))[:, None]
    return tuple(a[kept] for a in (x, y, z, green, numpy.full(count, VEGETATION)))


def tile_points(random, low, edge_m):
    parts = [make(random, low, edge_m) for make in (from_above, walls, trees)]
    x, y, z, color, kind = (numpy.concatenate(arrays) for arrays in zip(*parts))
    inside = (x >= low[0]) & (x < low[0] + edge_m) & (y >= low[1]) & (y < low[1] + edge_m)
    records = numpy.zeros(int(inside.sum()), RECORD)
    place = numpy.stack([x, y, z], 1)[inside] + 0.015 * random.normal(size=(len(records), 3))
    place[:, :2] = numpy.clip(place[:, :2], low, [low[0] + edge_m - SCALE, low[1] + edge_m - SCALE])
    records["xyz"] = numpy.round(place / SCALE)
    records["rgb"] = numpy.clip(color[inside] + 6.0 * random.normal(size=(len(records), 1)), 0, 255).astype(numpy.uint16) * 257
    records["class"], records["returns"] = kind[inside], 0x11
    return records


class Octree:
    """Nodes of the file: each point has a level, so that each level is an even subset, twice as dense as the one above."""

    def __init__(self, path, levels, edge_m):
        config = copclib.CopcConfigWriter(7, copclib.Vector3(SCALE, SCALE, SCALE), copclib.Vector3(0, 0, 0), "")
        half = 0.5 * edge_m
        info = config.copc_info
        info.center_x, info.center_y, info.center_z, info.halfsize, info.spacing = half, half, half, half, edge_m / 128
        config.las_header.min, config.las_header.max = copclib.Vector3(0, 0, -10), copclib.Vector3(edge_m, edge_m, 90)
        self.writer, self.levels, self.edge_m = copclib.FileWriter(str(path), config), levels, edge_m
        self.coarse, self.points, self.made = {}, 0, set()

    def add(self, random, records, whole_from):
        """Adds points; nodes of the level `whole_from` and below have points of these alone."""
        weights = numpy.cumsum(4.0 ** numpy.arange(self.levels))
        level = numpy.searchsorted(weights / weights[-1], random.random(len(records)), side="right")
        for l in range(self.levels):
            chosen = records[level == l]
            cells = (chosen["xyz"] * (SCALE * 2.0**l / self.edge_m)).astype(numpy.int64)
            number = (cells[:, 0] << 40) | (cells[:, 1] << 20) | cells[:, 2]
            order = numpy.argsort(number, kind="stable")
            starts = numpy.flatnonzero(numpy.diff(number[order], prepend=-1))
            for begin, end in zip(starts, [*starts[1:], len(order)]):
                key, points = (l, *(int(n) for n in cells[order[begin]])), chosen[order[begin:end]]
                if l >= whole_from:
                    self.write(key, points)
                else:
                    self.coarse.setdefault(key, []).append(points)

    def write(self, key, records):
        self.writer.AddNode(copclib.VoxelKey(*key), copclib.VectorChar(numpy.frombuffer(records.tobytes(), numpy.int8)))
        self.points += len(records)
        self.made.add(key)

    def close(self):
        for key, parts in sorted(self.coarse.items()):
            self.write(key, numpy.concatenate(parts))
        # A level may have no point where those below it have some.
        for level, *cell in sorted(self.made, reverse=True):
            parent = (level - 1, *(c // 2 for c in cell))
            while parent[0] >= 0 and parent not in self.made:
                self.write(parent, numpy.zeros(0, RECORD))
                parent = (parent[0] - 1, *(c // 2 for c in parent[1:]))
        self.writer.Close()


def make_town(points, path):
    """Writes the file; returns its count of points and the edge in metres."""
    per_m2 = 2.0 * DENSITY  # with walls and trees
    edge_m = math.sqrt(points / per_m2)
    levels = max(2, round(math.log(0.75 * points / LEAF_POINTS, 4)) + 1)
    whole_from = max(0, levels - 3)
    tiles = 2**whole_from
    octree = Octree(path, levels, edge_m)
    for i in range(tiles):
        for j in range(tiles):
            random = numpy.random.default_rng([i, j])
            octree.add(random, tile_points(random, (i * edge_m / tiles, j * edge_m / tiles), edge_m / tiles), whole_from)
    octree.close()
    return octree.points, edge_m


def places(edge_m):
    """Where cameras stand: above, looking at the town's middle; in the street nearest to the middle, looking along it."""
    middle = 0.5 * edge_m
    street = (math.floor(middle / BLOCK_M) + 1) * BLOCK_M - 0.5 * STREET_M
    eye_z = float(ground_m(street, middle)) + 1.7
    return {"above": {"eye": [middle, middle - 0.75 * edge_m, 0.45 * edge_m], "target": [middle, middle, 30.0]},
            "street": {"eye": [street, middle, eye_z], "target": [street, middle + 60.0, float(ground_m(street, middle + 60.0)) + 4.0]}}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("points", type=int)
    parser.add_argument("-o", type=pathlib.Path, required=True)
    asked = parser.parse_args()
    points, edge_m = make_town(asked.points, asked.o)
    print(json.dumps({"points": points, "edge_m": edge_m, **places(edge_m)}))


if __name__ == "__main__":
    main()
