"""The software bill of materials of a release, in CycloneDX 1.6: its wheels with their licences and what they bring along, and its
boards, banks and bitstreams.
"""

import hashlib
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from datetime import UTC, datetime
from email.message import Message
from email.parser import BytesParser
from pathlib import Path
from typing import Final

from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom, BomMetaData
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.model.license import DisjunctiveLicense, LicenseExpression
from cyclonedx.output import make_outputter
from cyclonedx.schema import OutputFormat, SchemaVersion
from cyclonedx.spdx import is_expression, is_supported_id
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL
from packaging.utils import parse_wheel_filename

from controller.errors import UpdateError
from controller.workshop.publish.release_folder import digest_of

KINDS: Final = {"gateware": ComponentType.FIRMWARE, "banks": ComponentType.DATA, "boards": ComponentType.DATA}
License = LicenseExpression | DisjunctiveLicense


def sbom(
    version: str,
    time_s: int,  # its time, in s since 1970
    own: Path,  # wheel of this project
    wheels: Iterable[Path],  # the others
    others: Mapping[str, Path],  # of each other file's path in the release, where it is
    about: Mapping[str, Mapping[str, str]],  # of a file's path, what is known of how it was made
) -> bytes:
    """The bill of a release: the same bytes for the same files.

    Raises UpdateError if a wheel cannot be read, or tells another version than its name or the release.
    """
    main = _of_wheel(own, ComponentType.FIRMWARE)
    if main.version != version:
        raise UpdateError(f"{own}: tells version {main.version}, and the release is {version}")
    parts = [*(_of_wheel(wheel, ComponentType.LIBRARY) for wheel in wheels), *_of_files(others, about)]
    bill = Bom(components=parts, metadata=BomMetaData(component=main, timestamp=datetime.fromtimestamp(time_s, UTC)))
    bill.register_dependency(main, parts)
    bill.serial_number = None  # type: ignore[assignment] # a random one by default
    text = make_outputter(bill, OutputFormat.JSON, SchemaVersion.V1_6).output_as_string(indent=1)
    if invalid := JsonStrictValidator(SchemaVersion.V1_6).validate_str(text):
        raise UpdateError(f"the bill of materials does not fit its own schema: {invalid}")
    return text.encode() + b"\n"


def _of_wheel(wheel: Path, kind: ComponentType) -> Component:
    """A wheel: licences by its own metadata, and shared libraries of others that it brings along."""
    try:
        name, version, *_ = parse_wheel_filename(wheel.name)
        with zipfile.ZipFile(wheel) as archive:
            (metadata,) = (path for path in archive.namelist() if path.count("/") == 1 and path.endswith(".dist-info/METADATA"))
            reported = BytesParser().parsebytes(archive.read(metadata))
            vendored = [
                Component(type=ComponentType.FILE, name=path, bom_ref=f"{name}:{path}", hashes=[_sha256(archive.read(path))])
                for path in sorted(archive.namelist())
                if ".libs/" in path and not path.endswith("/")
            ]
    except (zipfile.BadZipFile, ValueError, OSError) as error:
        raise UpdateError(f"{wheel}: is no wheel that can be read ({error})") from error
    if reported["Version"] != str(version):
        raise UpdateError(f"{wheel}: tells version {reported['Version']} inside")
    return Component(
        type=kind,
        name=name,
        version=str(version),
        bom_ref=f"{name}=={version}",
        purl=PackageURL("pypi", None, name, str(version)),
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest_of(wheel)[0])],
        licenses=_licences(reported),
        components=vendored,
    )


def _licences(reported: Message) -> list[License]:
    """What a wheel tells of its licence: an expression of SPDX, else its name, else what its classifiers say."""
    expression, text = reported["License-Expression"], (reported["License"] or "").strip()
    if expression and is_expression(expression):
        return [LicenseExpression(expression)]
    if is_supported_id(text):
        return [DisjunctiveLicense(id=text)]
    if is_expression(text):
        return [LicenseExpression(text)]
    classified = [line.rpartition(" :: ")[2] for line in reported.get_all("Classifier", []) if line.startswith("License :: ")]
    named = classified or ([text.splitlines()[0]] if text else [])  # some have the whole text there
    return [DisjunctiveLicense(name=name) for name in named]


def _of_files(others: Mapping[str, Path], about: Mapping[str, Mapping[str, str]]) -> Iterator[Component]:
    """Boards, banks and bitstreams, by their paths in the release."""
    for path, file in sorted(others.items()):
        yield Component(
            type=KINDS[path.partition("/")[0]],
            name=path,
            bom_ref=path,
            hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest_of(file)[0])],
            properties=[Property(name=f"haptic-panel:{name}", value=value) for name, value in about.get(path, {}).items()],
        )


def _sha256(data: bytes) -> HashType:
    return HashType(alg=HashAlgorithm.SHA_256, content=hashlib.sha256(data).hexdigest())
