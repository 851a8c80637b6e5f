"""Bodies: rigid unions of convex primitives. They never change once built, and serve any number of links, obstacles and threads."""

from __future__ import annotations

import os
import tempfile
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, file_name, finite, frame_or_identity, index, integers, numbers, pointer, rows, scalar, vector
from ._callback import callback
from ._callback_errors import keep_callback_error
from ._handle import Handle
from ._native import ffi, lib
from ._progress import Progress, reporting
from ._user_data import Kept, data_of
from .enums import FeatureKind
from .errors import WrongSizeError, check
from .hierarchy import HierarchyOptions, Mesh, hierarchy_options, mesh_of
from .records import BodyPart, BodyStatistics, HierarchyNode, HierarchyStatistics, LevelStatistics, Primitive

Array = NDArray[np.float64]
Support = Callable[[Array], ArrayLike]
"""From a unit vector to a point of a convex set that is farthest along it."""


class Body(Handle):
    """A rigid union of convex primitives. Made by BodyBuilder, or of one call by the class methods here: `Body.box([1, 1, 1])`.

    Bodies are pickled as the files that save() writes, with their user data; copies share the body.
    """

    __slots__ = ()
    _noun = "body"

    def __init__(self) -> None:
        raise TypeError("bodies are built: Body.box([1, 1, 1]), BodyBuilder, or Body.load")

    @classmethod
    def polygon(cls, xyz: ArrayLike, *, dimension: int = 3, tag: int = 0) -> "Body":
        """One convex polygon. See BodyBuilder.add_polygon."""
        return BodyBuilder(dimension).add_polygon(xyz, tag).build()

    @classmethod
    def polyhedron(cls, xyz: ArrayLike, *, tag: int = 0) -> "Body":
        """The convex hull of points. See BodyBuilder.add_polyhedron."""
        return BodyBuilder().add_polyhedron(xyz, tag).build()

    @classmethod
    def mesh(
        cls,
        vertices: ArrayLike,
        faces: ArrayLike,
        *,
        solid: bool = False,
        pose: Optional[ArrayLike] = None,
        scale: ArrayLike = 1.0,
        hierarchy: Optional[HierarchyOptions] = None,
    ) -> "Body":
        """A mesh of (n, 3) vertices and (m, 3) faces, or (m, k) of k corners: a surface, or the boundary of a solid."""
        return BodyBuilder().add_mesh(vertices, faces, pose=pose, scale=scale).set_solid(solid).build(hierarchy)

    @classmethod
    def mesh_file(
        cls,
        file: "os.PathLike[str] | str",
        *,
        solid: bool = False,
        pose: Optional[ArrayLike] = None,
        scale: ArrayLike = 1.0,
        hierarchy: Optional[HierarchyOptions] = None,
    ) -> "Body":
        """The mesh in an .obj, .stl, .dae or .ply file. See BodyBuilder.add_mesh_file."""
        return BodyBuilder().add_mesh_file(file, pose=pose, scale=scale).set_solid(solid).build(hierarchy)

    @classmethod
    def sphere(cls, radius: float, center: ArrayLike = (0, 0, 0), *, dimension: int = 3, tag: int = 0) -> "Body":
        """A ball; in the plane a disc."""
        return BodyBuilder(dimension).add_sphere(center, radius, tag).build()

    @classmethod
    def capsule(cls, a: ArrayLike, b: ArrayLike, radius: float, *, dimension: int = 3, tag: int = 0) -> "Body":
        """All points within a radius of the segment from a to b."""
        return BodyBuilder(dimension).add_capsule(a, b, radius, tag).build()

    @classmethod
    def box(cls, half_extents: ArrayLike, pose: Optional[ArrayLike] = None, *, tag: int = 0) -> "Body":
        """A solid box around the origin of its frame."""
        return BodyBuilder().add_box(half_extents, pose, tag).build()

    @classmethod
    def cylinder(cls, radius: float, half_length: float, pose: Optional[ArrayLike] = None, *, tag: int = 0) -> "Body":
        """A solid cylinder around the z axis of its frame."""
        return BodyBuilder().add_cylinder(radius, half_length, pose, tag).build()

    @classmethod
    def cone(cls, radius: float, height: float, pose: Optional[ArrayLike] = None, *, tag: int = 0) -> "Body":
        """A solid cone around the z axis of its frame, its middle at the origin."""
        return BodyBuilder().add_cone(radius, height, pose, tag).build()

    @classmethod
    def ellipsoid(cls, semi_axes: ArrayLike, pose: Optional[ArrayLike] = None, *, tag: int = 0) -> "Body":
        """A solid ellipsoid around the origin of its frame."""
        return BodyBuilder().add_ellipsoid(semi_axes, pose, tag).build()

    @classmethod
    def points(cls, xyz: ArrayLike, radius: float = 0.0, *, dimension: int = 3) -> "Body":
        """A point cloud of balls of one radius; a radius of 0 gives points."""
        return BodyBuilder(dimension).add_points(xyz, radius).build()

    @classmethod
    def height_field(cls, heights: ArrayLike, cell_x: float, cell_y: float, base: Optional[float] = None) -> "Body":
        """A height field over the xy-plane. See BodyBuilder.add_height_field."""
        return BodyBuilder().add_height_field(heights, cell_x, cell_y, base).build()

    @classmethod
    def load(cls, file: "os.PathLike[str] | str") -> "Body":
        """A body that save() wrote. Nothing is rebuilt; queries give the same answers, bit for bit."""
        out = ffi.new("cstk_body **")
        check(lib.cstk_body_load(file_name("file", file), out))
        return cls._take(out[0])

    def save(self, file: "os.PathLike[str] | str") -> None:
        """Saves the body with its hierarchy. UnsupportedError for a body with a support function."""
        check(lib.cstk_body_save(self._pointer, file_name("file", file)))

    @classmethod
    def _from_file(cls, contents: bytes, data: Any) -> "Body":
        with tempfile.TemporaryDirectory(prefix="cstk") as folder:
            file = os.path.join(folder, "body")
            with open(file, "wb") as out:
                out.write(contents)
            body = cls.load(file)
        if data is not None:
            body.set_data(data)
        return body

    def __reduce__(self) -> Any:
        with tempfile.TemporaryDirectory(prefix="cstk") as folder:
            file = os.path.join(folder, "body")
            self.save(file)
            with open(file, "rb") as contents:
                return type(self)._from_file, (contents.read(), self.data)

    def __copy__(self) -> "Body":
        check(lib.cstk_body_retain(self._pointer))
        return type(self)._take(ffi.cast("cstk_body *", self._pointer))

    def __deepcopy__(self, memo: Any) -> "Body":
        return self.__copy__()

    def set_data(self, data: Any) -> None:
        """Attaches an object that witnesses hand back; once for each body."""
        with Kept(data) as kept:
            check(lib.cstk_body_set_data(self._pointer, kept.pointer, kept.destroy))

    @property
    def data(self) -> Any:
        """What set_data attached, or None."""
        out = ffi.new("void **")
        check(lib.cstk_body_get_data(self._pointer, out))
        return data_of(out[0])

    def statistics(self) -> BodyStatistics:
        """Counts and extents."""
        out = ffi.new("cstk_body_statistics *")
        check(lib.cstk_body_get_statistics(self._pointer, out))
        return BodyStatistics(out)

    def primitive(self, number: int) -> Primitive:
        """What a primitive is, and how many features it has. They are numbered in the order in which they were added."""
        out = ffi.new("cstk_primitive *")
        check(lib.cstk_body_get_primitive(self._pointer, index("number", number), out))
        return Primitive(out)

    def feature_vertices(self, primitive: int, kind: FeatureKind, feature: int = 0) -> Array:
        """The vertices of a feature of a primitive, (n, 3)."""
        arguments = (index("primitive", primitive), FeatureKind(kind), index("feature", feature))
        count = ffi.new("size_t *")
        check(lib.cstk_body_get_feature_vertices(self._pointer, *arguments, 0, ffi.NULL, count))
        out, xyz = empty(count[0], 3)
        check(lib.cstk_body_get_feature_vertices(self._pointer, *arguments, count[0], xyz, count))
        return out

    def part(self, number: int) -> BodyPart:
        """A body that was added to the builder of this one (BodyBuilder.add_body): its tag, pose and primitives."""
        out = ffi.new("cstk_body_part *")
        check(lib.cstk_body_get_part(self._pointer, index("number", number), out))
        return BodyPart(out)

    def vertices(self) -> Array:
        """The vertices of all primitives, one primitive after the other, (n, 3)."""
        count = ffi.new("size_t *")
        check(lib.cstk_body_get_vertices(self._pointer, 0, ffi.NULL, count))
        out, xyz = empty(count[0], 3)
        check(lib.cstk_body_get_vertices(self._pointer, count[0], xyz, count))
        return out

    def refit(self, xyz: ArrayLike) -> "Body":
        """A body with other vertices, in the order of vertices(): topology and grouping stay, boxes are fitted anew."""
        array = rows("xyz", xyz, 3)
        out = ffi.new("cstk_body **")
        check(lib.cstk_body_refit(self._pointer, doubles(array), len(array), out))
        return self._take(out[0])

    def hierarchy_statistics(self) -> HierarchyStatistics:
        """Depth, balance, cost, build times and memory of the hierarchy."""
        out = ffi.new("cstk_hierarchy_statistics *")
        check(lib.cstk_body_get_hierarchy_statistics(self._pointer, out))
        return HierarchyStatistics(out)

    def level_statistics(self, level: int) -> LevelStatistics:
        """Volume and surface of a level of the hierarchy; the root's is 0."""
        out = ffi.new("cstk_level_statistics *")
        check(lib.cstk_body_get_level_statistics(self._pointer, index("level", level), out))
        return LevelStatistics(out)

    def level_nodes(self, level: int) -> NDArray[np.uint32]:
        """The nodes of a level and the leaves above it, which together cover the body."""
        count = ffi.new("size_t *")
        check(lib.cstk_body_get_level_nodes(self._pointer, index("level", level), 0, ffi.NULL, count))
        out = np.empty(count[0], np.uint32)
        check(lib.cstk_body_get_level_nodes(self._pointer, level, count[0], pointer(out, "uint32_t"), count))
        return out

    def cover_nodes(self, max_count: int) -> NDArray[np.uint32]:
        """At most `max_count` nodes that cover the body."""
        room = min(index("max_count", max_count, 64), self.statistics().node_count)
        out = np.empty(room, np.uint32)
        count = ffi.new("size_t *")
        check(lib.cstk_body_get_cover_nodes(self._pointer, room, pointer(out, "uint32_t"), count))
        return out[: count[0]]

    def node(self, node: int) -> HierarchyNode:
        """A node of the hierarchy; the root is 0."""
        out = ffi.new("cstk_hierarchy_node *")
        check(lib.cstk_body_get_node(self._pointer, index("node", node), out))
        return HierarchyNode(out)

    def node_corners(self, node: int) -> Array:
        """The corners of a node's wrapper, (n, 3)."""
        count = ffi.new("size_t *")
        check(lib.cstk_body_get_node_corners(self._pointer, index("node", node), 0, ffi.NULL, count))
        out, xyz = empty(count[0], 3)
        check(lib.cstk_body_get_node_corners(self._pointer, node, count[0], xyz, count))
        return out

    def mesh_of_nodes(self, nodes: ArrayLike) -> Mesh:
        """A mesh of the wrappers of nodes, leaves as their primitives."""
        array = integers("nodes", nodes, np.uint32)
        out = ffi.new("cstk_mesh **")
        check(lib.cstk_mesh_create_from_nodes(self._pointer, pointer(array, "uint32_t"), array.size, out))
        return mesh_of(out[0])

    def show_nodes(self, nodes: ArrayLike, file: "os.PathLike[str] | str") -> None:
        """A picture of nodes; the file's name ends in .glb."""
        array = integers("nodes", nodes, np.uint32)
        check(lib.cstk_body_show_nodes(self._pointer, pointer(array, "uint32_t"), array.size, file_name("file", file)))


