# SPDX-License-Identifier: MIT
"""The places of a Python module, by its syntax tree: inside of functions."""
import ast

from place import COMPARISONS, OTHER, Place, constant_becomes, short

SIGNS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=", ast.Add: "+", ast.Sub: "-"}


class Finder(ast.NodeVisitor):
    def __init__(self, name, source):
        self.name = name
        self.source = source
        self.starts = [0]
        for line in source.encode().splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))
        self.places = []
        self.depth = 0

    def text(self, node):
        return ast.get_source_segment(self.source, node)

    def add(self, node, kind, mutated, told):
        start = self.starts[node.lineno - 1] + node.col_offset
        end = self.starts[node.end_lineno - 1] + node.end_col_offset
        self.places.append(Place(self.name, node.lineno, kind, start, end, mutated, told))

    def visit_FunctionDef(self, node):
        self.depth += 1
        for child in node.body:
            self.visit(child)
        self.depth -= 1

    def visit_JoinedStr(self, node):
        """Text with values in it stays as it is."""

    def visit_Compare(self, node):
        sign = SIGNS.get(type(node.ops[0]))
        if self.depth and len(node.ops) == 1 and sign in COMPARISONS:
            left, right = self.text(node.left), self.text(node.comparators[0])
            self.add(node, "comparison", f"(({left} {OTHER[sign]} {right}) if {{on}} else ({left} {sign} {right}))",
                     f"{short(f'{left} {sign} {right}')} with {OTHER[sign]}")
        self.generic_visit(node)

    def visit_BinOp(self, node):
        sign = SIGNS.get(type(node.op))
        if self.depth and sign:
            # The operands keep the parentheses that stand around them.
            whole = self.text(node)
            left, right = f"({self.text(node.left)})", f"({self.text(node.right)})"
            self.add(node, "sign", f"(({left} {OTHER[sign]} {right}) if {{on}} else ({left} {sign} {right}))",
                     f"{short(whole)} with {OTHER[sign]}")
        self.generic_visit(node)

    def visit_BoolOp(self, node):
        if self.depth and len(node.values) == 2:
            left, whole = self.text(node.values[0]), self.text(node)
            self.add(node, "condition", f"(({left}) if {{on}} else ({whole}))", f"{short(self.text(node.values[1]))} dropped")
        self.generic_visit(node)

    def visit_Constant(self, node):
        if self.depth and type(node.value) in (int, float):
            text = self.text(node)
            other = constant_becomes(text)
            if other:
                self.add(node, "constant", f"({other} if {{on}} else {text})", f"{text} as {other}")

    def visit_If(self, node):
        if self.depth:
            text = self.text(node.test)
            self.add(node.test, "check", f"(not {{on}} and ({text}))", f"if {short(text)} never")
        self.generic_visit(node)

    def visit_Expr(self, node):
        if self.depth and isinstance(node.value, ast.Call):
            text = self.text(node.value)
            self.add(node.value, "statement", f"(None if {{on}} else {text})", f"{short(text)} dropped")
        self.generic_visit(node)


def places(root, name):
    source = (root / name).read_text()
    if imports(source, root) is None:
        return []
    finder = Finder(name, source)
    finder.visit(ast.parse(source))
    return finder.places


def imports(source, folder):
    """The source with the switch imported, on the line of its first import, so that no line moves; None: it has none."""
    lines = source.splitlines(keepends=True)
    for node in ast.parse(source).body:
        if isinstance(node, (ast.Import, ast.ImportFrom)) and getattr(node, "module", "") != "__future__":
            switch = f"import sys; sys.path.append({str(folder)!r}); from mutant import mutant; "
            lines[node.lineno - 1] = switch + lines[node.lineno - 1]
            return "".join(lines)
    return None
