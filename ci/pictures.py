#!/usr/bin/env python3
"""Makes the pictures of the documents with the program itself.

    ci/pictures.py            writes them
    ci/pictures.py --check    says which would change, and exits with 1 if any would
"""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAYERS = ["--offset", "1=5", "--layers", "programmed,compensated,tool"]
COMPENSATION = ["start", "start-inside", "inside", "outside", "outside-arc", "arcs", "cancel", "slot", "inner-arc"]
REFUSED = {"slot", "inner-arc"}

# The picture, the program and how it is run, the exit code.
PICTURES = [("docs/plate.svg", ["examples/plate.nc", "--setup", "examples/plate.setup.toml"], 0)]
PICTURES += [
    (f"docs/compensation/{name}.svg", [f"examples/compensation/{name}.nc", *LAYERS], int(name in REFUSED))
    for name in COMPENSATION
]
PICTURES += [
    ("docs/compensation/start-b.svg",
     ["examples/compensation/start.nc", "--policy", "compensation-start=b", *LAYERS], 0),
]

MOTION = "examples/motion"
DRIVEN = ["--layers", "programmed,actual"]
MOTION_PICTURES = {
    "speed": ["pocket.nc", "--layers", "speed", "--view", "plan"],
    "square": ["square.nc", "--chart"],
    "tolerance": ["corner.nc", "--machine", f"{MOTION}/tolerance.toml", *DRIVEN],
    "classic-corner": ["corner.nc", "--machine", f"{MOTION}/classic.toml", *DRIVEN, "--view", "plan"],
    "classic-arcs": [
        "rounded.nc", "--machine", f"{MOTION}/classic.toml", *DRIVEN, "--view", "plan", "--exaggerate", "25",
    ],
    "classic-short": ["short.nc", "--machine", f"{MOTION}/slow.toml", "--chart"],
}
PICTURES += [
    (f"docs/motion/{name}.svg", [f"{MOTION}/{program}", *arguments], 0)
    for name, (program, *arguments) in MOTION_PICTURES.items()
]
PICTURES += [
    ("docs/builders-logic/index-table.svg",
     ["examples/builders-logic/index-table.nc", "--machine", "index-table", "--timing", "--during", "0.8,2.2"], 0),
]
# The pages that show them, but for the plate's, which is the README's.
PAGES = ["docs/builders-logic.md", "docs/compensation.md", "docs/motion.md"]


def drawn(arguments: list[str], code: int) -> bytes:
    """The picture as the program draws it today."""
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.svg"
        command = ["cargo", "run", "--quiet", "--locked", "-p", "cyclestart", "--", "plot", *arguments, "-o", str(picture)]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode != code:
            sys.exit(f"{' '.join(command)}: exit code {done.returncode}, not {code}\n{done.stderr}")
        return picture.read_bytes()


def pictures_of(page: str) -> list[str]:
    """The pictures that a page shows."""
    return [part.split(")")[0] for part in page.split("](")[1:] if part.split(")")[0].endswith(".svg")]


def main() -> int:
    check = "--check" in sys.argv[1:]
    faults = []
    for name, arguments, code in PICTURES:
        path = ROOT / name
        picture = drawn(arguments, code)
        if path.is_file() and path.read_bytes() == picture:
            continue
        if check:
            faults.append(f"{name} is not what the program draws: run ci/pictures.py")
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(picture)
    made = {name for name, _, _ in PICTURES}
    pages = [ROOT / page for page in PAGES if (ROOT / page).is_file()]
    shown = {f"docs/{picture}" for page in pages for picture in pictures_of(page.read_text(encoding="utf-8"))}
    folders = tuple(f"{page.relative_to(ROOT).with_suffix('')}/" for page in pages)
    lying = {str(path.relative_to(ROOT)) for path in ROOT.glob("docs/**/*.svg")}
    faults += [f"{name} is shown, and nothing makes it" for name in sorted(shown - made)]
    faults += [f"{name} is shown by no page" for name in sorted(made - shown) if name.startswith(folders)]
    faults += [f"{name} is made by no command of ci/pictures.py" for name in sorted(lying - made)]
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
