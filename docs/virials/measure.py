#!/usr/bin/env python3
"""Measures the table of docs/virials.md, body by body, and writes docs/virials/table.md.

    python3 docs/virials/measure.py [SECONDS [PASSES [PROGRAM]]]

PASSES (1) more passes over all bodies of docs/virials/bodies.txt, SECONDS (60) each, to B6; 0 passes only write the
table. Each pass of a body is a run of its own seed, kept in build/virials, and the table has the mean of all of them:
the command goes on where it was stopped. PROGRAM is build/release/bin/vex_virial.
"""
import json
import math
import pathlib
import re
import subprocess
import sys

ORDER = 6
root = pathlib.Path(__file__).resolve().parents[2]
runs = root / "build" / "virials"


def bodies():
    for line in (root / "docs/virials/bodies.txt").read_text().splitlines():
        if line.startswith("#"):
            continue
        name, arguments, published = (part.strip() for part in line.split("|"))
        yield name, arguments.split(), published


def file_of(name, seed):
    return runs / f"{re.sub('[^A-Za-z0-9]', '_', name.replace('.', 'p'))}.{seed}.json"


def measure(name, arguments, seconds, program):
    seed = 1
    while file_of(name, seed).exists():
        seed += 1
    part = file_of(name, seed).with_suffix(".part")
    command = [program, *arguments, "--order", str(ORDER), "--seconds", str(seconds), "--seed", str(seed)]
    print(name, seed, file=sys.stderr, flush=True)
    subprocess.run([*command, "--json", str(part), "--quiet"], check=True)
    part.rename(file_of(name, seed))


def mean(name):
    """Of all passes: a list of (n, value, error, clusters), and B2 / V."""
    found, b2_per_volume, seconds, seed = {}, None, 0.0, 1
    while file_of(name, seed).exists():
        document = json.loads(file_of(name, seed).read_text())
        b2_per_volume = document["b2_per_volume"]
        seconds += document["seconds"] * document["threads"]
        for one in document["coefficients"]:
            if one["reduced"] is not None and one["std_error"] is not None:
                found.setdefault(one["n"], []).append((one["samples"], one["reduced"], one["std_error"]))
        seed += 1
    rows = []
    for n in sorted(found):
        total = sum(k for k, _, _ in found[n])
        value = sum(k * x for k, x, _ in found[n]) / total
        rows.append((n, value, math.sqrt(sum((k * e) ** 2 for k, _, e in found[n])) / total, total))
    return rows, b2_per_volume, seconds


def with_error(value, error):
    digits = max(0, 1 - math.floor(math.log10(error) + 1e-9))
    in_last_digits = round(error * 10**digits)
    return f"{value:.{digits}f}({in_last_digits})"


def write_table():
    lines = [
        "# Virial coefficients, measured",
        "",
        "Written by `python3 docs/virials/measure.py`; what the columns are, and the sources in brackets: "
        "[virials.md](../virials.md).",
        "",
        "| body | B2/V | " + " | ".join(f"B{n}/B2^{n - 1}" for n in range(3, ORDER + 1)) + " | thread-seconds | published |",
        "|---" * (ORDER + 2) + "|",
    ]
    for name, _, published in bodies():
        rows, b2_per_volume, seconds = mean(name)
        if not rows:
            continue
        by_order = {n: with_error(x, e) + ("" if abs(x) > 3 * e else " ?") for n, x, e, _ in rows}
        b2 = "flat" if b2_per_volume is None else f"{b2_per_volume:.8g}"
        cells = [name, b2, *(by_order.get(n, "-") for n in range(3, ORDER + 1)), f"{seconds:.0f}", published]
        lines.append("| " + " | ".join(cells) + " |")
    (root / "docs/virials/table.md").write_text("\n".join(lines) + "\n")


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    passes = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    program = sys.argv[3] if len(sys.argv) > 3 else str(root / "build/release/bin/vex_virial")
    runs.mkdir(parents=True, exist_ok=True)
    for _ in range(passes):
        for name, arguments, _ in bodies():
            measure(name, arguments, seconds, program)
        write_table()
    write_table()


main()
