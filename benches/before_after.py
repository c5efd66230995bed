#!/usr/bin/env python3
"""Whether a change has cost speed: an older build and the present one, by turns, on the same programs.

    benches/before_after.py BEFORE [RUNS]      BEFORE is the older program; 9 runs if not said otherwise; exit code 1 if
                                               the present one needs more than LIMIT times the CPU time

The older program: git worktree add /tmp/before COMMIT && make -C /tmp/before fast
"""
import statistics
import sys
import tempfile
from pathlib import Path

import drill
import macro_loop
import surface
from measure import PROGRAM, needs_program, run

LIMIT = 1.10  # two shared cores differ by so much from run to run
BLOCKS, HOLES, TURNS = 500_000, 100_000, 500_000


def write(folder: Path) -> list[Path]:
    parts = [folder / name for name in ("surface.nc", "drill.nc", "macro.nc")]
    with parts[0].open("w", encoding="ascii") as out:
        surface.write(BLOCKS, "fanuc", out)
    with parts[1].open("w", encoding="ascii") as out:
        drill.write(HOLES, out)
    parts[2].write_text(macro_loop.PROGRAM_TEXT.format(turns=TURNS), encoding="ascii")
    return parts


def main() -> int:
    needs_program()
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    before, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 9
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        for part in write(Path(folder)):
            arguments = ["check", str(part), "--machine", "unlimited"]
            pairs = [(run([before, *arguments]), run([str(PROGRAM), *arguments])) for _ in range(runs)]
            if any(one.code != 0 for pair in pairs for one in pair):
                print(f"before_after: a run of {part.name} failed", file=sys.stderr)
                return 1
            old, new = (statistics.median(pair[side].seconds for pair in pairs) for side in (0, 1))
            ratio = statistics.median(pair[1].seconds / pair[0].seconds for pair in pairs)
            print(f"cyclestart check {part.name} --machine unlimited: median of {runs} pairs, one core")
            print(f"  before {old:.3f} s, now {new:.3f} s of CPU time; ratio {ratio:.2f}, at most {LIMIT:.2f}")
            missed |= ratio > LIMIT
    if missed:
        print("before_after: the change has cost speed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
