"""Mutants of Verilog: small mechanical changes of a module's source, found in its syntax tree (pyslang).

The preprocessor's lines are blanked and its names are read as identifiers, so that a place in the tree is one in the file;
what stands behind `ifdef` is left alone. Whatever must be constant (declarations, widths, indices of parts, loops, labels of a
case) is left alone too.
`schema` writes all mutants of a module into one text, each behind `mutants::selected == number`: it is compiled once, and the
environment variable MUTANT says which of them runs (0: none).
"""

import random
import re
import zlib
from typing import NamedTuple

from pyslang import syntax

OPERATORS = {
    "condition": "negate the condition of an if or of ?:",
    "logic": "&& for ||, || for &&",
    "bitwise": "& for |, | for &, one of them for ^",
    "equality": "!= for ==, == for !=",
    "relation": "<= for <, < for <=, >= for >, > for >=",
    "arithmetic": "- for +, + for -",
    "shift": ">> for <<, << for >>",
    "negation": "leave out ! or ~",
    "term": "leave out one side of &&, ||, &, | or ^",
    "constant": "a number one higher, or a bit the other way round",
    "limit": "a named constant one higher",
    "branches": "swap the branches of ?:",
    "statement": "leave out an assignment of an always block",
    "arm": "leave out what a case does at one of its labels",
    "reset": "another value after reset, all bits turned",
    "stuck": "a bit of a register stuck",
    "index": "the neighbour of an element or bit",
    "connection": "an input of an instance tied to 0",
    "sticky": "what a register has once taken it keeps: the second time",
    "filter": "a bit that is low, or high, for one clock is not seen",
}
BINARY = {
    "LogicalAndExpression": ("logic", "||"),
    "LogicalOrExpression": ("logic", "&&"),
    "BinaryAndExpression": ("bitwise", "|"),
    "BinaryOrExpression": ("bitwise", "&"),
    "BinaryXorExpression": ("bitwise", "|"),
    "EqualityExpression": ("equality", "!="),
    "InequalityExpression": ("equality", "=="),
    "LessThanExpression": ("relation", "<="),
    "LessThanEqualExpression": ("relation", "<"),
    "GreaterThanExpression": ("relation", ">="),
    "GreaterThanEqualExpression": ("relation", ">"),
    "AddExpression": ("arithmetic", "-"),
    "SubtractExpression": ("arithmetic", "+"),
    "LogicalShiftLeftExpression": ("shift", ">>"),
    "LogicalShiftRightExpression": ("shift", "<<"),
}
TERMS = ("logic", "bitwise")
CONSTANT_PLACES = {
    "ParameterDeclarationStatement",
    "ParameterDeclaration",
    "ParameterPortList",
    "ParameterValueAssignment",
    "VariableDimension",
    "RangeDimensionSpecifier",
    "SimpleRangeSelect",
    "InitialBlock",
    "LoopGenerate",
    "EventControlWithExpression",
    "AnsiPortList",
    "GenvarDeclaration",
    "SystemTask",
}
SELECTED = "mutants::selected"
PACKAGE = (
    "package mutants;\n"
    'int unsigned selected = $c32("(std::getenv(\\"MUTANT\\") ? std::atoi(std::getenv(\\"MUTANT\\")) : 0)");\nendpackage\n'
)
UNSIGNED = re.compile(r"(\d+)?\s*('[bdhBDH])?\s*([\da-fA-F_]+)")


class Mutant(NamedTuple):
    """One change.

    Attributes
    ----------
    module, operator : str
    start, end : int
        Characters of the file that are replaced.
    text : str
        By what.
    form : str
        How the change is written beside the original: "expression", "leave" (out the statement), "append".
    line : int
    before : str
        The line as it is.
    name : str
        Stays the same where other lines change: module, operator and a hash of line, place and change.
    """

    module: str
    operator: str
    start: int
    end: int
    text: str
    form: str
    line: int
    before: str
    name: str

    def applied(self, source: str) -> str:
        """The module with this change alone."""
        text = f"({self.text})" if self.form == "expression" else self.text
        return source[: self.start] + text + source[self.end :]

    def shown(self, source: str) -> str:
        return f"{' '.join(source[self.start : self.end].split())[:50]} → {' '.join(self.text.split())[:60]}"


