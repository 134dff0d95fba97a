"""millstand: from the drawing of a rolling-mill stand to the vibration of its rolls.

A case is read or made, changed by key, checked and run; results come with units, errors and sources::

    import millstand as ms
    case = ms.load("cases/four-high-1400.toml")
    case["backup_roll.crown"] = "150 um"
    run = case.run(progress=ms.bar)
    print(run.verdict, run["K3"])
"""

import atexit as _atexit

from ._errors import InputError, Place, Problem, SolverError, SystemError, WarningRecord
from ._millstand import (
    Bearing,
    BearingState,
    Case,
    Chain,
    Chatter,
    Check,
    Curves,
    Modes,
    PairState,
    Result,
    RollPair,
    Run,
    StabilityMap,
    __version__,
    _finish_left_work,
    load,
    new,
)
from ._plot import _plot_map, _plot_run, bar
from ._records import Analysis, Calibration, Record, _calibrate, record
from ._tables import Study, SweepTable, study, sweep

Case.calibrate = _calibrate
Run.plot = _plot_run
StabilityMap.plot = _plot_map

# Types are known by the name of the package, in messages and in pickles.
for _name in list(globals()):
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name

_atexit.register(_finish_left_work)

__all__ = [
    "Analysis", "Bearing", "BearingState", "Calibration", "Case", "Chain", "Chatter", "Check", "Curves", "InputError",
    "Modes", "PairState", "Place", "Problem", "Record", "Result", "RollPair", "Run", "SolverError", "StabilityMap",
    "Study", "SweepTable", "SystemError", "WarningRecord", "bar", "load", "new", "record", "study", "sweep",
]
