"""Environments: s-objects, the obstacles, changed while other threads query."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import file_name, index, integers, pointer, pose, text
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._user_data import Kept, keep_name
from .body import Body
from .enums import ChangeKind, MeshForm
from .errors import NotFoundError, check
from .hierarchy import HierarchyOptions, hierarchy_options
from .records import ObjectInfo
from .space import Space


MAX_SCENE_OBJECTS = 1 << 17
"""As many as a planning scene may have."""


@dataclass(frozen=True)
class Change:
    """One change of an environment, for Environment.apply. Made by the class methods."""

    kind: ChangeKind
    id: int = 0
    body: Optional[Body] = None
    pose: Optional[ArrayLike] = None
    data: Any = None
    space: Optional[Space] = None
    link: int = 0
    touch_links: ArrayLike = ()
    name: str = ""

    @classmethod
    def add(cls, body: Body, pose: Optional[ArrayLike] = None, data: Any = None, *, name: str = "") -> "Change":
        """Adds a body at a pose in the world; witnesses return `data`. Several objects may have one name."""
        return cls(ChangeKind.ADD, body=body, pose=pose, data=data, name=name)

    @classmethod
    def add_attached(
        cls,
        body: Body,
        space: Space,
        link: int,
        pose: ArrayLike,
        touch_links: ArrayLike = (),
        data: Any = None,
        *,
        name: str = "",
    ) -> "Change":
        """Adds a body that is attached to a link from the first, `pose` in the link's frame: add() and attach() in one change."""
        return cls(ChangeKind.ADD, 0, body, pose, data, space, link, touch_links, name)

    @classmethod
    def move(cls, id: int, pose: ArrayLike) -> "Change":
        """Moves an object; an attached object is detached."""
        return cls(ChangeKind.MOVE, id, pose=pose)

    @classmethod
    def delete(cls, id: int) -> "Change":
        """Deletes an object."""
        return cls(ChangeKind.DELETE, id)

    @classmethod
    def attach(cls, id: int, space: Space, link: int, pose: ArrayLike, touch_links: ArrayLike = ()) -> "Change":
        """Fixes an object to a link of a space, `pose` in the link's frame. The links in `touch_links` (the fingers) may meet it."""
        return cls(ChangeKind.ATTACH, id, pose=pose, space=space, link=link, touch_links=touch_links)


