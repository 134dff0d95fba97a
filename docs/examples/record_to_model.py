"""From a record of the driven stand to a calibrated model.

The record of this example is made by the chain itself with a spring that is 12 % softer, so that the answer is known.

usage: record_to_model.py CASE.toml PICTURE.png [SECONDS]
"""

import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import millstand as ms

case_file, picture = sys.argv[1], sys.argv[2]
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 40
rate = 5000

mill = ms.load(case_file)
mill["dynamics.force_meaning"] = "measured"  # the record holds the whole force of the bite
mill["given.K1"] = (0.88 * mill.modes()["K1"].value, "N/m")
chain = mill.modes().chain
random = np.random.default_rng(4)
force = 976e3 + 3e3 * random.standard_normal(int(seconds * rate))
response = chain.simulate(force, rate=rate)

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "stand.csv"
    columns = [response["time"], response["force"]]
    names = ["time [s]", "force [N]"]
    for label in ("upper work roll", "lower work roll"):  # a sensor on each chock, with its noise
        columns.append(response[label] + 0.02 * response[label].std() * random.standard_normal(len(force)))
        names.append(f"{label.replace(' ', '_')} [m/s2]")
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=",".join(names), comments="", fmt="%.9g")
    record = ms.record(path, between="lines")
    case = ms.load(case_file)
    analysis = record.analyse(case)
    calibration = case.calibrate([record], free="K1, K2, K6, K7")  # the springs of frame and chocks
    calibrated = calibration.case.modes().chain

print("modes of the record:", [round(mode["frequency"], 1) for mode in analysis.modes])
found = {unknown["name"]: unknown["shown"]["value"] for unknown in calibration.content["unknowns"] if unknown["taken"]}
print("unknowns:", found)
figure, axes = plt.subplots(figsize=(7, 4))
n = np.arange(1, 7)
for offset, label, one in ((-0.2, "drawing", case.modes().chain), (0, "calibrated", calibrated), (0.2, "mill", chain)):
    axes.bar(n + offset, one.modes().frequency, width=0.2, label=label)
axes.set_xlabel("mode")
axes.set_ylabel("frequency [Hz]")
axes.set_yscale("log")
axes.legend()
figure.tight_layout()
figure.savefig(picture, dpi=110)
