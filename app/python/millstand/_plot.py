"""What is shown: a bar of progress, figures where matplotlib is installed."""

import sys

import numpy as np

from ._errors import InputError

_width = 30


def bar(stage, fraction):
    """Shows the progress of a run on standard error: progress=ms.bar."""
    filled = int(round(_width * min(1.0, max(0.0, fraction))))
    sys.stderr.write(f"\r{stage:<28.28} [{'#' * filled}{' ' * (_width - filled)}]")
    if fraction >= 1:
        sys.stderr.write("\n")
    sys.stderr.flush()


def _axes(axes):
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise InputError("figures need matplotlib, which is not installed; apt-get install python3-matplotlib") from None
    return axes if axes is not None else plt.subplots()[1]


def _label(name, unit):
    return name if unit in ("", "1") else f"{name} [{unit}]"


def _plot_run(self, name, columns=None, ax=None):
    """A curve of the run over its first column; returns the axes of matplotlib.

    name     as in self.curves; "campbell" and other beginnings of a name are enough where one curve has it
    columns  names of the columns that are drawn; None: all
    """
    names = [one for one in self.curves if one == name] or [one for one in self.curves if one.startswith(name)]
    if len(names) != 1:
        known = ", ".join(names or self.curves)
        raise InputError(f"no single curve '{name}' in this run; there are {known}")
    curve, units = self.curves[names[0]], self.curves.units(names[0])
    first, *others = curve.dtype.names
    axes = _axes(ax)
    wanted = others if columns is None else list(columns)
    for column in wanted:
        if np.isfinite(curve[column]).any():
            axes.plot(curve[first], curve[column], label=_label(column, units[column]))
    axes.set_xlabel(_label(first, units[first]))
    if len(wanted) == 1:
        axes.set_ylabel(_label(wanted[0], units[wanted[0]]))
    else:
        axes.legend(fontsize="small")
    axes.set_title(names[0])
    return axes


def _plot_map(self, ax=None):
    """Growth rate over both quantities with its zero line, the border of stability; returns the axes."""
    axes = _axes(ax)
    growth = np.ma.masked_invalid(self.growth.T)
    largest = float(np.abs(growth).max()) or 1.0
    shown = axes.pcolormesh(self.x, self.y, growth, cmap="RdBu_r", vmin=-largest, vmax=largest)
    axes.figure.colorbar(shown, ax=axes, label="growth rate [1/s]")
    if growth.min() < 0 < growth.max():
        axes.contour(self.x, self.y, growth, levels=[0], colors="black")
    axes.set_xlabel(_label(self.x_name, self.x_unit))
    axes.set_ylabel(_label(self.y_name, self.y_unit))
    return axes
