"""Records of a mill: their analysis, and the calibration of a case by them."""

import json
import tempfile
from pathlib import Path

from ._errors import InputError
from ._millstand import _carry_out, _text_of_value, load
from ._tables import _folder, _options


def _pairs(names):
    return [f"{name}={_text_of_value(value)}" for name, value in (names or {}).items()]


def _text(value):
    return None if value is None else _text_of_value(value)


def _toml_text(text):
    """A text of a TOML file.  JSON has the same quotes and escapes, but it may leave DEL as it is."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise InputError(f"{ascii(text)} holds bytes that are not UTF-8; rename the file or its folder") from None
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


class Record:
    """A file of measured channels, and what it does not say itself."""

    def __init__(self, path, *, units=None, channels=None, scales=None, rate=None, zone=None, between="smooth"):
        self.path = str(Path(path).absolute())  # the program may change its folder before the record is read
        if not Path(self.path).is_file():
            raise InputError(f"the record {self.path} is not a file")
        self.units = dict(units or {})
        self.channels = dict(channels or {})
        self.scales = dict(scales or {})
        self.rate = rate
        self.zone = zone
        self.between = between

    def _reading(self):
        return _options(
            units=_pairs(self.units),
            channels=_pairs(self.channels),
            scales=_pairs(self.scales),
            rate=_text(self.rate),
            zone=self.zone,
        )

    def analyse(self, case=None, *, model=None, speed=None, limit=None, out=None, threads=0, overwrite=False,
                progress=None):
        """Lines, modes, sources and the account of the variance, as `millstand analyse` finds them.

        progress  called on the way as progress(stage, fraction)
        """
        folder, kept = _folder(out, "analysis")
        options = _options(
            names=[self.path],
            out=str(folder),
            case_file=None if case is None else case.path,
            model=model,
            speed=_text(speed),
            limit=_text(limit),
            threads=threads,
            overwrite=overwrite,
            **self._reading(),
        )
        _carry_out("analyse", case, options, progress)
        return Analysis(json.loads((folder / "analysis.json").read_text(encoding="utf-8")), folder, kept)

    def __repr__(self):
        return f"<millstand.Record {self.path}>"


def record(path, *, units=None, channels=None, scales=None, rate=None, zone=None, between="smooth"):
    """A record: CSV, MATLAB, numpy, UFF, WAV and others.

    units     column -> unit, where the file says none: {"a1": "g"}
    channels  column -> place, {"AI_07": "upper_work_roll"}
    scales    column -> scale of a voltage, {"AI_07": "50 mV/g"}
    between   course of the force between its samples; "lines" of a simulated record
    """
    return Record(path, units=units, channels=channels, scales=scales, rate=rate, zone=zone, between=between)


class Analysis:
    """What a record shows; `content` is its analysis.json."""

    def __init__(self, content, folder, kept=None):
        self.content = content
        self.folder = str(folder)
        self._kept = kept

    def _of_kind(self, *kinds):
        return [finding for finding in self.findings if finding["kind"] in kinds]

    @property
    def findings(self):
        """Every finding: kind, channel, frequency (Hz) with its interval, amplitude, unit, owner, evidence."""
        return self.content["findings"]

    @property
    def lines(self):
        """Lines and families of lines."""
        return self._of_kind("line", "family", "locked to the speed")

    @property
    def modes(self):
        """Modes of the stand."""
        return self._of_kind("mode")

    @property
    def account(self):
        """Shares of the variance of each channel, in percent: lines, families, modes, floor, not explained."""
        return self.content["account"]

    @property
    def notes(self):
        return self.content["notes"]

    def __getstate__(self):
        return {**self.__dict__, "_kept": None}


class Calibration:
    """The fit of a case to records; `content` is its calibration.json."""

    def __init__(self, content, folder, origin, kept=None):
        self.content = content
        self.folder = str(folder)
        self._origin = origin
        self._kept = kept

    @property
    def refused(self):
        """Why the fit cannot be trusted; empty: it can."""
        return self.content.get("refusals", [])

    @property
    def case(self):
        """The calibrated case; the case itself where the records agree with it."""
        written = Path(self.folder) / "calibrated.toml"
        if written.exists():
            return load(written)
        if self.refused:
            raise InputError(f"the calibration is refused: {self.refused[0]}; accept=True takes it all the same")
        return self._origin.copy()

    def __getstate__(self):
        return {**self.__dict__, "_kept": None}


def _wish(record, name):
    """What the program reads of one wish of a record, to compare it with that of another."""
    value = getattr(record, name)
    if isinstance(value, dict):
        return {column: _text_of_value(one) for column, one in value.items()}
    return _text(value)


def _require_same(records, name):
    """The program takes this wish once for all records: with different ones some would be read wrongly."""
    first = records[0]
    for other in records[1:]:
        if _wish(other, name) != _wish(first, name):
            raise InputError(
                f"{name}={getattr(first, name)!r} of {first.path}, but {name}={getattr(other, name)!r} of {other.path}: "
                f"one calibration has one `{name}` for all its records; give all of them the same, or write it into "
                "the files"
            )


def _described(record, channels):
    """The [[record]] of a records.toml."""
    lines = [
        "[[record]]",
        f"file = {_toml_text(str(Path(record.path).resolve()))}",
        f"between = {_toml_text(record.between)}",
    ]
    if channels:
        pairs = (f"{_toml_text(column)} = {_toml_text(place)}" for column, place in channels.items())
        lines.append(f"channels = {{ {', '.join(pairs)} }}")
    return "\n".join(lines) + "\n"


def _calibrate(self, records, *, free=None, model=None, model_error=None, accept=False, out=None, threads=0,
               overwrite=False, progress=None):
    """Fits masses, springs and damping of a case to records, as `millstand calibrate` does.

    records   of ms.record(), or paths of files that say all by themselves; `channels` may differ from record to
              record, all else that ms.record() takes is the same for all
    progress  called on the way as progress(stage, fraction)
    """
    records = [one if isinstance(one, Record) else Record(one) for one in records]
    if not records:
        raise InputError("calibrate needs at least one record, for example case.calibrate([ms.record(\"stand4.csv\")])")
    for name in ("rate", "zone", "units", "scales", "between"):
        _require_same(records, name)
    first = records[0]
    # What is given once for all is an option, whose columns the program looks for in every record.
    one_naming = all(_wish(one, "channels") == _wish(first, "channels") for one in records)
    folder, kept = _folder(out, "calibration")
    with tempfile.TemporaryDirectory(prefix="millstand-records-") as listed:
        entries = "".join(_described(one, {} if one_naming else _wish(one, "channels")) for one in records)
        (Path(listed) / "records.toml").write_text(entries, encoding="utf-8")
        options = _options(
            measured=listed,
            free=free,
            model=model,
            model_error=_text(model_error),
            accept=accept,
            out=str(folder),
            threads=threads,
            overwrite=overwrite,
            units=_pairs(first.units),
            channels=_pairs(first.channels) if one_naming else None,
            scales=_pairs(first.scales),
            rate=_text(first.rate),
            zone=first.zone,
        )
        _carry_out("calibrate", self, options, progress)
    return Calibration(json.loads((folder / "calibration.json").read_text(encoding="utf-8")), folder, self, kept)
