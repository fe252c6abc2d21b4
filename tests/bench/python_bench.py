"""A million poses from Python, beside the C++ library's own batch of the same poses, in one process on one thread.

    cmake --build build/release --target vex_python_batch
    PYTHONPATH=build/release/python:build/release/tests/bench python3 tests/bench/python_bench.py [POSES]

Prints Markdown: nanoseconds of processor time a pose, the median of seven rounds in which each takes its turn, and
ratios, which are medians of the rounds' own.
"""

import sys
import time

import numpy as np

import vex
import vex_python_batch as cpp

ROUNDS = 7


def poses_of(reach, n):
    rng = np.random.default_rng(1)
    direction = rng.normal(size=(n, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.concatenate([reach * rng.random((n, 1)) ** (1 / 3) * direction, rng.normal(size=(n, 4))], axis=1)


def matrices(q):
    w, x, y, z = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1).reshape(-1, 3, 3)


def timed(work):
    start = time.process_time()
    work()
    return time.process_time() - start


def main():
    n = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    with open("/proc/cpuinfo") as file:
        processor = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "?")
    print(f"{n} poses, one thread, {processor}\n")
    print("| query | pair | C++ batch | C++, poses made of the rows | Python, quaternions | ratio | Python, matrices | "
          "ratio to the batch | one call a pose |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for query in ("overlap", "distance"):
        for text in ("box:1,1,1", "ellipsoid:2,0.5,0.5", "capsule:1,0.25", "cylinder:1,0.5"):
            body = vex.Body(text)
            poses = poses_of(2.0 * body.circumradius, n)
            split = matrices(poses[:, 3:]), np.ascontiguousarray(poses[:, :3])
            ask = getattr(vex, query)
            few = poses[: max(1, n // 500)]
            times = {"cpp": [], "cpp_rows": [], "quaternions": [], "matrices": [], "single": []}
            for round_ in range(ROUNDS + 1):
                seconds = {"cpp": getattr(cpp, query)(text, text, poses)[0],
                           "quaternions": timed(lambda: ask(body, body, poses, threads=1)),
                           "matrices": timed(lambda: ask(body, body, split, threads=1)),
                           "single": timed(lambda: [ask(body, body, pose, threads=1) for pose in few]) * n / len(few)}
                seconds["cpp_rows"] = seconds["cpp"] + cpp.poses(poses)
                if round_ > 0:  # the first one warms up
                    for name, value in seconds.items():
                        times[name].append(value)
            ns = {name: 1e9 * np.median(values) / n for name, values in times.items()}
            of_rows = np.median(np.array(times["quaternions"]) / np.array(times["cpp_rows"]))
            of_poses = np.median(np.array(times["matrices"]) / np.array(times["cpp"]))
            print(f"| {query} | {text} | {ns['cpp']:.1f} | {ns['cpp_rows']:.1f} | {ns['quaternions']:.1f} | {of_rows:.2f} | "
                  f"{ns['matrices']:.1f} | {of_poses:.2f} | {ns['single']:.0f} |", flush=True)


if __name__ == "__main__":
    main()
