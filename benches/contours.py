#!/usr/bin/env python3
"""Tool radius compensation on random contours: by its own definition, beside another program's offsets, by exact arithmetic.

    benches/contours.py [CONTOURS]      1,000,000 if not said otherwise (an hour and more); exit code 1 if one is wrong

The tests fail by themselves at the first contour that is wrong; this prints what they saw.
"""
import os
import subprocess
import sys

TESTS = ["compensation", "compensation_changes", "corner_points", "offset_oracle"]


def main() -> int:
    contours = sys.argv[1] if len(sys.argv) > 1 else "1000000"
    wrong = False
    for name in TESTS:
        command = ["cargo", "test", "--quiet", "--locked", "-p", "station", "--test", name, "--", "--nocapture"]
        print(f"CONTOURS={contours} {' '.join(command)}", flush=True)
        said = subprocess.run(command, env={**os.environ, "CONTOURS": contours}, capture_output=True, text=True, check=False)
        for line in said.stdout.splitlines():
            if line.strip() and not line.startswith("running") and set(line) != {"."}:
                print(f"  {line.strip().lstrip(".")}")
        if said.returncode:
            print(said.stderr, file=sys.stderr)
            wrong = True
    print("contours: none may be wrong" + (": one is" if wrong else "; none is"))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
