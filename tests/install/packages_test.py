"""packages_test.py BUILD: makes the Debian packages of a build tree, looks at them as lintian does where that is installed, and runs the
programs as unpacked in a folder of their own. Exit 77 with a sentence where dpkg's tools are missing."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from install_test import run

PACKAGES = {"splatray": ["usr/bin/splatray-render", "usr/bin/splatray-preprocess", "usr/bin/splatray-view", "usr/share/man/man1/splatray-render.1.gz",
                         "usr/share/applications/splatray-view.desktop", "usr/share/mime/packages/splatray.xml"],
            "libsplatray0.1": ["usr/lib/libsplatray.so.0.1"],
            "splatray-oiio": ["usr/lib/splatray/libsplatray_oiio-0.1.0.so"],
            "splatray-vtk": ["usr/lib/splatray/libsplatray_vtk-0.1.0.so"],
            "libsplatray-dev": ["usr/include/splatray.h", "usr/lib/libsplatray.so", "usr/lib/pkgconfig/splatray.pc",
                                "usr/lib/cmake/splatray/splatrayConfig.cmake"]}
MISSING = 77


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
    run(render, work / "cloud.soct", "-o", work / "a.png", "--resolution", "64x36", "--samples", "1", "--quiet")
    for program in ("splatray-render", "splatray-view"):
        run(root / "usr/bin" / program, "--version")
    if shutil.which("man") is None:
        print("skipped: the man page is not read, there is no man")
    else:
        page = run("man", "-l", root / "usr/share/man/man1/splatray-render.1.gz")
        if "--turntable" not in page.replace("\u2010", "-") or "EXIT STATUS" not in page:
            sys.exit("the man page says nothing of --turntable or the exit status")
    shutil.move(root / "usr/lib/splatray", root / "usr/lib/elsewhere")
    if subprocess.run([render, work / "cloud.soct", "-o", work / "b.png", "--quiet"], capture_output=True).returncode != 1:
        sys.exit("splatray-render wrote a picture without its library of codecs: it was not the packages' one")


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


if __name__ == "__main__":
    main()
