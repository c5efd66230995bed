#!/usr/bin/env python3
"""What planning motion costs: moves planned per CPU second, and how long one servo period of live execution takes.

    benches/planner.py [RUNS]      3 if not said otherwise; exit code 1 if a limit is missed
"""
import re
import statistics
import subprocess
import sys
from pathlib import Path

from measure import PROGRAM, needs_program, pin, run

PLANNER = PROGRAM.parent / "examples" / "planner"
MOVES = 2_000_000
PERIODS = 1_000_000
LEAST_MOVES_PER_SECOND = 1.0e6  # of CPU time, the whole process
MOST_PERIOD_US = 20.0  # of thread CPU time, in all but one period of a thousand


def main() -> int:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    needs_program()
    missed = False
    for part, what in [("chords", "chords of a curve, 0.1 mm"), ("contour", "lines and arcs by turns")]:
        seconds = statistics.median(run([str(PLANNER), part, str(MOVES)]).seconds for _ in range(runs))
        rate = MOVES / seconds
        print(f"planner {part}: {MOVES:,} moves ({what}), one core, median of {runs} runs")
        print(f"  {rate / 1e6:.2f} M moves per CPU second; at least {LEAST_MOVES_PER_SECOND / 1e6:.2f} M")
        missed |= rate < LEAST_MOVES_PER_SECOND
    said = subprocess.run([str(PLANNER), "live", str(PERIODS)], check=True, capture_output=True, text=True, preexec_fn=pin)
    print(f"planner live: {PERIODS:,} servo periods of lines and arcs, overrides and holds among them")
    for line in said.stdout.splitlines():
        print(f"  {line}")
    found = re.search(r"^thread CPU time: .* p99\.9 ([\d.]+) µs", said.stdout, re.MULTILINE)
    period = float(found.group(1)) if found else float("inf")
    print(f"  p99.9 of thread CPU time {period:.2f} µs; less than {MOST_PERIOD_US:.0f} µs")
    missed |= period >= MOST_PERIOD_US
    if missed:
        print("planner: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
