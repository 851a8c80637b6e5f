"""What the package takes from include/cstk.h: the declarations for cffi, and two modules of Python.

    python3 declarations.py CDEF_FILE     # writes the declarations there, and src/cstk/enums.py and src/cstk/records.py

The header is the only source: it is read anew for every wheel, so that nothing here can fall behind it. What the reader does
not know (a directive, a type) ends the build.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADER = HERE.parent / "include" / "cstk.h"
PACKAGE = HERE / "src" / "cstk"

# What a C99 compiler would answer. Any other condition is refused.
CONDITIONS = {
    "#ifndef CSTK_H": True,
    "#ifdef __cplusplus": False,
    "#ifndef __cplusplus": True,
    "#if __STDC_VERSION__ >= 202311L": False,
    "#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L": False,
}


def preprocessed(text: str) -> str:
    """The header as a C99 compiler reads it, with its comments; constants stay as `#define NAME NUMBER`."""
    kept: list[str] = []
    active = [True]
    for number, line in enumerate(text.splitlines(), 1):
        word = line.split()[0] if line.startswith("#") else ""
        if word in ("#if", "#ifdef", "#ifndef"):
            condition = line.split("//")[0].strip()
            if condition not in CONDITIONS:
                raise ValueError(f"{HEADER}:{number}: unknown condition: {line}")
            active.append(CONDITIONS[condition])
        elif word == "#else":
            active[-1] = not active[-1]
        elif word == "#endif":
            active.pop()
        elif not all(active) or word == "#include" or line == "#define CSTK_H":
            continue
        elif word and not re.fullmatch(r"#define CSTK_[A-Z_]+ \d+", line):
            raise ValueError(f"{HEADER}:{number}: unknown directive: {line}")
        else:
            kept.append(line)
    if len(active) != 1:
        raise ValueError(f"{HEADER}: an #if without its #endif")
    return "\n".join(kept) + "\n"


def without_comments(text: str) -> str:
    """What cffi's cdef takes."""
    return re.sub(r"\n\s*\n+", "\n", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)).lstrip()


@dataclass
class Member:
    """An enumerator or a field."""

    name: str
    type: str
    count: int
    doc: str


@dataclass
class Definition:
    """An enum or a struct."""

    name: str
    doc: str
    members: list[Member]

    def __contains__(self, name: str) -> bool:
        return any(member.name == name for member in self.members)


COMMENT = r"/\*\*(?P<doc>(?:[^*]|\*(?!/))*)\*/"


def plain(comment: str | None) -> str:
    """A comment's text without its stars."""
    lines = [re.sub(r"^\s*\* ?", "", line).rstrip() for line in (comment or "").splitlines()]
    return "\n".join(lines).strip()


def enums(text: str) -> list[Definition]:
    found = []
    for match in re.finditer(COMMENT + r"\s*enum (?P<name>cstk_\w+)\s*\{(?P<body>.*?)\};", text, re.DOTALL):
        members = [
            Member(part["name"], "", int(part["value"]), plain(part["doc"]))
            for part in re.finditer(rf"(?:{COMMENT}\s*)?(?P<name>CSTK_\w+) = (?P<value>\d+),", match["body"])
        ]
        if len(members) != without_comments(match["body"]).count(" = "):
            raise ValueError(f"enum {match['name']}: an enumerator is not understood")
        found.append(Definition(match["name"], plain(match["doc"]), members))
    return found


def structs(text: str) -> list[Definition]:
    found = []
    pattern = COMMENT + r"\s*(?:typedef )?struct (?P<name>cstk_\w+) \{(?P<body>.*?)\n\}"
    field = rf"(?:{COMMENT}\s*)?(?P<type>(?:const )?\w+(?:(?: \*const)? \*)?)\s*(?P<name>\w+)(?:\[(?P<count>\d+)\])?;"
    for match in re.finditer(pattern, text, re.DOTALL):
        members = [
            Member(part["name"], part["type"].strip(), int(part["count"] or 0), plain(part["doc"]))
            for part in re.finditer(field, match["body"])
        ]
        if len(members) != without_comments(match["body"]).count(";"):
            raise ValueError(f"struct {match['name']}: a field is not understood")
        found.append(Definition(match["name"], plain(match["doc"]), members))
    return found


