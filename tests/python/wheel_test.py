"""wheel_test.py SOURCE WORK RENDER: builds the wheel of the system's Python in WORK, checks what is in it, installs it where nothing else is and
runs the tests beside this file there, some beside the program RENDER. With SPLATRAY_TEST_ALL set (tests/run --all) those of all Pythons on PATH, and Debian's package.
Exit 77 with a sentence where tools are missing."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

SOURCE, WORK, RENDER = map(pathlib.Path, sys.argv[1:4])
sys.path += [str(SOURCE / "tests/install"), str(SOURCE / "app/python")]
from install_test import run  # noqa: E402  (lies in a folder just named)
from make_wheels import WHEELS, build_requirements, interpreters  # noqa: E402
from packages_test import check_with_lintian  # noqa: E402

BUILD = WORK / "wheels/build"  # of make_wheels.py, and of Debian's package before
MOST_BYTES = 15 << 20
MISSING = 77
ALL = "SPLATRAY_TEST_ALL" in os.environ
FLAGS = {"CMAKE_COMPILE_WARNING_AS_ERROR": "ON", "CMAKE_CXX_FLAGS_RELEASE": "-O1 -DNDEBUG"}  # optimised, whatever this build is
PACKAGED = ["splatray/__init__.py", "splatray/_core.pyi", "splatray/_fields.pyi", "splatray/py.typed"]
METADATA = {"Name": "splatray", "License-Expression": "MIT", "License-File": "LICENSE", "Author": "The splatray authors", "Requires-Python": ">=3.10",
            "Requires-Dist": "numpy>=1.23", "Description-Content-Type": "text/markdown"}


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(MISSING)


def make_tools():
    """A virtual environment with what the module's build needs, of the versions that pyproject.toml pins, and what checks a wheel."""
    packages = build_requirements()
    made = subprocess.run([sys.executable, "-m", "venv", WORK / "tools"], capture_output=True)
    if made.returncode != 0:
        skip("Python has no venv (Debian's package python3-venv)")
    tools = WORK / "tools/bin"
    got = subprocess.run([tools / "pip", "install", "-q", *packages, "twine", "numpy", "mypy==1.18.2"], capture_output=True, text=True)
    if got.returncode != 0:
        skip(f"pip cannot get {', '.join(packages)}: {got.stderr[-300:]}")
    if not any(interpreters(names)[0] for names in WHEELS.values()):
        skip("Python.h is missing (Debian's package python3-dev)")
    return tools


def make_package(tools):
    """Debian's package of the module and the folder of the library that it is built for, None where dpkg's tools are missing."""
    if shutil.which("dpkg-shlibdeps") is None:
        print("skipped: Debian's package is not built, dpkg-shlibdeps is missing (Debian's package dpkg-dev)")
        return None
    (BUILD / "CMakeCache.txt").unlink(missing_ok=True)  # the last wheel's
    nanobind = run(tools / "python", "-m", "nanobind", "--cmake_dir").strip()
    run("cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSPLATRAY_PYTHON=ON", f"-Dnanobind_DIR={nanobind}",
        f"-DPython_EXECUTABLE={tools / 'python'}", *(f"-D{name}={value}" for name, value in FLAGS.items()))
    run("cmake", "--build", BUILD)
    for old in BUILD.glob("*.deb"):
        old.unlink()
    run("cpack", "-G", "DEB", cwd=BUILD)
    return next(BUILD.glob("python3-splatray_*.deb")), BUILD / "bin"


def make_wheels():
    out = WORK / "wheels"
    for old in out.glob("*.whl"):
        old.unlink()
    settings = [f"--config-settings=cmake.define.{name}={value}" for name, value in FLAGS.items()]
    print(run(sys.executable, SOURCE / "app/python/make_wheels.py", out, *settings))
    return sorted(out.glob("*.whl"))


def check_names(what, names, expected, unwanted):
    for name in expected:
        if name not in names:
            sys.exit(f"{what}: found no {name}")
    for part in unwanted:
        if any(part in name for name in names):
            sys.exit(f"{what}: found {part} in it, expected it to stay outside")


