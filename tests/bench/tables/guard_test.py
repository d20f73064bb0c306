"""guard_test.py: the guard names figures that got worse, and passes equal ones and those whose change is less than their noise."""

import unittest

from guard_table import compare, report


def table(figures, machine="one"):
    return {"commit": "1234567", "device": {"name": "a CPU"}, "machine": machine, "parts": {"models": {"bunny": figures}}}


def words(before, after, machine="one"):
    """Of each figure that is compared, what is said of it."""
    changes = compare(table(before), table(after, machine))
    return {change.figure: "worse" if change.worse else "better" if change.better else "" for change in changes}


class Guard(unittest.TestCase):
    def test_equal_figures_pass(self):
        figures = {"wrong": 100.0, "pixels": 1e6, "normals p95": 1.0, "CPU s": 2.0, "depth p50": 0.0}
        self.assertEqual(set(words(figures, figures).values()), {""})

    def test_a_worse_figure_is_named(self):
        before, after = table({"normals p95": 1.0, "depth p50": 10.0}), table({"normals p95": 1.2, "depth p50": 10.0})
        changes = compare(before, after)
        self.assertEqual([change.figure for change in changes if change.worse], ["normals p95"])
        text = report(before, after, changes)
        self.assertIn("worse: models, bunny: normals p95 1 -> 1.2", text)
        self.assertNotIn("depth", text)

    def test_a_better_figure_is_no_worse(self):
        self.assertEqual(words({"normals p95": 1.2}, {"normals p95": 1.0}), {"normals p95": "better"})

    def test_counts_scatter_by_how_many_there_are(self):
        self.assertEqual(words({"wrong": 100.0, "pixels": 1e6}, {"wrong": 130.0, "pixels": 1e6})["wrong"], "")
        self.assertEqual(words({"wrong": 100.0, "pixels": 1e6}, {"wrong": 150.0, "pixels": 1e6})["wrong"], "worse")
        self.assertEqual(words({"wrong": 100.0, "pixels": 1e8}, {"wrong": 110.0, "pixels": 1e8})["wrong"], "worse")

    def test_one_pixel_more_than_none_is_noise_and_many_are_not(self):
        self.assertEqual(words({"holes": 0.0, "pixels": 1e6}, {"holes": 1.0, "pixels": 1e6})["holes"], "")
        self.assertEqual(words({"holes": 0.0, "pixels": 1e6}, {"holes": 20.0, "pixels": 1e6})["holes"], "worse")

    def test_a_figure_that_is_no_number_any_more_is_worse(self):
        self.assertEqual(words({"normals p95": 1.0}, {"normals p95": float("nan")}), {"normals p95": "worse"})

    def test_seconds_of_other_machines_are_not_compared(self):
        self.assertEqual(words({"CPU s": 1.0}, {"CPU s": 2.0}), {"CPU s": "worse"})
        self.assertEqual(words({"CPU s": 1.0}, {"CPU s": 2.0}, machine="another"), {})

    def test_a_scan_that_is_no_longer_read_is_named(self):
        self.assertEqual(words({"failed": 0.0}, {"failed": 1.0}), {"failed": "worse"})

    def test_a_tile_that_looks_different_is_named_whatever_the_last_table_said(self):
        self.assertEqual(words({"tile differs": 1.0}, {"tile differs": 0.2}), {"tile differs": "worse"})
        self.assertEqual(words({}, {"tile differs": 0.01}), {"tile differs": ""})

    def test_cases_that_one_table_lacks_are_said(self):
        before, after = table({"wrong": 1.0}), table({"wrong": 1.0})
        before["parts"]["models"]["dragon"] = {"wrong": 1.0}
        self.assertIn("not measured: models, dragon", report(before, after, compare(before, after)))
        self.assertNotIn("not measured", report(before, after, compare(before, after), only="bunny"))


if __name__ == "__main__":
    unittest.main()