def camel(name: str) -> str:
    """cstk_motion_result: MotionResult."""
    return "".join(part.capitalize() for part in name.split("_")[1:])


def stem(definition: Definition) -> str:
    """What all enumerators begin with: CSTK_CLASS_."""
    names = [member.name for member in definition.members]
    common = names[0]
    while not all(name.startswith(common) for name in names):
        common = common[:-1]
    return common[: common.rindex("_") + 1]


def python_words(doc: str, all_enums: list[Definition], all_structs: list[Definition]) -> str:
    """A comment with Python's names for what it mentions."""
    values = {m.name: f"{camel(e.name)}.{m.name[len(stem(e)) :]}" for e in all_enums for m in e.members}
    types = {d.name for d in all_enums + all_structs}
    doc = re.sub(r"\bCSTK_NONE\b|\bUINT32_MAX\b|\bNULL\b", "None", doc)
    doc = re.sub(r"\bCSTK_\w+", lambda m: values.get(m[0], m[0]), doc)
    doc = re.sub(r"\bcstk_\w+", lambda m: camel(m[0]) if m[0] in types else m[0].removeprefix("cstk_"), doc)
    return doc.replace("\\", "\\\\").replace('"""', "'''")


def docstring(text: str, indent: str) -> str:
    lines = text.splitlines() or [""]
    if len(lines) == 1:
        return f'{indent}"""{lines[0]}"""\n'
    return f'{indent}"""' + f"\n{indent}".join(lines).replace(f"\n{indent}\n", "\n\n") + f'\n{indent}"""\n'


def listed(names: list[str]) -> str:
    return "[" + "".join(f'\n    "{name}",' for name in names) + "\n]"


BEGINNING = '"""{about} Written by declarations.py from include/cstk.h; do not edit."""\n\n'


def enums_module(all_enums: list[Definition], all_structs: list[Definition]) -> str:
    """One class for each enum but the statuses, which are exceptions (errors.py)."""
    out = BEGINNING.format(about="The enumerations of the C API, without their prefixes.")
    named = [camel(enum.name) for enum in all_enums if enum.name != "cstk_status"]
    out += f"from ._named import Named\n\n__all__ = {listed(named)}\n"
    for enum in all_enums:
        if enum.name == "cstk_status":
            continue
        out += f"\n\nclass {camel(enum.name)}(Named):\n"
        out += docstring(python_words(enum.doc, all_enums, all_structs), "    ")
        for member in enum.members:
            out += f"\n    {member.name[len(stem(enum)) :]} = {member.count}\n"
            if member.doc:
                out += docstring(python_words(member.doc, all_enums, all_structs), "    ")
    return out


# Fields in which CSTK_NONE or UINT32_MAX stands for none.
MAY_BE_NONE = {
    "cstk_witness": {"r_link", "s_link", "coordinate", "r_part", "s_part"},
    "cstk_object_info": {"link"},
    "cstk_hierarchy_node": {"children", "primitive"},
    "cstk_certificate_entry": {"links"},
}
# Fields that are set only where a flag of another name says so.
SET_WHERE = {
    ("cstk_distance_result", "r_point"): "has_witness",
    ("cstk_distance_result", "s_point"): "has_witness",
    ("cstk_batch_result", "first_failed"): "failed",
    ("cstk_batch_result", "first_hit"): "has_hit",
}
# Data of s-objects, and the fields with their ids.
OBJECT_IDS = {
    ("cstk_witness", "r_data"): "r_object",
    ("cstk_witness", "s_data"): "s_object",
    ("cstk_object_pair", "r_data"): "r_object",
    ("cstk_object_pair", "s_data"): "s_object",
    ("cstk_object_info", "data"): "id",
}
# Inputs, which have classes of their own.
NOT_RECORDS = {"cstk_allowed_pair", "cstk_map_axis", "cstk_range"}
# Arrays that belong to the query context: the package copies them into arrays of its own.
COPIED = {"cstk_path"}
NUMBERS = {"int32_t": "int", "uint32_t": "int", "uint64_t": "int", "size_t": "int", "double": "float", "bool": "bool"}


def is_record(struct: Definition) -> bool:
    """Answers that stand for themselves: neither options nor lists, whose arrays belong to something else."""
    lists = {"cstk_witness_list", "cstk_pseudo_normal_result"}
    points = any("*" in member.type and member.type != "void *" for member in struct.members)
    return "cookie" not in struct and not points and struct.name not in lists | NOT_RECORDS


