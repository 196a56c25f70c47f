"""Every command line that a page or a unit shows is one that the program takes: a renamed option breaks a test, not a reader."""

import argparse
import re
import shlex
from importlib.util import find_spec
from pathlib import Path

import pytest
from tables import each_row

from controller.cli import COMMANDS, parser
from controller.commands.shell.files import arguments
from controller.device.application_socket.client import command_line
from controller.errors import UsageError

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    page
    for page in ROOT.rglob("*.md")
    if page.name != "CHANGELOG.md" and not any(part.startswith(".") or part == "build" for part in page.relative_to(ROOT).parts)
)
SHOWN = re.compile(rf"(?<![\w.-])haptic-panel ((?:{'|'.join(COMMANDS)})(?![\w-]).*)")
MODULE = re.compile(r"-m (controller[\w.]+)(.*)")
OTHERS = {"--write-sram", "--write-flash", "--unprotect-flash", "--haptic"}  # openFPGALoader's; a property of style sheets


def code(page):
    """Lines of a page's blocks, each with True, and what stands between backticks in its text, with False."""
    text = page.read_text()
    blocks = re.findall(r"^```[^\n]*\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    spans = re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))
    return [(line, True) for block in blocks for line in block.splitlines()] + [(span, False) for span in spans]


def command(text):
    """Up to a comment, the next command, or where its output goes."""
    return re.split(r"  +#| && | &$| >| \| |\)$| …", text)[0].strip()


def complaint(words, parser_of=parser):
    """What the parser says against a command line; None if it takes it."""
    said = []

    def error(_, message):
        said.append(message)
        raise SystemExit

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(argparse.ArgumentParser, "error", error)
        try:
            parser_of(words).parse_args(words)
        except SystemExit:
            return " ".join(said)
        except UsageError as error:
            return str(error)
    return None


@each_row("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_command_of_a_page_is_taken_by_the_parser(page):
    for text, whole in code(page):
        if found := SHOWN.search(text):
            said = complaint(shlex.split(command(found[1]).replace("[", "").replace("]", "")))
            assert said is None or (not whole and re.search("required|expected one argument", said)), f"{text}: {said}"


@each_row("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_module_that_a_page_calls_is_there_and_knows_its_options(page):
    for text, _ in code(page):
        if (found := MODULE.search(text)) and found[1] == "controller.device.application_socket.client":
            assert complaint(shlex.split(command(found[2])), lambda _: command_line._parser()) is None, text
        elif found:
            spec = find_spec(found[1])
            assert spec, text
            source = Path(spec.origin).read_text()
            for option in re.findall(r"(?<=\s)--[a-z-]+", command(found[2])):
                assert f'"{option}"' in source, text


@each_row("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_file_of_the_checkout_that_a_page_names_is_there(page):
    for text, _ in code(page):
        for path in re.findall(r"(?<![\w/.-])((?:tests|controller|boards|systemd|fpga_rtl)/[\w./*-]*[\w*])", text):
            places = (ROOT, page.parent, ROOT / "controller")
            assert any(next(place.glob(path), None) for place in places), f"{text}: {path}"


def test_every_option_that_a_text_names_by_itself_is_one_of_ours_or_of_a_program_that_is_known():
    ours = {option for action in arguments(parser()) for option in action.option_strings}
    for file in (*(ROOT / "controller").rglob("*.py"), *(ROOT / "tests").rglob("*.py")):
        ours.update(re.findall(r'(?:add_argument|addoption)\(\s*"(--[a-z-]+)"', file.read_text()))
    unknown = {
        (option, str(page.relative_to(ROOT)))
        for page in PAGES
        for text, whole in code(page)
        if not whole
        for option in re.findall(r"(?:^|\s)(--[a-z][a-z-]+)", text)
        if text.startswith("--") and option not in ours | OTHERS
    }
    assert unknown == set()


def test_every_unit_calls_a_command_that_there_is():
    called = [
        (unit.name, line)
        for unit in (ROOT / "systemd").glob("*.service")
        for line in re.findall(r"^Exec\w+=\S*/haptic-panel (.*)$", unit.read_text(), re.MULTILINE)
    ]
    assert called
    for unit, line in called:
        assert complaint(shlex.split(line)) is None, f"{unit}: {line}"


@each_row(
    ("line", "said"),
    [
        ("run --sped max", "'--sped' is no option of haptic-panel run"),
        ("gateware make", "'make' is no action"),
        ("update make-release out --version 1", "the following arguments are required: --counter"),
        ("focus --at 100", "expected 2 arguments"),
    ],
)
def test_a_line_that_the_program_would_refuse_is_found(line, said):
    assert said in complaint(shlex.split(line))
