#!/usr/bin/env python3
"""How fast `check` turns a WHILE loop with trigonometry, a condition and a move in each turn.

    benches/macro_loop.py [RUNS]      5 if not said otherwise; exit code 1 if the limit is missed
"""
import statistics
import sys
import tempfile
from pathlib import Path

from measure import PROGRAM, needs_program, run

TURNS = 1_000_000
LEAST_TURNS_PER_SECOND = 1e6  # of CPU time, the whole process

PROGRAM_TEXT = """%
O0001
(MACRO LOOP)
G17 G21 G40 G49 G80 G90 G94
G54
S8000 M3
#100=0
#101=40.
F1500
WHILE[#100LT{turns}]DO1
#102=#100*0.36
#103=#101+10*SIN[#102*3]
#104=#103*COS[#102]
#105=#103*SIN[#102]
#106=0
IF[#105LE0]GOTO10
#106=SQRT[ABS[#104*#105]]/100
N10G1X#104Y#105Z[0-#106]
#100=#100+1
END1
G0 Z50.
M5
M30
%
"""


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "macro.nc"
        part.write_text(PROGRAM_TEXT.format(turns=TURNS), encoding="ascii")
        used = [run([str(PROGRAM), "check", str(part), "--machine", "unlimited"]) for _ in range(runs)]
    if any(one.code != 0 for one in used):
        print(f"macro_loop: a run failed: exit codes {[one.code for one in used]}", file=sys.stderr)
        return 1
    seconds = statistics.median(one.seconds for one in used)
    rate = TURNS / seconds
    print(f"cyclestart check MACRO --machine unlimited: {TURNS:,} turns of a loop of ten blocks, median of {runs} runs")
    print(f"  {rate / 1e6:.2f} M turns per CPU second ({seconds:.3f} s); at least {LEAST_TURNS_PER_SECOND / 1e6:.2f} M")
    missed = rate < LEAST_TURNS_PER_SECOND
    if missed:
        print("macro_loop: the limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
