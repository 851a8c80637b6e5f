"""Lists of answers: copies of the arrays that a query context wrote, which no later call changes."""

from __future__ import annotations

from typing import Any, Iterator, Optional

import numpy as np
from numpy.typing import NDArray

from ._native import ffi
from ._record import Records
from .enums import Class
from .records import Contact, DistanceResult, LinkPair, Penetration, SignedDistance, Verdict, Witness

Array = NDArray[np.float64]


def path_from(given: Any) -> Array:
    """A copy of a path, (count, nq)."""
    out = np.empty((given.count, given.nq))
    if out.size:
        ffi.memmove(ffi.from_buffer(out), given.points, out.nbytes)
    return out


class WitnessList:
    """Witnesses, nearest first, with their contacts. It is a sequence of its witnesses."""

    __slots__ = ("_c", "_witnesses", "_contacts", "_gradients", "_rows")

    def __init__(self, given: Any) -> None:
        self._witnesses = Records.copied(Witness, given.witnesses, given.witness_count)
        self._contacts = Records.copied(Contact, given.contacts, given.contact_count)
        self._gradients: Optional[Array] = None
        # A copy for slide_step and spring_step, with the arrays that belong to this list.
        self._c = ffi.new("cstk_witness_list *")
        ffi.memmove(self._c, ffi.addressof(given), ffi.sizeof("cstk_witness_list"))
        self._c.witnesses = self._witnesses._c
        self._c.contacts = self._contacts._c
        if given.nv:
            shape = (given.contact_count, given.nv)
            # Memory that the array does not own: nothing that is done to the array frees what C points to.
            self._c.gradients = self._rows = ffi.new("double[]", shape[0] * shape[1])
            if given.contact_count:
                ffi.memmove(self._rows, given.gradients, ffi.sizeof(self._rows))
                self._gradients = np.frombuffer(ffi.buffer(self._rows), np.float64).reshape(shape)
            else:
                self._gradients = np.empty(shape)

    @property
    def witnesses(self) -> Records[Witness]:
        """Nearest first."""
        return self._witnesses

    @property
    def contacts(self) -> Records[Contact]:
        """Of all witnesses, one after the other; contacts_of() gives those of one."""
        return self._contacts

    @property
    def gradients(self) -> Optional[Array]:
        """(contacts, nv), one row for each contact: the derivative of its distance. None for lists without gradients. slide_step and
        spring_step read what stands in it."""
        return self._gradients

    @property
    def truncated(self) -> bool:
        """There are more witnesses than max_count; these are the nearest."""
        return bool(self._c.truncated)

    @property
    def contacts_left_out(self) -> bool:
        """Query.set_contacts has left out contacts: slide_step and spring_step refuse the list."""
        return bool(self._c.contacts_left_out)

    @property
    def environment_version(self) -> int:
        """The version of the environment that the query saw, the largest of several."""
        return int(self._c.environment_version)

    def __reduce__(self) -> Any:
        why = "slide_step and spring_step follow its pointers"
        raise TypeError(f"a cstk.{type(self).__name__} cannot be pickled, since {why}; its witnesses, contacts and gradients can")

    def contacts_of(self, number: int) -> "list[Contact]":
        """The contacts of a witness."""
        witness = self.witnesses[number]
        return list(self.contacts[witness.first_contact : witness.first_contact + witness.contact_count])

    def __len__(self) -> int:
        return len(self.witnesses)

    def __getitem__(self, number: int) -> Witness:
        return self.witnesses[number]

    def __iter__(self) -> Iterator[Witness]:
        return iter(self.witnesses)

    def __repr__(self) -> str:
        return f"<cstk.WitnessList of {len(self.witnesses)} witnesses, {len(self.contacts)} contacts>"


class PseudoNormal:
    """Class, distance, witnesses and gradients at one configuration: Appendix A's cstk-pseudo-normal."""

    __slots__ = ("point_class", "distance", "list")

    def __init__(self, given: Any) -> None:
        self.point_class = Class(given.point_class)
        self.distance = DistanceResult(given.distance, given)
        self.list = WitnessList(given.list)

    def __repr__(self) -> str:
        return f"<cstk.PseudoNormal: {self.point_class}, distance {self.distance.distance:.6g}, {len(self.list)} witnesses>"


class Explanation:
    """A class, and the leaves and witnesses that decide it."""

    __slots__ = ("point_class", "leaves", "list")

    def __init__(self, given: Any) -> None:
        self.point_class = Class(given.point_class)
        self.leaves = Records.copied(Verdict, given.leaves, given.leaf_count)
        self.list = WitnessList(given.list)

    def __repr__(self) -> str:
        return f"<cstk.Explanation: {self.point_class}, {len(self.leaves)} leaves, {len(self.list)} witnesses>"


class LinkPairs:
    """All pairs of links with bodies."""

    __slots__ = ("pairs", "tested")

    pairs: Records[LinkPair]
    tested: NDArray[np.uint32]
    """The pairs to test, (n, 2), as CObject.induced_links takes them."""

    def __init__(self, given: Any) -> None:
        self.pairs = Records.copied(LinkPair, given.pairs, given.count)
        self.tested = np.empty((given.tested_count, 2), np.uint32)
        if given.tested_count:
            ffi.memmove(ffi.from_buffer(self.tested), given.tested, self.tested.nbytes)

    def __repr__(self) -> str:
        return f"<cstk.LinkPairs: {len(self.tested)} of {len(self.pairs)} to test>"


class PenetrationList:
    """Primitive pairs that meet, deepest first."""

    __slots__ = ("penetrations", "of_whole_bodies", "truncated")

    def __init__(self, given: Any) -> None:
        self.penetrations = Records.copied(Penetration, given.penetrations, given.count)
        self.of_whole_bodies = bool(given.of_whole_bodies)
        """Each body is one convex primitive, so that the first entry separates the bodies."""
        self.truncated = bool(given.truncated)
        """More pairs meet than max_count; these are the deepest."""

    def __len__(self) -> int:
        return len(self.penetrations)

    def __getitem__(self, number: int) -> Penetration:
        return self.penetrations[number]

    def __iter__(self) -> Iterator[Penetration]:
        return iter(self.penetrations)

    def __repr__(self) -> str:
        return f"<cstk.PenetrationList of {len(self.penetrations)}>"


class SignedDistanceList:
    """Signed distances of body pairs, least first. It is a sequence of them."""

    __slots__ = ("pairs", "gradients", "truncated", "environment_version")

    pairs: Records[SignedDistance]
    gradients: Array
    """(pairs, nv): the derivative of each distance; see `gradient_kind` of the pair."""

    def __init__(self, given: Any) -> None:
        self.pairs = Records.copied(SignedDistance, given.pairs, given.count)
        self.gradients = np.empty((given.count, given.nv))
        if self.gradients.size:
            ffi.memmove(ffi.from_buffer(self.gradients), given.gradients, self.gradients.nbytes)
        self.truncated = bool(given.truncated)
        """There are more pairs than max_count; these have the least distances."""
        self.environment_version = int(given.environment_version)

    def __len__(self) -> int:
        return len(self.pairs)

    def __getitem__(self, number: int) -> SignedDistance:
        return self.pairs[number]

    def __iter__(self) -> Iterator[SignedDistance]:
        return iter(self.pairs)

    def __repr__(self) -> str:
        return f"<cstk.SignedDistanceList of {len(self.pairs)} pairs>"
