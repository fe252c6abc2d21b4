"""vex_trial_bench and vex_query_bench of an older commit beside this tree's, row by row.

    python3 tests/bench/beside_commit.py COMMIT [--runs N] [--bench trial|query] [--programs FOLDER] [--old FOLDER]
                                         [-- OPTION...]

Builds the two programs of COMMIT in a temporary worktree, as the preset `release` says, which takes minutes, and removes
it at the end; --old FOLDER takes them from where they have been built already. This tree's are those of --programs
(default build/release/bin). What follows -- goes to every program: --rounds, --poses, --turn-ms, --seed.

In each run the old program, the new one, and the old one once more begin at once on one core, and the system's
scheduler has them take turns every few milliseconds, so whatever slows the machine slows all three alike. Their turns
are of equal processor time, so that they time the same row at about the same time. A figure is the median over the runs
of new / old; beside it stand its quartiles, and old / old, which says what such a ratio is without any cause: rows of
two builds differ by some percent for no more than where their loops lie in memory. Peers' rows, FCL's above all, are not
the engine's and show that, too.

Ends with 1 if the programs did not answer the same poses with as many hits.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCHES = {"trial": "vex_trial_bench", "query": "vex_query_bench"}
SIDES = ("old", "new", "old again")


def build(commit, folder):
    def call(*words):
        subprocess.run(words, check=True, stdout=sys.stderr)

    call("git", "-C", ROOT, "worktree", "add", "--quiet", "--detach", folder, commit)
    call("cmake", "-S", folder, "--preset", "release")
    call("cmake", "--build", folder / "build" / "release", "--target", *BENCHES.values(), "--parallel", "2")
    return folder / "build" / "release" / "bin"


def run_at_once(programs, options, core, work):
    """The documents that the programs write, all on one core at one time."""
    files = [work / f"{side}.json" for side in SIDES]
    running = []
    for program, file in zip(programs, files):
        running.append(subprocess.Popen([program, *options, "--json", file], stdout=subprocess.DEVNULL,
                                        preexec_fn=lambda: os.sched_setaffinity(0, {core})))
    codes = [one.wait() for one in running]
    if any(codes):
        raise SystemExit(f"a benchmark ended with {codes} - run it alone to see why: {programs[0]}")
    return [json.loads(file.read_text()) for file in files]


def rows_of(document):
    """Of each row its nanoseconds and what must be equal on both sides."""
    rows = {}
    for row in document.get("trials", []):
        for name, one in row["contenders"].items():
            rows["trial", row["pair"], name] = one["median_ns"], (row["poses"], row["hits"], row["hits_of_trials"])
    for goal in ("distance", "depth"):
        for row in document.get(goal, []):
            for one in row["queries"]:
                rows[goal, row["body"], one["name"]] = one["median_ns"], (row["poses"], one["failed"])
    return rows


def quartiles(values):
    if len(values) < 2:
        return values[0], values[0]
    low, _, high = statistics.quantiles(values, n=4, method="inclusive")
    return low, high


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commit")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--bench", choices=BENCHES)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build" / "release" / "bin")
    parser.add_argument("--old", type=pathlib.Path)
    asked = parser.parse_args(words[:len(words) - len(options) - 1] if "--" in words else words)
    core = max(os.sched_getaffinity(0))
    seen, others = {}, set()
    work = pathlib.Path(tempfile.mkdtemp(prefix="vex-beside-"))
    try:
        old = asked.old or build(asked.commit, work / "tree")
        for run in range(asked.runs):
            for program in [BENCHES[asked.bench]] if asked.bench else BENCHES.values():
                sides = [old / program, asked.programs / program, old / program]
                documents = [rows_of(one) for one in run_at_once(sides, options, core, work)]
                for row in documents[0].keys() ^ documents[1].keys():
                    others.add(f"one side alone has: {', '.join(row)}")
                for row in documents[0]:
                    if row not in documents[1]:
                        continue
                    figures = [document[row] for document in documents]
                    if figures[0][1] != figures[1][1]:
                        others.add(f"other poses or answers: {', '.join(row)}: {figures[0][1]}, {figures[1][1]}")
                    seen.setdefault(row, []).append([ns for ns, _ in figures])
            print(f"run {run + 1} of {asked.runs}", file=sys.stderr, flush=True)
    finally:
        if asked.old is None:
            subprocess.run(["git", "-C", ROOT, "worktree", "remove", "--force", work / "tree"], check=False)
        shutil.rmtree(work, ignore_errors=True)
    print("| what | body | row | old, ns | new / old | quartiles | old / old | quartiles |\n"
          "|---|---|---|---:|---:|---:|---:|---:|")
    for row, runs in seen.items():
        # The two old ones' mean is beside the new one for as long as either.
        new = [run[1] / (0.5 * (run[0] + run[2])) for run in runs]
        again = [run[2] / run[0] for run in runs]
        cells = [f"{statistics.median(run[0] for run in runs):.3g}"]
        for ratios in (new, again):
            low, high = quartiles(ratios)
            cells += [f"{statistics.median(ratios):.3f}", f"{low:.3f} to {high:.3f}"]
        print("| " + " | ".join([*row, *cells]) + " |")
    for other in sorted(others):
        print(f"\n{other}")
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
