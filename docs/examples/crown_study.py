"""How the crown of a backup roll gathers the line load and changes the contact stiffness.

usage: crown_study.py CASE.toml PICTURE.png
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import millstand as ms

case = ms.load(sys.argv[1])
pair = case.roll_pair("upper")

figure, (loads, stiffness) = plt.subplots(1, 2, figsize=(11, 4))
crowns = range(0, 401, 50)
tangents = []
for crown in crowns:
    state = pair.solve(force="976 kN", crown=(crown, "um"))
    tangents.append(state.tangent.to("kN/mm"))
    if crown % 100 == 0:
        loads.plot(1e3 * state.z, state.line_load / 1e3, label=f"{crown} um")
loads.set_xlabel("from mid-length [mm]")
loads.set_ylabel("line load [N/mm]")
loads.legend(title="crown")
stiffness.plot(crowns, tangents, "o-")
stiffness.set_xlabel("crown of the backup roll [um]")
stiffness.set_ylabel("tangent of the contact [kN/mm]")
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
print(f"tangent {tangents[0]:.0f} kN/mm without crown, {tangents[-1]:.0f} kN/mm with {crowns[-1]} um")
