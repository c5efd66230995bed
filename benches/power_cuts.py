#!/usr/bin/env python3
"""The power is cut (SIGKILL) at random moments while programs are loaded, offsets, origins and variables written, and a program
runs and writes on its own. After every cut the memory must open; what standard output has said must be in it, and nothing by half.

    benches/power_cuts.py [CUTS] [--program FILE] [--seed N]      1,000 if not said otherwise; exit code 1 if anything is lost
"""
import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
from pathlib import Path

from measure import PROGRAM, needs_program

ACTIONS = 300  # of the operator in a round
LONGEST_S = 0.45  # a round that is not cut before ends by itself
PART = "O{name}\n(EDIT {mark})\n{body}M30\n"
# A piece: counts itself, and then writes the count into an offset, as so many thousandths.
COUNTING = "O9\n#500=#500+1\nG90 G10 P99 R[#500/1000]\nG91 G01 X0.01 F6000\nG01 X-0.01\nM30\n"


def part(name: int, mark: int) -> str:
    return PART.format(name=name, mark=mark, body=f"G91 G01 X0.{mark % 1000:03} F500\n" * (200 + mark % 300))


class Round:
    """A round's actions, each with the cell that it writes and the value; the values of one run of the bench differ all."""

    def __init__(self, folder: Path, marks, chance: random.Random):
        self.lines = ["reset", "mode memory"]
        self.writes = {}  # index of a line: cell, value
        for _ in range(ACTIONS):
            mark, what = next(marks), chance.randrange(12)
            if what < 4:
                self.write(("offsets", str(1 + mark % 40)), mark / 1000, f"offset {1 + mark % 40} = {mark / 1000}")
                self.lines.append(f"show offset {1 + mark % 40}")
            elif what < 6:
                self.write(("work", f"G{54 + mark % 6} Y"), mark / 1000, f"work G{54 + mark % 6} Y = {mark / 1000}")
                self.lines.append(f"show work G{54 + mark % 6}")
            elif what < 9:
                self.write(("variables", str(510 + mark % 40)), float(mark), f"variable {510 + mark % 40} = {mark}")
                self.lines += [f"show variable {510 + mark % 40}", "show program", "show modal"]
            elif what < 10:
                name = 1 + mark % 5
                (folder / f"{mark}.nc").write_text(part(name, mark), encoding="ascii")
                self.write(("programs", f"O{name}"), part(name, mark), f"load {folder}/{mark}.nc")
                self.lines.append("show program")
            else:
                self.lines += ["select O9", "cycle-start", "run until idle"]

    def write(self, cell, value, line: str) -> None:
        self.writes[len(self.lines)] = (cell, value)
        self.lines.append(line)


