"""Tables of many runs: sweep and study."""

import json
import math
import tempfile
from pathlib import Path

import numpy as np

from ._errors import InputError, SolverError
from ._millstand import _carry_out, _full_name, _list_items, _text_of_value


def _variation(key, values):
    """KEY=a,b,c of a list; a text is taken as written: "0..200 um:21"."""
    if isinstance(values, str):
        return f"{key}={values}"
    items = [_item(key, _text_of_value(value)) for value in values]
    return f"{key}={','.join(items)}"


def _item(key, text):
    """One value of a list.  A text that would be read as several values is put in quotes, which keep it whole."""
    if _stays_whole(text):
        return text
    quoted = '"' + text.replace("\\", "\\\\") + '"'
    if '"' in text or not _stays_whole(quoted):
        raise InputError(f"{key}: the value {text} has a comma, a bracket or a quote that would end it too early")
    return quoted


def _stays_whole(text):
    """Is the text one value, wherever it is in a list?"""
    return _list_items(f"{text},0") == [text.strip(" \t"), "0"]


def _nan_for_null(values):
    return [math.nan if value is None else value for value in values]


def _folder(out, what):
    """The folder of a verb, and what keeps it alive when the user named none."""
    if out is not None:
        return Path(out).absolute(), None  # the program may change its folder before it reads the results
    kept = tempfile.TemporaryDirectory(prefix=f"millstand-{what}-")
    return Path(kept.name) / what, kept


def _options(**named):
    return {name: value for name, value in named.items() if value is not None}


class SweepTable:
    """One row for each combination of values: keys and watched results, each column with its unit."""

    def __init__(self, content, folder, kept=None):
        self._content = content
        self._kept = kept
        self.folder = str(folder)
        self.work = content["work"]
        columns = content["keys"] + content["results"]
        self.names = [column["name"] for column in columns]
        self.units = {column["name"]: column["unit"] or "1" for column in columns}
        self.base = {one["name"]: (one["base"], one["unit"]) for one in content["results"]}
        self.failures = [row["failure"] for row in content["rows"]]
        self.texts = [tuple(row["values"]) for row in content["rows"]]
        rows = [tuple(_nan_for_null(row["numbers"] + row["results"])) for row in content["rows"]]
        fields = np.dtype([(name, "f8") for name in self.names], metadata={"units": self.units})
        self.array = np.array(rows, dtype=fields)

    def __len__(self):
        return len(self.array)

    def __getitem__(self, name):
        """A column in its unit (units[name]); nan where a row failed or its value is a word."""
        return self.array[_full_name(name)]

    def __iter__(self):
        return iter(self.array)

    def __getstate__(self):
        return {**self.__dict__, "_kept": None, "array": None}

    def __setstate__(self, state):
        self.__init__(state["_content"], state["folder"])

    def __str__(self):
        heads = [f"{name} [{self.units[name]}]" if self.units[name] != "1" else name for name in self.names]
        lines = ["  ".join(f"{head:>14}" for head in heads)]
        for row, failure in zip(self.array, self.failures):
            cells = (f"{value:>{max(14, len(head))}.6g}" for value, head in zip(row, heads))
            lines.append("  ".join(cells) + (f"  {failure}" if failure else ""))
        return "\n".join(lines)


def sweep(case, vary, watch=None, *, model="full", out=None, threads=0, fresh=False, cache=None, overwrite=False,
          progress=None):
    """Every combination of the values in `vary`, as `millstand sweep` computes it.

    vary   key -> list of values ("0 um", (50, "um"), "solid"), or a text "0..200 um:21"
    watch  names of results; None: the usual ones of the kind
    model  "full" as a run, "quick" by closed forms
    progress  called on the way as progress(stage, fraction); progress=ms.bar shows a bar
    """
    folder, kept = _folder(out, "sweep")
    options = _options(
        vary=[_variation(key, values) for key, values in vary.items()],
        watch=list(watch or []),
        row_model=model,
        out=str(folder),
        threads=threads,
        fresh=fresh,
        cache=None if cache is None else str(cache),
        overwrite=overwrite,
    )
    code = _carry_out("sweep", case, options, progress)
    table = SweepTable(json.loads((folder / "sweep.json").read_text(encoding="utf-8")), folder, kept)
    if code != 0:
        raise SolverError(f"every row of the sweep failed; the first: {table.failures[0]}")
    return table


class Study:
    """The folder of a study; `report` is its report.json."""

    def __init__(self, folder, kept=None):
        self.folder = str(Path(folder).absolute())
        self._kept = kept

    def run(self, *, engine="here", jobs=0, keep=False, cache_limit=None, progress=None):
        """Computes the rows that are not finished; run again after an interruption.

        keep         all files of each row of a full model, not results.json alone
        cache_limit  largest size of the cache folder, "20GB"; what was not used for longest is removed first
        progress     called about once a second with the share of the open rows that are finished
        """
        options = _options(
            action="run", target=self.folder, engine=engine, jobs=jobs, keep=keep, cache_limit=cache_limit
        )
        code = _carry_out("study", None, options, progress)
        if code == 130:
            raise KeyboardInterrupt
        if code != 0:
            raise SolverError(f"the engine '{engine}' of the study {self.folder} failed with exit code {code}")
        return self

    def report(self, *, allow_failed=False):
        """Statistics of the finished rows; writes report.html and returns the content of report.json."""
        _carry_out("study", None, {"action": "report", "target": self.folder, "allow_failed": allow_failed})
        return json.loads((Path(self.folder) / "report.json").read_text(encoding="utf-8"))

    def merge(self):
        """results.csv of the finished rows; returns its path."""
        _carry_out("study", None, {"action": "merge", "target": self.folder})
        return str(Path(self.folder) / "results.csv")

    def __getstate__(self):
        return {"folder": self.folder, "_kept": None}


def study(case, vary, watch=None, *, method="monte-carlo", samples=None, seed=1, model="full", correlate=None,
          list_file=None, minimise=None, maximise=None, out=None, run=True, engine="here", jobs=0, threads=0, cache=None,
          keep=False, cache_limit=None, overwrite=False, progress=None):
    """A study as `millstand study` draws it; run=False draws and checks the rows only.

    vary      key -> distribution "normal(5, 0.2) MN/mm" (or a list of values for method="grid")
    minimise  the result whose least value method="optimise" searches between the bounds of uniform(low, high);
              maximise its greatest one
    keep, cache_limit, progress  as in Study.run
    """
    folder, kept = _folder(out, "study")

    def written(key, values):
        is_drawn = isinstance(values, str) and values.rstrip().partition("(")[2] != ""
        return f"{key}~{values}" if is_drawn else _variation(key, values)

    options = _options(
        action="new",
        vary=[written(key, values) for key, values in (vary or {}).items()],
        watch=list(watch or []),
        method=method,
        samples=samples,
        seed=seed,
        row_model=model,
        correlate=list(correlate or []),
        list=None if list_file is None else str(list_file),
        minimise=minimise,
        maximise=maximise,
        out=str(folder),
        threads=threads,
        cache=None if cache is None else str(cache),
        cache_limit=cache_limit,
        overwrite=overwrite,
    )
    _carry_out("study", case, options, progress)
    drawn = Study(folder, kept)
    if run:
        drawn.run(engine=engine, jobs=jobs, keep=keep, cache_limit=cache_limit, progress=progress)
    return drawn