def blanked(source: str) -> str:
    """As long as the source, without directives and what they leave out, and with macros as identifiers."""
    lines, taken = [], [True]
    for line in source.split("\n"):
        directive = re.match(r"\s*`(ifdef|ifndef|else|endif|include|default_nettype|timescale|define|undef)\b", line)
        word = directive[1] if directive else ""
        if word in {"ifdef", "ifndef"}:
            taken.append(word == "ifndef")
        elif word == "else":
            taken[-1] = not taken[-1]
        elif word == "endif":
            taken.pop()
        lines.append(" " * len(line) if directive or not all(taken) else line)
    return "\n".join(lines).replace("`", "_")


def other_number(text: str) -> str:
    """A literal one higher within its width."""
    match = UNSIGNED.fullmatch(text.strip())
    if match is None:
        return ""
    width, base, digits = match[1], match[2], match[3].replace("_", "")
    if base is None:
        return str(int((width or "") + digits) + 1)
    radix = {"b": 2, "d": 10, "h": 16}[base[1].lower()]
    value = int(digits, radix) + 1
    if width:
        value %= 1 << int(width)
    return f"{width or ''}'d{value}"


class Finder:
    """All mutants of one module's source."""

    def __init__(self, module: str, source: str) -> None:
        self.module, self.source, self.found = module, source, []
        text = blanked(source)
        tree = syntax.SyntaxTree.fromText(text)
        assert not any(diagnostic.isError() for diagnostic in tree.diagnostics), module
        self.constants = set(re.findall(r"\b([A-Z][A-Z0-9_]+)\b\s*=(?!=)", text))
        self.registers = dict(self._registers(text))
        self._visit(tree.root, [])

    @staticmethod
    def _registers(text):
        """Name and highest bit of each `reg` that is no memory; None for a width that is no number."""
        for width, names in re.findall(r"^\s*reg\s*(\[[^\]]*\])?([^;=\[]*);", text, flags=re.MULTILINE):
            high = re.fullmatch(r"\[\s*(\d+)\s*:\s*0\s*\]", width)
            for name in re.findall(r"\w+", names):
                yield name, 0 if not width else int(high[1]) if high else None

    def text(self, node):
        return self.source[node.sourceRange.start.offset : node.sourceRange.end.offset]

    def add(self, operator, node, text, form="expression"):
        self.add_at(operator, node.sourceRange.start.offset, node.sourceRange.end.offset, text, form)

    def add_at(self, operator, start, end, text, form):
        if self.source[start:end].strip() == text:
            return
        first = self.source.rfind("\n", 0, start) + 1
        last = self.source.find("\n", start)
        line, before = self.source.count("\n", 0, start) + 1, self.source[first:last].strip()
        indent = len(self.source[first:last]) - len(self.source[first:last].lstrip())
        where = f"{before}|{start - first - indent}|{end - start}|{text}"
        if form == "append":  # behind the last statement of a block: there the line says nothing
            where = text
        name = f"{self.module}/{operator}/{zlib.crc32(where.encode()):08x}"
        self.found.append(Mutant(self.module, operator, start, end, text, form, line, before, name))

    def _visit(self, node, above):
        if not hasattr(node, "sourceRange") or hasattr(node, "valueText"):
            return
        kind = str(node.kind).removeprefix("SyntaxKind.")
        if kind in CONSTANT_PLACES or (kind == "FunctionDeclaration" and self._makes_constants(node)):
            return
        self._mutate(kind, node, above)
        children = [child for child in node if child is not None]
        if kind == "ForLoopStatement":
            children = [node.statement]
        elif kind == "StandardCaseItem":
            children = [node.clause]
        elif kind == "IfGenerate":
            children = [child for child in children if child is not node.condition and "Block" in str(child.kind)]
        elif kind == "MultipleConcatenationExpression":
            children = [node.concatenation]
        elif kind in {"NonblockingAssignmentExpression", "AssignmentExpression"}:
            children = [node.right]
        elif kind in {"AscendingRangeSelect", "DescendingRangeSelect"}:
            children = [node.left]
        for child in children:
            self._visit(child, [*above, (kind, node)])

    def _makes_constants(self, function):
        """A function that a constant is made with is one itself."""
        name = re.search(r"(\w+)\s*[(;]", self.text(function))
        return name is not None and re.search(rf"\b(localparam|parameter)\b[^;]*\b{name[1]}\s*\(", self.source) is not None

    def _mutate(self, kind, node, above):
        if kind == "ConditionalPredicate":
            self.add("condition", node, f"!({self.text(node)})")
        elif kind in BINARY:
            operator, other = BINARY[kind]
            left, right = self.text(node.left), self.text(node.right)
            self.add(operator, node, f"({left}) {other} ({right})")
            if operator in TERMS:
                keep = "!!({})" if operator == "logic" else "({})"
                self.add("term", node, keep.format(left))
                self.add("term", node, keep.format(right))
        elif kind == "UnaryLogicalNotExpression":
            self.add("negation", node, f"!!({self.text(node.operand)})")
        elif kind == "UnaryBitwiseNotExpression":
            self.add("negation", node, f"({self.text(node.operand)})")
        elif kind in {"IntegerVectorExpression", "IntegerLiteralExpression"}:
            if above[-1][0] != "BitSelect" and (other := other_number(self.text(node))):
                self.add("constant", node, other)
        elif kind == "IdentifierName" and self.text(node) in self.constants and above[-1][0] != "BitSelect":
            self.add("limit", node, f"({self.text(node)} + 1'b1)")
        elif kind == "ConditionalExpression":
            parts = [self.text(part) for part in (node.predicate, node.right, node.left)]
            self.add("branches", node, "({}) ? ({}) : ({})".format(*parts))
        elif kind == "IdentifierSelectName" and (found := re.fullmatch(r"\s*(\w+)\[(\d+)\]\s*", self.text(node))):
            if self.registers.get(found[1]) and int(found[2]) > 0:
                before = f"{found[1]}[{int(found[2]) - 1}]"
                self.add("filter", node, f"{found[0].strip()} || {before}")
                self.add("filter", node, f"{found[0].strip()} && {before}")
        elif kind == "BitSelect":
            index = self.text(node)
            if index.strip().isdigit():
                self.add("index", node, str(int(index) - 1 if int(index) else 1))
            elif not re.fullmatch(r"`?[A-Z_0-9]+", index.strip()):
                self.add("index", node, f"({index}) ^ 1'b1")
        elif kind == "ExpressionStatement" and any(name == "AlwaysBlock" for name, _ in above):
            self._assignment(node, above)
        elif kind in {"StandardCaseItem", "DefaultCaseItem"} and self._in_clocked(above):
            self.add("arm", node.clause, ";", "leave")
        elif kind == "NamedPortConnection":
            port, given = node.name.valueText, node.expr
            if given is not None and port.endswith("_i") and port not in {"clk_i", "rst_i"}:
                self.add("connection", given, "1'b0")
        elif kind == "AlwaysBlock":
            self._stuck(node)

    @staticmethod
    def _in_clocked(above):
        return any(name == "AlwaysBlock" and "edge" in str(node)[:90] for name, node in above)

    def _assignment(self, node, above):
        assignment = node.expr
        if not self._in_clocked(above) or "Nonblocking" not in str(assignment.kind):
            return
        self.add("statement", node, ";", "leave")
        if not self._after_reset(above, node) and (left := self.text(assignment.left).strip()) in self.registers:
            self.add("sticky", assignment.right, f"({self.text(assignment.right)}) | {left}")
        if self._after_reset(above, node):
            self.add("reset", assignment.right, f"~({self.text(assignment.right)})")

    def _after_reset(self, above, node):
        """Within `if (rst_i)`, not in its else."""
        for name, parent in above:
            if name == "ConditionalStatement" and re.fullmatch(r"rst_i|clock_lost_i|!?rst\w*", self.text(parent.predicate).strip()):
                first = parent.statement.sourceRange
                return first.start.offset <= node.sourceRange.start.offset < first.end.offset
        return False

    def _stuck(self, node):
        if "edge" not in str(node)[:90]:
            return
        text = self.text(node)
        if not text.rstrip().endswith("end"):
            return
        end = node.sourceRange.start.offset + text.rstrip().rfind("end")
        written = set(re.findall(r"(?:^|[;)\s])([a-z]\w*)\s*<=", text)) & set(self.registers)
        for name in sorted(written):
            high = self.registers[name]
            if high is None:
                continue
            bits = [""] if high == 0 else ["[0]", f"[{high}]"]
            for bit in bits:
                for level in (0, 1):
                    self.add_at("stuck", end, end, f"{name}{bit} <= 1'b{level}; ", "append")


