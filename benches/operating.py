#!/usr/bin/env python3
"""Every action of the operator in every state of the control, held against the table of docs/operating.md.

    benches/operating.py      exit code 1 if a pair is answered otherwise than the page says
"""
import subprocess
import sys


def main() -> int:
    command = ["cargo", "test", "--quiet", "--locked", "-p", "cyclestart", "--test", "operating", "--", "--nocapture"]
    print(" ".join(command), flush=True)
    said = subprocess.run(command, capture_output=True, text=True, check=False)
    for line in said.stdout.splitlines():
        if " pairs of " in line:
            print(f"  {line.strip().lstrip('.')}")
    print(f"  {'none' if said.returncode == 0 else 'some'} answered otherwise than the page says; none may be")
    if said.returncode:
        print(said.stderr, file=sys.stderr)
    return said.returncode


if __name__ == "__main__":
    sys.exit(main())
