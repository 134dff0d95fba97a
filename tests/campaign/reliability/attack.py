"""What the campaigns of this folder share: options, trials, the invariants of docs/reliability.md.

    tests/campaign/reliability/NAME PROGRAM [--seed N] [--trials N] [--only TEXT] [--keep]

prints one line for each attack that lost, and one line of figures: tried, survived, lost.  Without --trials the short form of the
suite runs.  The same seed makes the same attacks.  Exit code 1 where anything was lost.
"""
import argparse, hashlib, json, os, random, re, resource, shutil, signal, subprocess, sys, tempfile, time

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
CASES = os.path.join(SOURCE, "cases")
SENTENCE_CODES = (1, 2, 3)
# What a program of ours must never show, whatever its input.
NEVER = re.compile(r"internal error|Assertion|terminate called|what\(\)|Traceback|AddressSanitizer|runtime error:|std::|boost::|nlohmann|"
                   r"\[json\.exception|core dumped|basic_string|vector::_M")


def parser(text):
    p = argparse.ArgumentParser(description=text)
    p.add_argument("program")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--trials", type=int, help="of the long form; without it the short form of the suite")
    p.add_argument("--only", default="", help="attacks whose name has this text")
    p.add_argument("--keep", action="store_true", help="keep the working folder")
    p.add_argument("--tell", action="store_true", help="a line for each call of the program")
    return p


# The address sanitizer reserves terabytes of addresses, and ends a process whose own system calls fail.
SANITIZED = "ASAN_OPTIONS" in os.environ


def address_limit(gigabytes):
    """For preexec_fn of Campaign.call: a bound on the addresses of the program; none with the address sanitizer."""
    return None if SANITIZED else lambda: resource.setrlimit(resource.RLIMIT_AS, (gigabytes << 30, gigabytes << 30))


def skip_where_sanitized():
    if SANITIZED:
        print("SKIPPED: the address sanitizer itself fails here")
        raise SystemExit(0)


class Outcome:
    def __init__(self, code, out, err, seconds):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds

    def __repr__(self):
        return "exit %s after %.1f s: %s" % (self.code, self.seconds, (self.err or self.out).strip()[:300])


