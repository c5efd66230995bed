#!/usr/bin/env python3
"""How right the time left is that `run` shows on a terminal: on every program, at every picture after the first tenth.

    benches/progress.py [SECONDS]      programs of about so long a run each, 12 if not said otherwise; exit code 1 if the limit is missed
    benches/progress.py weights        the CPU time of each program and what it is made of, for the weights of a forecast

The run is given a terminal, and what it writes there is read as it comes. Time left is by the clock on the wall. What
else the computer does is no fault of the forecast: where the process had less than 97 % of the wall's time, its own CPU
time is the clock, and the time left is judged as the part of the run that it stands for.
"""
import json
import os
import pty
import re
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import contour
import drill
import macro_loop
import part
import surface
from measure import PROGRAM, needs_program, pin

MOST_OFF = 0.05  # of all the time that the run takes
FROM = 0.1  # of it
ARGUMENTS = ["--machine", "unlimited", "--offset", "1=3"]
SHOWN = re.compile(rb"(\d+) % .*? (?:(\d+):(\d\d) (h|min)|([\d.]+) s) left")
COUNTS = b"counting what is to do"
TICKS = os.sysconf("SC_CLK_TCK")


def mixed(size: int, out) -> None:
    """Holes, contours, pockets, then short cuts: what costs little first, what costs much last."""
    out.write("%\nO0001\nG17 G21 G40 G49 G80 G90 G94\nG54\n")
    for _ in range(max(1, size // 40_000)):
        part.holes(out)
        part.pockets(out)
        part.contours(out)
    part.finishing(size, out)
    out.write("M30\n%\n")


def pockets(size: int, out) -> None:
    out.write("%\nO0001\nG17 G21 G40 G49 G80 G90 G94\nG54\n")
    for _ in range(max(1, size // 3_300)):
        part.pockets(out)
    out.write("M30\n%\n")


def loop(size: int, out) -> None:
    out.write(macro_loop.PROGRAM_TEXT.format(turns=size))


PROGRAMS = {
    "surface": lambda size, out: surface.write(size, "fanuc", out),
    "pockets": pockets,
    "drill": drill.write,
    "contours": lambda size, out: contour.write(size, "fanuc", out),
    "macro": loop,
    "mixed": mixed,
}
# Parts that grow with their blocks: more of them do not lie within the numbers that the control can hold.
LARGEST = {"contours": 1_000_000, "drill": 2_000_000}


@dataclass
class Picture:
    """A time left as shown: seconds, on the wall and in CPU time of the process when it was shown."""

    left: float
    wall: float
    cpu: float


def cpu_of(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def watch(command: list[str]) -> tuple[list[Picture], float, float]:
    """Runs a command on a terminal: what it showed, that it counts first of all, and when it had ended by either clock."""
    terminal, theirs = pty.openpty()
    begun = time.monotonic()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "120"}
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=theirs,
                               preexec_fn=pin, env=environment)
    os.close(theirs)
    pictures, cpu = [], 0.0
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    while True:
        try:
            text = os.read(terminal, 65536)
        except OSError:
            break
        if not text:
            break
        if COUNTS in text and not pictures:
            pictures.append(Picture(0.0, time.monotonic() - begun, cpu_of(process.pid)))
        found = SHOWN.findall(text)
        if found:
            _, high, low, unit, seconds = found[-1]
            left = float(seconds) if seconds else (int(high) * 60 + int(low)) * (60 if unit == b"h" else 1)
            pictures.append(Picture(left, time.monotonic() - begun, cpu_of(process.pid)))
    code = process.wait()
    wall = time.monotonic() - begun
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if code != 0:
        raise SystemExit(f"progress: {' '.join(command)} ended with exit code {code}")
    return pictures, wall, cpu


def judge(pictures: list[Picture], wall: float, cpu: float) -> tuple[float, float, float, str]:
    """How far off the forecasts of the whole run are at worst, at the first and on average after the first tenth."""
    counts, first, *_ = pictures
    # Counting is no part of the run that is forecast: it lasts from the picture that says so to the next one.
    counting_wall, counting_cpu = first.wall - counts.wall, first.cpu - counts.cpu
    total_wall, total_cpu = wall - counting_wall, cpu - counting_cpu
    busy = total_cpu < 0.97 * total_wall
    off = []
    for picture in pictures[1:]:
        spent_wall = picture.wall - counting_wall
        spent, total = (picture.cpu - counting_cpu, total_cpu) if busy else (spent_wall, total_wall)
        if spent >= FROM * total:
            off.append((spent + picture.left * spent / spent_wall - total) / total)
    worst = max(off, key=abs)
    return worst, off[0], sum(map(abs, off)) / len(off), "CPU time" if busy else "the wall's clock"


def size_for(write, seconds: float, path: Path) -> int:
    """How large a program is that runs about so long."""
    size = 20_000
    while True:
        with path.open("w", encoding="ascii") as out:
            write(size, out)
        before = time.monotonic()
        subprocess.run([str(PROGRAM), "run", str(path), *ARGUMENTS], stdout=subprocess.DEVNULL, check=True, preexec_fn=pin)
        took = time.monotonic() - before
        if took > 1.0:
            return int(size * seconds / took)
        size *= 4


def weights(folder: Path) -> None:
    """CPU time of each program, and what it is made of: from these the weights in crates/cli/src/progress.rs."""
    for name, write in PROGRAMS.items():
        path = folder / f"{name}.nc"
        with path.open("w", encoding="ascii") as out:
            write(200_000, out)
        best = float("inf")
        for _ in range(3):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            subprocess.run([str(PROGRAM), "run", str(path), *ARGUMENTS], stdout=subprocess.DEVNULL, check=True)
            best = min(best, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        done = subprocess.run([str(PROGRAM), "run", str(path), "--json", *ARGUMENTS], stdout=subprocess.PIPE, check=True)
        trace = subprocess.run(f"{PROGRAM} trace {path} {' '.join(ARGUMENTS)} | cut -d, -f1 | sort | uniq -c", shell=True,
                               stdout=subprocess.PIPE, check=True, text=True).stdout
        kinds = {line.split('"')[3]: int(line.split()[0]) for line in trace.splitlines()}
        blocks = json.loads(done.stdout)["blocks"]
        print(f"{name}: {best:.3f} s of CPU time, {blocks:,} blocks, " + ", ".join(f"{n:,} {kind}" for kind, n in kinds.items()))


def main() -> int:
    needs_program()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.nc"
        if sys.argv[1:] == ["weights"]:
            weights(Path(folder))
            return 0
        seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 12.0
        missed = False
        print(f"cyclestart run PART {' '.join(ARGUMENTS)}, on a terminal: time left after the first tenth of the run")
        for name, write in PROGRAMS.items():
            size = size_for(write, seconds, path)
            pieces = 1 + size // LARGEST.get(name, size + 1)
            with path.open("w", encoding="ascii") as out:
                write(size // pieces, out)
            pictures, wall, cpu = watch([str(PROGRAM), "run", str(path), *ARGUMENTS, "--repeat", str(pieces)])
            if len(pictures) < 2:
                print(f"  {name}: no time left was shown", file=sys.stderr)
                missed = True
                continue
            worst, first, mean, clock = judge(pictures, wall, cpu)
            print(f"  {name}: {len(pictures) - 1} times shown in {wall:.1f} s, the first after {pictures[1].wall:.1f} s; off by at most "
                  f"{worst:+.1%}, at the first tenth {first:+.1%}, on average {mean:.1%} of the run, by {clock}; at most {MOST_OFF:.0%}")
            missed |= abs(worst) > MOST_OFF
    if missed:
        print("progress: the limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
