#!/usr/bin/env python3
"""How fast `check` reads two million blocks cut with tool radius compensation, beside LinuxCNC's interpreter if it is here,
and that memory does not grow with their number.

    benches/compensation.py [RUNS]      5 if not said otherwise; exit code 1 if a limit is missed
"""
import sys
import tempfile
from pathlib import Path

import contour
from measure import PROGRAM, Bars, beside_peer, needs_program, run

BLOCKS = 2_000_000
LEAST_BLOCKS_PER_SECOND = 2.0e6  # of CPU time, the whole process
MOST_MIB = 32.0
MOST_GROWTH_MIB = 1.0  # what the allocator may do on its own account
ARGUMENTS = ["--machine", "unlimited", "--offset", f"1={contour.RADIUS}"]


def peak_mib(blocks: int) -> float:
    """The peak of `check` with so many compensated blocks."""
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "part.nc"
        with part.open("w", encoding="ascii") as out:
            contour.write(blocks, "fanuc", out)
        used = run([str(PROGRAM), "check", str(part), *ARGUMENTS])
    if used.code != 0:
        raise SystemExit(f"compensation: {blocks:,} blocks ended with exit code {used.code}")
    return used.mib


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5

    def write(spelling: str, out) -> None:
        contour.write(BLOCKS, spelling, out)

    bars = Bars(contour.size(BLOCKS), LEAST_BLOCKS_PER_SECOND, MOST_MIB)
    missed = beside_peer("CONTOURS", write, bars, runs, ARGUMENTS)
    short, long = peak_mib(BLOCKS // 10), peak_mib(BLOCKS)
    print(f"  peak with {BLOCKS // 10:,} blocks {short:.1f} MiB, with {BLOCKS:,} {long:.1f} MiB; at most {MOST_GROWTH_MIB:.0f} MiB more")
    missed |= long - short > MOST_GROWTH_MIB
    if missed:
        print("compensation: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
