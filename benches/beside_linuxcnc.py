#!/usr/bin/env python3
"""Tool radius compensation beside LinuxCNC's interpreter: the same corners and contours, and where the paths differ, why.

    benches/beside_linuxcnc.py      exit code 1 if a path differs where no rule of the control says so

Corners: line, left and right arc by the same, six angles, after M96 and M97. Contours: those of benches/contour.py.
"""
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import contour
from measure import PROGRAM, needs_program

RADIUS = contour.RADIUS
ALIKE = 1.5e-4  # mm: LinuxCNC prints four decimals
CONTOURS = 4
BOW = 25  # radius of the arcs, mm
KINDS = ("line", "left arc", "right arc")
# Where the path goes on behind the corner, having come along +X, and what the corner is to a tool on its left.
HEADINGS = {"tangent": (1.0, 0.0), "inside": (0.6, 0.8), "sharp inside": (-0.6, 0.8), "outside": (0.6, -0.8),
            "square outside": (0.0, -1.0), "sharp outside": (-0.6, -0.8)}

WHY_CORNER = "M97 joins the offset lines in a point, or in two where they turn by more than a right angle; LinuxCNC goes round, as M96 does"
WHY_SHALLOW = "LinuxCNC makes no corner where the path turns by less than 0.05 radians, but ends square to the line before it"
SHALLOW = 0.05
WHY_START = "start-up ends square to the next element; LinuxCNC's ends square to the way in and goes round a corner from there"


@dataclass
class Piece:
    """A straight or round piece of the tool's way in XY."""

    start: tuple
    end: tuple
    centre: tuple | None = None
    ccw: bool = False

    def distance(self, point: tuple) -> float:
        ends = min(math.dist(point, self.start), math.dist(point, self.end))
        if self.centre is None:
            way = (self.end[0] - self.start[0], self.end[1] - self.start[1])
            along = (point[0] - self.start[0]) * way[0] + (point[1] - self.start[1]) * way[1]
            square = way[0] ** 2 + way[1] ** 2
            if not 0 < along < square:
                return ends
            share = along / square
            return math.dist(point, (self.start[0] + way[0] * share, self.start[1] + way[1] * share))
        first, last, here = (math.atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end, point))
        turn = 1 if self.ccw else -1
        if (here - first) * turn % math.tau > (last - first) * turn % math.tau:
            return ends
        return min(ends, abs(math.dist(point, self.centre) - math.dist(self.start, self.centre)))

    def points(self) -> list:
        """Its end, and of an arc a point on the way."""
        if self.centre is None:
            return [self.end]
        first, last = (math.atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end))
        turn = 1 if self.ccw else -1
        angle = first + (last - first) * turn % math.tau / 2 * turn
        radius = math.dist(self.start, self.centre)
        return [(self.centre[0] + radius * math.cos(angle), self.centre[1] + radius * math.sin(angle)), self.end]


