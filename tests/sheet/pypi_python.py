"""A Python that has packages which read sheets as other programs do."""
import shutil
import subprocess
import sys

RASTERIO = ("rasterio==1.4.3", "numpy==2.2.6")
EZDXF = ("ezdxf==1.4.3",)
PDFPLUMBER = ("pdfplumber==0.11.10",)


def pypi_python(folder, *packages):
    """Python of the virtual environment that the folder is, made once. Ends the test as skipped (77) where it cannot be made."""
    if not (folder / "bin/python").exists():
        try:
            subprocess.run([sys.executable, "-m", "venv", folder], check=True, capture_output=True)
            subprocess.run([folder / "bin/pip", "install", "-q", *packages], check=True, capture_output=True)
        except subprocess.CalledProcessError as error:
            shutil.rmtree(folder, ignore_errors=True)
            print("skipped:", *packages, "of PyPI cannot be installed, or python3 -m venv fails:", error.stderr[-300:])
            sys.exit(77)
    return folder / "bin/python"
