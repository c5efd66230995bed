#!/usr/bin/env python3
"""How long a shift of eight machine hours takes to run, without setpoints sampled.

    benches/shift.py [RUNS]      3 if not said otherwise; exit code 1 if the limit is missed
"""
import json
import math
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import part
import surface
from measure import PROGRAM, needs_program, run

SHIFT_S = 8 * 3600
MOST_S = 20.0
ARGUMENTS = ["--machine", "unlimited", "--offset", "1=3"]


def summary(command: list[str]) -> dict:
    done = subprocess.run([*command, "--json"], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.nc"
        programs = [
            ("an ordinary part", part.write, MOST_S),
            ("nothing but finishing in cuts of 0.2 mm", lambda out: surface.write(400_000, "fanuc", out), None),
        ]
        for name, write, most in programs:
            with path.open("w", encoding="ascii") as out:
                write(out)
            command = [str(PROGRAM), "run", str(path), *ARGUMENTS]
            one = summary(command)
            pieces = math.ceil(SHIFT_S / one["cycle_time"]["total"])
            command += ["--repeat", str(pieces)]
            walls, used = [], []
            for _ in range(runs):
                start = time.monotonic()
                used.append(run(command))
                walls.append(time.monotonic() - start)
            if any(one.code != 0 for one in used):
                print(f"shift: a run failed: exit codes {[one.code for one in used]}", file=sys.stderr)
                return 1
            wall, seconds = statistics.median(walls), statistics.median(one.seconds for one in used)
            hours = pieces * one["cycle_time"]["total"] / 3600
            print(f"cyclestart run PART {' '.join(ARGUMENTS)} --repeat {pieces}: {name}, {hours:.2f} machine hours, "
                  f"{pieces * one['blocks']:,} blocks in {pieces * one['moves']:,} moves, one core, median of {runs} runs")
            limit = f"less than {most:.0f} s" if most else "no limit"
            print(f"  {wall:.1f} s ({seconds:.1f} s of CPU time, {pieces * one['moves'] / seconds / 1e6:.2f} M moves a second); {limit}")
            missed |= most is not None and wall >= most
    if missed:
        print("shift: the limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
