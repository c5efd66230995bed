#!/usr/bin/env python3
"""Writes an ordinary part: faced, pockets roughed in rings with arcs, contours under G41, holes spotted, drilled and tapped,
and one face finished in short cuts. About an hour on the stock machine.

    benches/part.py > part.nc

The same arguments give the same bytes. The holes and pockets lie on several parts' worth of plate, so run it with
`--machine unlimited --offset 1=3`.
"""
import sys

import contour
import surface
from surface import number

POCKETS, LEVELS, RINGS = 6, 5, 12
CONTOURS = 6
HOLES = (8, 12)  # rows and holes, 12 mm apart
FINISHING = 150_000  # blocks


def facing(out) -> None:
    out.write("(FACE)\nT01 M06\nG00 X-20. Y0. S800 M03\nZ2. M08\nG01 Z-1. F300\n")
    for line in range(24):
        out.write(f"G01 X{180 if line % 2 == 0 else -20}. F900\nY{number((line + 1) * 8.0)}\n")
    out.write("G00 Z50. M09\n")


def pockets(out) -> None:
    out.write("(POCKETS)\nT02 M06\nG00 X0. Y0. S3000 M03\nZ5. M08\n")
    for pocket in range(POCKETS):
        x, y = pocket % 3 * 80.0, pocket // 3 * 60.0
        out.write(f"G00 X{number(x)} Y{number(y)}\nZ2.\n")
        for level in range(1, LEVELS + 1):
            out.write(f"G01 Z{number(-1.2 * level)} F300\n")
            for ring in range(1, RINGS + 1):
                w, h, r = 2.0 * ring + 4, 1.2 * ring + 2, 0.5 + 0.35 * ring
                x0, x1, y0, y1, n = x - w, x + w, y - h, y + h, number
                out.write(f"G01 X{n(x0 + r)} Y{n(y0)} F1200\nX{n(x1 - r)}\nG03 X{n(x1)} Y{n(y0 + r)} I0. J{n(r)}\n"
                          f"G01 Y{n(y1 - r)}\nG03 X{n(x1 - r)} Y{n(y1)} I{n(-r)} J0.\nG01 X{n(x0 + r)}\n"
                          f"G03 X{n(x0)} Y{n(y1 - r)} I0. J{n(-r)}\nG01 Y{n(y0 + r)}\nG03 X{n(x0 + r)} Y{n(y0)} I{n(r)} J0.\n")
            out.write(f"G01 X{number(x)} Y{number(y)}\n")
        out.write("G00 Z5.\n")
    out.write("G00 Z50. M09\n")


def contours(out) -> None:
    out.write("(CONTOURS)\nT03 M06\nG00 Z50. S4000 M03\nM08\n")
    for text in contour.contours(CONTOURS * contour.BLOCKS_OF_ONE, "fanuc"):
        out.write(text)
    out.write("G00 Z50. M09\n")


def holes(out) -> None:
    rows, columns = HOLES
    cycles = [("SPOT", "G82 Z-2. R2. P200 F120", 2000), ("DRILL", "G83 Z-22. R2. Q5. F180", 1800), ("TAP M6", "G84 Z-14. R5. F400", 400)]
    for tool, (name, cycle, speed) in enumerate(cycles, 4):
        out.write(f"({name})\nT{tool:02} M06\nG00 X0. Y0. S{speed} M03\nZ20. M08\nG99 {cycle} L0\n")
        for row in range(rows):
            for column in range(columns):
                out.write(f"X{number(column * 12.0)} Y{number(row * 12.0)}\n")
        out.write("G80\nG00 Z50. M09\n")


def finishing(blocks: int, out) -> None:
    out.write("(FINISH)\nT07 M06\nG00 X0. Y0. S8000 M03\nZ30. M08\nG01 Z12. F1500\n")
    for text in surface.cuts(blocks):
        out.write(text)
    out.write("G00 Z50. M09\n")


def write(out, finish: int = FINISHING) -> None:
    """Writes the whole program to a text stream."""
    out.write("%\nO0001 (ORDINARY PART)\nG17 G21 G40 G49 G80 G90 G94\nG54\n")
    for operation in (facing, pockets, contours, holes):
        operation(out)
    finishing(finish, out)
    out.write("M05\nM30\n%\n")


if __name__ == "__main__":
    write(sys.stdout)