def check_wheel(wheel, tools):
    size = wheel.stat().st_size
    if size > MOST_BYTES:
        sys.exit(f"{wheel.name}: found {size} bytes, expected at most {MOST_BYTES}")
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        info = next(name for name in names if name.endswith(".dist-info/METADATA"))
        fields = files.read(info).decode().split("\n\n")[0].split("\n")
    core = "splatray/_core.abi3.so" if "-abi3-" in wheel.name else f"splatray/_core.cpython-{wheel.name.split('-cp')[1][:3]}-x86_64-linux-gnu.so"
    licence = info.replace("METADATA", "licenses/LICENSE")
    check_names(wheel.name, names, [*PACKAGED, core, licence], ["libvulkan", "vtk", "OpenImageIO", "libLLVM"])
    for name, value in METADATA.items():
        if f"{name}: {value}" not in fields:
            sys.exit(f"{wheel.name}: found no '{name}: {value}' in its metadata, expected it")
    run(tools / "twine", "check", "--strict", wheel)
    print(f"{wheel.name}: {size / 1e6:.2f} MB")


def run_cases(python, pattern, folder, **changes):
    """Runs tests beside this file; nothing of the sources or the sanitizers of this build is in the way."""
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "ASAN_OPTIONS", "LD_PRELOAD")}
    environment |= {"SPLATRAY_RENDER": str(RENDER)} | changes
    print(run(python, "-m", "unittest", "discover", "-s", SOURCE / "tests/python", "-p", pattern, "-v", cwd=folder, env=environment))


def check_types(tools, python):
    """A type checker passes and refuses what it should of the module that `python` has installed."""
    page = pathlib.Path(__file__).parent / "typed_use.py"
    shown = subprocess.run([tools / "mypy", "--strict", "--python-executable", python, "--cache-dir", os.devnull, page], capture_output=True, text=True).stdout
    found = {int(line) for line in re.findall(r"typed_use\.py:(\d+): error", shown)}
    expected = {i for i, line in enumerate(page.read_text().split("\n"), 1) if line.endswith("# refused")}
    if found != expected:
        sys.exit(f"{page.name}: found errors in the lines {sorted(found)}, expected {sorted(expected)}:\n{shown}")


def use_wheel(wheel, python, tools):
    with tempfile.TemporaryDirectory() as fresh:
        run(python, "-m", "venv", fresh)
        run(pathlib.Path(fresh) / "bin/pip", "install", "-q", wheel)
        print(f"{wheel.name} in {python}")
        run_cases(pathlib.Path(fresh) / "bin/python", "*_case.py", fresh)
        check_types(tools, pathlib.Path(fresh) / "bin/python")


def use_package(package, library, tools):
    """What Debian's package holds works as unpacked, with the library of its build in place of libsplatray's package."""
    depends = run("dpkg-deb", "-f", package, "Depends")
    minor = sys.version_info.minor
    for expected in ("libsplatray0.1 (= 0.1.0)", f"python3 (>= 3.{minor})", f"python3 (<< 3.{minor + 1})", "python3-numpy"):
        if expected not in depends:
            sys.exit(f"{package.name}: found that it depends on {depends.strip()}, expected {expected} among them")
    with tempfile.TemporaryDirectory() as root:
        run("dpkg-deb", "-x", package, root)
        modules = pathlib.Path(root) / "usr/lib/python3/dist-packages"
        names = [str(path.relative_to(modules)) for path in modules.rglob("*")]
        check_names(package.name, names, PACKAGED, ["libsplatray", "__pycache__"])
        places = {"PYTHONPATH": modules, "LD_LIBRARY_PATH": library}
        found = run(tools / "python", "-c", "import splatray; print(splatray.__file__)", cwd=root, env=os.environ | places).strip()
        if not found.startswith(root):
            sys.exit(f"{package.name}: found splatray in {found}, expected what was unpacked in {root}")
        run_cases(tools / "python", "rays_case.py", root, **places)


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    if not ALL:
        os.environ["PATH"] = "/usr/local/bin:/usr/bin:/bin"
    tools = make_tools()
    if ALL and (made := make_package(tools)) is not None:
        check_with_lintian([made[0]])
        use_package(*made, tools)
    for wheel in make_wheels():
        check_wheel(wheel, tools)
        versions = next(names for names in WHEELS.values() if names[0].replace("python3.", "cp3") in wheel.name)
        for python in interpreters(versions)[0]:
            use_wheel(wheel, python, tools)


if __name__ == "__main__":
    main()
