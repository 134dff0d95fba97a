"""Reads the state-space matrices of a stand and prints the largest response of the work rolls.

    millstand export statespace cases/published-1400.toml -o stand
    python3 docs/examples/statespace.py stand        (needs numpy)
"""
import csv
import sys

import numpy as np

folder = sys.argv[1]
A, B, C, D = (np.loadtxt(f"{folder}/{name}.csv", delimiter=",", ndmin=2) for name in "ABCD")
with open(f"{folder}/names.csv", newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
outputs = [row["name"] for row in rows if row["of"] == "output"]

# Natural frequencies: A mixes entries of 1 and of stiffness over mass, numpy's eigenvalues balance it.
poles = np.linalg.eigvals(A)
poles = sorted(poles[poles.imag > 0], key=abs)
print("natural frequencies:", ", ".join(f"{abs(p) / 2 / np.pi:.2f}" for p in poles), "Hz")

# Acceleration per newton of rolling force.
frequency = np.linspace(1, 1.2 * abs(poles[-1]) / 2 / np.pi, 4000)
eye = np.eye(len(A))
response = np.array([(C @ np.linalg.solve(2j * np.pi * f * eye - A, B) + D)[:, 0] for f in frequency])
for name in ("a_upper_work_roll", "a_lower_work_roll"):
    column = np.abs(response[:, outputs.index(name)])
    k = column.argmax()
    print(f"{name}: {column[k]:.3e} m/s2 per N at {frequency[k]:.1f} Hz")
