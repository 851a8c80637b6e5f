"""Robots: trees of links, each with a joint to its parent and perhaps a body."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Optional, Sequence, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, file_name, index, integers, pointer, pose, scalar, text, vector
from ._callback import callback
from ._callback_errors import keep_callback_error
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from ._urdf import FolderOrFolders, srdf_options, urdf_options
from ._user_data import Kept, data_of
from .body import Body
from .enums import JointKind, MeshForm, UrdfGeometry
from .errors import WrongSizeError, check
from .hierarchy import HierarchyOptions
from .records import LinkInfo, SrdfReport, UrdfReport
from .semantics import (
    EndEffector,
    JointGroup,
    NamedState,
    Semantics,
    VirtualJoint,
    end_effector_of,
    group_of,
    semantics_of,
    state_of,
    virtual_joint_of,
)

Array = NDArray[np.float64]
Said = TypeVar("Said")


def name_of(call: Any, owner: Any, link: int) -> str:
    """A name that C writes into a buffer."""
    length = ffi.new("size_t *")
    check(call(owner, link, ffi.NULL, 0, length))
    buffer = ffi.new("char[]", length[0] + 1)
    check(call(owner, link, buffer, length[0] + 1, ffi.NULL))
    return str(ffi.string(buffer).decode())


class Robot(Handle):
    """A tree of links. Made by RobotBuilder or load_urdf; it never changes."""

    __slots__ = ("_whole_nq",)
    _noun = "robot"
    _whole_nq: int

    def __init__(self) -> None:
        raise TypeError("robots are built: Robot.load_urdf(file) or RobotBuilder")

    @classmethod
    def load_urdf(cls, file: "os.PathLike[str] | str", **arguments: Any) -> "Robot":
        """The robot of a URDF file; arguments as for RobotBuilder.load_urdf, whose urdf_report() tells what was read."""
        builder = RobotBuilder()
        builder.load_urdf(file, **arguments)
        return builder.build()

    def _size(self, place: int) -> int:
        out = ffi.new("size_t[3]")
        check(lib.cstk_robot_get_size(self._pointer, out, out + 1, out + 2))
        return int(out[place])

    @property
    def nq(self) -> int:
        """The number of coordinates."""
        return self._size(0)

    @property
    def nv(self) -> int:
        """The number of velocities: one fewer for each quaternion."""
        return self._size(1)

    @property
    def link_count(self) -> int:
        return self._size(2)

    def body(self, link: int) -> Body:
        """The link's body; EmptyError if it has none."""
        out = ffi.new("cstk_body **")
        check(lib.cstk_robot_get_body(self._pointer, index("link", link), out))
        return Body._take(out[0])

    def find_link(self, name: str) -> int:
        """The number of the link with this name; NotFoundError if there is none."""
        out = ffi.new("uint32_t *")
        check(lib.cstk_robot_find_link(self._pointer, text("name", name), out))
        return int(out[0])

    def find_joint(self, name: str) -> int:
        """The number of the link that the joint with this name moves."""
        out = ffi.new("uint32_t *")
        check(lib.cstk_robot_find_joint(self._pointer, text("name", name), out))
        return int(out[0])

    def link_info(self, link: int) -> LinkInfo:
        """A link and the joint that moves it."""
        out = ffi.new("cstk_link_info *")
        check(lib.cstk_robot_get_link_info(self._pointer, index("link", link), out))
        return LinkInfo(out)

    def link_name(self, link: int) -> str:
        return name_of(lib.cstk_robot_get_link_name, self._pointer, index("link", link))

    def joint_name(self, link: int) -> str:
        """The name of the joint that moves the link; "" if it has none."""
        return name_of(lib.cstk_robot_get_joint_name, self._pointer, index("link", link))

    def link_pose(self, q: ArrayLike, link: int) -> Array:
        """The pose of a link in the world at configuration q."""
        array, out = vector("q", q), np.eye(4)
        check(lib.cstk_robot_link_pose(self._pointer, doubles(array), array.size, index("link", link), doubles(out)))
        return out

    def jacobian(self, q: ArrayLike, link: int, point: ArrayLike = (0, 0, 0)) -> Array:
        """The basic Jacobian (eq. 33) at q of a point fixed to a link, in the link's frame: (6, nv), linear rows before angular ones,
        in the world.
        """
        array, at = vector("q", q), doubles(vector("point", point, 3))
        out, jacobian = empty(6, self.nv)
        check(lib.cstk_robot_jacobian(self._pointer, doubles(array), array.size, index("link", link), at, jacobian))
        return out

    def semantics(self) -> Semantics:
        """What SRDF files say of the robot: counts, all 0 where none was read, and the passive joints."""
        return self._said("cstk_semantics", lib.cstk_robot_get_semantics, semantics_of)

    def find_group(self, name: str) -> int:
        """The index of the joint group with this name; NotFoundError if there is none."""
        return self._found(lib.cstk_robot_find_group, text("name", name))

    def find_state(self, group: Optional[str], name: str) -> int:
        """The index of the named state of a group; None for a state of which the file names no group."""
        of = ffi.NULL if group is None else text("group", group)
        return self._found(lib.cstk_robot_find_state, of, text("name", name))

    def find_end_effector(self, name: str) -> int:
        """The index of the end effector with this name; NotFoundError if there is none."""
        return self._found(lib.cstk_robot_find_end_effector, text("name", name))

    def group(self, group: int) -> JointGroup:
        """A joint group, by its index."""
        return self._said("cstk_joint_group", lib.cstk_robot_get_group, group_of, index("group", group))

    def state(self, state: int) -> NamedState:
        """A named state, by its index."""
        return self._said("cstk_named_state", lib.cstk_robot_get_state, state_of, index("state", state))

    def end_effector(self, end_effector: int) -> EndEffector:
        """An end effector, by its index."""
        place = index("end_effector", end_effector)
        return self._said("cstk_end_effector", lib.cstk_robot_get_end_effector, end_effector_of, place)

    def virtual_joint(self, virtual_joint: int) -> VirtualJoint:
        """A virtual joint, by its index."""
        place = index("virtual_joint", virtual_joint)
        return self._said("cstk_virtual_joint", lib.cstk_robot_get_virtual_joint, virtual_joint_of, place)

    def apply_state(self, state: int, q: ArrayLike) -> Array:
        """q with the values of a named state, by its index."""
        out = vector("q", q).copy()
        check(lib.cstk_robot_apply_state(self._pointer, index("state", state), doubles(out), out.size))
        return out

    def frozen(self, joints: ArrayLike, q: ArrayLike) -> "Robot":
        """The robot of which only the joints that move these links are left, the others frozen at q: a joint group as a robot of
        its own, with the same links by the same numbers. Coordinates that are left keep their order.
        """
        array, left = vector("q", q), integers("joints", joints, np.uint32)
        out = ffi.new("cstk_robot **")
        moved = pointer(left, "uint32_t")
        check(lib.cstk_robot_create_frozen(self._pointer, moved, left.size, doubles(array), array.size, out))
        made = Robot._take(out[0])
        made._whole_nq = array.size
        return made

    def to_whole(self, q: ArrayLike, whole: Optional["Robot"] = None) -> Array:
        """Of a robot that frozen() made: the configuration of the robot that it was made from, at its own configuration q. EmptyError for
        any other. Where `whole` is given, it must have as many coordinates as that robot.
        """
        array = vector("q", q)
        if whole is not None:
            pointer_of(Robot, "whole", whole)
        out, to = empty(getattr(self, "_whole_nq", 0) if whole is None else whole.nq)
        check(lib.cstk_robot_to_whole(self._pointer, doubles(array), array.size, to, out.size))
        return out

    def from_whole(self, whole: ArrayLike) -> Array:
        """Of a robot that frozen() made: the coordinates that are left to it, of a configuration of the whole robot."""
        array = vector("whole", whole)
        out, to = empty(self.nq)
        check(lib.cstk_robot_from_whole(self._pointer, doubles(array), array.size, to, out.size))
        return out

    def _found(self, call: Any, *names: Any) -> int:
        out = ffi.new("uint32_t *")
        check(call(self._pointer, *names, out))
        return int(out[0])

    def _said(self, ctype: str, call: Any, copied: Callable[[Any], Said], *place: int) -> Said:
        # The structure's arrays belong to the robot: the pointer keeps it until they are copied.
        robot, out = self._pointer, ffi.new(f"{ctype} *")
        check(call(robot, *place, out))
        return copied(out)


