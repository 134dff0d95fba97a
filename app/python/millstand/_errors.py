"""What can go wrong, with places and remedies."""

from typing import NamedTuple


class Place(NamedTuple):
    """Where something stands; line 0: no place in a file (a value that was set, an argument)."""

    file: str
    line: int
    column: int

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column}" if self.line else self.file


class Problem(NamedTuple):
    """One mistake: place, message, and the parts of the message."""

    place: Place
    message: str
    value: str
    remedy: str
    related: tuple = ()

    def __str__(self):
        return f"{self.place}: {self.message}" if self.place.file else self.message


class WarningRecord(NamedTuple):
    """A warning of a run by its parts; docs/output.md has the ids."""

    id: str
    subject: str
    fact: str
    detail: str
    remedy: str
    concerns: tuple
    key: str
    place: Place

    def __str__(self):
        head = f"{self.subject}: {self.fact}" if self.subject else self.fact
        rest = "; ".join(part for part in (self.detail, self.remedy) if part)
        return head + ((": " if self.detail else "; ") + rest if rest else "")


class InputError(ValueError):
    """A mistake in a case, a record or an argument; str() is what the program prints."""

    def __init__(self, text, problems=()):
        super().__init__(text, tuple(problems))

    def __str__(self):
        return self.args[0]

    @property
    def problems(self):
        return self.args[1]


class SystemError(InputError, OSError):
    """The disk, a permission or a limit of the system refuses what was rightly asked for."""


class SolverError(RuntimeError):
    """A numerical failure: what failed, where it stood, its usual cause, what to change, what is good."""

    def __init__(self, what, where="", cause="", remedy="", kept=""):
        super().__init__(what, where, cause, remedy, kept)

    def __str__(self):
        names = ("", "where", "usual cause", "change", "kept")
        return "\n  ".join(f"{n}: {t}" if n else t for n, t in zip(names, self.args) if t)

    @property
    def what(self):
        return self.args[0]

    @property
    def where(self):
        return self.args[1]

    @property
    def cause(self):
        return self.args[2]

    @property
    def remedy(self):
        return self.args[3]

    @property
    def kept(self):
        return self.args[4]
