"""The lock file: version and hashes of each package that a device gets, and which wheels of a folder it means for one platform."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from packaging.requirements import InvalidRequirement, Requirement
from packaging.tags import Tag, compatible_tags, cpython_tags
from packaging.utils import InvalidWheelFilename, NormalizedName, canonicalize_name, parse_wheel_filename

from controller.errors import UpdateError
from controller.workshop.publish.release_folder import digest_of

GLIBC: Final = (2, 36)  # of Debian 12; wheels for a newer one would not start
OLDEST_GLIBC: Final = {"x86_64": 5}  # for which there are wheels; 17 for all other computers
HASH: Final = re.compile(r"--hash=sha256:([0-9a-f]{64})")
BUILT: Final = frozenset({"cobs", "evdev", "spidev"})  # the registry has their sources alone: wheels are built here


@dataclass(frozen=True, slots=True)
class Target:
    """What wheels are for."""

    architecture: str  # as `platform.machine` has it
    minor: int  # of Python 3

    @classmethod
    def of(cls, platform: str) -> Self:
        """Target of a platform such as `aarch64-cp311`; raises UpdateError if it is not written so."""
        found = re.fullmatch(r"([0-9a-z_]+)-cp3([0-9]{1,2})", platform)
        if not found:
            raise UpdateError(f"platform {platform!r}: must be like aarch64-cp311 or x86_64-cp311")
        return cls(found[1], int(found[2]))

    def platforms(self) -> list[str]:
        """Tags of the platform, the best first."""
        oldest = OLDEST_GLIBC.get(self.architecture, 17)
        names = [f"manylinux_{GLIBC[0]}_{minor}_{self.architecture}" for minor in range(GLIBC[1], oldest - 1, -1)]
        return [*names, f"manylinux2014_{self.architecture}", f"linux_{self.architecture}"]

    def tags(self) -> list[Tag]:
        """All tags of wheels that it can use, the best first."""
        version, platforms = (3, self.minor), self.platforms()
        return [*cpython_tags(version, platforms=platforms), *compatible_tags(version, f"cp3{self.minor}", platforms)]

    def environment(self) -> dict[str, str]:
        """What markers of requirements are evaluated by."""
        return {
            "implementation_name": "cpython",
            "os_name": "posix",
            "platform_machine": self.architecture,
            "platform_python_implementation": "CPython",
            "platform_system": "Linux",
            "python_full_version": f"3.{self.minor}.0",
            "python_version": f"3.{self.minor}",
            "sys_platform": "linux",
        }


@dataclass(frozen=True, slots=True)
class Locked:
    """A package of the lock file."""

    requirement: Requirement  # with one exact version
    hashes: frozenset[str]  # SHA-256 of its files, whatever the platform

    @property
    def name(self) -> NormalizedName:
        """Its name as it is compared."""
        return canonicalize_name(self.requirement.name)

    @property
    def line(self) -> str:
        """As pip reads it."""
        name = f"{self.requirement.name}{self.requirement.specifier}"
        return " ".join([name, *(f"--hash=sha256:{digest}" for digest in sorted(self.hashes))]) + "\n"


def read_lock(file: Path) -> list[Locked]:
    """All packages of a lock file, in its order.

    Raises UpdateError if it cannot be read, or a package has no exact version or no hash.
    """
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise UpdateError(f"{file}: cannot be read: {error}") from error
    packages = []
    for line in re.sub(r"(#.*)?$", "", text.replace("\\\n", " "), flags=re.MULTILINE).splitlines():
        if not line.strip():
            continue
        try:
            requirement = Requirement(HASH.sub("", line).strip())
        except InvalidRequirement as error:
            raise UpdateError(f"{file}: {line.split()[0]} is no package with a version and hashes: make the file again") from error
        found = Locked(requirement, frozenset(HASH.findall(line)))
        if not found.hashes or [one.operator for one in requirement.specifier] != ["=="]:
            raise UpdateError(f"{file}: {requirement.name} has no exact version, or no hash: make the file again")
        packages.append(found)
    return packages


def wanted(packages: Iterable[Locked], target: Target) -> list[Locked]:
    """Those that a target needs."""
    environment = target.environment()
    return [one for one in packages if not one.requirement.marker or one.requirement.marker.evaluate(environment)]


def choose(packages: Iterable[Locked], target: Target, folder: Path) -> dict[NormalizedName, Path]:
    """The wheel of each package, in a folder, that a target can use best; other files there do not matter.

    Raises UpdateError if there is none, or it is not the one that was locked.
    """
    there = wheels_of(folder)
    return {one.name: _choose_one(one, target, [wheel for wheel in there if wheel[1] == one.name], folder) for one in packages}


def own_wheel(name: str, target: Target, folder: Path) -> Path | None:
    """This project's wheel for a target, if a folder has one.

    Raises UpdateError if it has several, or only those for other targets.
    """
    found = [wheel for wheel in wheels_of(folder) if wheel[1] == canonicalize_name(name)]
    suitable = [path for path, *_, tags in found if not tags.isdisjoint(target.tags())]
    if len(suitable) > 1 or (found and not suitable):
        names = ", ".join(path.name for path, *_ in found)
        raise UpdateError(f"{folder}: must have one wheel of {name} for {target.architecture}-cp3{target.minor}, has {names}")
    return suitable[0] if suitable else None


Wheel = tuple[Path, NormalizedName, str, frozenset[Tag]]


def wheels_of(folder: Path) -> list[Wheel]:
    """Each wheel of a folder: file, name, version, tags.

    Raises UpdateError if the folder is absent, or a file is called as no wheel can be.
    """
    if not folder.is_dir():
        raise UpdateError(f"{folder}: there is no such folder of wheels")
    wheels = []
    for path in sorted(folder.glob("*.whl")):
        try:
            name, version, _, tags = parse_wheel_filename(path.name)
        except InvalidWheelFilename as error:
            raise UpdateError(f"{path}: is not named as a wheel is: remove it") from error
        wheels.append((path, name, str(version), tags))
    return wheels


def _choose_one(package: Locked, target: Target, found: list[Wheel], folder: Path) -> Path:
    what = f"{package.requirement.name}{package.requirement.specifier}"
    order = {tag: place for place, tag in enumerate(target.tags())}
    right = [wheel for wheel in found if package.requirement.specifier.contains(wheel[2], prereleases=True)]
    usable = sorted((min(order.get(tag, len(order)) for tag in wheel[3]), wheel[0]) for wheel in right)
    if not usable or usable[0][0] == len(order):
        there = ", ".join(wheel[0].name for wheel in found) or "none"
        raise UpdateError(
            f"{folder}: has no wheel of {what} for {target.architecture}-cp3{target.minor} (of this package: {there})"
        )
    path = usable[0][1]
    if package.name not in BUILT and digest_of(path)[0] not in package.hashes:
        raise UpdateError(f"{path}: is not the file of {what} whose hash is locked: take the one of the registry")
    return path
