"""What cffi is told, against a C compiler's own reading of the header."""

import importlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from cstk._native import ffi

PYTHON = Path(__file__).resolve().parents[1]
sys.path.append(str(PYTHON))
declarations = importlib.import_module("declarations")
HEADER = declarations.HEADER.read_text("utf-8")
needs_compiler = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")


def words(text):
    return re.sub(r"\s+", " ", re.sub(r"\bbool\b", "_Bool", text)).strip()


@needs_compiler
def test_declarations_are_what_a_compiler_reads():
    command = ["cc", "-E", "-std=c99", str(declarations.HEADER)]
    read = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    kept, ours = [], False
    for line in read.splitlines():
        if line.startswith("# "):
            ours = line.split('"')[1].endswith("cstk.h")
        elif ours:
            kept.append(line)
    told = declarations.without_comments(declarations.preprocessed(HEADER))
    told = "\n".join(line for line in told.splitlines() if not line.startswith("#define"))
    assert len(told) > 20000 and words(told) == words("\n".join(kept))


@needs_compiler
def test_structures_are_laid_out_as_a_compiler_does(tmp_path):
    lines, expected = [], []
    for struct in declarations.structs(declarations.preprocessed(HEADER)):
        lines.append(f'printf("%zu\\n", sizeof(struct {struct.name}));')
        expected.append(ffi.sizeof(f"struct {struct.name}"))
        for member in struct.members:
            lines.append(f'printf("%zu\\n", offsetof(struct {struct.name}, {member.name}));')
            expected.append(ffi.offsetof(f"struct {struct.name}", member.name))
    assert len(expected) > 300
    source = tmp_path / "layout.c"
    source.write_text("#include <cstk.h>\n#include <stdio.h>\nint main(void) {" + "\n".join(lines) + "return 0; }")
    program, include = tmp_path / "layout", declarations.HEADER.parent
    subprocess.run(["cc", f"-I{include}", str(source), "-o", str(program)], check=True)
    printed = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout
    assert [int(number) for number in printed.split()] == expected


@pytest.mark.parametrize(
    "old, new, says",
    [
        ("#ifndef CSTK_H", "#ifndef CSTK_H_", "unknown condition"),
        ("#include <stdint.h>", "#pragma once", "unknown directive"),
        ("  CSTK_OK = 0,", "  CSTK_OK = FIRST,", "enumerator"),
        ("  bool has_witness;", "  bool (*has_witness)(void);", "field"),
        ("  double depth;", "  float depth;", "no rule for float depth"),
    ],
)
def test_what_the_reader_does_not_know_ends_the_build(old, new, says, tmp_path, monkeypatch):
    assert old in HEADER
    header = tmp_path / "cstk.h"
    header.write_text(HEADER.replace(old, new, 1), "utf-8")
    monkeypatch.setattr(declarations, "HEADER", header)
    monkeypatch.setattr(declarations, "PACKAGE", tmp_path)
    with pytest.raises(ValueError, match=says):
        declarations.write_all(tmp_path / "cdef.h")


def test_a_new_enumerator_or_field_needs_nothing(tmp_path, monkeypatch):
    header = tmp_path / "cstk.h"
    text = HEADER.replace("  CSTK_CLASS_INSIDE = 2,", "  CSTK_CLASS_INSIDE = 2,\n  /**\n   * Unknown.\n   */\n  CSTK_CLASS_UNKNOWN = 3,")
    text = text.replace("  double depth;", "  double depth;\n  bool exact;")
    header.write_text(text, "utf-8")
    monkeypatch.setattr(declarations, "HEADER", header)
    monkeypatch.setattr(declarations, "PACKAGE", tmp_path)
    declarations.write_all(tmp_path / "cdef.h")
    assert '    UNKNOWN = 3\n    """Unknown."""' in (tmp_path / "enums.py").read_text("utf-8")
    assert "def exact(self) -> bool:" in (tmp_path / "records.py").read_text("utf-8")