class CustomJoint:
    """A joint that moves by functions: `pose(q)` gives the pose of the link in the joint's frame at the joint's coordinates,
    `jacobian(q)` its derivative, (6, coordinates), linear rows before angular ones, in the joint's frame. Both are called by any
    thread that uses the robot, must be pure, and must not use the running Query. `linear_speed` and `angular_speed` are upper
    bounds of the link's speeds per unit rate of any coordinate; without them motions of this joint cannot be proved free.
    """

    def __init__(
        self,
        coordinates: int,
        pose: Callable[[Array], ArrayLike],
        jacobian: Callable[[Array], ArrayLike],
        linear_speed: Optional[float] = None,
        angular_speed: Optional[float] = None,
    ) -> None:
        self.coordinates = index("coordinates", coordinates)
        self.pose = pose
        self.jacobian = jacobian
        self.linear_speed = linear_speed
        self.angular_speed = angular_speed

    def structure(self, kept: Kept) -> Any:
        """What C takes; the joint is `kept` until C drops it."""
        return options(
            "custom_joint",
            coordinates=self.coordinates,
            pose=_joint_pose,
            jacobian=_joint_jacobian,
            user=kept.pointer,
            destroy=kept.destroy,
            linear_speed=self.linear_speed,
            angular_speed=self.angular_speed,
        )


