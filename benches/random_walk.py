#!/usr/bin/env python3
"""Walks at random over the operator's actions: no panic, no illegal state, nothing refused that changes anything, no motion
without a cause. Prints the command, the sample, the figure and its limit.

    WALK=10000000 benches/random_walk.py     so many actions, 100000 if none are said
"""
import os
import subprocess
import sys
import time
from pathlib import Path

MEAN = 12  # actions of a walk, from none to 24
TESTS = 2  # tests that walk


def main() -> int:
    actions = int(os.environ.get("WALK", "100000"))
    cases = max(1000, -(-actions // (MEAN * TESTS)))
    command = ["cargo", "test", "-p", "station", "--test", "operator", "--locked"]
    begun = time.monotonic()
    run = subprocess.run(command, cwd=Path(__file__).resolve().parent.parent, env={**os.environ, "PROPTEST_CASES": str(cases)},
                         capture_output=True, text=True, check=False)
    failed = [line for line in run.stdout.splitlines() if line.startswith("test ") and line.endswith("FAILED")]
    print(f"command: PROPTEST_CASES={cases} {' '.join(command)}")
    print(f"sample: {TESTS} x {cases} walks, about {cases * MEAN * TESTS} actions, {time.monotonic() - begun:.0f} s")
    print(f"figure: {len(failed)} tests that found a panic, an illegal state or a motion without a cause; limit 0")
    if run.returncode != 0:
        print(run.stdout[-4000:], run.stderr[-2000:], file=sys.stderr)
    return run.returncode


if __name__ == "__main__":
    sys.exit(main())
