#!/usr/bin/env python3
"""Builds the program with the profile of its own runs: the compiler then knows which way blocks usually take.

    benches/fast.py [--quiet]      at target/fast/release/cyclestart; `make fast` calls it, and so does every bench

Two builds: one that counts, which runs programs of every kind in small; and one that uses the counts. Nothing is done
again while no source has changed.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import contour
import drill
import macro_loop
import part
import surface

TARGET = Path(os.environ.get("CARGO_TARGET_DIR", "target")).absolute()
COUNTING, FAST = TARGET / "counting", TARGET / "fast"
COUNTS = COUNTING / "counts.profdata"
BUILD = ["cargo", "build", "--release", "--locked", "--quiet"]
PROGRAM = ["-p", "cyclestart"]
# With the planner on its own, which benches/planner.py measures: the same crate, the same counts.
PROGRAM_AND_PLANNER = [*PROGRAM, "-p", "motion", "--bin", "cyclestart", "--example", "planner"]
# What an operator does while a part is cut, so that live execution is counted too.
SHIFT = """load {part} as O7000
mode memory
select O7000
offset 1 = 3
cycle-start
run for 2
override feed 60
run for 1
feed-hold
run for 1
cycle-start
override feed 150
run for 20
reset
"""
FREE = ["--machine", "unlimited", "--offset", "1=3"]


def merger() -> Path:
    """The compiler's own tool that adds counts up; fetched if rustup is here."""
    said = subprocess.run(["rustc", "-vV"], check=True, capture_output=True, text=True).stdout
    host = next(line.split()[1] for line in said.splitlines() if line.startswith("host:"))
    root = subprocess.run(["rustc", "--print", "sysroot"], check=True, capture_output=True, text=True).stdout.strip()
    tool = Path(root) / "lib" / "rustlib" / host / "bin" / "llvm-profdata"
    if not tool.is_file() and shutil.which("rustup"):
        subprocess.run(["rustup", "component", "add", "llvm-tools"], check=True)
    if not tool.is_file():
        raise SystemExit("the compiler's llvm-profdata is missing: rustup.rs installs Rust with `rustup component add llvm-tools`")
    return tool


def build(target: Path, flag: str, what: list[str]) -> Path:
    """Builds with a flag more, in a folder of its own."""
    flags = f"{os.environ.get('RUSTFLAGS', '')} {flag}".strip()
    subprocess.run([*BUILD, *what, "--target-dir", str(target)], check=True, env=dict(os.environ, RUSTFLAGS=flags))
    return target / "release" / "cyclestart"


def programs(folder: Path) -> list[Path]:
    """Parts of every kind, small: what takes part in a bench is never the part itself."""
    texts = {
        "surface": lambda out: surface.write(20_000, "fanuc", out),
        "contour": lambda out: contour.write(30_000, "fanuc", out),
        "holes": lambda out: drill.write(3_000, out),
        "loop": lambda out: out.write(macro_loop.PROGRAM_TEXT.format(turns=5_000)),
        "part": lambda out: part.write(out, finish=10_000),
    }
    paths = []
    for name, write in texts.items():
        paths.append(folder / f"{name}.nc")
        with paths[-1].open("w", encoding="ascii") as out:
            write(out)
    return paths


def train(program: Path, raw: Path) -> None:
    """Runs the counting program over everything that it does in bulk."""
    env = dict(os.environ, LLVM_PROFILE_FILE=str(raw / "%p-%m.profraw"))

    def go(*arguments: str) -> None:
        done = subprocess.run([str(program), *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=env)
        if done.returncode not in (0, 1):  # 1: an example that raises an alarm
            raise SystemExit(f"{' '.join(arguments)}: {done.stderr.decode()}")

    with tempfile.TemporaryDirectory() as folder:
        parts = programs(Path(folder))
        for path in parts:
            go("check", str(path), *FREE)
            go("trace", str(path), *FREE)
        for path in parts:
            go("run", str(path), *FREE)
        for path in parts:
            script = path.with_suffix(".txt")
            script.write_text(SHIFT.format(part=path), encoding="ascii")
            go("operate", str(script), *FREE[:2])
        go("plot", str(parts[0]), *FREE, "-o", f"{folder}/part.svg")
    for example in sorted(Path("examples").rglob("*.nc")):
        for command in ("check", "trace", "run"):
            go(command, str(example))


def main() -> int:
    tool = merger()
    quiet = "--quiet" in sys.argv[1:]
    if not quiet:
        print("fast: two builds and a trial run between them, some minutes the first time", flush=True)
    counting = build(COUNTING, f"-Cprofile-generate={COUNTING}/raw", PROGRAM)
    if not COUNTS.is_file() or COUNTS.stat().st_mtime < counting.stat().st_mtime:
        raw = COUNTING / "raw"
        shutil.rmtree(raw, ignore_errors=True)
        train(counting, raw)
        subprocess.run([str(tool), "merge", "-o", str(COUNTS), str(raw)], check=True)
        shutil.rmtree(raw)
        # What was built with the counts before is to be built again.
        shutil.rmtree(FAST, ignore_errors=True)
    program = build(FAST, f"-Cprofile-use={COUNTS}", PROGRAM_AND_PLANNER)
    if not quiet:
        print(f"fast: {program}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