def ours(text: str, folder: Path) -> list:
    """Our path: pieces, each with the number of its line; an alarm is a sentence at the end."""
    part = folder / "ours.nc"
    part.write_text(text, encoding="ascii")
    command = [str(PROGRAM), "trace", str(part), "--machine", "unlimited", "--offset", f"1={RADIUS}"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    pieces, at = [], (0.0, 0.0)
    for event in map(json.loads, done.stdout.splitlines()):
        if event["event"] == "alarm":
            pieces.append((event.get("line"), f"alarm {event.get('name', event.get('condition'))}"))
        if event["event"] not in ("rapid", "feed", "arc"):
            continue
        end = (event["to"]["x"], event["to"]["y"])
        centre = (event["center"]["x"], event["center"]["y"]) if event["event"] == "arc" else None
        pieces.append((event["line"], Piece(at, end, centre, event.get("sweep", 0) > 0)))
        at = end
    return pieces


def theirs(text: str, folder: Path) -> list:
    """LinuxCNC's canonical moves; an error is a sentence at the end."""
    part = folder / "theirs.ngc"
    part.write_text(text, encoding="ascii")
    done = subprocess.run(["rs274", "-g", str(part)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, text=True)
    pieces, at = [], (0.0, 0.0)
    for name, words in re.findall(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED)\(([^)]*)\)", done.stdout):
        values = [float(word) for word in words.split(",")]
        arc = name == "ARC_FEED"
        pieces.append(Piece(at, (values[0], values[1]), (values[2], values[3]) if arc else None, arc and values[4] > 0))
        at = (values[0], values[1])
    if done.returncode != 0 or "PROGRAM_END" not in done.stdout:
        pieces.append((done.stdout.strip().splitlines() or ["no answer"])[-1])
    return pieces


@dataclass
class Difference:
    """A point that one path has and the other has not."""

    whose: str
    line: int
    point: tuple
    by: float


def compare(our: list, their: list) -> tuple[int, float, list]:
    """How many points were compared, the farthest of those that are alike, and the others."""
    points, farthest, differences = 0, 0.0, []
    mine, lines = [piece for _, piece in our], [line for line, _ in our]
    for whose, path, other in (("ours", mine, their), ("LinuxCNC's", their, mine)):
        for index, piece in enumerate(path):
            for point in piece.points():
                by = min(candidate.distance(point) for candidate in other)
                points += 1
                if by <= ALIKE:
                    farthest = max(farthest, by)
                    continue
                # A point of theirs belongs to the line of ours that is nearest.
                nearest = index if whose == "ours" else min(range(len(mine)), key=lambda i: mine[i].distance(point))
                differences.append(Difference(whose, lines[nearest], point, by))
    return points, farthest, differences


def arc(at: tuple, heading: tuple, kind: str) -> tuple[tuple, str]:
    """A quarter of a circle from a place: its end, and its block."""
    turn = 1 if kind == "left arc" else -1
    centre = (-heading[1] * BOW * turn, heading[0] * BOW * turn)
    end = (at[0] + centre[0] + heading[0] * BOW, at[1] + centre[1] + heading[1] * BOW)
    return end, f"G0{3 if turn > 0 else 2} X{end[0]:.3f} Y{end[1]:.3f} I{centre[0]:.3f} J{centre[1]:.3f}\n"


def corner(before: str, after: str, heading: tuple) -> str:
    """The blocks of two elements that meet in X0 Y0, with a straight way on and off: %s stands for the spellings' own words."""
    blocks = ""
    # The first element comes to the corner along +X: an arc is made backwards.
    start, first = (-40.0, 0.0), (1.0, 0.0)
    if before != "line":
        turn = 1 if before == "left arc" else -1
        start, first = (-BOW, BOW * turn), (0.0, -turn)
    blocks += f"G00 X{start[0] - 20 * first[0]:.3f} Y{start[1] - 20 * first[1]:.3f}\n%s G01 X{start[0]:.3f} Y{start[1]:.3f} F500\n"
    if before == "line":
        blocks += "G01 X0. Y0.\n"
    else:
        blocks += f"G0{3 if before == 'left arc' else 2} X0. Y0. I{BOW}. J0.\n"
    if after == "line":
        end = (heading[0] * 40, heading[1] * 40)
        blocks += f"G01 X{end[0]:.3f} Y{end[1]:.3f}\n"
    else:
        end, block = arc((0.0, 0.0), heading, after)
        turn = 1 if after == "left arc" else -1
        blocks, heading = blocks + block, (-heading[1] * turn, heading[0] * turn)
    return blocks + f"G40 G01 X{end[0] + 20 * heading[0]:.3f} Y{end[1] + 20 * heading[1]:.3f}\n"


HEAD = "G17 G21 G40 G49 G80 G90 G94\n"
ABOUT = 1.5 * RADIUS  # what M97 does at a corner lies within it, mm: its points are at most √2 radii away


def corners(folder: Path) -> tuple[int, int]:
    """Compares all corners; how many differ, and how many of them without a reason."""
    count = equal = explained = both = points = 0
    farthest, strange = 0.0, []
    for mode in ("M96", "M97"):
        for before in KINDS:
            for after in KINDS:
                for name, heading in HEADINGS.items():
                    blocks, count = corner(before, after, heading), count + 1
                    our = ours(f"{HEAD}{mode}\n{blocks % 'G41 D1'}M30\n", folder)
                    their = theirs(f"{HEAD}(AS IT IS)\n{blocks % f'G41.1 D{2 * RADIUS:.3f}'}M2\n", folder)
                    what = f"{mode}, {before} to {after}, {name}"
                    ends = [isinstance(end, str) for end in (our[-1][1], their[-1])]
                    if any(ends):
                        both += all(ends)
                        if not all(ends):
                            strange.append(f"{what}: {'ours' if ends[0] else 'LinuxCNC'} refuses it, the other runs it")
                        continue
                    seen, far, differences = compare(our, their)
                    points, farthest = points + seen, max(farthest, far)
                    reason = mode == "M97" and "outside" in name and all(math.hypot(*one.point) < ABOUT for one in differences)
                    if not differences:
                        equal += 1
                    elif reason:
                        explained += 1
                    else:
                        strange += [f"{what}: {one.whose} ({one.point[0]:.4f}, {one.point[1]:.4f}), {one.by:.4f} mm apart"
                                    for one in differences[:3]]
    print(f"cyclestart trace CORNER and rs274 -g CORNER, radius {RADIUS} mm: {count} corners, {points:,} points of their paths")
    print(f"  {equal} paths alike, farthest {farthest:.1e} mm; within {ALIKE:.1e} mm, for LinuxCNC prints four decimals")
    print(f"  {both} refused by both: the tool does not fit between the elements")
    print(f"  {explained} differ at the corner alone, after M97: {WHY_CORNER}")
    for line in strange:
        print(f"  not explained: {line}")
    return count, len(strange)


def starts(folder: Path) -> int:
    """Compares start-ups from several sides; how many differences have no reason."""
    alike = explained = 0
    strange = []
    for degrees in range(-165, 180, 15):
        x, y = (20 * math.cos(math.radians(degrees)), 20 * math.sin(math.radians(degrees)))
        blocks = f"G00 X{-x:.3f} Y{-y:.3f}\n%s G01 X0. Y0. F500\nX40.\nY-40.\nG40 G01 Y-60.\n"
        our = ours(f"{HEAD}M96\n{blocks % 'G41 D1'}M30\n", folder)
        their = theirs(f"{HEAD}{blocks % f'G41.1 D{2 * RADIUS:.3f}'}M2\n", folder)
        if isinstance(our[-1][1], str) or isinstance(their[-1], str):
            strange.append(f"start-up {degrees} degrees: {our[-1][1]}; {their[-1]}")
            continue
        _, _, differences = compare(our, their)
        far = [one for one in differences if math.hypot(*one.point) > ABOUT]
        alike, explained = alike + (not differences), explained + (bool(differences) and not far)
        strange += [f"start-up {degrees} degrees: {one.whose} {one.point}, {one.by:.4f} mm apart" for one in far]
    print(f"cyclestart trace START and rs274 -g START: {alike + explained + len(strange)} ways onto a line, 15 degrees apart")
    print(f"  {alike} alike, {explained} differ about the contour's start alone: {WHY_START}")
    for line in strange:
        print(f"  not explained: {line}")
    return len(strange)


def shallow_corner(lines: list, difference: Difference) -> bool:
    """Whether a difference lies at a corner of its block, or of one beside it, at which LinuxCNC makes none."""
    places = []
    for line in lines[difference.line - 3 : difference.line + 2]:
        words = re.findall(r"X(\S+) Y(\S+)", line)
        places += [tuple(map(float, place)) for place in words]
    for a, b, c in zip(places, places[1:], places[2:]):
        way, on = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
        turn = math.atan2(way[0] * on[1] - way[1] * on[0], way[0] * on[0] + way[1] * on[1])
        if abs(turn) < SHALLOW and math.dist(b, difference.point) < ABOUT:
            return True
    return False


def contours(folder: Path) -> int:
    """Compares the contours; how many differences have no reason."""
    blocks = contour.BLOCKS_OF_ONE * CONTOURS
    texts = {spelling: contour.head(spelling) + "".join(contour.contours(blocks, spelling)) + contour.tail(spelling)
             for spelling in ("fanuc", "rs274")}
    our = ours(texts["fanuc"].replace("(COMPENSATED CONTOURS)", "M96"), folder)
    their = theirs(texts["rs274"], folder)
    for path in ([piece for _, piece in our], their):
        if isinstance(path[-1], str):
            print(f"  not explained: {path[-1]}")
            return 1
    points, farthest, differences = compare(our, their)
    lines = texts["fanuc"].splitlines()
    shallow = [one for one in differences if shallow_corner(lines, one)]
    strange = [one for one in differences if one not in shallow]
    print(f"cyclestart trace CONTOURS and rs274 -g CONTOURS: {CONTOURS} contours of {contour.LINES} lines, {points:,} points")
    print(f"  {points - len(differences):,} alike, farthest {farthest:.1e} mm; within {ALIKE:.1e} mm")
    most = max((one.by for one in shallow), default=0.0)
    print(f"  {len(shallow)} points of nearly straight corners differ by up to {most:.4f} mm: {WHY_SHALLOW}")
    for one in strange[:10]:
        print(f"  not explained: line {one.line}, {one.whose} ({one.point[0]:.4f}, {one.point[1]:.4f}), {one.by:.4f} mm apart")
    return len(strange)


def main() -> int:
    needs_program()
    if not shutil.which("rs274"):
        print("rs274 is not here to compare with: apt-get install -y --no-install-recommends linuxcnc-uspace")
        return 0
    with tempfile.TemporaryDirectory() as name:
        _, strange = corners(Path(name))
        strange += starts(Path(name)) + contours(Path(name))
    if strange:
        print("beside_linuxcnc: a difference has no reason", file=sys.stderr)
    return 1 if strange else 0


if __name__ == "__main__":
    sys.exit(main())
