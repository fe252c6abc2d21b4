import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
pytest.importorskip("mypy")


def test_the_stub_is_what_would_be_written(tmp_path):
    subprocess.run([sys.executable, ROOT / "python" / "make_stub.py", tmp_path / "stub.pyi"], check=True)
    assert (tmp_path / "stub.pyi").read_text() == (ROOT / "python" / "vex" / "_vex.pyi").read_text()


def test_the_package_and_its_use_have_types(tmp_path):
    use = tmp_path / "use.py"
    use.write_text("import vex\n"
                   "result: vex.ExcludedVolume = vex.excluded_volume(vex.box(1, 2, 3), rel_error=1e-3)\n"
                   "value: float = result.value\n"
                   "scene = vex.Scene('sphere:1', [[0, 0, 0, 1, 0, 0, 0]], box=(9, 9, 9))\n"
                   "sizes = scene.clusters().sizes\n"
                   "wrong: str = result.value\n")
    found = subprocess.run([sys.executable, "-m", "mypy", "--config-file", ROOT / "python" / "mypy.ini", "--cache-dir",
                            tmp_path / "cache", ROOT / "python" / "vex", use], capture_output=True, text=True)
    errors = [line for line in found.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 1 and "use.py:6" in errors[0], found.stdout
