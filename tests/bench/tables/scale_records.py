"""Ways to choose among the records of rays (race.h), and the laws of growth fitted to them."""

import math

#: Peers, as the report names them, in its order.
PEERS = {
    "embree window": "Embree window",
    "embree user 1": "Embree, 1 disc a box",
    "embree user 8": "Embree, 8 discs a box",
    "embree user 32": "Embree, 32 discs a box",
    "embree nearest": "Embree nearest",
}


def sizes_of(records):
    """Numbers of splats of the races, ascending."""
    return sorted({run.get("splats") for run in records.all if run.data.get("rays")})


def cost(run):
    """Median time of the class's rays, ms."""
    return run.get("cost_ms_median")


class Races:
    """Runs of one class of rays, by number of splats."""

    def __init__(self, records, rays):
        self._runs = [run for run in records.all if run.data.get("rays") == rays]

    def own(self, splats, against=None, method="window"):
        """splatray's run in the race against that peer, or in the first; None = not measured."""
        for run in self._runs:
            if run.is_ours and run.get("splats") == splats and run.data["method"] == method:
                if against is None or run.data.get("against") == against:
                    return run
        return None

    def pair(self, splats, peer):
        """The runs of splatray and of the peer in their race, or None."""
        method = "nearest" if peer == "embree nearest" else "window"
        own = self.own(splats, peer, method)
        other = [run for run in self._runs if run.get("splats") == splats and run.data["method"] == peer]
        return (own, other[0]) if own and other else None

    def all(self, splats):
        return [run for run in self._runs if run.get("splats") == splats]

    def curve(self, method):
        """Points (splats, ms) of a method, splatray's or a peer's."""
        points = {}
        for run in self._runs:
            if run.data["method"] == method:
                points.setdefault(run.get("splats"), cost(run))
        return sorted(points.items())


def line_fit(points):
    """Least squares: slope and intercept of y over x; None with fewer than two different x."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    if len(set(xs)) < 2:
        return None
    mean_x, mean_y = sum(xs) / len(xs), sum(ys) / len(ys)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x in xs)
    return slope, mean_y - slope * mean_x


def exponent(points):
    """e of y ~ x^e by least squares of the logarithms, and how far a point is from the law at most, as a factor."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    fit = line_fit(logs)
    if not fit:
        return None
    worst = max(abs(y - fit[0] * x - fit[1]) for x, y in logs)
    return fit[0], math.exp(worst)
