"""Runs a command pinned to one core and says what it used."""
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

PROGRAM = Path(os.environ.get("CARGO_TARGET_DIR", "target")) / "fast" / "release" / "cyclestart"
LOOK_EVERY_S = 0.005


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


def peak_mib(pid: int) -> float:
    """The process's peak so far, from Linux's own account; 0 before its program is loaded and once it has ended.

    What the system reports at the end (ru_maxrss) will not do: it counts this very script, from which the process came.
    """
    try:
        if os.readlink(f"/proc/{pid}/exe") == os.readlink("/proc/self/exe"):
            return 0.0
        status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    except OSError:
        return 0.0
    found = re.search(r"^VmHWM:\s*(\d+) kB", status, re.MULTILINE)
    return int(found.group(1)) / 1024 if found else 0.0


def feed_all(feed, pipe) -> None:
    try:
        with pipe:
            feed(pipe)
    except BrokenPipeError:
        pass  # the exit code says why


def run(command: list[str], feed=None) -> Used:
    """Runs a command to its end, its output thrown away. `feed` writes its standard input."""
    source = subprocess.PIPE if feed else subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=source, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=pin)
    if feed:
        threading.Thread(target=feed_all, args=(feed, process.stdin)).start()
    mib = 0.0
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        mib = max(mib, peak_mib(process.pid))
        time.sleep(LOOK_EVERY_S)
    process.returncode = os.waitstatus_to_exitcode(status)
    return Used(process.returncode, usage.ru_utime + usage.ru_stime, mib)


@dataclass
class Bars:
    """What a bench of `check` is held against."""

    blocks: int
    least_per_second: float  # of CPU time, the whole process
    most_mib: float


def beside_peer(name: str, write, bars: Bars, runs: int, arguments: list[str]) -> bool:
    """Checks a program of so many blocks, beside LinuxCNC's interpreter if it is here; prints it; whether a limit is missed.

    `write` writes the program in one of both spellings to a text stream.
    """
    with tempfile.TemporaryDirectory() as folder:
        parts = {spelling: Path(folder) / f"part.{spelling}.nc" for spelling in ("fanuc", "rs274")}
        for spelling, path in parts.items():
            with path.open("w", encoding="ascii") as out:
                write(spelling, out)
        ours = [str(PROGRAM), "check", str(parts["fanuc"]), *arguments]
        peer = ["rs274", "-g", str(parts["rs274"]), "/dev/null"] if shutil.which("rs274") else None
        used, peers = [], []
        for _ in range(runs):  # in turn, so that both meet the same weather
            used.append(run(ours))
            if peer:
                peers.append(run(peer))
    if any(one.code != 0 for one in used + peers):
        print(f"{name}: a run failed: exit codes {[one.code for one in used + peers]}", file=sys.stderr)
        return True
    seconds, mib = statistics.median(one.seconds for one in used), max(one.mib for one in used)
    rate = bars.blocks / seconds
    print(f"cyclestart check {name} {' '.join(arguments)}: {bars.blocks:,} blocks, one core, median of {runs} runs")
    print(f"  {rate / 1e6:.2f} M blocks per CPU second ({seconds:.3f} s); at least {bars.least_per_second / 1e6:.2f} M")
    print(f"  {mib:.1f} MiB at its peak; less than {bars.most_mib:.0f} MiB")
    if peers:
        other = statistics.median(one.seconds for one in peers)
        print(f"  LinuxCNC's rs274 -g on the same part: {bars.blocks / other / 1e6:.2f} M blocks per CPU second ({other:.3f} s)")
        print(f"  ratio of medians: {other / seconds:.2f} times as fast")
    else:
        print("  rs274 is not here to compare with: apt-get install -y --no-install-recommends linuxcnc-uspace")
    return rate < bars.least_per_second or mib >= bars.most_mib


def needs_program() -> None:
    """Builds the program as `make fast` does, if it is not there or a source has changed since."""
    subprocess.run([sys.executable, str(Path(__file__).with_name("fast.py")), "--quiet"], check=True)
