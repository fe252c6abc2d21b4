"""Of pyproject.toml: the compiled part is made by CMake, the sources lie in python/."""

import sys

from skbuild import setup

setup(
    packages=["vex"],
    package_dir={"": "python"},
    package_data={"vex": ["py.typed", "*.pyi"]},
    cmake_args=["-DCMAKE_BUILD_TYPE=Release", "-DVEX_BUILD_PROGRAMS=OFF", "-DVEX_BUILD_TESTS=OFF",
                "-DVEX_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}",
                "-DVEX_PYTHON_INSTALL_DIR=python"],
    cmake_install_target="install_vex_python",
)
