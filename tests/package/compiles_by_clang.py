"""Whether the library is C++ to clang++, too: docs/library.md says that it is, and all else is built by g++.

compiles_by_clang.py BUILD: every compilation of engine, shapes and meshes that BUILD/compile_commands.json has, its
kernels with their own instruction sets, once more by clang++ with -fsyntax-only. Ends with 77 where there is no clang++.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

ROOMS = ("engine/", "shapes/", "meshes/")
WITH_A_WORD = {"-o", "-MF", "-MT"}
# What g++ alone knows, or what is not asked here: warnings, files of dependencies, an object.
DROPPED = {"-MD", "-c", "-Werror", "-Winvalid-pch", "-Wno-restrict", "-fno-tree-vectorize"}


def by_clang(clang, entry):
    words = shlex.split(entry["command"])
    kept, k = [clang, "-fsyntax-only", "-w"], 1
    while k < len(words):
        if words[k] in WITH_A_WORD:
            k += 1
        elif words[k] not in DROPPED and not words[k].startswith("-mmemset-strategy="):
            kept.append(words[k])
        k += 1
    return kept


def output_of(entry):
    words = shlex.split(entry["command"])
    return words[words.index("-o") + 1]


def main():
    build = pathlib.Path(sys.argv[1])
    clang = shutil.which("clang++")
    if clang is None:
        print("no clang++ here")
        return 77
    entries = [
        entry
        for entry in json.loads((build / "compile_commands.json").read_text())
        if output_of(entry).startswith(ROOMS)
    ]
    if not entries:
        print("no compilation of the library is in compile_commands.json")
        return 1

    def compile_one(entry):
        return subprocess.run(by_clang(clang, entry), cwd=entry["directory"], capture_output=True, text=True)

    n_failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for entry, done in zip(entries, pool.map(compile_one, entries)):
            if done.returncode != 0:
                n_failed += 1
                print(f"{entry['file']}:\n{done.stderr}")
    print(f"{len(entries)} compilations, {n_failed} failed")
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
