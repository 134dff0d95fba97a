#!/usr/bin/env python3
"""Full journal bearing once more, apart from the program: entries of oilfilm.json.

Reynolds equation d/dt(H^3 dP/dt) + (D/L)^2 H^3 d2P/dz2 = dH/dt + 2 dH/d(omega time) with P >= 0 by projected
over-relaxation (complementarity) on half the width, z = 0 .. 1; lengths in the clearance, P in 6 mu omega (R/c)^2.
Coefficients are differences of the load over displacements and velocities of 1e-3.  Richardson extrapolation from
180 x 15 and 360 x 30 cells of the half width.  Standard library only; some minutes for an entry.

    oil_film.py "1.0 0.6" ...     prints S, attitude, k and b of these entries and their deviations from the file
"""
import json
import math
import os
import sys

STEP = 1e-3


def load(ratio, x, y, vx, vy, n, m, p):
    """Load (x, y) of the film on half a width; p, the pressures, is the start and is improved in place."""
    dt, dz = 2 * math.pi / n, 1 / m
    cos = [math.cos(i * dt) for i in range(n)]
    sin = [math.sin(i * dt) for i in range(n)]
    h3 = [(1 - x * math.cos((i + 0.5) * dt) - y * math.sin((i + 0.5) * dt)) ** 3 for i in range(n)]  # between nodes
    h = [1 - x * cos[i] - y * sin[i] for i in range(n)]
    across = [h[i] ** 3 / (ratio * dz) ** 2 for i in range(n)]
    right = [x * sin[i] - y * cos[i] - 2 * (vx * cos[i] + vy * sin[i]) for i in range(n)]
    weight = 2 / (1 + math.sin(math.pi / n * 2))
    for sweep in range(20 * n):
        change = largest = 0.0
        for i in range(n):
            east, west = h3[i] / dt**2, h3[i - 1] / dt**2
            up, down, row = p[(i + 1) % n], p[i - 1], p[i]
            diagonal = east + west + 2 * across[i]
            for j in range(m):  # node 0 on the plane of symmetry, node m at the end, where the pressure is 0
                other = 2 * row[1] if j == 0 else row[j - 1] + row[j + 1]
                old = row[j]
                value = (east * up[j] + west * down[j] + across[i] * other - right[i]) / diagonal
                new = max(0.0, old + weight * (value - old))
                row[j] = new
                change = max(change, abs(new - old))
                largest = max(largest, new)
        if change < 1e-9 * largest:
            break
    columns = [dt * dz * (0.5 * row[0] + sum(row[1:m])) for row in p]
    return sum(c * w for c, w in zip(columns, cos)), sum(c * w for c, w in zip(columns, sin))


def numbers(ratio, e, n, m):
    """S, attitude in degrees, k and b (rows along the load, across it) on one grid."""
    p = [[0.0] * (m + 1) for _ in range(n)]
    wx, wy = load(ratio, e, 0, 0, 0, n, m, p)
    size, turn = math.hypot(wx, wy), math.atan2(wy, wx)
    axes = ((math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn)))

    def slope(axis, velocity):
        sides = []
        for sign in (STEP, -STEP):
            dx, dy = sign * axis[0], sign * axis[1]
            start = [row[:] for row in p]
            sides.append(load(ratio, e, 0, dx, dy, n, m, start) if velocity else load(ratio, e + dx, dy, 0, 0, n, m, start))
        return [(sides[0][i] - sides[1][i]) / (2 * STEP * size) for i in (0, 1)]

    def matrix(velocity):
        columns = [slope(axis, velocity) for axis in axes]
        return [[sum(a * c for a, c in zip(axes[i], columns[j])) for j in (0, 1)] for i in (0, 1)]

    return [1 / (6 * math.pi * size), -math.degrees(turn)] + sum(matrix(False), []) + sum(matrix(True), [])


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "oilfilm.json")
    with open(path) as file:
        entries = json.load(file)["entries"]
    for name in sys.argv[1:] or entries:
        ratio, e = (float(part) for part in name.split())
        coarse, fine = (numbers(ratio, e, *grid) for grid in ((180, 15), (360, 30)))
        best = [(4 * b - a) / 3 for a, b in zip(coarse, fine)]
        entry = entries[name]
        given = [entry["S"], entry["attitude_deg"]] + sum(entry["k"], []) + sum(entry["b"], [])
        for label, value, known in zip("S attitude kxx kxy kyx kyy bxx bxy byx byy".split(), best, given):
            print(f"{name:10} {label:9} {value:12.5f} {known:12.5f} {value - known:+.1e}")


if __name__ == "__main__":
    main()
