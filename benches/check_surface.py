#!/usr/bin/env python3
"""How fast `check` reads a surface finishing program of a million blocks, beside LinuxCNC's interpreter if it is here.

    benches/check_surface.py [RUNS]      5 if not said otherwise; exit code 1 if a limit is missed
"""
import sys

import surface
from measure import Bars, beside_peer, needs_program

BARS = Bars(blocks=1_000_000, least_per_second=1.5e6, most_mib=32.0)


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5

    def write(spelling: str, out) -> None:
        surface.write(BARS.blocks, spelling, out)

    missed = beside_peer("SURFACE", write, BARS, runs, ["--machine", "unlimited"])
    if missed:
        print("check_surface: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
