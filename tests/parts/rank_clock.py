#!/usr/bin/env python3
"""A simulated clock of vex_mesh's ranks: how busy rank 0 is, and how many of the others wait.

    python3 tests/parts/rank_clock.py [--ranks 10 100 1000 10000] [--record 30e-6] [--block 0.2] [--seconds 20]

Each rank has one block in work and one in stock; it hands in a block of which the time scatters by a fifth (and every
tenth rank is half as fast), and asks for another one. Rank 0 reads one record at a time, in `record` seconds. With
--block 0 blocks are as long as vex makes them: max(0.2 s, K * 0.5 ms).
"""
import argparse
import heapq
import random


def simulate(n_ranks, record, block, seconds, latency=20e-6):
    random.seed(n_ranks)
    speed = [0.5 if k % 10 == 9 else 1.0 for k in range(n_ranks)]
    length = lambda k: block / speed[k] * random.lognormvariate(0.0, 0.2)
    # Arrivals at rank 0 of (time, rank): the rank has just finished a block, and works on the one it had in stock.
    events = [(random.uniform(0.0, block), k) for k in range(n_ranks)]
    heapq.heapify(events)
    free = busy = worked = 0.0
    has_stock_since = [0.0] * n_ranks
    n_messages = 0
    while events:
        now, rank = heapq.heappop(events)
        if now > seconds:
            break
        start = max(free, now + latency)
        free = start + record
        busy += record
        n_messages += 3  # the record, the question, the block
        answer = free + latency
        begin = max(now, has_stock_since[rank])  # its next block is in stock, or on its way
        has_stock_since[rank] = answer
        work = length(rank)
        worked += min(work, max(0.0, seconds - begin))
        heapq.heappush(events, (begin + work, rank))
    return busy / seconds, worked / (seconds * n_ranks), n_messages / seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ranks", type=int, nargs="+", default=[10, 100, 1000, 10000])
    parser.add_argument("--record", type=float, default=30e-6)
    parser.add_argument("--bytes", type=float, default=2762.0)
    parser.add_argument("--block", type=float, default=0.0)
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args()
    print("ranks   block s   messages/s   MB/s   rank 0 busy   ranks at work")
    for n in options.ranks:
        block = options.block or max(0.2, 5e-4 * n)
        busy, work, messages = simulate(n, options.record, block, max(options.seconds, 10 * block))
        print(f"{n:5} {block:9.2f} {messages:12.0f} {messages / 3 * options.bytes / 1e6:6.2f} {100 * busy:12.1f} % {100 * min(work, 1.0):13.1f} %")


if __name__ == "__main__":
    main()
