"""Certificates: proofs of free motions, to keep and to check anew."""

from __future__ import annotations

import os
import tempfile
from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, file_name, index, pointer, same_length, scalar, vector
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from .cobject import CObject
from .errors import check
from .records import CertificateEntry, CertificateSummary


class Certificate(Handle):
    """A proof that a motion keeps clear of a C-object. It refers to no other object, and is pickled as the file that save() writes."""

    __slots__ = ()
    _noun = "certificate"

    def __init__(self) -> None:
        raise TypeError("certificates come from Query.motion_certificate or Certificate.load")

    @classmethod
    def load(cls, file: "os.PathLike[str] | str") -> "Certificate":
        """A certificate that save() wrote. It proves nothing before verify() accepts it."""
        out = ffi.new("cstk_certificate **")
        check(lib.cstk_certificate_load(file_name("file", file), out))
        return cls._take(out[0])

    def save(self, file: "os.PathLike[str] | str") -> None:
        check(lib.cstk_certificate_save(self._pointer, file_name("file", file)))

    @classmethod
    def _from_file(cls, contents: bytes) -> "Certificate":
        with tempfile.TemporaryDirectory(prefix="cstk") as folder:
            file = os.path.join(folder, "certificate")
            with open(file, "wb") as out:
                out.write(contents)
            return cls.load(file)

    def __reduce__(self) -> Any:
        with tempfile.TemporaryDirectory(prefix="cstk") as folder:
            file = os.path.join(folder, "certificate")
            self.save(file)
            with open(file, "rb") as contents:
                return type(self)._from_file, (contents.read(),)

    def verify(self, cobject: CObject, q0: ArrayLike, q1: ArrayLike, threshold: float = 0.0) -> None:
        """Raises NotProvedError, naming the entry, unless this proves the motion from q0 to q1 free and farther away than `threshold`."""
        a, b = vector("q0", q0), vector("q1", q1)
        motion = pointer_of(CObject, "cobject", cobject), doubles(a), doubles(b), same_length("q0", a, "q1", b)
        check(lib.cstk_certificate_verify(self._pointer, *motion, scalar("threshold", threshold)))

    def summary(self) -> CertificateSummary:
        """What the certificate is of."""
        out = ffi.new("cstk_certificate_summary *")
        check(lib.cstk_certificate_get_summary(self._pointer, out))
        return CertificateSummary(out)

    def ends(self) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The first and the last configuration of the motion."""
        nq = self.summary().nq
        (q0, q0_out), (q1, q1_out) = empty(nq), empty(nq)
        check(lib.cstk_certificate_get_ends(self._pointer, nq, q0_out, q1_out))
        return q0, q1

    def entry(self, number: int) -> CertificateEntry:
        """An entry, counted from 0."""
        out = ffi.new("cstk_certificate_entry *")
        check(lib.cstk_certificate_get_entry(self._pointer, index("number", number, 64), out))
        return CertificateEntry(out)

    def primitives(self, number: int, side: int) -> NDArray[np.uint32]:
        """The primitives of one side of an entry, 0 or 1."""
        place, count = (index("number", number, 64), index("side", side)), ffi.new("size_t *")
        check(lib.cstk_certificate_get_primitives(self._pointer, *place, 0, ffi.NULL, count))
        out = np.empty(count[0], np.uint32)
        check(lib.cstk_certificate_get_primitives(self._pointer, *place, count[0], pointer(out, "uint32_t"), count))
        return out
