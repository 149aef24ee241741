"""The wheel in an empty environment: no compiler, no extras, nothing but what it asks for."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

USE = """
import shutil, sys
assert shutil.which("cargo") is None and shutil.which("rustc") is None
import snell
assert str(snell.program()).startswith(sys.prefix), snell.program()
assert len(snell.call("scenes")) > 10
snell.call("reference", "uniform-ball", "-o", "a.exr", "--resolution", "16", "--positions", "1")
light = snell.read("a.exr")
assert light.shape == (16, 16, 3) and abs(light - 1).max() < 1e-2
assert float(snell.compare("a.exr", light)["value"].iloc[0]) == 0.0
for extra in ("distributed", "IPython", "pyarrow"):
    assert extra not in sys.modules
try:
    import snell.dask
except ModuleNotFoundError as error:
    assert error.name == "distributed"
else:
    raise AssertionError("the extra is not optional")
"""


@pytest.mark.skipif("SNELL_WHEELS" not in os.environ, reason="check.sh builds the wheel")
def test_the_wheel_works_where_there_is_no_cargo(tmp_path: Path) -> None:
    (wheel,) = Path(os.environ["SNELL_WHEELS"]).glob("*.whl")
    python = tmp_path / "venv/bin/python"
    subprocess.run([sys.executable, "-m", "venv", tmp_path / "venv"], check=True)
    subprocess.run([python, "-m", "pip", "install", "-q", wheel], check=True)
    empty = {"PATH": str(tmp_path / "nothing"), "HOME": str(tmp_path)}
    ran = subprocess.run([python, "-c", USE], cwd=tmp_path, env=empty, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    # The control: without the program the same words fail, and say what is missing.
    (tmp_path / "venv/bin/snell").unlink()
    ran = subprocess.run([python, "-c", USE], cwd=tmp_path, env=empty, capture_output=True, text=True)
    assert ran.returncode != 0
    assert "the program snell is not in this environment" in ran.stderr