class Campaign:
    def __init__(self, name, options):
        self.name, self.options = name, options
        self.program = os.path.abspath(options.program)
        self.random = random.Random(options.seed)
        self.tried = self.lost = 0
        self.began = time.time()
        self.work = tempfile.mkdtemp(prefix="millstand-%s-" % name, dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self.environment = dict(os.environ, LC_ALL="C.UTF-8", OMP_NUM_THREADS="1")
        self.environment.pop("MILLSTAND_TEST_CACHE", None)
        self.copy = None

    def path(self, *parts):
        path = os.path.join(self.work, *parts)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return path

    def open_to_others(self):
        """Programs and cases where another user can read them, as in an installed program; the folder of the cases.  A tree below
        the home of root is copied."""
        if os.geteuid() != 0 or all(searched_by_others(path) for path in (self.program, CASES)):
            return CASES
        self.copy = tempfile.mkdtemp(prefix="millstand-copy-")
        os.chmod(self.copy, 0o755)
        beside = os.path.dirname(self.program)
        for name in os.listdir(beside):
            if name.startswith("millstand") and os.path.isfile(os.path.join(beside, name)):
                shutil.copy(os.path.join(beside, name), self.copy)
        self.program = os.path.join(self.copy, os.path.basename(self.program))
        return shutil.copytree(CASES, os.path.join(self.copy, "cases"))

    def wants(self, attack):
        return self.options.only in attack

    def call(self, arguments, timeout=120, before=None, **more):
        """The program with these arguments; code "hang" where it does not end in time."""
        command = (before or []) + [self.program] + arguments
        begin = time.time()
        more.setdefault("env", self.environment)
        more.setdefault("cwd", SOURCE)
        more.setdefault("stdin", subprocess.DEVNULL)
        more.setdefault("stdout", subprocess.PIPE)
        more.setdefault("stderr", subprocess.PIPE)
        child = subprocess.Popen(command, start_new_session=True, **more)
        try:
            out, err = child.communicate(timeout=timeout)
            code = child.returncode
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            out, err = child.communicate()
            code = "hang"
        text = lambda b: (b or b"").decode("utf-8", "replace")
        if self.options.tell:
            print("   exit %s: %s: %s" % (code, ascii(arguments)[:300], ascii(text(err).strip())[:300]), flush=True)
        return Outcome(code, text(out), text(err), time.time() - begin)

    def judge(self, attack, problems):
        """One trial is over.  problems: sentences; empty: survived."""
        self.tried += 1
        problems = [p for p in problems if p]
        if problems:
            self.lost += 1
            print("   lost: %s: %s" % (attack, "; ".join(problems)), flush=True)

    def sentence(self, outcome, allowed=(0, 1, 2, 3)):
        """Promise 3 of one call: an exit code of ours, a sentence where it is not 0, no inner text of a library."""
        problems = []
        if outcome.code not in allowed:
            problems.append(repr(outcome))
        elif outcome.code != 0 and len(outcome.err.strip()) < 15:
            problems.append("exit %s without a sentence" % outcome.code)
        found = NEVER.search(outcome.err + outcome.out)
        if found:
            problems.append("shows %r: %s" % (found.group(0), (outcome.err + outcome.out)[:300]))
        return problems

    def end(self):
        seconds = time.time() - self.began
        print("%-14s seed %d: %d tried, %d survived, %d lost, %.0f s" %
              (self.name, self.options.seed, self.tried, self.tried - self.lost, self.lost, seconds), flush=True)
        if not self.options.keep:
            shutil.rmtree(self.work, ignore_errors=True)
        if self.copy:
            shutil.rmtree(self.copy, ignore_errors=True)
        sys.exit(1 if self.lost or not self.tried else 0)


def searched_by_others(path):
    """Whether every folder above a path lets other users through."""
    while path != "/":
        path = os.path.dirname(path)
        if not os.stat(path).st_mode & 0o001:
            return False
    return True


def sha(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


# Files that hold times of the clock, the machine or the page made of them.
CLOCKED = ("run.json", "report.html", "millstand.log")


def contents(folder, clocked=False):
    """Name -> hash of every file that a folder shows; without those that hold times."""
    found = {}
    for base, folders, names in os.walk(folder):
        folders[:] = [n for n in folders if not n.startswith(".")]
        for name in names:
            path = os.path.join(base, name)
            short = os.path.relpath(path, folder)
            if os.path.isfile(path) and (clocked or short not in CLOCKED):
                found[short] = sha(path)
    return found


def differing(a, b):
    return sorted(name for name in set(a) | set(b) if a.get(name) != b.get(name))


def whole(folder):
    """Promise 1: problems of a result folder that shows something: every file of one run, each JSON whole, no NaN.  The lists of
    run.json are compared with the files they name."""
    problems = []
    results, run = os.path.join(folder, "results.json"), os.path.join(folder, "run.json")
    if not os.path.exists(results):
        return ["no results.json"]
    identities = set()
    for path in (results, run):
        try:
            identities.add(json.load(open(path), parse_constant=refuse_constant)["run_id"])
        except (ValueError, KeyError, OSError) as e:
            problems.append("%s: %s" % (path, e))
    for name in os.listdir(folder):
        if name.endswith(".toml"):
            identities.add(open(os.path.join(folder, name)).readline().split()[-1])
    page = os.path.join(folder, "report.html")
    if os.path.exists(page):
        named = re.search(r", run ([0-9a-f]{16})", open(page, encoding="utf-8").read())
        identities.add(named.group(1) if named else "a page that names no run")
    if len(identities) != 1:
        problems.append("files of several runs: %s" % sorted(identities))
    return problems


def refuse_constant(text):
    raise ValueError("a number that is not finite: " + text)


def numbers(folder):
    """The results of a run without its remarks: what a run says of its surroundings (a cache it may not write) is no result."""
    stored = json.load(open(os.path.join(folder, "results.json")), parse_constant=refuse_constant)
    return {key: value for key, value in stored.items() if key not in ("warnings", "warning_records", "status")}
