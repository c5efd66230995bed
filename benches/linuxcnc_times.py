#!/usr/bin/env python3
"""Cycle times beside LinuxCNC 2.9 in simulation, on the programs it was timed with: servo period 1 ms, axes of 200 mm/s and
500 mm/s², corner tolerance 0.01 mm. Its times were measured once and stand in the table below, with up to 0.1 s of latency.

    benches/linuxcnc_times.py      exit code 1 if a limit is missed
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import PROGRAM, needs_program

PERIOD_S = 0.001
CURVE_OPTIMUM_S = 7.06  # of the smooth curve, on a grid of 20,000 points
MACHINE = 'name = "beside-linuxcnc"\n' + "".join(
    f'\n[axes.{axis}]\nkind = "linear"\ntravel = [-1000.0, 1000.0]\nrapid = 12000.0\nmax_feed = 12000.0\nacceleration = 500.0\n'
    for axis in "XYZ"
) + "\n[path]\ncorner_tolerance = 0.01\n\n[functions]\nfin_time = 0.0\n"


def line(f: int) -> list[str]:
    return [f"G64 G01 X200. F{f}"]


def square(times: int, mode: str) -> list[str]:
    return [f"{mode} G01 F3000", *["X20.", "Y20.", "X0", "Y0"] * times]


def slot(times: int) -> list[str]:
    """Four lines and four arcs of radius 10, 714.2 mm in all."""
    side = (714.2 / times - 2 * math.pi * 10) / 4
    return ["G64 G91 F4000", *[f"G01 X{side:.3f}", "G03 X10. Y10. I0 J10.", f"G01 Y{side:.3f}", "G03 X-10. Y10. I-10. J0",
            f"G01 X-{side:.3f}", "G03 X-10. Y-10. I0 J-10.", f"G01 Y-{side:.3f}", "G03 X10. Y-10. I10. J0"] * times]


def sine(chords: int, mode: str) -> list[str]:
    return [f"{mode} G01 F6000", *(f"X{index / 10:.1f} Y{3 * math.sin(index / 20):.4f}" for index in range(1, chords + 1))]


# Name, program, LinuxCNC's seconds, stops (one servo period each is allowed).
ROWS = [
    ("200 mm at F6000", line(6000), 2.20, 1),
    ("10 times round a 20 mm square at F3000, exact stop", square(10, "G61"), 20.48, 40),
    ("the same within the tolerance", square(10, "G64"), 20.02, 1),
    ("5 times round a slot of lines and arcs at F4000", slot(5), 11.40, 1),
    ("2001 chords of y = 3 sin(x/2) at F6000", sine(2001, "G64"), 8.03, 1),
    ("the first 500 of them, exact stop", sine(500, "G61"), 16.10, 500),
]


def seconds(blocks: list[str], folder: Path) -> float:
    """The cutting time of a program from (0, 0, 0), as `cyclestart time` says it."""
    program, machine = folder / "part.nc", folder / "machine.toml"
    program.write_text("\n".join(["O1", "G90 G17", *blocks, "M30", ""]), encoding="ascii")
    machine.write_text(MACHINE, encoding="utf-8")
    said = subprocess.run([str(PROGRAM), "time", "--json", "--machine", str(machine), str(program)], check=True,
                          capture_output=True, text=True)
    return json.loads(said.stdout)["cycle_time"]["cutting"]


def main() -> int:
    needs_program()
    print("cyclestart time --json --machine MACHINE PART: cutting time; LinuxCNC 2.9 in simulation, measured once")
    missed = False
    with tempfile.TemporaryDirectory() as name:
        for what, blocks, theirs, stops in ROWS:
            ours, limit = seconds(blocks, Path(name)), theirs + stops * PERIOD_S
            note = f", {100 * (ours / theirs - 1):+.1f} %"
            print(f"  {what}: {len(blocks)} lines, {ours:.3f} s, LinuxCNC {theirs:.2f} s{note}; at most {limit:.3f} s")
            missed |= ours > limit
        ours, limit = seconds(sine(2001, "G64"), Path(name)), 1.03 * CURVE_OPTIMUM_S
        print(f"  2001 chords beside their smooth curve's optimum of {CURVE_OPTIMUM_S} s: {ours:.3f} s; at most {limit:.3f} s")
        missed |= ours > limit
    if missed:
        print("linuxcnc_times: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
