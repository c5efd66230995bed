#!/usr/bin/env python3
"""Memory does not grow with the program: streams of very different length through standard input.

    benches/memory.py [BLOCKS]      20,000,000 if not said otherwise, about half a gigabyte; exit code 1 if a limit is missed
"""
import sys

import surface
from measure import PROGRAM, needs_program, run

BLOCKS = 20_000_000
MOST_MIB = 32.0
MOST_GROWTH_MIB = 1.0  # what the allocator may do on its own account
PIECE = 400_000  # blocks that are made once and sent again and again


def feeder(blocks: int):
    """A function that writes a program of so many blocks to a pipe."""
    piece = "".join(surface.cuts(PIECE)).encode()
    short = "".join(surface.cuts(blocks % PIECE)).encode()

    def feed(pipe) -> None:
        pipe.write(surface.head("fanuc").encode())
        for _ in range(blocks // PIECE):
            pipe.write(piece)
        pipe.write(short + surface.tail("fanuc").encode())

    feed.size = len(piece) * (blocks // PIECE) + len(short)
    return feed


def main() -> int:
    needs_program()
    blocks = int(sys.argv[1]) if len(sys.argv) > 1 else BLOCKS
    command = [str(PROGRAM), "check", "-", "--machine", "unlimited"]
    peaks = []
    for count in (blocks // 100, blocks):
        feed = feeder(count)
        used = run(command, feed)
        if used.code != 0:
            print(f"memory: exit code {used.code}", file=sys.stderr)
            return 1
        peaks.append(used.mib)
        print(f"cyclestart check - : {count:,} blocks, {feed.size / 1e6:,.0f} MB through standard input: {used.mib:.1f} MiB")
    print(f"  less than {MOST_MIB:.0f} MiB, and at most {MOST_GROWTH_MIB:.0f} MiB more for a hundred times the length")
    missed = max(peaks) >= MOST_MIB or peaks[1] - peaks[0] > MOST_GROWTH_MIB
    if missed:
        print("memory: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
