#!/usr/bin/env python3
"""Whether any axis is ever asked for more than it can give, and whether the path is kept to: the long run.

    benches/limits.py [PROGRAMS]      10000 if not said otherwise (half an hour on two cores); exit code 1 if a limit is passed

Random programs of every model, with overrides, holds and stops at random; every case of the corpus; the programs of the
other benches. Each setpoint of each servo period is looked at before it is rounded.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import contour
import drill
import surface

LIMIT = 1.001  # of the velocity, acceleration and jerk of every axis, and of the tolerance of the path
BLOCKS = 3000  # of each program of the other benches
PERIODS = 100_000  # of a case at most; twenty times that of a longer program
FIGURE = re.compile(r"(velocity|acceleration|jerk|path) ([\d.]+)")


def run(command: list[str], **more: str) -> tuple[bool, str]:
    print(f"{' '.join(f'{key}={value}' for key, value in more.items())} {' '.join(command)}", flush=True)
    said = subprocess.run(command, env={**os.environ, **more}, capture_output=True, text=True, check=False)
    if said.returncode:
        print(said.stdout + said.stderr, file=sys.stderr)
    return said.returncode == 0, said.stdout


def write(folder: Path) -> None:
    for name, text in [("contour", lambda out: contour.write(BLOCKS, "fanuc", out)),
                       ("drill", lambda out: drill.write(BLOCKS, out)),
                       ("surface", lambda out: surface.write(BLOCKS, "fanuc", out))]:
        with (folder / f"{name}.nc").open("w", encoding="ascii") as out:
            text(out)


def main() -> int:
    programs = sys.argv[1] if len(sys.argv) > 1 else "10000"
    test = ["cargo", "test", "--quiet", "--locked"]
    show = ["--", "--nocapture", "--test-threads=2"]
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder))
        runs = [
            run([*test, "-p", "station", "--test", "axes", *show], PERIODS=str(PERIODS), PROGRAMS_IN=folder),
            *(run([*test, "-p", "motion", "--test", name, *show], PROGRAMS=programs)
              for name in ("properties", "jerk", "classic_laws")),
        ]
    worst: dict[str, float] = {}
    for _, said in runs:
        for line in said.splitlines():
            if " programs" in line:
                print(f"  {line.strip()}")
            for kind, part in FIGURE.findall(line):
                worst[kind] = max(worst.get(kind, 0.0), float(part))
    for kind, part in worst.items():
        print(f"limits: {kind}: at most {part:.6f} of the limit; not above {LIMIT}")
    passed = not all(ok for ok, _ in runs) or not worst or max(worst.values()) > LIMIT
    if passed:
        print("limits: a limit is passed", file=sys.stderr)
    return 1 if passed else 0


if __name__ == "__main__":
    sys.exit(main())
