#!/usr/bin/env python3
"""Walks at random over all that an operator can do, on controls of both families and on machines with and without builder's
logic: no panic, no illegal state, nothing refused that changes anything, no motion without a cause, no acknowledged write lost.
Prints the command, the sample, the figure and its limit.

    WALK=10000000 benches/random_walk.py             so many actions, 100000 if none are said
    WALK=10000000 SEED=7 benches/random_walk.py      the same ones every time
"""
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MEAN = 40  # actions of a walk, from none to 80
TESTS = 3  # tests that walk


def main() -> int:
    actions = int(os.environ.get("WALK", "100000"))
    cases = max(1000, -(-actions // (MEAN * TESTS)))
    command = ["cargo", "test", "-p", "station", "--test", "operator", "--locked"]
    seed = {"PROPTEST_RNG_SEED": os.environ["SEED"]} if "SEED" in os.environ else {}
    subprocess.run([*command, "--no-run"], cwd=ROOT, capture_output=True, check=True)
    begun = time.monotonic()
    run = subprocess.run(command, cwd=ROOT, env={**os.environ, **seed, "PROPTEST_CASES": str(cases)},
                         capture_output=True, text=True, check=False)
    failed = [line for line in run.stdout.splitlines() if line.startswith("test ") and line.endswith("FAILED")]
    seconds, walked = time.monotonic() - begun, cases * MEAN * TESTS
    said = "".join(f"{name}={value} " for name, value in seed.items())
    print(f"command: {said}PROPTEST_CASES={cases} {' '.join(command)}")
    print(f"sample: {TESTS} x {cases} walks, about {walked} actions, {seconds:.0f} s, {walked / seconds:.0f} actions/s")
    print(f"figure: {len(failed)} tests that found a panic, an illegal state, a motion without a cause or a lost write; limit 0")
    if run.returncode != 0:
        print(run.stdout[-4000:], run.stderr[-2000:], file=sys.stderr)
    return run.returncode


if __name__ == "__main__":
    sys.exit(main())
