"""Updates as a device lives through them, and what must hold whenever the power is cut."""

from dataclasses import dataclass, field, replace

from updated_device import NAME, WORDS, tree_of

LATER = "9.0"  # release that a device which was cut is brought to
TRIES = 3  # starts of a trial


@dataclass
class Truth:
    """What a device may be found to be, reported as a mark in the log.

    Attributes
    ----------
    phase : str
    may_run : tuple of str
        Releases that may be chosen by the next start.
    failed : tuple of str
        Those that must be remembered as bad.
    """

    phase: str
    may_run: tuple
    failed: tuple = ()

    def __str__(self):
        return f"{self.phase} {'/'.join(self.may_run)} {'/'.join(self.failed)}"

    @classmethod
    def read(cls, mark):
        phase, may_run, failed = mark.split(" ")
        return cls(phase, tuple(may_run.split("/")), tuple(filter(None, failed.split("/"))))


@dataclass
class Story:
    """Runs updates, and says beforehand and afterwards what must hold.

    Attributes
    ----------
    device : Device
    tell : callable
        Takes a `Truth`: at once, before anything else is written.
    trees : dict
        Files of each release, by its version.
    """

    device: object
    tell: object = None
    failed: list = field(default_factory=list)
    trees: dict = field(default_factory=dict)

    def now(self, phase, *may_run):
        self.tell(Truth(phase, may_run, tuple(self.failed)))

    def expect(self, *versions):
        """A start of the service, with what it must choose."""
        chosen = self.device.boot()
        if chosen not in versions:
            raise AssertionError(f"{chosen} was started, not {' or '.join(versions)}")

    def install(self, old, new):
        """Download and install; the trial is started once."""
        device = self.device
        self.now("download", old)
        device.download(new)
        self.now("install", old)
        device.install(new)
        self.trees[new] = tree_of(device.root / "releases" / new)
        self.now("switch", old, new)
        device.answer()
        self.now("trial", new)
        self.expect(new)

    def good(self, old, new):
        """An update that waits for its permit first, and stays."""
        device = self.device
        self.install(old, new)
        self.now("trial", old, new)
        for _ in range(TRIES - 1):
            self.expect(new)
        device.ask("stands", new)
        device.answer()
        self.now("waiting", new)
        self.expect(new)
        self.now("promotion", new)
        device.judge("armed")
        device.answer()
        self.now("promoted", new)
        self.expect(new)

    def crashes(self, old, new):
        """An update that never serves: its starts are counted."""
        self.install(old, new)
        self.now("trial", old, new)
        for _ in range(TRIES - 1):
            self.expect(new)
        self.now("fall-back", old)
        self.expect(old)
        self.fell_back(old, new)

    def evaluated_bad(self, old, new):
        """An update that starts, and is faulted."""
        self.install(old, new)
        self.now("fall-back", old, new)
        self.device.judge("faulted")
        self.device.answer()
        self.fell_back(old, new)

    def fell_back(self, old, new):
        self.failed.append(new)
        self.now("fallen-back", old)
        self.expect(old)

    def roll_back(self, new, old):
        """The owner wants the release before."""
        self.now("roll-back", old, new)
        self.device.ask("rollback", new)
        self.device.answer()
        self.failed.append(new)
        self.now("rolled-back", old)
        self.expect(old)


def faults(device, truth, trees):
    """What is wrong with a device that has found power again; an empty list if nothing is. It is started once.

    Parameters
    ----------
    device : Device
    truth : Truth
    trees : dict
    """
    found = []
    try:
        for name in WORDS:
            if (word := device.word(name)) and not NAME.fullmatch(word):
                found.append(f"brick: state: {name} is {word!r}")
        asked = device.root / "requests/trial"
        if asked.exists():  # a wish from before the cut counts
            truth = replace(truth, may_run=(*truth.may_run, asked.read_text().strip()))
        found += faults_of_start(device, truth, trees)
    except (OSError, RuntimeError) as error:
        found.append(f"brick: {error}")
    forgotten = set(truth.failed) - set(device.failed())
    if forgotten:
        found.append(f"lost: {', '.join(sorted(forgotten))} is not remembered as bad")
    return found


def faults_of_start(device, truth, trees):
    """What is wrong when the service is started once; an empty list if nothing is. Raises OSError, Refused."""
    found = []
    chosen = device.boot()
    versions = device.start()
    if not (device.root / "current" / ".complete").is_file():
        found.append(f"brick: {chosen} is not complete")
    if versions != [chosen]:
        found.append(f"mixed: {chosen} runs {' and '.join(versions) or 'nothing'}")
    tree = tree_of(device.root / "releases" / chosen)
    if tree != trees[chosen]:
        other = sorted(name for name in tree.keys() | trees[chosen].keys() if tree.get(name) != trees[chosen].get(name))
        found.append(f"mixed: {len(other)} files of {chosen} are not its own, such as {other[0]}")
    if chosen not in truth.may_run:
        found.append(f"lost: {chosen} was started, not {' or '.join(truth.may_run)}")
    return found


def carry_on(device):
    """Bring a device that has found power again to a later release; what is wrong then.

    Parameters
    ----------
    device : Device
        Its repositories have a release LATER that it has not had.
    """
    try:
        trial = device.word("trial")
        if trial:  # it is decided before anything else is installed
            device.judge("armed")
            device.answer()
            if device.boot() != trial:
                return [f"brick: the trial of {trial} did not go on"]
        device.install(LATER)
        device.answer()
        chosen = device.boot()
        device.judge("armed")
        device.answer()
        found = [] if chosen == device.boot() == device.word("current") == LATER else [f"lost: {device.boot()} runs after {LATER}"]
        if device.start() != [LATER]:
            found.append(f"mixed: {LATER} runs {' and '.join(device.start())}")
    except (OSError, RuntimeError) as error:
        return [f"stuck: {error}"]
    releases = sorted((device.root / "releases").iterdir())
    if len(releases) > 3 or not all((release / ".complete").exists() for release in releases):  # in use, before it, and before that
        found.append(f"rest: releases {', '.join(release.name for release in releases)}")
    rests = [*(device.root / "download/parts").iterdir(), *(device.root / "download/metadata").glob("tmp*")]
    return found + [f"rest: {path}" for path in rests]