def record_property(struct: Definition, member: Member, enum_names: set[str], record_names: set[str]) -> tuple[str, str]:
    """The type and the value of a record's property."""
    value = f"self._c.{member.name}"
    if member.type in enum_names and not member.count:
        return camel(member.type), f"{camel(member.type)}({value})"
    if member.type in record_names and not member.count:
        return camel(member.type), f"{camel(member.type)}({value}, self._owner)"
    if (struct.name, member.name) in OBJECT_IDS:
        return "Any", f"data_of_object({value}, self._c.{OBJECT_IDS[struct.name, member.name]})"
    if member.type == "void *":
        return "Any", f"data_of({value})"
    if member.type in NUMBERS and not member.count:
        if member.name in MAY_BE_NONE.get(struct.name, ()):
            return "Optional[int]", f"None if {value} == NONE else {value}"
        return NUMBERS[member.type], value
    if member.type == "double":
        return "NDArray[np.float64]", f"{'pose' if member.count == 12 else 'vector'}_from({value})"
    if member.type == "uint32_t" and member.name in MAY_BE_NONE.get(struct.name, ()):
        return "Tuple[Optional[int], ...]", f"tuple(None if item == NONE else item for item in {value})"
    if member.type == "uint32_t":
        return "Tuple[int, ...]", f"tuple({value})"
    if member.type == "uint8_t":
        return "bytes", f"bytes({value})"
    raise ValueError(f"struct {struct.name}: no rule for {member.type} {member.name}")


def record_class(struct: Definition, all_enums: list[Definition], all_structs: list[Definition]) -> str:
    enum_names = {enum.name for enum in all_enums}
    record_names = {other.name for other in all_structs if is_record(other)}
    out = f"\n\nclass {camel(struct.name)}(Record):\n"
    out += docstring(python_words(struct.doc, all_enums, all_structs), "    ")
    fields = [m for m in struct.members if not m.name.startswith("reserved") and m.type not in COPIED]
    out += f'\n    __slots__ = ()\n    _type = "{struct.name}"\n'
    out += f"    _fields = ({', '.join(repr(member.name) for member in fields)},)\n"
    for member in fields:
        kind, value = record_property(struct, member, enum_names, record_names)
        flag = SET_WHERE.get((struct.name, member.name), f"has_{member.name}")
        if flag in struct:
            kind, value = f"Optional[{kind}]", f"{value} if self._c.{flag} else None"
        out += f"\n    @property\n    def {member.name}(self) -> {kind}:\n"
        if member.doc:
            out += docstring(python_words(member.doc, all_enums, all_structs), "        ")
        out += f"        return {value}\n"
    return out


def records_module(all_enums: list[Definition], all_structs: list[Definition]) -> str:
    """One class for each structure of answers."""
    out = BEGINNING.format(about="The structures of answers, without their prefixes.")
    out += "from typing import Any, Optional, Tuple\n\nimport numpy as np\nfrom numpy.typing import NDArray\n\n"
    out += "from ._record import Record, pose_from, vector_from\nfrom ._native import lib\nfrom ._user_data import data_of, data_of_object\n"
    bodies = "".join(record_class(struct, all_enums, all_structs) for struct in all_structs if is_record(struct))
    named = [camel(struct.name) for struct in all_structs if is_record(struct)]
    used = sorted({camel(e.name) for e in all_enums if re.search(rf"\b{camel(e.name)}\(", bodies)})
    out += f"from .enums import {', '.join(used)}\n\n__all__ = {listed(['NONE', *named])}\n\nNONE: int = lib.CSTK_NONE\n"
    out += '"""Means "none" in the arrays of answers; properties give None for it."""\n'
    return out + bodies


def write(file: Path, text: str) -> None:
    """Keeps the time of a file that is current."""
    if not file.exists() or file.read_text("utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, "utf-8")


def write_all(cdef_file: Path) -> None:
    text = preprocessed(HEADER.read_text("utf-8"))
    all_enums, all_structs = enums(text), structs(text)
    write(cdef_file, without_comments(text))
    write(PACKAGE / "enums.py", enums_module(all_enums, all_structs))
    write(PACKAGE / "records.py", records_module(all_enums, all_structs))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_all(Path(sys.argv[1]))
