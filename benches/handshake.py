#!/usr/bin/env python3
"""Holds the handshake against its hand-drawn charts: the edges of every line, and where moves end.

    benches/handshake.py [PROGRAM]      the program; one is built if none is given

A chart stands in the comment of a case (cases/*/chart-*/case.toml): a row of times, and under them a row for each line or
for several alike, `/` where it turns on, `\\` where it turns off, `X` off and on again; `|` in the row `motion` is the end of
a move. Every edge that is drawn must be in the trace, every edge in the trace must be drawn, and none may be off by
more than one servo period.
"""
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEAD = "# chart, s"
SERVO_PERIOD = 0.001  # s, that of a machine file without the key
ON_AND_OFF = {"/": [True], "\\": [False], "X": [False, True]}
MOVES = {"rapid", "feed", "arc"}


def drawn(text: str) -> dict[str, list[tuple[float, bool]]]:
    """The edges of a chart by the name of their line; the ends of moves are edges of `motion`."""
    lines = text[text.index(HEAD):].splitlines()
    times = {match.start(): float(match.group()) for match in re.finditer(r"[\d.]+", lines[0])}
    first = min(times)
    edges: dict[str, list[tuple[float, bool]]] = {}
    for line in lines[1:]:
        names, marks = line[1:first].split(), line
        for column, time in times.items():
            mark = marks[column] if column < len(marks) else " "
            for name in names:
                of_line = edges.setdefault(name, [])
                if name == "motion":
                    of_line += [(time, True)] if mark == "|" else []
                else:
                    of_line += [(time, on) for on in ON_AND_OFF.get(mark, [])]
        if any(mark in ON_AND_OFF and column not in times for column, mark in enumerate(marks) if column >= first):
            sys.exit(f"an edge stands under no time: {line}")
    return edges


def traced(program: str, folder: Path, case: dict) -> dict[str, list[tuple[float, bool]]]:
    """The edges that the program tells."""
    run = case.get("run", "trace")
    file = case.get("file", "script.txt" if run == "operate" else "in.nc")
    command = [program, run, file, *case.get("arguments", [])]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode != case.get("exit", 0):
        sys.exit(f"{folder.name}: exit code {done.returncode}\n{done.stderr}")
    edges: dict[str, list[tuple[float, bool]]] = {}
    for line in done.stdout.splitlines():
        event = json.loads(line)
        if event["event"] == "signal":
            edges.setdefault(event["name"], []).append((event["time"], event["on"]))
        elif event["event"] in MOVES:
            edges.setdefault("motion", []).append((event["time"], True))
    return edges


def build() -> str:
    subprocess.run(["cargo", "build", "--quiet", "--locked", "-p", "cyclestart"], cwd=ROOT, check=True)
    return str(ROOT / "target/debug/cyclestart")


def main() -> int:
    program = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else build()
    faults, count, greatest, charts = [], 0, 0.0, 0
    for path in sorted(ROOT.glob("cases/*/*/case.toml")):
        text = path.read_text(encoding="utf-8")
        if HEAD not in text:
            if path.parent.name.startswith("chart-"):
                faults.append(f"{path.parent.name}: has no chart")
            continue
        wanted, found = drawn(text), traced(program, path.parent, tomllib.loads(text))
        charts, of_case, worst = charts + 1, 0, 0.0
        for name in sorted(wanted.keys() | found.keys()):
            by_hand, seen = wanted.get(name, []), found.get(name, [])
            if [on for _, on in by_hand] != [on for _, on in seen]:
                faults.append(f"{path.parent.name}: {name} is drawn {by_hand}, and told {seen}")
                continue
            off = [abs(a - b) for (a, _), (b, _) in zip(by_hand, seen)]
            of_case += len(off)
            worst = max([worst, *off])
        count, greatest = count + of_case, max(greatest, worst)
        print(f"{path.parent.name:32} {of_case:4} edges, greatest deviation {worst * 1e6:.3f} us")
        if worst > SERVO_PERIOD:
            faults.append(f"{path.parent.name}: off by {worst} s")
    print(f"{charts} charts, {count} edges compared, greatest deviation {greatest * 1e6:.3f} us; limit 1000 us (one servo period)")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults or not count else 0


if __name__ == "__main__":
    sys.exit(main())
