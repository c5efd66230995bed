#!/usr/bin/env python3
"""Writes closed contours cut with tool radius compensation: lobes of short lines, and a tangent arc off each.

    benches/contour.py [BLOCKS] [fanuc|rs274] > part.nc      100,000 compensated blocks in Fanuc spelling if not said otherwise

The same arguments give the same bytes. Memory does not grow with the number of blocks. Every other contour is cut the
other way round, so that G41 and G42 take turns and the tool is always outside.
"""
import math
import sys

RADIUS = 3.0  # mm, of the tool; in the offset memory D1 in Fanuc spelling
LINES = 200  # of a contour
SIZE, LOBES, LOBE = 50.0, 5, 6.0  # its radius, how many lobes, how high, mm
PITCH, ROW = 160.0, 30  # from one contour to the next, mm; contours in a row
BLOCKS_OF_ONE = LINES + 2  # with the line onto it and the arc off it


def head(spelling: str) -> str:
    name = "(COMPENSATED CONTOURS)\n"
    return ("%\nO0001\n" + name if spelling == "fanuc" else name) + "G17 G21 G40 G49 G80 G90 G94\nG54\nS8000 M03\n"


def tail(spelling: str) -> str:
    return "G00 Z50.\nM05\n" + ("M30\n%\n" if spelling == "fanuc" else "M2\n")


def outline(left: bool) -> list[tuple[float, float]]:
    """Its corners about its middle, clockwise if the tool is on the left."""
    points = []
    for corner in range(LINES + 1):
        angle = 2.0 * math.pi * corner / LINES
        radius = SIZE + LOBE * math.cos(LOBES * angle)
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return points[::-1] if left else points


def number(value: float) -> str:
    text = f"{value:.3f}"
    return "0." if text in ("0.000", "-0.000") else text


def place(x: float, y: float) -> str:
    return f"X{number(x)} Y{number(y)}"


def contours(blocks: int, spelling: str):
    """The contours, a string each, with at least so many compensated blocks in all."""
    outlines = {left: outline(left) for left in (True, False)}
    for contour in range(-(-blocks // BLOCKS_OF_ONE)):
        left, sign = (True, 1) if contour % 2 == 0 else (False, -1)
        dx, dy = contour % ROW * PITCH, contour // ROW * PITCH
        points = [(x + dx, y + dy) for x, y in outlines[left]]
        x, y = points[0]
        code = "G41" if left else "G42"
        on = f"{code} D1" if spelling == "fanuc" else f"{code}.1 D{2 * RADIUS:.3f}"
        text = [f"G00 {place(x + 20, y + sign * 20)}\nZ2.\nG01 Z-3. F300\n{on} G01 {place(x + 8, y + sign * 8)} F900\n"]
        text += [place(x, y) + "\n" for x, y in points]
        # The contour ends straight up or down; the arc leads on and away from it.
        text.append(f"G0{3 if left else 2} {place(x + 10, y - sign * 10)} I10. J0.\nG01 G40 X{number(x + 25)}\nG00 Z5.\n")
        yield "".join(text)


def size(blocks: int) -> int:
    """How many compensated blocks are written when so many are asked for: whole contours."""
    return -(-blocks // BLOCKS_OF_ONE) * BLOCKS_OF_ONE


def write(blocks: int, spelling: str, out) -> None:
    """Writes a whole program to a text stream."""
    out.write(head(spelling))
    for text in contours(blocks, spelling):
        out.write(text)
    out.write(tail(spelling))


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    write(count, sys.argv[2] if len(sys.argv) > 2 else "fanuc", sys.stdout)