@callback("int32_t(double *, size_t, double *, void *)", keep_callback_error)
def _joint_pose(q: Any, n: int, out: Any, user: Any) -> int:
    out[0:12] = pose("the joint's pose", data_of(user).pose(np.array(ffi.unpack(q, n)))).ravel().tolist()
    return 0


@callback("int32_t(double *, size_t, double *, void *)", keep_callback_error)
def _joint_jacobian(q: Any, n: int, out: Any, user: Any) -> int:
    found = np.asarray(data_of(user).jacobian(np.array(ffi.unpack(q, n))), np.float64)
    if found.shape != (6, n):
        raise WrongSizeError(f"the joint's jacobian has shape {found.shape}; needed: (6, {n})")
    out[0 : 6 * n] = found.ravel().tolist()
    return 0


class RobotBuilder(Handle):
    """Collects the links of a robot of dimension 2 (planar: joints turn about z or shift along x and y) or 3."""

    __slots__ = ()
    _noun = "robot_builder"

    def __init__(self, dimension: int = 3) -> None:
        self._created(index("dimension", dimension))

    def add_link(
        self,
        joint: JointKind = JointKind.FIXED,
        *,
        parent: int = -1,
        body: Optional[Body] = None,
        at: Optional[ArrayLike] = None,
        axis: ArrayLike = (0, 0, 1),
        name: Optional[str] = None,
        joint_name: Optional[str] = None,
        coordinate: int = -1,
        multiplier: float = 1.0,
        offset: float = 0.0,
        lower: float = -np.inf,
        upper: float = np.inf,
        custom: Optional[CustomJoint] = None,
    ) -> int:
        """Adds a link and returns its number; parents before children.

        `at` is the joint's frame in the parent's (-1: the world's); the link's frame, in which its body is given, coincides with it at
        coordinate 0. `axis` is that of a revolute or prismatic joint, in the joint's frame. `coordinate` is the joint's first, or
        -1 for the next unused ones: a revolute or prismatic joint may share an earlier one and so mimic it, moving by
        multiplier * coordinate + offset. Without limits a revolute joint turns on a circle.
        """
        if custom is not None and not isinstance(custom, CustomJoint):
            raise TypeError(f"custom must be a CustomJoint, not {type(custom).__name__}")
        with Kept(custom) as kept:
            names = [ffi.NULL if n is None else ffi.new("char[]", text(k, n)) for k, n in _named(name, joint_name)]
            moved = ffi.NULL if custom is None else custom.structure(kept)
            link = options(
                "link_def",
                name=names[0],
                body=ffi.NULL if body is None else pointer_of(Body, "body", body),
                parent=parent,
                joint=JointKind(joint),
                at=None if at is None else pose("at", at).ravel().tolist(),
                axis=vector("axis", axis, 3).tolist(),
                coordinate=coordinate,
                joint_name=names[1],
                multiplier=scalar("multiplier", multiplier),
                offset=scalar("offset", offset),
                lower=scalar("lower", lower),
                upper=scalar("upper", upper),
                custom=moved,
            )
            out = ffi.new("uint32_t *")
            check(lib.cstk_robot_builder_add_link(self._pointer, link, out))
        return int(out[0])

    def load_urdf(
        self,
        file: "os.PathLike[str] | str",
        *,
        geometry: UrdfGeometry = UrdfGeometry.COLLISION,
        base: JointKind = JointKind.FIXED,
        parent: int = -1,
        sides: int = 0,
        at: Optional[ArrayLike] = None,
        prefix: Optional[str] = None,
        package_paths: FolderOrFolders = (),
        hierarchy: Optional[HierarchyOptions] = None,
        cache_folder: "os.PathLike[str] | str | None" = None,
        mesh_form: MeshForm = MeshForm.SURFACE,
        link_forms: Optional[Mapping[str, MeshForm]] = None,
        progress: Optional[Progress] = None,
    ) -> int:
        """Adds the robot of a URDF file, and returns its root link. `geometry` chooses its shapes, `base` is the joint of the root,
        `prefix` is put before all names, `cache_folder` keeps the built bodies for the next start. urdf_report() tells what was
        read. A body wholly inside a mesh does not meet it, unless `mesh_form`, or `link_forms` for a link by its name in the file,
        makes it a solid or its convex hull.
        """
        return self._read_urdf(
            lambda *rest: lib.cstk_robot_builder_load_urdf(self._pointer, file_name("file", file), *rest),
            progress,
            geometry=geometry,
            base=base,
            parent=parent,
            sides=sides,
            at=at,
            prefix=prefix,
            package_paths=package_paths,
            hierarchy=hierarchy,
            cache_folder=cache_folder,
            mesh_form=mesh_form,
            link_forms=link_forms,
        )

    def load_urdf_text(
        self,
        urdf: str,
        folder: "os.PathLike[str] | str | None" = None,
        *,
        progress: Optional[Progress] = None,
        **arguments: Any,
    ) -> int:
        """As load_urdf, with its arguments, from a text: what the robot_description of ROS holds. Names of meshes are relative to
        `folder`; without it they must be absolute, or in packages.
        """
        source = text("urdf", urdf)
        place = ffi.NULL if folder is None else ffi.new("char[]", file_name("folder", folder))
        return self._read_urdf(
            lambda *rest: lib.cstk_robot_builder_load_urdf_text(self._pointer, source, place, *rest),
            progress,
            **arguments,
        )

    def _read_urdf(self, call: Callable[..., int], progress: Optional[Progress], **arguments: Any) -> int:
        given, _kept = urdf_options(**arguments)
        root = ffi.new("uint32_t *")
        reporting(lambda function, user: call(given, function, user, root), progress)
        return int(root[0])

    def urdf_report(self) -> UrdfReport:
        """What became of the URDF file or text added last."""
        out = ffi.new("cstk_urdf_report *")
        check(lib.cstk_robot_builder_get_urdf_report(self._pointer, out))
        return UrdfReport(out)

    def load_srdf(
        self, file: "os.PathLike[str] | str", *, prefix: Optional[str] = None, skip_unknown: bool = False
    ) -> None:
        """Adds what an SRDF file says of the links that are there: disabled pairs, joint groups, named states, end effectors.
        `prefix` is the one that the URDF file was loaded with. Names that are not there are refused, or, with `skip_unknown`,
        skipped and counted by srdf_report().
        """
        given, _kept = srdf_options(prefix, skip_unknown)
        check(lib.cstk_robot_builder_load_srdf(self._pointer, file_name("file", file), given))

    def load_srdf_text(self, srdf: str, *, prefix: Optional[str] = None, skip_unknown: bool = False) -> None:
        """As load_srdf, from a text: what the robot_description_semantic of ROS holds."""
        given, _kept = srdf_options(prefix, skip_unknown)
        check(lib.cstk_robot_builder_load_srdf_text(self._pointer, text("srdf", srdf), given))

    def srdf_report(self) -> SrdfReport:
        """What became of the SRDF file or text added last."""
        out = ffi.new("cstk_srdf_report *")
        check(lib.cstk_robot_builder_get_srdf_report(self._pointer, out))
        return SrdfReport(out)

    def disable_pair(self, r_link: str, s_link: str) -> None:
        """Rules a pair of links, by their names, out for self-collision."""
        names = text("r_link", r_link), text("s_link", s_link)
        check(lib.cstk_robot_builder_disable_pair(self._pointer, *names))

    def build(self) -> Robot:
        """Builds a robot from the links added so far; the builder is unchanged."""
        out = ffi.new("cstk_robot **")
        check(lib.cstk_robot_build(self._pointer, out))
        return Robot._take(out[0])


def _named(name: Optional[str], joint_name: Optional[str]) -> Any:
    return ("name", name), ("joint_name", joint_name)
