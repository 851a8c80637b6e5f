"""What pip calls to make a wheel: maturin, once declarations.py has read the header.

maturin takes the declarations from header.h in cargo's target folder.
"""

import os
from pathlib import Path

import maturin
from maturin import *  # noqa: F403  The other hooks are maturin's own.

import declarations


def _declare() -> None:
    target = os.environ.get("CARGO_TARGET_DIR", declarations.HERE.parent / "target")
    declarations.write_all(Path(target) / "header.h")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):  # type: ignore[no-untyped-def]
    _declare()
    return maturin.prepare_metadata_for_build_wheel(metadata_directory, config_settings)