class Environment(Handle):
    """A set of obstacles. Each query sees one consistent state, whatever other threads change meanwhile."""

    __slots__ = ()
    _noun = "environment"

    def __init__(self) -> None:
        self._created()

    def add(self, body: Body, pose: Optional[ArrayLike] = None, data: Any = None, *, name: str = "") -> int:
        """Adds an object at a pose in the world; returns its id. Witnesses return `data`. Several objects may have one name."""
        return int(self.apply([Change.add(body, pose, data, name=name)])[0])

    def add_attached(
        self,
        body: Body,
        space: Space,
        link: int,
        pose: ArrayLike,
        touch_links: ArrayLike = (),
        data: Any = None,
        *,
        name: str = "",
    ) -> int:
        """Adds an object that is attached to a link from the first, `pose` in the link's frame; returns its id. See attach()."""
        return int(self.apply([Change.add_attached(body, space, link, pose, touch_links, data, name=name)])[0])

    def move(self, id: int, pose: ArrayLike) -> None:
        """Moves an object; an attached object is detached."""
        self.apply([Change.move(id, pose)])

    def delete(self, id: int) -> None:
        """Deletes an object."""
        self.apply([Change.delete(id)])

    def attach(self, id: int, space: Space, link: int, pose: ArrayLike, touch_links: ArrayLike = ()) -> None:
        """Fixes an object to a link of a space, `pose` in the link's frame; move() lets it go. The links in `touch_links` (the fingers)
        may meet it.
        """
        self.apply([Change.attach(id, space, link, pose, touch_links)])

    def apply(self, changes: Sequence[Change]) -> NDArray[np.uint64]:
        """Applies all changes as one, or none; returns the ids they are about. Many in one call cost much less than one by one."""
        ids = np.zeros(len(changes), np.uint64)
        array = ffi.new("cstk_environment_change[]", max(1, len(changes)))
        alive = []
        kept = []
        try:
            for i, change in enumerate(changes):
                if not isinstance(change, Change):
                    raise TypeError(f"changes[{i}] must be a cstk.Change, not {type(change).__name__}")
                kept.append(Kept(change.data))
                structure, *held = _structure(f"changes[{i}]" if len(changes) > 1 else "", change, kept[-1])
                alive.append(held)
                array[i] = structure[0]
            ids_out = pointer(ids, "uint64_t")
            check(lib.cstk_environment_apply(self._pointer, array, len(changes), ids_out, ffi.NULL))
        except BaseException:
            for data in kept:
                data.drop()
            raise
        return ids

    def load_scene(
        self,
        file: "os.PathLike[str] | str",
        *,
        at: Optional[ArrayLike] = None,
        mesh_form: MeshForm = MeshForm.SURFACE,
        hierarchy: Optional[HierarchyOptions] = None,
    ) -> NDArray[np.uint64]:
        """Adds the objects of a MoveIt planning scene, a .scene file, all or none, with their names, which are their data too; returns
        their ids, in the order of the file. `at` is where the scene's frame is in the world.
        """
        call = lib.cstk_environment_load_scene
        return self._load_scene(call, file_name("file", file), at, mesh_form, hierarchy)

    def load_scene_text(
        self,
        scene: str,
        *,
        at: Optional[ArrayLike] = None,
        mesh_form: MeshForm = MeshForm.SURFACE,
        hierarchy: Optional[HierarchyOptions] = None,
    ) -> NDArray[np.uint64]:
        """As load_scene, from a text."""
        call = lib.cstk_environment_load_scene_text
        return self._load_scene(call, text("scene", scene), at, mesh_form, hierarchy)

    def _load_scene(
        self,
        call: Any,
        scene: bytes,
        at: Optional[ArrayLike],
        mesh_form: MeshForm,
        hierarchy: Optional[HierarchyOptions],
    ) -> NDArray[np.uint64]:
        tree = hierarchy_options(hierarchy)
        given = options(
            "scene_options",
            at=None if at is None else pose("at", at).ravel().tolist(),
            hierarchy=tree,
            mesh_form=MeshForm(mesh_form),
        )
        ids, count = np.empty(MAX_SCENE_OBJECTS, np.uint64), ffi.new("size_t *")
        check(call(self._pointer, scene, given, ids.size, pointer(ids, "uint64_t"), count))
        ids = ids[: count[0]].copy()
        # What is named cannot go while a state holds it; other threads may have deleted some before.
        with self.snapshot() as state:
            held = state._pointer
            out = ffi.new("cstk_object_info *")
            for id in ids.tolist():
                try:
                    check(lib.cstk_environment_get_object_info(held, id, out))
                except NotFoundError:
                    continue
                keep_name(out.data, id)
        return ids

    def snapshot(self) -> "Environment":
        """An environment that stays as this one is now."""
        out = ffi.new("cstk_environment **")
        check(lib.cstk_environment_snapshot(self._pointer, out))
        return Environment._take(out[0])

    @property
    def object_count(self) -> int:
        out = ffi.new("size_t *")
        check(lib.cstk_environment_get_state(self._pointer, out, ffi.NULL))
        return int(out[0])

    @property
    def version(self) -> int:
        """The number of successful changes."""
        out = ffi.new("uint64_t *")
        check(lib.cstk_environment_get_state(self._pointer, ffi.NULL, out))
        return int(out[0])

    def objects(self) -> NDArray[np.uint64]:
        """The ids of all objects, in the order in which they came."""
        ids = np.empty(self.object_count, np.uint64)
        count = ffi.new("size_t *")
        check(lib.cstk_environment_get_objects(self._pointer, ids.size, pointer(ids, "uint64_t"), count))
        # Others may have gone meanwhile.
        return ids[: count[0]]

    def object_info(self, id: int) -> ObjectInfo:
        """The pose, the attachment and the data of an object."""
        out = ffi.new("cstk_object_info *")
        check(lib.cstk_environment_get_object_info(self._pointer, index("id", id, 64), out))
        return ObjectInfo(out)

    def object_name(self, id: int) -> str:
        """The name of an object; empty if it has none."""
        length = ffi.new("size_t *")
        number = index("id", id, 64)
        check(lib.cstk_environment_get_object_name(self._pointer, number, ffi.NULL, 0, length))
        out = ffi.new("char[]", length[0] + 1)
        check(lib.cstk_environment_get_object_name(self._pointer, number, out, len(out), ffi.NULL))
        return ffi.string(out).decode()

    def find_object(self, name: str) -> int:
        """The id of the object with this name, of several the one that was added first. NotFoundError if there is none."""
        out = ffi.new("uint64_t *")
        check(lib.cstk_environment_find_object(self._pointer, text("name", name), out))
        return int(out[0])

    def object_pose(self, id: int) -> NDArray[np.float64]:
        """The pose of an object: in the world, or in the frame of the link that it is attached to."""
        out = np.eye(4)
        pose_out = ffi.from_buffer("double[]", out)
        check(lib.cstk_environment_get_object_pose(self._pointer, index("id", id, 64), pose_out))
        return out


def _structure(where: str, change: Change, kept: Kept) -> Any:
    """What C takes of a change, and what must outlive it."""
    dot = f"{where}." if where else ""
    links = integers(f"{dot}touch_links", change.touch_links, np.uint32)
    given = options(
        "environment_change",
        kind=ChangeKind(change.kind),
        id=index(f"{dot}id", change.id, 64),
        pose=None if change.pose is None else pose(f"{dot}pose", change.pose).ravel().tolist(),
        link=index(f"{dot}link", change.link),
        touch_links=pointer(links, "uint32_t"),
        touch_count=links.size,
        data=kept.pointer,
        destroy=kept.destroy,
    )
    name = ffi.new("char[]", text(f"{dot}name", change.name))
    if change.kind == ChangeKind.ADD:
        given.body = pointer_of(Body, f"{dot}body", change.body)
        given.name = name
    if change.kind == ChangeKind.ATTACH or change.space is not None:
        given.space = pointer_of(Space, f"{dot}space", change.space)
    return given, links, name
