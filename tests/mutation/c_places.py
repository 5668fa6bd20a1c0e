# SPDX-License-Identifier: MIT
"""The places of a C or C++ source, by Clang's syntax tree: inside of functions, and not where a constant has to stand."""
import json
import re
import shlex
from functools import lru_cache
from pathlib import Path

from clang.cindex import CursorKind as Kind
from clang.cindex import Index, StorageClass, TranslationUnit, TypeKind

from place import COMPARISONS, OTHER, Place, constant_becomes, short

CLOSED = {Kind.ENUM_DECL, Kind.STATIC_ASSERT, Kind.CXX_UNARY_EXPR, Kind.STRUCT_DECL, Kind.UNION_DECL, Kind.TYPEDEF_DECL}
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


class Sources:
    """The translation units of a build, and for each header one of them that includes it."""

    def __init__(self, root, build):
        self.root = root
        self.arguments = {}
        for entry in json.loads((build / "compile_commands.json").read_text()):
            file = Path(entry["directory"], entry["file"]).resolve()
            words = shlex.split(entry["command"])[1:]
            kept = [word for word in words if word.startswith(("-I", "-D", "-std", "-m", "-f")) or word == "-iquote"
                    or words[words.index(word) - 1] in ("-isystem", "-iquote") or word == "-isystem"]
            self.arguments.setdefault(file, [word for word in kept if not word.startswith("-fno-sanitize")])
        self.includers = {}
        for file in self.root.rglob("*.[ch]"):
            for name in INCLUDE.findall(file.read_text(errors="replace")):
                self.includers.setdefault(Path(name).name, []).append(file)

    def unit_of(self, file):
        """A source of the build that includes the file, by names of headers; None: there is none."""
        seen, front = {file}, [file]
        while front:
            for one in front:
                if one.resolve() in self.arguments:
                    return one.resolve()
            front = [up for one in front for up in self.includers.get(one.name, []) if up not in seen]
            seen.update(front)
        return None

    @lru_cache(maxsize=8)
    def parse(self, unit):
        return Index.create().parse(str(unit), self.arguments[unit], options=TranslationUnit.PARSE_INCOMPLETE)


class Finder:
    def __init__(self, name, path):
        self.name, self.path = name, str(path)
        self.bytes = path.read_bytes()
        self.places = []

    def text(self, start, end):
        return self.bytes[start:end].decode(errors="replace")

    def add(self, cursor, kind, mutated, told):
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        self.places.append(Place(self.name, cursor.extent.start.line, kind, start, end, mutated, told))

    def operator(self, cursor):
        """(left, operator, right) of a binary operator, as they are written; None where a macro wrote it."""
        children = list(cursor.get_children())
        if len(children) != 2:
            return None
        left, right = children[0].extent, children[1].extent
        between = self.text(left.end.offset, right.start.offset).strip()
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        if not re.fullmatch(r"[-+<>=!&|*/]{1,2}", between):
            return None
        return self.text(start, left.end.offset), between, self.text(right.start.offset, end)

    def binary(self, cursor):
        parts = self.operator(cursor)
        if not parts:
            return
        left, sign, right = parts
        if sign in ("&&", "||"):
            self.add(cursor, "condition", f"({{on}} ? !!({left}) : ({left} {sign} {right}))", f"{sign} {short(right)} dropped")
        elif sign in OTHER:
            kind = "comparison" if sign in COMPARISONS else "sign"
            other = f"{left} {OTHER[sign]} {right}"
            self.add(cursor, kind, f"({{on}} ? ({other}) : ({left} {sign} {right}))", f"{short(f'{left} {sign} {right}')} with {OTHER[sign]}")

    def literal(self, cursor):
        text = self.text(cursor.extent.start.offset, cursor.extent.end.offset)
        other = constant_becomes(text)
        if other and not self.text(0, cursor.extent.start.offset).rstrip().endswith(("[", "case")):
            self.add(cursor, "constant", f"({{on}} ? {other} : {text})", f"{text} as {other}")

    def condition_of(self, cursor):
        condition = next(cursor.get_children())
        text = self.text(condition.extent.start.offset, condition.extent.end.offset)
        if condition.kind != Kind.DECL_STMT and text:
            self.add(condition, "check", f"(!{{on}} && ({text}))", f"if ({short(text)}) never")

    def statement(self, cursor):
        start = cursor.extent.start.offset
        end = cursor.extent.end.offset
        text = self.text(start, end)
        if self.text(end, end + 1) == ";" and not text.startswith(("assert", "#")):
            self.add(cursor, "statement", f"if (!{{on}}) {text}", f"{short(text)} dropped")

    def visit(self, cursor, in_block):
        kind = cursor.kind
        if kind in CLOSED or (kind == Kind.VAR_DECL and cursor.storage_class == StorageClass.STATIC):
            return
        if kind == Kind.CALL_EXPR and cursor.spelling.startswith(("__builtin", "_mm")):
            return
        if kind == Kind.BINARY_OPERATOR:
            self.binary(cursor)
        elif kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            self.literal(cursor)
        elif kind == Kind.IF_STMT:
            self.condition_of(cursor)
        if in_block and (kind == Kind.COMPOUND_ASSIGNMENT_OPERATOR or kind == Kind.CALL_EXPR or
                         kind == Kind.BINARY_OPERATOR):
            self.statement(cursor)
        children = list(cursor.get_children())
        if kind == Kind.CASE_STMT:
            children = children[1:]
        if kind == Kind.VAR_DECL and cursor.type.kind in (TypeKind.CONSTANTARRAY, TypeKind.VARIABLEARRAY):
            children = [child for child in children if child.kind == Kind.INIT_LIST_EXPR]
        for child in children:
            self.visit(child, kind == Kind.COMPOUND_STMT)

    def functions(self, cursor):
        for child in cursor.get_children():
            if not child.location.file or child.location.file.name != self.path:
                if child.kind != Kind.LINKAGE_SPEC and child.kind != Kind.NAMESPACE:
                    continue
            if child.kind in (Kind.FUNCTION_DECL, Kind.CXX_METHOD) and child.is_definition():
                for part in child.get_children():
                    if part.kind == Kind.COMPOUND_STMT:
                        self.visit(part, False)
            elif child.kind in (Kind.LINKAGE_SPEC, Kind.NAMESPACE):
                self.functions(child)


def places(sources, name):
    """The places of the file `name` below the sources' root; none where no unit includes it."""
    path = (sources.root / name).resolve()
    unit = sources.unit_of(path)
    if not unit:
        return []
    finder = Finder(name, path)
    finder.functions(sources.parse(unit).cursor)
    # A tree has an expression twice where an initializer has a syntactic and a semantic form.
    unique = {(place.start, place.end, place.kind): place for place in finder.places}
    return list(unique.values())
