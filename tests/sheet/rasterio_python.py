"""A Python that has rasterio, which reads sheets as other programs do."""
import shutil
import subprocess
import sys


def rasterio_python(folder):
    """Python of a virtual environment in the folder, made once. Ends the test as skipped (77) where it cannot be made."""
    python = folder / "python"
    if not (python / "bin/python").exists():
        try:
            subprocess.run([sys.executable, "-m", "venv", python], check=True, capture_output=True)
            subprocess.run([python / "bin/pip", "install", "-q", "rasterio==1.4.3", "numpy==2.2.6"], check=True, capture_output=True)
        except subprocess.CalledProcessError as error:
            shutil.rmtree(python, ignore_errors=True)
            print("skipped: PyPI's rasterio cannot be installed, or python3 -m venv fails:", error.stderr[-300:])
            sys.exit(77)
    return python / "bin/python"