class _SupportFunction:
    def __init__(self, function: Support) -> None:
        self.function = function
        self.added = False


def _keep_or_print(error: BaseException) -> None:
    if isinstance(error, Exception):
        raise error  # Queries go on with the bounding box: cffi prints what was raised.
    keep_callback_error(error)


@callback("int32_t(double *, double *, void *)", _keep_or_print)
def _support(direction: Any, point: Any, user: Any) -> int:
    support: _SupportFunction = data_of(user)
    try:
        found = vector("the support function's point", support.function(np.array(ffi.unpack(direction, 3))), 3)
        point[0:3] = found.tolist()
        return 0
    except Exception as error:
        if support.added:
            raise
        keep_callback_error(error)
        return 1


def _scale(scale: ArrayLike) -> Array:
    array = numbers("scale", scale)
    return np.full(3, array) if array.ndim == 0 else vector("scale", array, 3)


def _control_net(name: str, points: ArrayLike, weights: Optional[ArrayLike]) -> "tuple[Array, Any]":
    """The control points of a surface, rows by columns by 3, and the pointer to their weights: NULL without."""
    net = numbers(name, points)
    if net.ndim != 3 or net.shape[2] != 3 or 0 in net.shape:
        raise WrongSizeError(f"{name} must have the shape (rows, columns, 3), not {net.shape}")
    if weights is None:
        return net, ffi.NULL
    factors = numbers("weights", weights)
    if factors.shape != net.shape[:2]:
        raise WrongSizeError(f"weights must have the shape {net.shape[:2]}, not {factors.shape}")
    return net, doubles(factors.reshape(-1))


