"""Runs a command pinned to one core and says what it used."""
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

PROGRAM = Path(os.environ.get("CARGO_TARGET_DIR", "target")) / "release" / "cyclestart"


@dataclass
class Used:
    """What a process used: its exit code, CPU seconds, peak resident memory in MiB."""

    code: int
    seconds: float
    mib: float


def pin() -> None:
    """Keeps this process (a child before its program is loaded) on one core, where the system can."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def run(command: list[str], feed=None) -> Used:
    """Runs a command to its end, its output thrown away. `feed` writes its standard input."""
    source = subprocess.PIPE if feed else subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=source, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=pin)
    if feed:
        try:
            with process.stdin as pipe:
                feed(pipe)
        except BrokenPipeError:
            pass  # its exit code says why
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    # The unit of ru_maxrss is the system's.
    unit = 1 if os.uname().sysname == "Darwin" else 1024
    return Used(process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * unit / 2**20)


def needs_program() -> None:
    """Ends with a sentence if the program has not been built."""
    if not PROGRAM.is_file():
        raise SystemExit(f"{PROGRAM} is not there: run `make build` first")
