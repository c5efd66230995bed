#!/usr/bin/env python3
"""Writes a surface finishing program as CAM systems do: short straight cuts in lines over a free-form surface.

    benches/surface.py [BLOCKS] [fanuc|rs274] > part.nc      1,000,000 blocks in Fanuc spelling if not said otherwise

The same arguments give the same bytes. Memory does not grow with the number of blocks.
"""
import math
import sys

STEP = 0.2  # mm between points
STEPOVER = 0.25  # mm between lines
POINTS = 800  # a line


def height(x: float, y: float) -> float:
    """A free-form surface: two waves and a bowl, mm."""
    return 6.0 * math.sin(x * 0.05) * math.cos(y * 0.07) + 2.0 * math.cos(x * 0.19 - y * 0.11) - 0.0005 * (x - 80.0) ** 2


def head(spelling: str) -> str:
    start = "G17 G21 G40 G49 G80 G90\nG54\nS8000 M03\nG00 X0. Y0.\nZ30.\nG01 Z12. F1500\nF3000\n"
    return ("%\nO0001\n(SURFACE FINISHING)\n" if spelling == "fanuc" else "(SURFACE FINISHING)\nG64 P0.01\n") + start


def tail(spelling: str) -> str:
    return "G00 Z50.\nM05\n" + ("M30\n%\n" if spelling == "fanuc" else "M2\n")


def number(value: float) -> str:
    text = f"{value:.3f}"
    return "0." if text in ("0.000", "-0.000") else text


def cuts(blocks: int):
    """The cutting blocks, one string a line of points; a line runs back where the one before ran forth."""
    line = 0
    while blocks > 0:
        count = min(POINTS, blocks)
        y = line * STEPOVER
        columns = range(count) if line % 2 == 0 else range(POINTS - 1, POINTS - 1 - count, -1)
        points = ((column * STEP, height(column * STEP, y)) for column in columns)
        # The first block of a line says all that is modal, as post-processors do at every new line.
        words = [f"X{number(x)} Y{number(y)} Z{number(z)}\n" for x, z in points]
        words[0] = "G01 " + words[0][:-1] + " F3000\n"
        yield "".join(words)
        blocks -= count
        line += 1


def write(blocks: int, spelling: str, out) -> None:
    """Writes a whole program to a text stream."""
    out.write(head(spelling))
    for text in cuts(blocks):
        out.write(text)
    out.write(tail(spelling))


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    write(count, sys.argv[2] if len(sys.argv) > 2 else "fanuc", sys.stdout)
