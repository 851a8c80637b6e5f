"""What pip calls to make a wheel: maturin, once declarations.py has read the header.

maturin takes the declarations from header.h in cargo's target folder. That is one of its own: the wheel's library is built with other
kinds of output than the installed one, and would otherwise make cargo build that anew. There are no source packages: a wheel is built
from the repository, whose header it needs.
"""

import os
import shutil
from pathlib import Path

import maturin
from maturin import get_requires_for_build_editable, get_requires_for_build_wheel  # noqa: F401

import declarations


def _declare() -> None:
    target = os.environ.setdefault("CARGO_TARGET_DIR", str(declarations.HERE.parent / "target" / "wheel"))
    root = declarations.HERE.parent
    declarations.write_all(Path(target) / "header.h")
    for name in "LICENSE-MIT", "LICENSE-APACHE":
        shutil.copyfile(root / name, declarations.HERE / name)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.build_editable(wheel_directory, config_settings, metadata_directory)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.prepare_metadata_for_build_wheel(metadata_directory, config_settings)


def prepare_metadata_for_build_editable(metadata_directory, config_settings=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.prepare_metadata_for_build_editable(metadata_directory, config_settings)
