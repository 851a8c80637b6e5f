"""The package follows the header: what it does not cover yet fails here, by name."""

import re
from pathlib import Path

import numpy as np

import cstk
from cstk._native import ffi, lib

SOURCES = {file.name: file.read_text("utf-8") for file in Path(cstk.__file__).parent.glob("*.py")}
TEXT = "\n".join(SOURCES.values())

# Functions of the header that Python needs in no way of its own.
LEFT_OUT = {
    **{
        f"cstk_{noun}_retain": "Python's references are to one of the library's"
        for noun in (
            "body_builder robot robot_builder space environment cobject query certificate mesh batch map octree".split()
        )
    },
}


def functions():
    names = [name for name in dir(lib) if name.startswith("cstk_")]
    assert len(names) > 150
    return names


def is_called(name):
    """Called by its name, or by that of its noun, as handles and options are."""
    if re.search(rf"\b_?lib\.{name}\b", TEXT):
        return True
    noun = re.fullmatch(r"cstk_(\w+)_(create|release|default)", name)
    if noun is None:
        return False
    if noun[2] == "default":
        return re.search(rf'options\(\s*"{noun[1]}"', TEXT) is not None
    return f'_noun = "{noun[1]}"' in TEXT


def test_every_function_of_the_header_is_called():
    missing = [name for name in functions() if not is_called(name) and name not in LEFT_OUT]
    assert not missing, f"add methods for {missing}, or say in LEFT_OUT why Python needs none"
    assert not [name for name in LEFT_OUT if not hasattr(lib, name)]


def test_every_status_has_an_exception():
    numbers = ffi.typeof("enum cstk_status").relements
    assert len(numbers) >= 25
    for name, number in numbers.items():
        if number:
            kind = cstk.errors.BY_STATUS[number]
            words = re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__.removesuffix("Error")).upper()
            assert name == f"CSTK_ERROR_{words}"
            assert kind("x").status == number and kind("x").status_name == name
            assert issubclass(kind, cstk.Error) and getattr(cstk, kind.__name__) is kind


def test_every_enumerator_has_its_value():
    checked = 0
    for name in ffi.list_types()[0]:
        try:
            values = ffi.typeof(f"enum {name}").relements
        except ffi.error:
            continue
        if name == "cstk_status":
            continue  # Those are exceptions.
        python = getattr(cstk, "".join(part.capitalize() for part in name.split("_")[1:]))
        assert sorted(values.values()) == sorted(item.value for item in python)
        for item in python:
            assert any(c.endswith(f"_{item.name}") and v == item.value for c, v in values.items())
        checked += 1
    assert checked >= 20


def options_structures():
    typedefs = [name for name in ffi.list_types()[0] if name.startswith("cstk_")]
    for name in typedefs:
        try:
            ffi.sizeof(name)
        except ffi.error:
            continue  # Opaque; cffi must not be asked for its fields.
        kind = ffi.typeof(name)
        if kind.kind == "struct" and "cookie" in dict(kind.fields):
            yield name, [field for field, _ in kind.fields]


def test_every_field_of_options_can_be_set():
    structures = dict(options_structures())
    assert len(structures) >= 13
    for name, fields in structures.items():
        noun = name.removeprefix("cstk_")
        calls = [text for text in SOURCES.values() if re.search(rf'options\(\s*"{noun}"', text)]
        assert calls, f"nothing sets {name}"
        for field in set(fields) - {"size", "cookie", "reserved"}:
            found = any(re.search(rf"\b{field}(=|:|\")|\.{field} =", text) for text in calls)
            assert found, f"{name}.{field} cannot be set"


def test_records_have_all_fields_and_arrays_show_them():
    kinds = [kind for kind in vars(cstk).values() if isinstance(kind, type) and "_type" in vars(kind)]
    assert len(kinds) >= 24
    for kind in kinds:
        dtype = cstk.dtype_of(kind._type)
        assert dtype.itemsize == ffi.sizeof(kind._type)
        fields = {name: field.type for name, field in ffi.typeof(kind._type).fields if not name.startswith("reserved")}
        assert list(fields) == list(dtype.names)
        # Arrays of the query context are copied by classes of the package's own.
        assert list(kind._fields) == [name for name, ctype in fields.items() if ctype is not ffi.typeof("cstk_path")]
        for name in kind._fields:
            assert isinstance(getattr(kind, name), property)
            assert dtype.fields[name][1] == ffi.offsetof(kind._type, name)


def test_the_version_is_that_of_the_header():
    numbers = lib.CSTK_VERSION_MAJOR, lib.CSTK_VERSION_MINOR, lib.CSTK_VERSION_PATCH
    assert cstk.__version__ == ".".join(map(str, numbers)) == cstk.version()
    assert cstk.NONE == np.iinfo(np.uint32).max


def test_everything_public_says_what_it_is_for():
    for name, item in vars(cstk).items():
        if isinstance(item, type) and not name.startswith("_"):
            assert item.__doc__, name