def find(module: str, source: str) -> list[Mutant]:
    """All mutants of a module; a change that occurs twice with one name is numbered."""
    seen: dict[str, int] = {}
    named = []
    for mutant in sorted(Finder(module, source).found, key=lambda mutant: (mutant.start, mutant.end, mutant.operator, mutant.text)):
        seen[mutant.name] = seen.get(mutant.name, 0) + 1
        count = seen[mutant.name]
        named.append(mutant if count == 1 else mutant._replace(name=f"{mutant.name}.{count}"))
    return named


def schema(source: str, numbered: dict[int, Mutant]) -> str:
    """All of these mutants of one module in one text, each behind its number."""
    spans: dict[tuple[int, int], list[tuple[int, Mutant]]] = {}
    for number, mutant in numbered.items():
        spans.setdefault((mutant.start, mutant.end), []).append((number, mutant))
    order = sorted(spans, key=lambda span: (span[0], -span[1]))

    def rendered(start, end, within):
        """The text from `start` to `end` with the changes of the spans within, which are in order."""
        text, at, index = [], start, 0
        while index < len(within):
            span = within[index]
            inner = index + 1
            while inner < len(within) and within[inner][0] < span[1]:
                inner += 1
            text.append(source[at : span[0]])
            text.append(wrapped(rendered(*span, within[index + 1 : inner]), spans[span]))
            at, index = span[1], inner
        text.append(source[at:end])
        return "".join(text)

    def wrapped(text, changes):
        for number, mutant in changes:
            chosen = f"{SELECTED} == {number}"
            if mutant.form == "append":
                text = f"if ({chosen}) {mutant.text}{text}"
            elif mutant.form == "leave":
                text = f"begin if ({SELECTED} != {number}) begin {text} end end"
            else:
                text = f"({chosen} ? ({mutant.text}) : {text})"
        return text

    return rendered(0, len(source), order)


def sample(mutants: list[Mutant], count: int, seed: int) -> list[Mutant]:
    """`count` of a module's mutants, of each operator in turn."""
    rng = random.Random(f"{seed} {mutants[0].module}" if mutants else seed)
    by_operator: dict[str, list[Mutant]] = {}
    for mutant in mutants:
        by_operator.setdefault(mutant.operator, []).append(mutant)
    for found in by_operator.values():
        rng.shuffle(found)
    operators = sorted(by_operator)
    rng.shuffle(operators)
    chosen: list[Mutant] = []
    while len(chosen) < min(count, len(mutants)):
        for operator in operators:
            if by_operator[operator] and len(chosen) < count:
                chosen.append(by_operator[operator].pop())
    return sorted(chosen, key=lambda mutant: (mutant.start, mutant.name))
