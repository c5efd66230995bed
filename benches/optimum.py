#!/usr/bin/env python3
"""How near the optimum the planner comes, and that what is sent to the axes adds up to the path's end.

    benches/optimum.py [PERIODS]      10,000,000 servo periods if not said otherwise; exit code 1 if a limit is missed

The optimum of a path is the time-optimal parameterisation on a dense grid (model trapezoid); that of a move from point to
point under jerk is Ruckig's. The tests fail by themselves where a limit is missed; this prints what they saw.
"""
import os
import re
import subprocess
import sys

ANY, SINGLE = 1.03, 1.001
ROW = re.compile(r"^(.+?) +([\d.]+) +([\d.]+) +([\d.]+)$", re.MULTILINE)


def run(command: list[str], **more: str) -> str:
    print(f"{' '.join(f'{key}={value}' for key, value in more.items())}{' ' if more else ''}{' '.join(command)}", flush=True)
    said = subprocess.run(command, env={**os.environ, **more}, capture_output=True, text=True, check=False)
    if said.returncode:
        print(said.stdout + said.stderr, file=sys.stderr)
        raise SystemExit("optimum: a limit is missed")
    return said.stdout


def main() -> int:
    periods = sys.argv[1] if len(sys.argv) > 1 else "10000000"
    test = ["cargo", "test", "--quiet", "--locked"]
    rows = ROW.findall(run([*test, "-p", "motion", "--test", "optimum", "--", "--nocapture"]))
    if len(rows) < 20:
        raise SystemExit(f"optimum: only {len(rows)} paths were compared")
    name, ratio = max(((name.strip(), float(ratio)) for name, _, _, ratio in rows), key=lambda row: row[1])
    print(f"  {len(rows)} paths of different character: at most {ratio:.4f} of the optimum ({name}); not above {ANY}, single moves from rest to rest {SINGLE}")
    for line in run([*test, "-p", "motion", "--test", "stroke", "--", "--nocapture"]).splitlines():
        if "Ruckig" in line:
            print(f"  {line}; not above {SINGLE}")
    for line in run([*test, "-p", "station", "--test", "setpoints", "--", "--nocapture"], PERIODS=periods).splitlines():
        if "servo periods" in line:
            print(f"  {line}; no drift at all")
    return 0


if __name__ == "__main__":
    sys.exit(main())