class BodyBuilder(Handle):
    """Collects the primitives of a body: of dimension 2 (planar worlds: all z are 0, polygons are solid) or 3. Each add_ method
    returns the builder. Points are (n, 3) arrays. `tag` is any number of yours; witnesses return it.
    """

    __slots__ = ()
    _noun = "body_builder"

    def __init__(self, dimension: int = 3) -> None:
        self._created(index("dimension", dimension))

    def add_polygon(self, xyz: ArrayLike, tag: int = 0) -> "BodyBuilder":
        """Adds a convex planar polygon, vertices in cyclic order: a surface in space, solid in the plane."""
        array = rows("xyz", xyz, 3)
        check(lib.cstk_body_builder_add_polygon(self._pointer, doubles(array), len(array), index("tag", tag, 64)))
        return self

    def add_polyhedron(self, xyz: ArrayLike, tag: int = 0) -> "BodyBuilder":
        """Adds the convex hull of points: a solid, or what the points span. Points inside the hull are ignored."""
        array = rows("xyz", xyz, 3)
        check(lib.cstk_body_builder_add_polyhedron(self._pointer, doubles(array), len(array), index("tag", tag, 64)))
        return self

    def add_mesh(
        self,
        vertices: ArrayLike,
        faces: ArrayLike,
        face_sizes: Optional[ArrayLike] = None,
        *,
        pose: Optional[ArrayLike] = None,
        scale: ArrayLike = 1.0,
    ) -> "BodyBuilder":
        """Adds the faces of a mesh as polygons: `faces` is (m, k), k vertex indices for each face, or, with `face_sizes`, the indices
        of all faces one after the other. The mesh is scaled along its own axes, then moved by `pose`. Faces are tagged with
        their number; those that are not convex or not planar are split into triangles.
        """
        points = rows("vertices", vertices, 3)
        corners = integers("faces", faces, np.uint32)
        if face_sizes is not None:
            sizes = integers("face_sizes", face_sizes, np.uint32)
            if corners.ndim != 1 or sizes.ndim != 1:
                raise WrongSizeError("faces and face_sizes have one dimension where both are given")
        elif corners.ndim == 2:
            sizes = np.full(len(corners), corners.shape[1], np.uint32)
        else:
            raise WrongSizeError(f"faces has shape {corners.shape}; needed: (m, 3), or face_sizes besides")
        check(
            lib.cstk_body_builder_add_mesh(
                self._pointer,
                doubles(points),
                len(points),
                ffi.from_buffer("uint32_t[]", sizes),
                sizes.size,
                ffi.from_buffer("uint32_t[]", corners),
                corners.size,
                frame_or_identity("pose", pose),
                doubles(_scale(scale)),
            )
        )
        return self

    def add_mesh_file(
        self, file: "os.PathLike[str] | str", *, pose: Optional[ArrayLike] = None, scale: ArrayLike = 1.0
    ) -> "BodyBuilder":
        """Adds the mesh in an .obj, .stl, .ply or .dae file (scaled to metres by a .dae file's unit)."""
        frame = frame_or_identity("pose", pose)
        path = file_name("file", file)
        check(lib.cstk_body_builder_add_mesh_file(self._pointer, path, frame, doubles(_scale(scale))))
        return self

    def add_cloud_file(
        self,
        file: "os.PathLike[str] | str",
        radius: float = 0.0,
        *,
        pose: Optional[ArrayLike] = None,
        scale: ArrayLike = 1.0,
    ) -> int:
        """Adds balls around the points in a .pcd file, or around the vertices in a .ply file; radius 0 adds the points themselves. They
        are tagged with their number. Points of a .pcd file that are NaN were not measured: they are left out, and their number returned.
        """
        frame = frame_or_identity("pose", pose)
        left_out = ffi.new("uint64_t *")
        factors, size = doubles(_scale(scale)), scalar("radius", radius)
        path = file_name("file", file)
        check(lib.cstk_body_builder_add_cloud_file(self._pointer, path, frame, factors, size, left_out))
        return int(left_out[0])

    def add_body(self, body: Body, pose: Optional[ArrayLike] = None, tag: int = 0) -> "BodyBuilder":
        """Adds a built body at a pose, as a part with its hierarchy. Witnesses give its number (`r_part`), Body.part its tag."""
        if not isinstance(body, Body):
            raise TypeError(f"body must be a Body, not {type(body).__name__}")
        frame = frame_or_identity("pose", pose)
        check(lib.cstk_body_builder_add_body(self._pointer, body._pointer, frame, index("tag", tag, 64)))
        return self

    def set_solid(self, solid: bool = True) -> "BodyBuilder":
        """Declares that all polygons and mesh faces together are the closed boundary of a solid; build() checks it."""
        check(lib.cstk_body_builder_set_solid(self._pointer, bool(solid)))
        return self

    def add_bezier_patch(
        self, points: ArrayLike, tolerance: float, weights: Optional[ArrayLike] = None, tag: int = 0
    ) -> "BodyBuilder":
        """Adds triangles that are within a tolerance of a Bezier patch: `points` is an array of (degree_u + 1, degree_v + 1, 3) control
        points, `weights` one of (degree_u + 1, degree_v + 1) for a rational patch. The body states how far they are from it.
        """
        net, factors = _control_net("points", points, weights)
        number, size = index("tag", tag, 64), scalar("tolerance", tolerance)
        degrees = net.shape[0] - 1, net.shape[1] - 1
        count = net.shape[0] * net.shape[1]
        check(
            lib.cstk_body_builder_add_bezier_patch(
                self._pointer, *degrees, doubles(net.reshape(-1)), factors, count, size, number
            )
        )
        return self

    def add_nurbs_surface(
        self,
        knots_u: ArrayLike,
        knots_v: ArrayLike,
        control_points: ArrayLike,
        tolerance: float,
        weights: Optional[ArrayLike] = None,
        tag: int = 0,
    ) -> "BodyBuilder":
        """Adds triangles that are within a tolerance of a NURBS surface: `control_points` is an array of (n, m, 3), `weights` one of
        (n, m). There are degree_u + 1 more knots in u than n, and degree_v + 1 more in v than m, which tells the degrees. Knots need not
        be clamped. The body states how far the triangles are from the surface.
        """
        net, factors = _control_net("control_points", control_points, weights)
        in_u, in_v = vector("knots_u", knots_u), vector("knots_v", knots_v)
        degrees = in_u.size - net.shape[0] - 1, in_v.size - net.shape[1] - 1
        for degree, name, line in zip(degrees, ("knots_u", "knots_v"), net.shape):
            if degree < 1:
                raise WrongSizeError(f"{name} must have more than {line + 1} entries for {line} control points")
        number, size = index("tag", tag, 64), scalar("tolerance", tolerance)
        knots = doubles(in_u), in_u.size, doubles(in_v), in_v.size
        count = net.shape[0] * net.shape[1]
        check(
            lib.cstk_body_builder_add_nurbs_surface(
                self._pointer, *degrees, *knots, doubles(net.reshape(-1)), count, factors, size, number
            )
        )
        return self

    def set_deviation(self, deviation: float) -> "BodyBuilder":
        """States that the body stands for something no farther from it than `deviation`, such as a curved surface: answers hold for
        that. Deviations are subtracted from distances as a margin is; upper bounds are greater by twice as much."""
        check(lib.cstk_body_builder_set_deviation(self._pointer, scalar("deviation", deviation)))
        return self

    def add_sphere(self, center: ArrayLike, radius: float, tag: int = 0) -> "BodyBuilder":
        """Adds a ball; in the plane a disc."""
        middle = doubles(vector("center", center, 3))
        check(lib.cstk_body_builder_add_sphere(self._pointer, middle, scalar("radius", radius), index("tag", tag, 64)))
        return self

    def add_capsule(self, a: ArrayLike, b: ArrayLike, radius: float, tag: int = 0) -> "BodyBuilder":
        """Adds all points within a radius of the segment from a to b."""
        ends = doubles(vector("a", a, 3)), doubles(vector("b", b, 3))
        check(lib.cstk_body_builder_add_capsule(self._pointer, *ends, scalar("radius", radius), index("tag", tag, 64)))
        return self

    def add_box(self, half_extents: ArrayLike, pose: Optional[ArrayLike] = None, tag: int = 0) -> "BodyBuilder":
        """Adds a solid box around the origin of the frame at `pose`, along its axes."""
        frame = frame_or_identity("pose", pose)
        half = doubles(vector("half_extents", half_extents, 3))
        check(lib.cstk_body_builder_add_box(self._pointer, frame, half, index("tag", tag, 64)))
        return self

    def add_cylinder(
        self, radius: float, half_length: float, pose: Optional[ArrayLike] = None, tag: int = 0
    ) -> "BodyBuilder":
        """Adds a solid cylinder around the z axis of the frame at `pose`, from -half_length to half_length."""
        frame = frame_or_identity("pose", pose)
        sizes = scalar("radius", radius), scalar("half_length", half_length)
        check(lib.cstk_body_builder_add_cylinder(self._pointer, frame, *sizes, index("tag", tag, 64)))
        return self

    def add_cone(self, radius: float, height: float, pose: Optional[ArrayLike] = None, tag: int = 0) -> "BodyBuilder":
        """Adds a solid cone around the z axis of the frame at `pose`: base at -height / 2, apex at height / 2."""
        frame = frame_or_identity("pose", pose)
        sizes = scalar("radius", radius), scalar("height", height)
        check(lib.cstk_body_builder_add_cone(self._pointer, frame, *sizes, index("tag", tag, 64)))
        return self

    def add_ellipsoid(self, semi_axes: ArrayLike, pose: Optional[ArrayLike] = None, tag: int = 0) -> "BodyBuilder":
        """Adds a solid ellipsoid around the origin of the frame at `pose`."""
        frame = frame_or_identity("pose", pose)
        axes = doubles(vector("semi_axes", semi_axes, 3))
        check(lib.cstk_body_builder_add_ellipsoid(self._pointer, frame, axes, index("tag", tag, 64)))
        return self

    def add_rounded_polygon(self, xyz: ArrayLike, radius: float, tag: int = 0) -> "BodyBuilder":
        """Adds all points within a radius of a convex polygon."""
        array = rows("xyz", xyz, 3)
        sizes = len(array), scalar("radius", radius), index("tag", tag, 64)
        check(lib.cstk_body_builder_add_rounded_polygon(self._pointer, doubles(array), *sizes))
        return self

    def add_rounded_polyhedron(self, xyz: ArrayLike, radius: float, tag: int = 0) -> "BodyBuilder":
        """Adds all points within a radius of the convex hull of points."""
        array = rows("xyz", xyz, 3)
        sizes = len(array), scalar("radius", radius), index("tag", tag, 64)
        check(lib.cstk_body_builder_add_rounded_polyhedron(self._pointer, doubles(array), *sizes))
        return self

    def add_points(self, xyz: ArrayLike, radius: float = 0.0) -> "BodyBuilder":
        """Adds a point cloud: balls of one radius, tagged with their numbers. Keep clouds in their own bodies."""
        array = rows("xyz", xyz, 3)
        check(lib.cstk_body_builder_add_points(self._pointer, doubles(array), len(array), scalar("radius", radius)))
        return self

    def add_height_field(
        self, heights: ArrayLike, cell_x: float, cell_y: float, base: Optional[float] = None
    ) -> "BodyBuilder":
        """Adds a height field over the xy-plane: `heights[j, i]` is the z of the node at (i cell_x, j cell_y), at least two each way.
        Without a base it is a surface, otherwise solid ground down to z = base.
        """
        array = rows("heights", heights)
        ny, nx = array.shape
        # NaN asks for a surface.
        bottom = float("nan") if base is None else float(finite("base", np.array(scalar("base", base))))
        check(
            lib.cstk_body_builder_add_height_field(
                self._pointer, nx, ny, doubles(array), scalar("cell_x", cell_x), scalar("cell_y", cell_y), bottom
            )
        )
        return self

    def add_support(self, support: Support, tag: int = 0) -> "BodyBuilder":
        """Adds the bounded convex set that a function describes: from a unit vector to a farthest point along it. It is called by any
        thread that queries the body, must be pure, and must not use the running Query. If it fails later, what it raised is printed
        and the set counts as its bounding box. Such a body cannot be saved.
        """
        if not callable(support):
            raise TypeError(f"support must be a function, not {type(support).__name__}")
        function = _SupportFunction(support)
        with Kept(function) as kept:
            arguments = _support, kept.pointer, kept.destroy, index("tag", tag, 64)
            check(lib.cstk_body_builder_add_support(self._pointer, *arguments))
        function.added = True
        return self

    def build(self, hierarchy: Optional[HierarchyOptions] = None, progress: Optional[Progress] = None) -> Body:
        """Builds a body from what was added; the builder can be used further. See Progress for the second argument."""
        given = hierarchy_options(hierarchy)
        out = ffi.new("cstk_body **")
        builder = self._pointer
        reporting(lambda function, user: lib.cstk_body_build(builder, given, function, user, out), progress)
        return Body._take(out[0])

