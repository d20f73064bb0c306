"""install_test.py BUILD CONSUMER LIBDIR: installs the library of a build tree, builds CONSUMER against it by find_package and, after the
tree has moved, by pkg-config, and runs both; then the guide's program (app/guide/embed.md). Each finding ends the test with a sentence."""

import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).parents[1] / "structure"))
import page_inputs  # noqa: E402  (lies in the folder just named)

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: found exit code {done.returncode}, expected 0:\n{done.stdout[-4000:]}")
    return done.stdout


def foreign_symbols(listing):
    """Names of a library's symbols (nm -DC) that are not the interface's."""
    names = [line.split(" ", 2)[2] for line in listing.split("\n") if line]
    ours = re.compile(r"(\w[\w:<>, ]* )?((vtable|typeinfo|typeinfo name) for )?splatray::api::")
    return [name for name in names if not ours.match(name) and not name.startswith("SPLATRAY_")]


def check_library(library):
    found = foreign_symbols(run("nm", "-DC", "--defined-only", library))
    if found:
        sys.exit(f"{library.name}: found the symbols {found[:5]}, expected those of splatray.h alone")
    dynamic = run("readelf", "-d", library)
    if not re.search(r"SONAME.*libsplatray\.so\.\d+\.\d+\]", dynamic) or "TEXTREL" in dynamic or "libvulkan" in dynamic:
        sys.exit(f"{library.name}: expected a versioned soname, no text relocations and no libvulkan, found\n{dynamic}")


def check_moveable(prefix, *folders):
    """No file names the folders it was made in."""
    for path in prefix.rglob("*"):
        if path.suffix in (".cmake", ".pc", ".h"):
            for folder in folders:
                if str(folder) in path.read_text():
                    sys.exit(f"{path.name}: found {folder} in it, expected only places relative to itself")


def own_places(folder):
    """The environment with all that a program may write to by itself in `folder`."""
    return os.environ | {"HOME": str(folder), "TMPDIR": str(folder), "XDG_CACHE_HOME": str(folder / "cache")}


def by_find_package(prefix, consumer, work):
    run("cmake", "-S", consumer, "-B", work / "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", work / "build")
    return work / "build" / "consumer"


def by_pkg_config(prefix, libdir, consumer, work):
    environment = os.environ | {"PKG_CONFIG_PATH": str(prefix / libdir / "pkgconfig")}
    flags = shlex.split(run("pkg-config", "--cflags", "--libs", "splatray", env=environment))
    program = work / "by_pkg_config"
    sources = sorted(consumer.glob("*.cpp"))
    run("c++", "-std=c++20", *WARNINGS, *sources, "-o", program, *flags, f"-Wl,-rpath,{prefix / libdir}")
    return program


def by_guide(build, source, work):
    """The guide's page about C++: its files, built and run by its commands, the first of them in splatray's folder."""
    page = (source / "app/guide/embed.md").read_text()
    theirs, ours = work / "theirs", work / "ours"
    (theirs / "build").mkdir(parents=True)
    (theirs / "build/release").symlink_to(build)
    ours.mkdir()
    for name, language in (("CMakeLists.txt", "cmake"), ("main.cpp", "cpp")):
        (ours / name).write_text(re.search(rf"`{re.escape(name)}`:\n\n```{language}\n(.*?)```", page, re.DOTALL).group(1))
    (ours / "survey.laz").write_bytes(page_inputs.survey())
    commands = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
    for command, folder in zip(commands, (theirs, ours), strict=True):
        shown = run("bash", "-euc", command, cwd=folder, env=own_places(work))
    if not re.search(r"3600 discs, 59(\.\d+)? across\nthe ray meets object 0 at distance ", shown) or not (ours / "picture.png").exists():
        sys.exit(f"the guide's program showed\n{shown}expected its discs, a hit and a picture")


def check_memory_only(program, work):
    """Scenes of arrays are built, shown and traced where no file can be written; all else the program does cannot be done there."""
    # Neither Mesa nor the validation layer keeps compiled shaders.
    no_files = {"env": own_places(work) | {"MESA_SHADER_CACHE_DISABLE": "true", "SPLATRAY_VALIDATION": "0"},
                "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))}
    run(program, "memory", **no_files)
    if subprocess.run([program, work], capture_output=True, **no_files).returncode == 0:
        sys.exit("a program that writes pictures ended well where no file can be written: the check is blind")


def prove():
    """The checks notice what they are for."""
    assert foreign_symbols("0 T splatray::Scene::x()\n0 T splatray::api::open()\n0 V vtable for splatray::api::Error\n") == ["splatray::Scene::x()"]


def main():
    prove()
    build, consumer, libdir = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        prefix, moved = work / "first place", work / "second"
        for component in ("library", "development"):
            run("cmake", "--install", build, "--prefix", prefix, "--component", component)
        check_library(next((prefix / libdir).glob("libsplatray.so.*.*.*")))
        check_moveable(prefix, prefix, build, consumer.parent.parent.parent)
        program = by_find_package(prefix, consumer, work)
        run(program, work, env=own_places(work))
        shutil.move(prefix, moved)
        program = by_pkg_config(moved, libdir, consumer, work)
        run(program, work, env=own_places(work))
        check_memory_only(program, work)
        by_guide(build, consumer.parent.parent.parent, work)


if __name__ == "__main__":
    main()
