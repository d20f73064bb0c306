"""make_stub.py CORE OUTPUT: writes _fields.pyi, the types of all fields, from the module built at CORE; nothing needs to be installed."""

import importlib.util
import pathlib
import sys
import types

core, output = sys.argv[1:]
package = types.ModuleType("splatray")
package.__path__ = [str(pathlib.Path(__file__).parent / "splatray")]
sys.modules["splatray"] = package
spec = importlib.util.spec_from_file_location("splatray._core", core)
package._core = sys.modules["splatray._core"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(package._core)
table = importlib.import_module("splatray._table")
pathlib.Path(output).write_text(table.stub())
