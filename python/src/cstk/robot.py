"""Robots: trees of links, each with a joint to its parent and perhaps a body."""

import os
from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, file_name, index, pose, scalar, text, vector
from ._callback import callback
from ._callback_errors import keep_callback_error
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from ._user_data import Kept, data_of
from .body import Body
from .enums import JointKind, UrdfGeometry
from .errors import WrongSizeError, check
from .hierarchy import HierarchyOptions, hierarchy_options
from .records import LinkInfo, UrdfReport

Array = NDArray[np.float64]


def name_of(call: Any, owner: Any, link: int) -> str:
    """A name that C writes into a buffer."""
    length = ffi.new("size_t *")
    check(call(owner, link, ffi.NULL, 0, length))
    buffer = ffi.new("char[]", length[0] + 1)
    check(call(owner, link, buffer, length[0] + 1, ffi.NULL))
    return str(ffi.string(buffer).decode())


class Robot(Handle):
    """A tree of links. Made by RobotBuilder or load_urdf; it never changes."""

    __slots__ = ()
    _noun = "robot"

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


@callback("int32_t(double *, size_t, double *, void *)")
def _joint_pose(q: Any, n: int, out: Any, user: Any) -> int:
    try:
        out[0:12] = pose("the joint's pose", data_of(user).pose(np.array(ffi.unpack(q, n)))).ravel().tolist()
        return 0
    except BaseException as error:
        keep_callback_error(error)
        return 1


@callback("int32_t(double *, size_t, double *, void *)")
def _joint_jacobian(q: Any, n: int, out: Any, user: Any) -> int:
    try:
        found = np.asarray(data_of(user).jacobian(np.array(ffi.unpack(q, n))), np.float64)
        if found.shape != (6, n):
            raise WrongSizeError(f"the joint's jacobian has shape {found.shape}; needed: (6, {n})")
        out[0 : 6 * n] = found.ravel().tolist()
        return 0
    except BaseException as error:
        keep_callback_error(error)
        return 1


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
        package_paths: Sequence["os.PathLike[str] | str"] = (),
        hierarchy: Optional[HierarchyOptions] = None,
        cache_folder: "os.PathLike[str] | str | None" = None,
        progress: Optional[Progress] = None,
    ) -> int:
        """Adds the robot of a URDF file, and returns its root link. `geometry` chooses its shapes, `base` is the joint of the root,
        `prefix` is put before all names, `cache_folder` keeps the built bodies for the next start. urdf_report() tells what was
        read. Meshes are surfaces: a body wholly inside one does not meet it.
        """
        folders = [ffi.new("char[]", file_name("package_paths", folder)) for folder in package_paths]
        folder_list = ffi.new("char *[]", folders)
        prefix_text = None if prefix is None else ffi.new("char[]", text("prefix", prefix))
        cache = None if cache_folder is None else ffi.new("char[]", file_name("cache_folder", cache_folder))
        tree = hierarchy_options(hierarchy)
        given = options(
            "urdf_options",
            geometry=UrdfGeometry(geometry),
            base=JointKind(base),
            parent=parent,
            sides=index("sides", sides),
            at=None if at is None else pose("at", at).ravel().tolist(),
            prefix=prefix_text,
            package_paths=folder_list,
            package_path_count=len(folders),
            hierarchy=tree,
            cache_folder=cache,
        )
        root = ffi.new("uint32_t *")
        builder, path = self._pointer, file_name("file", file)
        reporting(
            lambda function, user: lib.cstk_robot_builder_load_urdf(builder, path, given, function, user, root),
            progress,
        )
        return int(root[0])

    def urdf_report(self) -> UrdfReport:
        """What became of the URDF file added last."""
        out = ffi.new("cstk_urdf_report *")
        check(lib.cstk_robot_builder_get_urdf_report(self._pointer, out))
        return UrdfReport(out)

    def build(self) -> Robot:
        """Builds a robot from the links added so far; the builder is unchanged."""
        out = ffi.new("cstk_robot **")
        check(lib.cstk_robot_build(self._pointer, out))
        return Robot._take(out[0])


def _named(name: Optional[str], joint_name: Optional[str]) -> Any:
    return ("name", name), ("joint_name", joint_name)
