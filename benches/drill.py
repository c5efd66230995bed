#!/usr/bin/env python3
"""How fast canned cycles run: generated moves a CPU second in `check`, events a CPU second in `trace`.

    benches/drill.py [RUNS]      5 if not said otherwise; exit code 1 if a limit is missed
"""
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import PROGRAM, needs_program, run

HOLES = 100_000
PLATE = (10, 20)  # rows and holes of a plate, 8 mm and 6 mm apart; plates in rows of ten
LEAST_MOVES_PER_SECOND = 3.0e6  # `check`, of CPU time (user and system), the whole process
LEAST_EVENTS_PER_SECOND = 1.0e6  # `trace`, written to nowhere
MOVES = (b'{"event":"rapid"', b'{"event":"feed"')


def write(holes: int, out) -> None:
    """Plates of holes, by turns drilled (G81, end at R) and pecked in five cuts (G83, end at the initial level)."""
    out.write("%\nO0001\n(PLATES)\nG17 G21 G40 G49 G80 G90 G94\nG54\nS3000 M03\nG00 Z50.\n")
    rows, columns = PLATE
    for hole in range(holes):
        plate, place = divmod(hole, rows * columns)
        row, column = divmod(place, columns)
        x, y = plate % 10 * 130 + column * 6, plate // 10 * 90 + row * 8
        if place == 0:
            cycle = "G98 G83 Z-18. R2. Q4. F180" if plate % 2 else "G99 G81 Z-6. R2. F250"
            out.write(f"{cycle} X{x}. Y{y}.\n")
        else:
            out.write(f"X{x}.\n" if column else f"X{x}. Y{y}.\n")
        if place == rows * columns - 1:
            out.write("G80\nG00 Z50.\n")
    out.write("G80\nG00 Z50.\nM05\nM30\n%\n")


def count(command: list[str]) -> tuple[int, int]:
    """Events of a trace, and how many of them are moves."""
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        lines = list(map(MOVES.__contains__, (line[: line.index(b",")] for line in process.stdout)))
    if process.returncode:
        raise SystemExit(f"drill: the trace ended with exit code {process.returncode}")
    return len(lines), sum(lines)


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drill.nc"
        with path.open("w", encoding="ascii") as out:
            write(HOLES, out)
        check, trace = ([str(PROGRAM), name, str(path), "--machine", "unlimited"] for name in ("check", "trace"))
        events, moves = count(trace)
        used = [(run(check), run(trace)) for _ in range(runs)]  # in turn, so that both meet the same weather
    if any(one.code != 0 for pair in used for one in pair):
        print(f"drill: a run failed: exit codes {[one.code for pair in used for one in pair]}", file=sys.stderr)
        return 1
    missed = False
    for index, (command, sample, what, least) in enumerate([
        ("cyclestart check DRILL --machine unlimited", moves, "generated moves", LEAST_MOVES_PER_SECOND),
        ("cyclestart trace DRILL --machine unlimited > /dev/null", events, "events", LEAST_EVENTS_PER_SECOND),
    ]):
        seconds = statistics.median(pair[index].seconds for pair in used)
        rate = sample / seconds
        print(f"{command}: {HOLES:,} holes, {sample:,} {what}, one core, median of {runs} runs")
        print(f"  {rate / 1e6:.2f} M {what} per CPU second ({seconds:.3f} s); at least {least / 1e6:.2f} M")
        missed |= rate < least
    if missed:
        print("drill: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
