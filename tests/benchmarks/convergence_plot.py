#!/usr/bin/env python3
"""Draws the table of convergence (convergence_table.cpp) as an SVG picture.

    build/release/tests/benchmarks/convergence_table | tests/benchmarks/convergence_plot.py > FILE

reads the table, or any text that has its rows, and draws the mean error over the cells per edge,
both logarithmic, a panel for every shape of cells: dots for isoparametric interpolation, circles
for polynomials in the world; dashed, lines of exact order 2, 3 and 4 from the dots of the coarsest
meshes on.
"""

import math
import sys

WIDTH, HEIGHT, LEFT, TOP, GAP = 190, 250, 52, 34, 14
COLORS = {1: "#1b6ca8", 2: "#c2571a", 3: "#3d8b37"}
LEAST, MOST = -7, -1  # powers of ten


def read_rows(text):
    """{shape: {order: [(cells per edge, mean error, the polynomials')]}}, in the table's order."""
    shapes = {}
    for line in text:
        fields = [field.strip() for field in line.strip().strip("|").split("|")]
        if len(fields) != 9 or fields[1] not in ("1", "2", "3") or not fields[2].isdigit():
            continue
        orders = shapes.setdefault(fields[0], {})
        orders.setdefault(int(fields[1]), []).append(
            (int(fields[2]), float(fields[4]), float(fields[7])))
    return shapes


class Panel:
    def __init__(self, left, finest):
        self.left = left
        self.finest = math.log2(finest)

    def x(self, cells):
        return self.left + 14 + (WIDTH - 28) * math.log2(cells) / self.finest

    def y(self, error):
        return TOP + HEIGHT * (MOST - math.log10(error)) / (MOST - LEAST)


def line(points, color, style='stroke-width="1.6"'):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{color}" {style}/>'


def marks(points, color, radius, fill):
    return [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" stroke="{color}" fill="{fill}"/>'
            for x, y in points]


def draw_panel(name, orders, panel):
    out = [f'<rect x="{panel.left}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" '
           'stroke="#999"/>',
           f'<text x="{panel.left + WIDTH / 2}" y="{TOP - 10}" text-anchor="middle">{name}</text>']
    for cells in [row[0] for row in orders[1]]:
        out.append(f'<text x="{panel.x(cells):.1f}" y="{TOP + HEIGHT + 16}" '
                   f'text-anchor="middle">{cells}</text>')
    for order, rows in orders.items():
        color = COLORS[order]
        isoparametric = [(panel.x(n), panel.y(e)) for n, e, _ in rows]
        polynomial = [(panel.x(n), panel.y(e)) for n, _, e in rows]
        out.append(line(polynomial, color, 'stroke-width="0.8"'))
        out += marks(polynomial, color, 4.6, "none")
        out.append(line(isoparametric, color))
        out += marks(isoparametric, color, 2.2, color)
        # from the coarsest mesh's error on, what the exact order would have
        (first, error, _), (last, _, _) = rows[0], rows[-1]
        exact = [(n, error * (first / n) ** (order + 1)) for n in (first, last)]
        out.append(line([(panel.x(n), panel.y(e)) for n, e in exact], color,
                        'stroke-width="1.6" stroke-dasharray="3 3" opacity="0.6"'))
    return out


def main():
    shapes = read_rows(sys.stdin)
    if not shapes:
        sys.exit("convergence_plot: no rows of the table of convergence in the input")
    finest = max(row[0] for orders in shapes.values() for rows in orders.values() for row in rows)
    width = LEFT + len(shapes) * (WIDTH + GAP)
    height = TOP + HEIGHT + 60
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           'font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for power in range(LEAST, MOST + 1):
        y = TOP + HEIGHT * (MOST - power) / (MOST - LEAST)
        out.append(f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">1e{power}</text>')
        out.append(f'<line x1="{LEFT}" x2="{width - GAP}" y1="{y:.1f}" y2="{y:.1f}" '
                   'stroke="#eee"/>')
    for index, (name, orders) in enumerate(shapes.items()):
        out += draw_panel(name, orders, Panel(LEFT + index * (WIDTH + GAP), finest))
    labels = [("linear: order 2", 1), ("quadratic: order 3", 2), ("cubic: order 4", 3)]
    for index, (label, order) in enumerate(labels):
        x = LEFT + index * 140
        out.append(f'<rect x="{x}" y="{height - 28}" width="12" height="12" '
                   f'fill="{COLORS[order]}"/>')
        out.append(f'<text x="{x + 18}" y="{height - 18}">{label}</text>')
    out.append(f'<text x="{width - GAP}" y="{height - 18}" text-anchor="end">mean error of a '
               'pixel over cells per edge; dots: isoparametric, circles: polynomial, '
               'dashed: the order</text>')
    out.append("</svg>")
    print("\n".join(out))


if __name__ == "__main__":
    main()
