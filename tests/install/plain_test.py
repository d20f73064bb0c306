"""plain_test.py SOURCE PROGRAM: a build that is configured without a word has the programs and no tests; installing it when one program
is built installs that one and names the others."""

import pathlib
import re
import shutil
import sys
import tempfile

from install_test import run


def main():
    source, program = (pathlib.Path(argument) for argument in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as temporary:
        build, prefix = pathlib.Path(temporary) / "build", pathlib.Path(temporary) / "prefix"
        run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")
        targets = run("cmake", "--build", build, "--target", "help")
        for name, wanted in (("splatray-view", True), ("programs", True), ("test_cli", False), ("splatray-bench", False)):
            if bool(re.search(rf"^{name}: phony", targets, re.MULTILINE)) != wanted:
                sys.exit(f"a plain build {'lacks' if wanted else 'has'} the target {name}")
        (build / "bin").mkdir(exist_ok=True)
        shutil.copy(program, build / "bin" / program.name)
        said = run("cmake", "--install", build, "--prefix", prefix)
        if not (prefix / "bin" / program.name).exists() or "CMake Error" in said:
            sys.exit(f"{program.name} was built and not installed:\n{said}")
        left_out = set(re.findall(r"Left out, as it is not built: (\S+) ", said))
        if program.name in left_out or not {"splatray-view", "splatray", "splatray_vtk"} <= left_out:
            sys.exit(f"found {sorted(left_out)} named as left out, expected all but {program.name}")


if __name__ == "__main__":
    main()
