"""packages_test.py BUILD: makes the Debian packages of a build tree, looks at them as lintian does where that is installed, runs the
programs as unpacked in a folder of their own, and counts what their install would pull in. Exit 77 with a sentence where dpkg's tools are
missing."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from install_test import run

PACKAGES = {"splatray": ["usr/bin/splatray-render", "usr/bin/splatray-preprocess", "usr/bin/splatray-view", "usr/share/man/man1/splatray-render.1.gz",
                         "usr/share/applications/splatray-view.desktop", "usr/share/mime/packages/splatray.xml"],
            "libsplatray0.1": ["usr/lib/libsplatray.so.0.1"],
            "splatray-oiio": ["usr/lib/splatray/libsplatray_oiio-0.1.0.so"],
            "splatray-remote": ["usr/lib/splatray/libsplatray_remote-0.1.0.so"],
            "splatray-sheet": ["usr/lib/splatray/libsplatray_sheet-0.1.0.so"],
            "splatray-vtk": ["usr/lib/splatray/libsplatray_vtk-0.1.0.so"],
            "libsplatray-dev": ["usr/include/splatray.h", "usr/lib/libsplatray.so", "usr/lib/pkgconfig/splatray.pc",
                                "usr/lib/cmake/splatray/splatrayConfig.cmake"]}
MISSING = 77
# Packages, and megabytes of those that are not ours, which an install pulls in: where there is a Vulkan driver, and with the software device.
# Of the first, 200 MB with ours were asked for: GLFW comes with OpenGL, and that with LLVM and what LLVM needs, 177 MB. Ours are 39 MB,
# ten times as much of a build with sanitizers, whose libraries are 11 MB of the others.
LIGHT, LIGHT_WITH_DEVICE = (80, 240), (80, 310)


def make_packages(build, work):
    """The packages' files by name."""
    run("cpack", "-G", "DEB", "-B", work, "--config", build / "CPackConfig.cmake", cwd=work)
    found = {path.name.split("_")[0]: path for path in work.glob("*.deb")}
    if set(found) != set(PACKAGES):
        sys.exit(f"found the packages {sorted(found)}, expected {sorted(PACKAGES)}")
    return found


def check_with_lintian(packages):
    if shutil.which("lintian") is None:
        print("skipped: the packages' form is not looked at (Debian's package lintian)")
        return
    report = subprocess.run(["lintian", "--allow-root", *packages], capture_output=True, text=True).stdout
    errors = [line for line in report.split("\n") if line.startswith("E:")]
    if errors:
        sys.exit("lintian found\n" + "\n".join(errors))


def check_programs(root, work):
    """The programs work from where they are unpacked, and the one that reads pictures finds its library there."""
    (work / "cloud.xyz").write_text("".join(f"{i % 20} {i // 20} {(i % 7) * 0.1}\n" for i in range(400)))
    render = root / "usr/bin/splatray-render"
    run(root / "usr/bin/splatray-preprocess", work / "cloud.xyz", "-o", work / "cloud.soct")
    picture = [render, work / "cloud.soct", "--resolution", "64x36", "--samples", "1", "--quiet", "-o"]
    run(*picture, work / "a.png")
    for program in ("splatray-render", "splatray-view"):
        run(root / "usr/bin" / program, "--version")
    if shutil.which("man") is None:
        print("skipped: the man page is not read, there is no man")
    else:
        page = run("man", "-l", root / "usr/share/man/man1/splatray-render.1.gz")
        if "--turntable" not in page.replace("\u2010", "-") or "EXIT STATUS" not in page:
            sys.exit("the man page says nothing of --turntable or the exit status")
    shutil.move(root / "usr/lib/splatray", root / "usr/lib/elsewhere")
    if subprocess.run([*picture, work / "b.png"], capture_output=True).returncode != 1:
        sys.exit("splatray-render wrote a picture without its library of codecs: it was not the packages' one")


def apt(state, *command):
    """What apt says of a machine without any package, by the lists of this one; empty where it cannot."""
    options = [f"Dir::State::status={state / 'status'}", f"Dir::Cache={state}", "Debug::NoLocking=1", "APT::Install-Recommends=false"]
    words = [command[0], *(word for option in options for word in ("-o", option)), *command[1:]]
    done = subprocess.run(words, capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
    return done.stdout if done.returncode == 0 else ""


def installed(state, *packages):
    """All packages of a bare Debian 12, those of priority required and apt, to which these are installed."""
    listed = apt(state, "apt-get", "-s", "install", "~prequired", "apt", *map(str, packages))
    return set(re.findall(r"^Inst (\S+)", listed, re.MULTILINE))


def megabytes(state, names, files):
    """Installed sizes of packages by name; `files` are not in apt's lists."""
    kib = {run("dpkg-deb", "-f", file, "Package").strip(): run("dpkg-deb", "-f", file, "Installed-Size") for file in files}
    shown = apt(state, "apt-cache", "show", "--no-all-versions", *sorted(names - set(kib)))
    kib |= dict(re.findall(r"^Package: (\S+)$.*?^Installed-Size: (\d+)$", shown, re.MULTILINE | re.DOTALL))
    return {name: int(kib[name]) * 1024 / 1e6 for name in names}


def is_light(sizes, most):
    return len(sizes) <= most[0] and sum(size for name, size in sizes.items() if name not in PACKAGES) <= most[1]


def check_light(packages, work):
    """The programs alone are a light install; with the modules that need much they are not."""
    state = work / "apt"
    (state / "archives/partial").mkdir(parents=True, exist_ok=True)
    (state / "status").touch()
    bare = installed(state)
    if not bare or "VERSION_ID=\"12\"" not in pathlib.Path("/etc/os-release").read_text():
        print("skipped: what an install pulls in is not counted, there are no lists of Debian 12's packages (apt-get update)")
        return
    programs = [packages["splatray"], packages["libsplatray0.1"]]
    for most, others in ((LIGHT, []), (LIGHT_WITH_DEVICE, ["mesa-vulkan-drivers"])):
        sizes = megabytes(state, installed(state, *programs, *others) - bare, programs)
        largest = ", ".join(f"{name} {sizes[name]:.0f}" for name in sorted(sizes, key=sizes.get, reverse=True)[:5])
        print(f"{len(sizes)} packages of {sum(sizes.values()):.0f} MB come with {' and '.join(['the programs', *others])}: {largest} and others")
        if not {"splatray", "libglfw3"} <= set(sizes):
            sys.exit("expected the programs and GLFW among them")
        if not is_light(sizes, most):
            sys.exit(f"expected at most {most[0]} packages and {most[1]} MB without ours")
    if is_light(dict.fromkeys(installed(state, *packages.values()) - bare, 0), LIGHT):
        sys.exit("the modules pull in nothing: the check is blind")


def main():
    build = pathlib.Path(sys.argv[1])
    if shutil.which("dpkg-shlibdeps") is None:
        print("skipped: dpkg-shlibdeps is missing (Debian's package dpkg-dev)")
        sys.exit(MISSING)
    with tempfile.TemporaryDirectory() as temporary:
        work = pathlib.Path(temporary)
        packages = make_packages(build, work)
        check_with_lintian(packages.values())
        root = work / "root"
        for name, path in packages.items():
            run("dpkg-deb", "-x", path, root)
            for file in PACKAGES[name]:
                if not (root / file).exists():
                    sys.exit(f"{path.name}: found no {file}")
        if shutil.which("desktop-file-validate"):
            run("desktop-file-validate", root / "usr/share/applications/splatray-view.desktop")
        check_programs(root, work)
        check_light(packages, work)


if __name__ == "__main__":
    main()
