"""Writes python/vex/_vex.pyi: the types of the compiled part, as mypy's stubgen reads them from its docstrings.

    PYTHONPATH=build/release/python python3 python/make_stub.py [FILE]

A test holds the committed file against what this writes.
"""

import pathlib
import re
import sys
import tempfile

from mypy import stubgen

sys.path.pop(0)  # this folder has the package without its compiled part


def stub() -> str:
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = ["stubgen", "--quiet", "--module", "vex._vex", "--output", folder]
        stubgen.main()
        text = (pathlib.Path(folder) / "vex" / "_vex.pyi").read_text()
    # What this stubgen does not know: NumPy's types with arguments, fixed lengths, static methods.
    text = re.sub(r"numpy\.ndarray\[(numpy\.\w+)\]", r"npt.NDArray[\1]", text)
    text = re.sub(r"numpy\.ndarray\[[^\]]*\]", "npt.NDArray[Any]", text)
    text = re.sub(r"(\w+)\[\d+\]", r"\1", text)
    law = text.index("class OrientationLaw")
    end = text.index("\nclass ", law)
    names = {"aligned": "", "isotropic": "", "angle": "degrees: float", "cone": "degrees: float",
             "fixed": "w: float, x: float, y: float, z: float", "onsager": "alpha: float",
             "parse": "text: str",
             "maier_saupe": "strength: float", "table": "cosines: List[float], densities: List[float]",
             "each": "a: Any, b: Any"}
    block = text[law:end]
    for name, parameters in names.items():
        block = block.replace(f"    def {name}(self, *args, **kwargs) -> Any: ...",
                              f"    @staticmethod\n    def {name}({parameters}) -> OrientationLaw: ...")
    text = text[:law] + block + text[end:]
    text = text.replace("(self, *args, **kwargs) -> None: ...", "(self, *args: Any, **kwargs: Any) -> None: ...")
    text = text.replace("(*args, **kwargs) -> Any: ...", "(*args: Any, **kwargs: Any) -> Any: ...")
    text = text.replace("def __eq__(self, arg0: OrientationLaw)", "def __eq__(self, other: object)")
    text = text.replace("support: function", "support: Any")
    text = text.replace("warm_start: WarmStart", "warm_start: Optional[WarmStart]")
    text = re.sub(r"    def __reduce_ex__\(.*\n", "", text)  # as any object's
    text = text.replace("import numpy\n", "import numpy\nimport numpy.typing as npt\n\n", 1)
    text = re.sub(r"\bobject\b(?=\)|, |: \.\.\.)", "Any", text)
    return '"""Written by python/make_stub.py."""\n' + text


if __name__ == "__main__":
    target = sys.argv[1] if len(sys.argv) > 1 else str(pathlib.Path(__file__).parent / "vex" / "_vex.pyi")
    text = stub()
    pathlib.Path(target).write_text(text)
