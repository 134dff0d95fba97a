"""Tolerances of a stand: what interval each natural frequency has, and which input to measure better first.

usage: stand_tolerances.py CASE.toml PICTURE.png [SAMPLES]
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import millstand as ms

samples = int(sys.argv[3]) if len(sys.argv) > 3 else 512
frequencies = ["f1", "f2", "f3"]
tolerances = {f"given.K{i}": "normal(10 %)" for i in (1, 2, 6, 7)}
tolerances.update({f"given.M{i}": "normal(2 %)" for i in range(1, 7)})

study = ms.study(ms.load(sys.argv[1]), tolerances, watch=frequencies, samples=samples, model="quick")
with open(study.merge(), newline="") as table:
    head, *rows = csv.reader(table)
columns = [next(i for i, name in enumerate(head) if name.split(" ")[0] == f) for f in frequencies]
drawn = np.array([[float(row[c]) for c in columns] for row in rows])

figure, axes = plt.subplots(1, len(frequencies), figsize=(11, 3.5))
for axis, name, values in zip(axes, frequencies, drawn.T):
    low, high = np.quantile(values, [0.025, 0.975])
    axis.hist(values, bins=30, color="#4477aa")
    axis.axvspan(low, high, color="#4477aa", alpha=0.15)
    axis.set_xlabel(f"{name} [Hz]")
    print(f"{name}: mean {values.mean():.1f} Hz, 95 % within {low:.1f} .. {high:.1f} Hz")
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
study.report()
