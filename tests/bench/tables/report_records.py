"""The records of splatray-bench and splatray-bench peers (record.h), and ways to choose among them."""

import json
import pathlib
from dataclasses import dataclass

OURS = ("window", "paper", "nearest")
PEERS = ("embree window", "embree nearest", "embree flat", "embree user", "embree mesh")
#: Runs along a method's curve: the default, other numbers of splats, and the default with another blending.
ON_CURVE = ("", "splats", "blend")


@dataclass
class Record:
    """One run. `get` reads a key of speed, error or settings; None = not measured."""

    data: dict

    def get(self, key):
        for part in ("speed", "error", "settings"):
            if key in self.data.get(part, {}):
                return self.data[part][key]
        return None

    @property
    def case(self):
        return self.data["case"]

    @property
    def scene(self):
        return self.data["scene"]

    @property
    def is_flat(self):
        """Embree's discs as they are known: without normal fields, blended with a Gaussian."""
        return not self.get("normal_fields") and self.get("kernel") == "gaussian" and not self.is_ours

    @property
    def method(self):
        return "embree flat" if self.is_flat else self.data["method"]

    @property
    def varied(self):
        return "splats" if self.is_flat else self.data["varied"]

    @property
    def device(self):
        return self.data["device"]["name"]

    @property
    def is_ours(self):
        return self.data["method"] in OURS

    @property
    def ms(self):
        """Median time of a frame, milliseconds."""
        return self.get("frame_ms_median")

    @property
    def holes(self):
        """Holes, ppm: value, low and high end of the 95 % interval and number of rays."""
        return self.data.get("error", {}).get("holes_ppm")


class Records:
    """All runs of the files or folders named, in their order."""

    def __init__(self, paths):
        self.all = []
        for path in paths:
            path = pathlib.Path(path)
            for file in sorted(path.glob("*.json")) if path.is_dir() else [path]:
                self.all += [Record(data) for data in json.loads(file.read_text())]
        most = {}
        for record in self.all:
            if not record.is_ours:
                most[record.device] = max(most.get(record.device, 1), record.get("threads"))
        self._all_threads = most

    def uses_all_threads(self, record):
        """False for a peer's run on fewer threads than the machine has."""
        return record.is_ours or record.get("threads") == self._all_threads[record.device]

    def choose(self, **wanted):
        """Runs whose properties or keys equal those wanted; a tuple allows any of its values."""

        def matches(record):
            for key, value in wanted.items():
                own = getattr(record, key) if hasattr(Record, key) else record.get(key)
                if own not in (value if isinstance(value, tuple) else (value,)):
                    return False
            return True

        return [record for record in self.all if matches(record)]

    def unique(self, key, **wanted):
        """Different values of a property, in the order of the files."""
        return list(dict.fromkeys(getattr(record, key) for record in self.choose(**wanted)))

    def devices(self):
        """Names of the devices of our own runs."""
        return list(dict.fromkeys(record.device for record in self.all if record.is_ours))

    def peer_devices(self):
        return list(dict.fromkeys(record.device for record in self.all if not record.is_ours))

    def picture_scenes(self):
        """Scenes whose pictures were compared with a truth, and timed."""
        scenes = [r.scene for r in self.all if r.ms and r.get("normal_p99_deg") is not None]
        return list(dict.fromkeys(scenes))

    def curve(self, scene, method, device):
        """A method's runs with everything but the number of splats at its default, by that number; peers on all
        threads. A mesh's vertices lie on it only where the scene has no other points."""
        runs = [
            record
            for record in self.choose(scene=scene, method=method, device=device, varied=ON_CURVE)
            if record.ms and self.uses_all_threads(record)
        ]
        spread = [record for record in runs if record.get("sampling") != "vertices"]
        return sorted(spread or runs, key=lambda record: record.get("splats"))


def splats_text(count):
    """35k, 1M."""
    return f"{count / 1e6:.3g}M" if count >= 1e6 else f"{count / 1e3:.3g}k"


def front(points):
    """The points (time, error) that no other betters in both, by time."""
    best = []
    for time, error in sorted(points):
        if not best or error < best[-1][1]:
            best.append((time, error))
    return best