def kept(program: Path, memory: Path) -> dict:
    """What is in the memory, by an export; the run of it is itself the proof that it opens."""
    done = subprocess.run([program, "memory", "export", memory], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        raise Lost(f"the memory does not open: {done.stderr.decode()}")
    export = tomllib.loads(done.stdout.decode())
    cells = {(kind, name): float(value) for kind in ("offsets", "work", "variables") for name, value in export[kind].items()}
    cells |= {("programs", one["name"]): one["text"] for one in export.get("programs", [])}
    return {"cells": cells, "running": "running" in export["state"], "runs": export["history"]["runs"]}


class Lost(Exception):
    """What was acknowledged is not there, or something is there by half."""


def cut(command: list, live: bool, lines: list[str], after: float) -> list[dict]:
    """Runs the operator's lines and kills the process after so many seconds; the events on its standard output."""
    process = subprocess.Popen(command, stdin=subprocess.PIPE if live else subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL)
    said = []
    reader = threading.Thread(target=lambda: said.append(process.stdout.read()))
    reader.start()
    if live:
        threading.Thread(target=feed, args=(process.stdin, lines), daemon=True).start()
    time.sleep(after)
    process.kill()
    process.wait()
    reader.join()
    # The cut may have come in the middle of a line: only whole ones have been said.
    return [json.loads(line) for line in said[0].split(b"\n")[:-1]]


def feed(pipe, lines: list[str]) -> None:
    try:
        with pipe:
            for line in lines:
                pipe.write(line.encode() + b"\n")
                pipe.flush()
                time.sleep(0.001)
    except OSError:
        pass  # the power is off


def check(before: dict, after: dict, one: Round, said: list[dict]) -> int:
    """Holds what is there after a cut against what was said; how many writes had been acknowledged."""
    writes, now = one.writes, after["cells"]
    index = {(cell, value): at for at, (cell, value) in writes.items()}
    found = [index[cell, value] for cell, value in now.items() if (cell, value) in index]
    last = max(found, default=-1)
    model = dict(before["cells"])
    model.update(value for at, value in sorted(writes.items()) if at <= last)
    own = {("variables", "500"), ("offsets", "99")}
    differ = [cell for cell in model.keys() | now.keys() if cell not in own and model.get(cell) != now.get(cell)]
    if differ:
        cell = differ[0]
        raise Lost(f"{cell}: {str(now.get(cell))[:60]!r} is there, {str(model.get(cell))[:60]!r} should be (writes up to line {last})")
    acknowledged = acknowledged_line(one, said)
    if writes and acknowledged > last and any(last < at <= acknowledged for at in writes):
        raise Lost(f"line {acknowledged} was acknowledged, the memory ends with line {last}")
    told = {"variable": 0.0, "offset": 0.0}
    for event in said:
        if event["event"] == "set":
            for what in told:
                if event["what"].startswith(what):
                    told[what] = max(told[what], number(event["value"]))
    counts, offset = now.get(("variables", "500"), 0.0), now.get(("offsets", "99"), 0.0)
    if counts < told["variable"] or offset < told["offset"]:
        raise Lost(f"the program had said {told}, there is #500 = {counts}, offset 99 = {offset}")
    if round(offset * 1000) not in (counts - 1, counts):
        raise Lost(f"the program's own writes are out of order: #500 = {counts}, offset 99 = {offset}")
    began = sum(" begun" in line for line in after["runs"]) - sum(" begun" in line for line in before["runs"])
    if len(after["runs"]) < 900 and began < sum(event["event"] == "start" for event in said):
        raise Lost("a program's run that was said is not in the history")
    return sum(at <= acknowledged for at in writes)


def number(value) -> float:
    return max((number(one) for one in value.values()), default=0.0) if isinstance(value, dict) else float(value or 0)


def acknowledged_line(one: Round, said: list[dict]) -> int:
    """The last line of which something was said: the answers to `show` come in their order."""
    shows = [at for at, line in enumerate(one.lines) if line.startswith("show ")]
    shown = [event for event in said if event["event"] == "show"]
    for at, event in zip(shows, shown):
        if one.lines[at] != "show " + event["what"]:
            raise Lost(f"{one.lines[at]} was answered by {event}")
        cell, value = one.writes.get(at - 1, ((), None))
        if cell and cell[0] in ("offsets", "variables") and event["value"] != value:
            raise Lost(f"{one.lines[at]} showed {event['value']}, not {value}")
    return shows[len(shown) - 1] if shown else -1


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("cuts", nargs="?", type=int, default=1000)
    parser.add_argument("--program", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    if not asked.program:
        needs_program()
    program, chance = (asked.program or PROGRAM).resolve(), random.Random(asked.seed)
    written = interrupted = spoken = 0
    with tempfile.TemporaryDirectory() as name:
        folder, memory = Path(name), Path(name) / "memory"
        marks = iter(range(1, 10**9))
        (folder / "o9.nc").write_text(COUNTING, encoding="ascii")
        (folder / "first.txt").write_text(f"load {folder}/o9.nc\n", encoding="ascii")
        subprocess.run([program, "operate", folder / "first.txt", "--memory", memory], check=True)
        before = kept(program, memory)
        for count in range(1, asked.cuts + 1):
            one, live = Round(folder, marks, chance), count % 2 == 0
            script = folder / "script.txt"
            script.write_text("\n".join(one.lines) + "\n", encoding="ascii")
            command = [program, "operate", "-" if live else script, "--memory", memory, *(["--realtime"] if live else [])]
            after_s = chance.uniform(0, LONGEST_S)
            try:
                said = cut(command, live, one.lines, after_s)
                after = kept(program, memory)
                acknowledged = check(before, after, one, said)
                begins_with = said[0] if said else {}
                if before["running"] and said and (begins_with["event"], begins_with.get("name")) != ("alarm", "POWER"):
                    raise Lost(f"a program had been interrupted, and the next power-on began with {begins_with}")
            except Lost as lost:
                print(f"power cuts: after cut {count} ({' '.join(map(str, command[1:]))}, {after_s:.3f} s): {lost}", file=sys.stderr)
                keep = os.environ.get("POWER_CUTS_KEEP")
                if keep:
                    os.rename(memory, keep)
                return 1
            written, spoken, interrupted = written + acknowledged, spoken + bool(said), interrupted + after["running"]
            before = after
            for old in folder.glob("[0-9]*.nc"):
                old.unlink()
    print(f"cyclestart operate --memory, killed {asked.cuts:,} times (SIGKILL) at random moments, half of them by the clock with lines "
          f"typed while it runs; {ACTIONS} actions a round, seed {asked.seed}")
    print(f"  {written:,} writes had been acknowledged on standard output, {spoken:,} processes had spoken, {interrupted:,} cuts came in the "
          "middle of a program")
    print("  0 acknowledged writes lost, 0 written by half, the memory opened every time; limit: 0")
    return 0


if __name__ == "__main__":
    sys.exit(main())
