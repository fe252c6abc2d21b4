#!/usr/bin/env python3
"""Runs in parts against one run, for longer than the tests take.

    python3 tests/parts/kills_and_ranges.py build/release/bin [--kills 100] [--ranges 100] [--seed 1]

Every estimator, with random and with Sobol' points, and the default with a relative error: killed by SIGKILL at random
moments and resumed on 1, 2, 3 or 8 threads until it ends; and cut into ranges of trials, put together in a random
order. The final JSON must be that of one run, but for times. Then vex_virial and vex_percolate likewise.
"""
import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

BODIES = ["box:1,1,2", "capsule:1,0.3"]
WAYS = [(e, s) for e in ("hit-or-miss", "hit-or-miss-fitted", "stratified", "radial", "mixed-volume", "mean-width")
        for s in ("random", "sobol") if (e, s) != ("stratified", "sobol")]
# So that each takes about two seconds of one core.
TRIALS = {"hit-or-miss": 4e7, "hit-or-miss-fitted": 1.5e7, "stratified": 2e7, "radial": 6e6, "mixed-volume": 1e7,
          "mean-width": 2e7}


TIMES = ("command", "threads", "seconds", "trials_per_second", "seconds_to_this_error")
# Of a state's lines, with the checksum of those that tell a time.
LINES_OF_TIMES = ("seconds ", "# seconds: ", "# end, ")


def without_times(part):
    if isinstance(part, dict):
        return {key: without_times(value) for key, value in part.items() if key not in TIMES}
    if isinstance(part, list):
        return [without_times(value) for value in part
                if not (isinstance(value, str) and value.startswith(LINES_OF_TIMES))]
    return part


def document_without_times(path):
    with open(path) as file:
        return without_times(json.load(file))


def kill_until_it_ends(command, least_kills, longest):
    """The number of kills; the run ends by itself once it was killed often enough, or is done before."""
    kills = 0
    while True:
        process = subprocess.Popen(command + ["--threads", str(random.choice([1, 2, 3, 8]))])
        if kills < least_kills:
            time.sleep(random.uniform(0.02, longest))
            process.send_signal(signal.SIGKILL)
        code = process.wait()
        if code == 0:
            return kills
        if code != -signal.SIGKILL:
            sys.exit(f"exit code {code} of {' '.join(command)}")
        kills += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--ranges", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random.seed(options.seed)
    programs = os.path.abspath(options.programs)
    mesh, merge, percolate, virial = (os.path.join(programs, "vex_" + name)
                                      for name in ("mesh", "merge", "percolate", "virial"))
    saving = ["--quiet", "--checkpoint", "state", "--resume", "state", "--checkpoint-every", "0.01", "--json",
              "parts.json"]
    runs = [([mesh] + BODIES + ["--estimator", e, "--sequence", s], ["--trials", str(int(TRIALS[e]))])
            for e, s in WAYS]
    runs += [([mesh] + BODIES, ["--rel-error", "2e-6"]),
             ([mesh] + BODIES + ["--estimator", "hit-or-miss"], ["--rel-error", "2e-4"])]
    # Programs of their own words for a part: the command, how a part begins, how long it is, and of how many.
    others = [([virial, "box:1,1,2", "--order", "6"], "--first-trial", "--trials", 40),
              ([virial, "sphere:0.5", "box:1,1,1"], "--first-trial", "--trials", 40),
              ([percolate, "box:1,1,1", "--sizes", "3,4,6"], "--first-realisation", "--realisations", 8)]
    ranged = [(command, "--first-trial", "--trials", 320) for command, _ in runs[:len(WAYS)]] + others
    runs += [([virial, "box:1,1,2", "--order", "6"], ["--trials", "6000"]),
             ([virial, "cylinder:3,0.5"], ["--rel-error", "1e-3"]),
             ([percolate, "box:1,1,1", "--sizes", "3,4,6"], ["--realisations", "2000"])]
    n_kills = n_merged = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for command, stop in runs:
            subprocess.run(command + stop + ["--quiet", "--json", "whole.json"], check=True)
            seconds = json.load(open("whole.json"))["seconds"]
            kills = kill_until_it_ends(command + stop + saving, -(-options.kills // len(runs)),
                                       max(0.05, seconds / 3))
            os.remove("state")
            same = document_without_times("parts.json") == document_without_times("whole.json")
            print(f"{kills:4} kills, {'the same' if same else 'ANOTHER RESULT'}: {' '.join(command[1:] + stop)}", flush=True)
            n_kills += kills
            if not same:
                return 1
        for command, first, number, step in ranged:
            subprocess.run(command + [first, "0", number, str(step * options.ranges), "--quiet", "--json", "whole.json"],
                           check=True)
            names = [f"{k}.json" for k in range(options.ranges)]
            for k in random.sample(range(options.ranges), options.ranges):
                subprocess.run(command + [first, str(step * k), number, str(step), "--quiet", "--json",
                                          names[k], "--threads", str(random.choice([1, 2, 3]))], check=True)
            random.shuffle(names)
            subprocess.run([merge, "--quiet", "--max-z", "20", "--json", "parts.json"] + names, check=True)
            same = document_without_times("parts.json") == document_without_times("whole.json")
            print(f"{len(names):4} ranges, {'the same' if same else 'ANOTHER RESULT'}: {' '.join(command[1:])}", flush=True)
            n_merged += 1
            if not same:
                return 1
    print(f"{n_kills} kills in {len(runs)} runs, {n_merged} merges of {options.ranges} ranges: all the same")
    return 0


if __name__ == "__main__":
    sys.exit(main())
