#!/usr/bin/env python3
"""How fast `check` reads a surface finishing program of a million blocks, beside LinuxCNC's interpreter if it is here.

    benches/check_surface.py [RUNS]      5 if not said otherwise; exit code 1 if a limit is missed
"""
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

import surface
from measure import PROGRAM, needs_program, run

BLOCKS = 1_000_000
LEAST_BLOCKS_PER_SECOND = 1.5e6  # of CPU time, the whole process
MOST_MIB = 32.0


def main() -> int:
    needs_program()
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory() as folder:
        parts = {spelling: Path(folder) / f"surface.{spelling}.nc" for spelling in ("fanuc", "rs274")}
        for spelling, path in parts.items():
            with path.open("w", encoding="ascii") as out:
                surface.write(BLOCKS, spelling, out)
        ours = [str(PROGRAM), "check", str(parts["fanuc"]), "--machine", "unlimited"]
        peer = ["rs274", "-g", str(parts["rs274"]), "/dev/null"] if shutil.which("rs274") else None
        used, peers = [], []
        for _ in range(runs):  # in turn, so that both meet the same weather
            used.append(run(ours))
            if peer:
                peers.append(run(peer))
    if any(one.code != 0 for one in used + peers):
        print(f"check_surface: a run failed: exit codes {[one.code for one in used + peers]}", file=sys.stderr)
        return 1
    seconds, mib = statistics.median(one.seconds for one in used), max(one.mib for one in used)
    rate = BLOCKS / seconds
    print(f"cyclestart check SURFACE --machine unlimited: {BLOCKS:,} blocks, one core, median of {runs} runs")
    print(f"  {rate / 1e6:.2f} M blocks per CPU second ({seconds:.3f} s); at least {LEAST_BLOCKS_PER_SECOND / 1e6:.2f} M")
    print(f"  {mib:.1f} MiB at its peak; less than {MOST_MIB:.0f} MiB")
    if peers:
        other = statistics.median(one.seconds for one in peers)
        print(f"  LinuxCNC's rs274 -g on the same part: {BLOCKS / other / 1e6:.2f} M blocks per CPU second ({other:.3f} s)")
        print(f"  ratio of medians: {other / seconds:.2f} times as fast")
    else:
        print("  rs274 is not here to compare with: apt-get install -y --no-install-recommends linuxcnc-uspace")
    missed = rate < LEAST_BLOCKS_PER_SECOND or mib >= MOST_MIB
    if missed:
        print("check_surface: a limit is missed", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
