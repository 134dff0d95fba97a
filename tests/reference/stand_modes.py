#!/usr/bin/env python3
"""Frequencies of the six-mass chain once more, apart from the program: entries modes.published.frequencies,
variants.* of masses and springs that are printed, and static.K4_zero of stand.json.

ground - K1 - M1 - K2 - M2 - K3 - M3 - K4 - M4 - K5 - M5 - K6 - M6 - K7 - ground; det(K - w^2 M) = 0 by Jacobi
rotations of M^-1/2 K M^-1/2.  Standard library only.  Prints the largest relative deviation of each entry from
the file; exit status 1 where one exceeds 1e-9.
"""
import json
import math
import os
import sys


def stiffness_matrix(springs):
    n = 6
    k = [[0.0] * n for _ in range(n)]
    for i in range(n):
        k[i][i] = springs[i] + springs[i + 1]
        if i + 1 < n:
            k[i][i + 1] = k[i + 1][i] = -springs[i + 1]
    return k


def eigenvalues(a):
    """Of a symmetric matrix: cyclic Jacobi rotations until the part off the diagonal is gone."""
    a, n = [row[:] for row in a], len(a)
    for _ in range(60):
        for p in range(n):
            for q in range(p + 1, n):
                if a[p][q] == 0:
                    continue
                angle = 0.5 * math.atan2(2 * a[p][q], a[q][q] - a[p][p])
                c, s = math.cos(angle), math.sin(angle)
                for k in range(n):
                    a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
                for k in range(n):
                    a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
    return sorted(a[i][i] for i in range(n))


def frequencies(masses, springs):
    k = stiffness_matrix(springs)
    scaled = [[k[i][j] / math.sqrt(masses[i] * masses[j]) for j in range(6)] for i in range(6)]
    return [math.sqrt(w2) / (2 * math.pi) for w2 in eigenvalues(scaled)]


def with_changed(values, **changes):
    """Index from 1 in the name: m2=.. or k4=.."""
    out = list(values)
    for name, value in changes.items():
        out[int(name[1:]) - 1] = value
    return out


def main():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stand.json")
    with open(path) as file:
        entries = json.load(file)["entries"]
    m, k = entries["published.M"]["value"], entries["published.K"]["value"]
    line = entries["regression.R1.system"]["value"]["K"][2]  # K3 = K5 of the line contact
    computed = {
        "modes.published.frequencies": frequencies(m, k),
        "variants.as_published": frequencies(m, k),
        "variants.K4_zero": frequencies(m, with_changed(k, k4=0)),
        "variants.K3_K5_line_contact": frequencies(m, with_changed(k, k3=line, k5=line)),
        "variants.K3_K5_line_contact_K4_zero": frequencies(m, with_changed(k, k3=line, k4=0, k5=line)),
        "variants.M3_M4_exchanged": frequencies(with_changed(m, m3=m[3], m4=m[2]), k),
        "variants.M3_M4_both_3094.684": frequencies(with_changed(m, m3=m[3]), k),
        "variants.M3_M4_both_1888.705": frequencies(with_changed(m, m4=m[2]), k),
        "variants.M2_equal_M5_42200.563": frequencies(with_changed(m, m2=m[4]), k),
        "variants.M6_equal_M1_9321.943": frequencies(with_changed(m, m6=m[0]), k),
        # without K4 the force +1 on M3 and -1 on M4 meets two chains of springs in series
        "static.K4_zero": [sum(1 / x for x in k[:i]) for i in (1, 2, 3)] + [-sum(1 / x for x in k[i:]) for i in (4, 5, 6)],
    }
    worst = 0.0
    for name, values in computed.items():
        off = max(abs(a / b - 1) for a, b in zip(values, entries[name]["value"]))
        worst = max(worst, off)
        print(f"{name:42} {off:.1e}")
    return 0 if worst < 1e-9 else 1


if __name__ == "__main__":
    sys.exit(main())
