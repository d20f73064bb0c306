"""The notebook of data/: all its cells run. `python3 notebook_case.py` writes what they show into it."""

import ast
import base64
import contextlib
import io
import json
import pathlib
import unittest

NOTEBOOK = pathlib.Path(__file__).resolve().parents[2] / "data/notebook.ipynb"


def run_cell(source, names):
    """Runs a cell as Jupyter does; returns its outputs in the notebook's format (nbformat 4.5)."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, NOTEBOOK.name, "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), NOTEBOOK.name, "eval"), names)
    outputs = []
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(keepends=True)})
    if value is not None:
        data = {"text/plain": [repr(value)]}
        if hasattr(value, "_repr_png_"):
            data["image/png"] = base64.b64encode(value._repr_png_()).decode()
        outputs.append({"output_type": "display_data", "data": data, "metadata": {}})
    return outputs


def run_notebook():
    """The notebook, with what its cells show now."""
    notebook = json.loads(NOTEBOOK.read_text())
    names = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"] = run_cell("".join(cell["source"]), names)
    return notebook


def kinds_of(notebook):
    """What each cell shows: output types."""
    return [[output["output_type"] for output in cell.get("outputs", [])] for cell in notebook["cells"]]


class Notebook(unittest.TestCase):
    def test_all_cells_run_and_show_what_they_did(self):
        kept = json.loads(NOTEBOOK.read_text())
        shown = run_notebook()
        self.assertEqual(kinds_of(kept), kinds_of(shown))
        self.assertGreaterEqual(sum("image/png" in str(cell.get("outputs")) for cell in shown["cells"]), 2)


if __name__ == "__main__":
    NOTEBOOK.write_text(json.dumps(run_notebook(), indent=1) + "\n")
