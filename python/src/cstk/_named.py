"""Enumerations that print as their names: IntEnum prints numbers from Python 3.11 on."""

from enum import IntEnum


class Named(IntEnum):
    """Whole numbers with names: `print(outcome)` and `f"{outcome}"` give the name, `f"{outcome:d}"` the number."""

    def __str__(self) -> str:
        return self.name

    def __format__(self, spec: str) -> str:
        return format(int(self), spec) if spec else self.name
