"""Steps an exported stand from Python, once as a whole run and once by hand.

    millstand export fmu cases/published-1400.toml -o stand.fmu
    python3 -m pip install fmpy numpy
    python3 docs/examples/fmu_step.py stand.fmu
"""
import shutil
import sys

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave

unit = sys.argv[1]
step = 5e-5  # s
duration = 1.0  # s
time = np.arange(0.0, duration + step / 2, step)
force = 976e3 + 3e3 * np.sin(2 * np.pi * 39 * time)  # N, the rolling force


def whole_run():
    """FMPy steps the unit: the force is interpolated at the communication points and held between them."""
    signals = np.array(list(zip(time, force)), dtype=[("time", np.double), ("F_roll", np.double)])
    result = simulate_fmu(unit, stop_time=duration, output_interval=step, input=signals,
                          start_values={"F_mean": 976e3, "K3": 4.0e10},
                          output=["a_upper_work_roll", "a_lower_work_roll", "F_cell"])
    for name in ("a_upper_work_roll", "a_lower_work_roll"):
        print(f"{name}: peak {np.abs(result[name]).max() / 9.80665:.3f} g, force held")


def by_hand():
    """Every step by hand, with the slope of the force (second order in the step) and a stiffness that is changed."""
    description = read_model_description(unit)
    reference = {v.name: v.valueReference for v in description.modelVariables}
    folder = extract(unit)
    slave = FMU2Slave(guid=description.guid, unzipDirectory=folder,
                      modelIdentifier=description.coSimulation.modelIdentifier, instanceName="stand")
    slave.instantiate()
    slave.setReal([reference["F_mean"]], [976e3])
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.setReal([reference["F_roll"]], [force[0]])
    slave.exitInitializationMode()
    peak = 0.0
    for i in range(len(time) - 1):
        if i == len(time) // 2:
            slave.setReal([reference["K3"]], [2.0e10])  # N/m, from here on
        slave.setReal([reference["F_roll"]], [force[i]])
        slave.setRealInputDerivatives([reference["F_roll"]], [1], [(force[i + 1] - force[i]) / step])
        slave.doStep(currentCommunicationPoint=time[i], communicationStepSize=step)
        peak = max(peak, abs(slave.getReal([reference["a_upper_work_roll"]])[0]))
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)
    print(f"a_upper_work_roll: peak {peak / 9.80665:.3f} g, force in straight lines, K3 halved half-way")


whole_run()
by_hand()
