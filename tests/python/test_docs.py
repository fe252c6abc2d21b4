"""Every line of docs/python.md, as it stands there."""

import doctest
import os
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_python_md(monkeypatch):
    monkeypatch.chdir(ROOT / "meshes" / "data")
    text = (ROOT / "docs" / "python.md").read_text().replace("array([...])\n", "array([...])\n")
    test = doctest.DocTestParser().get_doctest(text, {}, "python.md", "docs/python.md", 0)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    report = []
    runner.run(test, out=report.append)
    results = runner.summarize(verbose=False)
    assert results.failed == 0, "".join(report)
    assert results.attempted > 35 and os.getcwd().endswith("data")
