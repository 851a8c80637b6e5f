#!/usr/bin/env python3
"""Kinematics of real robots against Pinocchio, through the C API.

    pinocchio_kinematics.py LIBRARY PACKAGES              poses, Jacobians, limits, and the space's steps and distances
    pinocchio_kinematics.py LIBRARY PACKAGES --geometry   loads every robot with its collision shapes

The robots are all of the package example-robot-data. PACKAGES is the folder made by scripts/fetch_pinocchio.sh; exit code
77: skipped, as it is not there.
"""
import ctypes
import math
import os
import sys
import time
import xml.etree.ElementTree as ElementTree
from ctypes import (POINTER, byref, c_bool, c_char_p, c_double, c_int32, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p,
                    sizeof)

TOLERANCE = 1e-12
CONFIGURATIONS = 1000
# Links whose Jacobians are compared at each configuration; drawn anew each time.
JACOBIAN_LINKS = 4
# Differences that turn any joint by more than this are not compared with Pinocchio's: at half a turn the way is not unique,
# and Pinocchio's logarithm of (cos, sin) rests on an arc cosine. As all others, they are followed with
# pinocchio.integrate, and must lead to the second configuration, with no more than half a turn.
HALF_TURN = math.pi - 0.02
# Where pairs are nearer than this on the circle, Pinocchio's logarithm of (cos, sin) is 0: it rests on a cosine. They are
# treated likewise.
LEAST_CIRCLE = 1e-7

# Files that are faulty, and what is said of them.
FAULTY = {
    "alex_description/urdf/alex_psyonic_hands.urdf": 'there is no joint "index_q1" to mimic',
    "ur_description/urdf/ur3.urdf": "the robot has no link",
}

FIXED, REVOLUTE, PRISMATIC, PLANAR, SPHERICAL, FREE = range(6)
# Revolute joints without limits, where the two libraries' kinds differ.
CONTINUOUS = "continuous"
CIRCLE, INTERVAL, _, QUATERNION = range(4)
COLLISION, NO_GEOMETRY = 0, 2


class LinkDef(ctypes.Structure):
    _fields_ = [("size", c_uint32), ("cookie", c_uint32), ("name", c_char_p), ("body", c_void_p), ("parent", c_int32),
                ("joint", c_int32), ("at", c_double * 12), ("axis", c_double * 3), ("coordinate", c_int32),
                ("reserved", c_uint32), ("joint_name", c_char_p), ("multiplier", c_double), ("offset", c_double),
                ("lower", c_double), ("upper", c_double), ("custom", c_void_p)]


class LinkInfo(ctypes.Structure):
    _fields_ = [("parent", c_int32), ("joint", c_int32), ("coordinate", c_uint32), ("nq", c_uint32),
                ("velocity", c_uint32), ("nv", c_uint32), ("has_body", c_bool), ("reserved_bytes", c_uint8 * 7),
                ("multiplier", c_double), ("offset", c_double), ("at", c_double * 12), ("axis", c_double * 3),
                ("reserved", c_uint64 * 8)]


class UrdfOptions(ctypes.Structure):
    _fields_ = [("size", c_uint32), ("cookie", c_uint32), ("geometry", c_int32), ("base", c_int32), ("parent", c_int32),
                ("sides", c_uint32), ("at", c_double * 12), ("prefix", c_char_p), ("package_paths", POINTER(c_char_p)),
                ("package_path_count", c_size_t), ("hierarchy", c_void_p)]


class Range(ctypes.Structure):
    _fields_ = [("kind", c_int32), ("reserved", c_uint32), ("lower", c_double), ("upper", c_double)]


class CstkError(Exception):
    pass


class Library:
    """The calls used, each raising the library's message. Arrays are passed by address."""

    ARGUMENTS = {
        "robot_builder_create": [c_uint32, POINTER(c_void_p)],
        "robot_builder_release": [c_void_p],
        "link_def_default": [POINTER(LinkDef), c_size_t],
        "robot_builder_add_link": [c_void_p, POINTER(LinkDef), POINTER(c_uint32)],
        "urdf_options_default": [POINTER(UrdfOptions), c_size_t],
        "robot_builder_load_urdf": [c_void_p, c_char_p, POINTER(UrdfOptions), c_void_p, c_void_p, POINTER(c_uint32)],
        "robot_build": [c_void_p, POINTER(c_void_p)],
        "robot_release": [c_void_p],
        "robot_get_size": [c_void_p] + [POINTER(c_size_t)] * 3,
        "robot_find_link": [c_void_p, c_char_p, POINTER(c_uint32)],
        "robot_find_joint": [c_void_p, c_char_p, POINTER(c_uint32)],
        "robot_get_link_info": [c_void_p, c_uint32, POINTER(LinkInfo)],
        "space_create": [POINTER(c_void_p), c_size_t, c_void_p, c_size_t, c_void_p, POINTER(c_void_p)],
        "space_release": [c_void_p],
        "space_get_range": [c_void_p, c_size_t, POINTER(Range)],
        "space_link_poses": [c_void_p, c_void_p, c_size_t, c_void_p],
        "space_jacobian": [c_void_p, c_void_p, c_size_t, c_uint32, c_void_p, c_void_p],
        "space_step": [c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p],
        "space_difference": [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p],
        "space_interpolate": [c_void_p, c_void_p, c_void_p, c_size_t, c_double, c_void_p],
        "space_distance": [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p],
    }

    def __init__(self, path):
        dll = ctypes.CDLL(os.path.abspath(path))
        for name in ("version", "last_error_message", "status_name"):
            getattr(dll, "cstk_" + name).restype = c_char_p
        self.version = dll.cstk_version().decode()

        def checked(status, function, _arguments):
            if status != 0:
                name, message = dll.cstk_status_name(status), dll.cstk_last_error_message()
                raise CstkError(f"{function.__name__}: {name.decode()}: {message.decode()}")

        for name, arguments in self.ARGUMENTS.items():
            function = getattr(dll, "cstk_" + name)
            function.argtypes, function.restype, function.errcheck = arguments, c_int32, checked
            setattr(self, name, function)


class Robot:
    """A robot of the library and its space."""

    def __init__(self, library, fill):
        """`fill` adds the links to the builder it is given, and returns the number of the root."""
        self.library = library
        self.handle, self.space = c_void_p(), c_void_p()
        builder = c_void_p()
        library.robot_builder_create(3, byref(builder))
        try:
            self.root = fill(builder)
            library.robot_build(builder, byref(self.handle))
        finally:
            library.robot_builder_release(builder)
        library.space_create(byref(self.handle), 1, None, 0, None, byref(self.space))
        sizes = [c_size_t() for _ in range(3)]
        library.robot_get_size(self.handle, *map(byref, sizes))
        self.nq, self.nv, self.link_count = (size.value for size in sizes)

    @classmethod
    def of_urdf(cls, library, path, geometry, base=FIXED, packages=()):
        options = UrdfOptions()
        library.urdf_options_default(byref(options), sizeof(options))
        options.geometry, options.base = geometry, base
        folders = (c_char_p * len(packages))(*(os.fsencode(folder) for folder in packages))
        options.package_paths, options.package_path_count = folders, len(packages)

        def fill(builder):
            root = c_uint32()
            library.robot_builder_load_urdf(builder, os.fsencode(path), byref(options), None, None, byref(root))
            return root.value

        return cls(library, fill)

    def release(self):
        self.library.space_release(self.space)
        self.library.robot_release(self.handle)

    def find(self, what, name):
        number = c_uint32()
        getattr(self.library, "robot_find_" + what)(self.handle, name.encode(), byref(number))
        return number.value

    def info(self, link):
        info = LinkInfo()
        self.library.robot_get_link_info(self.handle, link, byref(info))
        return info

    def range(self, coordinate):
        found = Range()
        self.library.space_get_range(self.space, coordinate, byref(found))
        return found


def rows(array):
    """The addresses of an array's rows."""
    assert array.flags.c_contiguous and array.dtype == np.float64
    step = array[0].nbytes
    return [array.ctypes.data + i * step for i in range(len(array))]


class Errors:
    """The largest error of each kind: largest difference over max(1, largest number), row by row."""

    KINDS = ("poses", "jacobians", "steps", "differences", "distances", "limits")

    def __init__(self):
        self.worst = dict.fromkeys(self.KINDS, 0.0)

    def add(self, kind, ours, theirs):
        if len(ours) == 0:
            return
        ours, theirs = (array.reshape(len(array), -1) for array in (ours, theirs))
        scale = np.maximum(1.0, np.abs(theirs).max(axis=1, initial=0.0))
        with np.errstate(invalid="ignore"):
            # Infinite limits may be equal.
            difference = np.where(ours == theirs, 0.0, np.abs(ours - theirs))
            error = (difference.max(axis=1, initial=0.0) / scale).max()
        # A NaN is an error too; max() would pass it over.
        self.worst[kind] = max(self.worst[kind], math.inf if math.isnan(error) else float(error))

    def are_small(self):
        return max(self.worst.values()) <= TOLERANCE

    def __str__(self):
        return " ".join(f"{self.worst[kind]:11.1e}" for kind in self.KINDS)


class Joint:
    """A joint as both number it: coordinates from `q`, velocities from `v`."""

    def __init__(self, info, model, index, follows):
        joint = model.joints[index]
        self.follows = follows
        self.kind, self.multiplier, self.offset = info.joint, info.multiplier, info.offset
        self.ours_q = slice(info.coordinate, info.coordinate + info.nq)
        self.ours_v = slice(info.velocity, info.velocity + info.nv)
        self.theirs_q = slice(joint.idx_q, joint.idx_q + joint.nq)
        self.theirs_v = slice(joint.idx_v, joint.idx_v + joint.nv)
        self.is_circle_of_theirs = self.kind == REVOLUTE and joint.nq == 2
        expected = {REVOLUTE: (1, 2), PRISMATIC: (1,), PLANAR: (4,), SPHERICAL: (4,), FREE: (7,)}[self.kind]
        assert joint.nq in expected, f"joint {model.names[index]}: kind {self.kind}, Pinocchio's nq {joint.nq}"


class Comparison:
    """A robot of the library and Pinocchio's model of it."""

    def __init__(self, robot, model, followers):
        """`followers` are the names of the joints that mimic others."""
        self.robot, self.model, self.data = robot, model, model.createData()
        self.joints = []
        for index in range(1, model.njoints):
            name = model.names[index]
            is_base = index == 1 and robot.info(robot.root).joint != FIXED
            link = robot.root if is_base else robot.find("joint", name)
            self.joints.append(Joint(robot.info(link), model, index, name in followers))
        # Links may share their names with joints: only frames of links are looked at.
        frames = [i for i, frame in enumerate(model.frames) if frame.type == pin.FrameType.BODY]
        self.links = np.array([robot.find("link", model.frames[i].name) for i in frames])
        self.frames = np.array(frames)
        assert len(set(self.links)) == robot.link_count, "the links are not the same"
        self.coordinates = [robot.range(i) for i in range(robot.nq)]
        # What their velocities are to ours; constant, but for planar joints.
        self.to_theirs = np.zeros((model.nv, robot.nv))
        for joint in self.joints:
            block = np.eye(joint.ours_v.stop - joint.ours_v.start)
            if joint.kind in (REVOLUTE, PRISMATIC):
                block *= joint.multiplier
            self.to_theirs[joint.theirs_v, joint.ours_v] = block
        self.has_planar = any(joint.kind == PLANAR for joint in self.joints)

    def draw(self, generator, count):
        """Configurations in our coordinates: angles within three half turns, whatever the limits."""
        spread = np.ones(self.robot.nq)
        for joint in self.joints:
            # Prismatic joints of robots are short.
            spread[joint.ours_q] = {PRISMATIC: 1, PLANAR: 3, FREE: 5}.get(joint.kind, 3 * math.pi)
        q = generator.uniform(-spread, spread, (count, self.robot.nq))
        for joint in self.joints:
            if joint.kind in (SPHERICAL, FREE):
                turns = generator.normal(size=(count, 4))
                q[:, joint.ours_q.stop - 4:joint.ours_q.stop] = turns / np.linalg.norm(turns, axis=1, keepdims=True)
        return q

    def theirs(self, q):
        """Our configurations in their coordinates."""
        result = np.zeros((len(q), self.model.nq))
        for joint in self.joints:
            own = q[:, joint.ours_q]
            if joint.kind in (REVOLUTE, PRISMATIC):
                own = joint.multiplier * own + joint.offset
            if joint.is_circle_of_theirs:
                own = np.hstack([np.cos(own), np.sin(own)])
            elif joint.kind == PLANAR:
                own = np.hstack([own[:, :2], np.cos(own[:, 2:]), np.sin(own[:, 2:])])
            result[:, joint.theirs_q] = own
        return result

    def same_signs(self, q, reference):
        """Their coordinates q, with the quaternions' signs as those of the reference: both signs are the same turn."""
        q = q.copy()
        for joint in self.joints:
            if joint.kind in (SPHERICAL, FREE):
                at = slice(joint.theirs_q.stop - 4, joint.theirs_q.stop)
                signs = np.sign((q[:, at] * reference[:, at]).sum(axis=1, keepdims=True))
                q[:, at] *= signs
        return q

    def kinematics(self, generator, errors, count):
        robot, model, data, library = self.robot, self.model, self.data, self.robot.library
        ours_q = self.draw(generator, count)
        theirs_q = self.theirs(ours_q)
        chosen = generator.integers(len(self.links), size=(count, JACOBIAN_LINKS))
        points = generator.uniform(-1, 1, (count, JACOBIAN_LINKS, 3))
        # Of each link, the origin and a point.
        points = np.stack([np.zeros_like(points), points], axis=2)

        ours_poses = np.full((count, robot.link_count, 12), math.nan)
        ours_jacobians = np.full((count, JACOBIAN_LINKS, 2, 6, robot.nv), math.nan)
        for q, poses, links, where, jacobians in zip(
                rows(ours_q), rows(ours_poses), self.links[chosen].tolist(), rows(points), rows(ours_jacobians)):
            library.space_link_poses(robot.space, q, robot.nq, poses)
            for i, link in enumerate(links):
                for j in (2 * i, 2 * i + 1):
                    library.space_jacobian(robot.space, q, robot.nq, link, where + 24 * j,
                                           jacobians + 48 * robot.nv * j)

        theirs_poses = np.empty((count, len(self.frames), 4, 4))
        theirs_jacobians = np.empty((count, JACOBIAN_LINKS, 6, model.nv))
        frames, placements = self.frames.tolist(), data.oMf
        for k, links in enumerate(self.frames[chosen].tolist()):
            pin.framesForwardKinematics(model, data, theirs_q[k])
            pin.computeJointJacobians(model, data)
            theirs_poses[k] = [placements[i].homogeneous for i in frames]
            theirs_jacobians[k] = [pin.getFrameJacobian(model, data, i, pin.LOCAL_WORLD_ALIGNED) for i in links]

        ours = ours_poses[:, self.links].reshape(-1, 12)
        errors.add("poses", ours, np.ascontiguousarray(theirs_poses[:, :, :3]).reshape(-1, 12))
        to_theirs = self.to_theirs
        if self.has_planar:
            to_theirs = self.planar_rates(ours_q)[:, None]
        theirs_jacobians = theirs_jacobians @ to_theirs
        # Theirs are at the origins: the velocity of another point differs by the angular velocity times the arm.
        turns = np.take_along_axis(theirs_poses, chosen[:, :, None, None], axis=1)[:, :, None, :3, :3]
        arms = (turns @ points[..., None])[..., None, :, 0]
        theirs_jacobians = np.repeat(theirs_jacobians[:, :, None], 2, axis=2)
        angular = theirs_jacobians[..., 3:, :].swapaxes(-1, -2)
        theirs_jacobians[..., :3, :] += np.cross(angular, arms).swapaxes(-1, -2)
        shape = (-1, 6 * robot.nv)
        errors.add("jacobians", ours_jacobians.reshape(shape), theirs_jacobians.reshape(shape))

    def planar_rates(self, q):
        """`to_theirs` at each configuration: their planar velocities are in the link's frame, ours in the joint's."""
        matrices = np.repeat(self.to_theirs[None], len(q), axis=0)
        for joint in self.joints:
            if joint.kind == PLANAR:
                angles, (v, w) = q[:, joint.ours_q.start + 2], (joint.theirs_v.start, joint.ours_v.start)
                matrices[:, v, w] = matrices[:, v + 1, w + 1] = np.cos(angles)
                matrices[:, v, w + 1], matrices[:, v + 1, w] = np.sin(angles), -np.sin(angles)
        return matrices

    def motions(self, generator, errors, count):
        """Steps, differences, interpolation, distances; returns how many pairs Pinocchio's differences are no measure of."""
        robot, model, library = self.robot, self.model, self.robot.library
        first, second = self.draw(generator, count), self.draw(generator, count)
        velocities = generator.normal(size=(count, robot.nv)) * 2
        # A quarter of the pairs are near each other, by all orders of magnitude.
        near = slice(0, count // 4)
        velocities[near] *= 10.0 ** generator.uniform(-9, 0, (count // 4, 1))
        parameters = generator.choice([0.0, 1.0, 0.5], count)
        parameters = np.where(generator.uniform(size=count) < 0.9, generator.uniform(size=count), parameters)
        # Theirs counts followers too.
        weights = np.sqrt((self.to_theirs ** 2).sum(axis=0))
        weights_at = None if np.all(weights == 1) else weights.ctypes.data

        stepped, between = np.full_like(first, math.nan), np.full_like(first, math.nan)
        ways, lengths = np.full((count, robot.nv), math.nan), np.full((count, 1), math.nan)
        space, nq, nv = robot.space, robot.nq, robot.nv
        for q, v, out in zip(rows(first), rows(velocities), rows(stepped)):
            library.space_step(space, q, nq, v, nv, out)
        second[near] = stepped[near]
        for q0, q1, way, t, q, length in zip(
                rows(first), rows(second), rows(ways), parameters.tolist(), rows(between), rows(lengths)):
            library.space_difference(space, q0, q1, nq, way)
            library.space_interpolate(space, q0, q1, nq, t, q)
            library.space_distance(space, q0, q1, nq, weights_at, length)

        p0, p1 = self.theirs(first), self.theirs(second)
        theirs_v, theirs_way = velocities @ self.to_theirs.T, ways @ self.to_theirs.T
        integrate = np.array([pin.integrate(model, p, v) for p, v in zip(p0, theirs_v)])
        errors.add("steps", self.same_signs(self.theirs(stepped), integrate), integrate)
        arrived = np.array([pin.integrate(model, p, v) for p, v in zip(p0, theirs_way)])
        errors.add("differences", self.same_signs(arrived, p1), p1)

        # The largest turn of any joint that has no limits: at most half of one, as the difference is the shortest.
        turns, is_clear = np.zeros(count), np.full(count, True)
        for joint in self.joints:
            own = ways[:, joint.ours_v]
            if joint.kind in (SPHERICAL, FREE):
                turns = np.maximum(turns, np.linalg.norm(own[:, -3:], axis=1))
            elif joint.is_circle_of_theirs:
                turns = np.maximum(turns, np.abs(own[:, 0] * joint.multiplier))
                is_clear &= np.abs(own[:, 0] * joint.multiplier) > LEAST_CIRCLE
        errors.add("differences", np.maximum(turns, math.pi)[:, None], np.full((count, 1), math.pi))

        clear = np.flatnonzero(is_clear & (turns < HALF_TURN))
        difference = np.array([pin.difference(model, p0[i], p1[i]) for i in clear]).reshape(len(clear), model.nv)
        errors.add("differences", theirs_way[clear], difference)
        mixed = np.array([pin.interpolate(model, p0[i], p1[i], parameters[i]) for i in clear])
        mixed = mixed.reshape(len(clear), model.nq)
        errors.add("steps", self.same_signs(self.theirs(between)[clear], mixed), mixed)
        distance = np.array([[pin.distance(model, p0[i], p1[i])] for i in clear]).reshape(-1, 1)
        errors.add("distances", lengths[clear], distance)
        return count - len(clear)

    def limits(self, errors):
        for joint in self.joints:
            ours = self.coordinates[joint.ours_q]
            kinds = [coordinate.kind for coordinate in ours]
            if joint.kind in (SPHERICAL, FREE):
                expected = [INTERVAL] * (len(kinds) - 4) + [QUATERNION] * 4
                assert kinds == expected, f"ranges of a quaternion: {kinds}"
            elif joint.is_circle_of_theirs:
                assert kinds == [CIRCLE], f"range of a continuous joint: {kinds}"
            elif joint.kind != PLANAR and not joint.follows:
                limits = np.array([[ours[0].lower, ours[0].upper]])
                theirs = [self.model.lowerPositionLimit, self.model.upperPositionLimit]
                assert kinds == [INTERVAL], f"range of a joint with limits: {kinds}"
                errors.add("limits", limits, np.array([[limit[joint.theirs_q.start] for limit in theirs]]))


def compare(name, robot, model, followers, generator):
    """Prints a line about a robot; whether all errors are small."""
    started = time.monotonic()
    errors, left_out = Errors(), 0
    both = Comparison(robot, model, followers)
    both.kinematics(generator, errors, CONFIGURATIONS)
    both.limits(errors)
    if not both.has_planar:
        left_out = both.motions(generator, errors, CONFIGURATIONS)
    print(f"{name:48} {robot.link_count:5} {robot.nq:4} {robot.nv:4} {errors} {left_out:8} "
          f"{time.monotonic() - started:8.1f}{'' if errors.are_small() else '  FAILED'}", flush=True)
    return errors.are_small()


def chain(library, kinds, generator):
    """A chain of joints of these kinds at random places, for the library and for Pinocchio."""
    places = [pin.SE3.Random() for _ in kinds]
    axes = [axis / np.linalg.norm(axis) for axis in generator.normal(size=(len(kinds), 3))]
    # From Python, Pinocchio's joints without limits turn about the frame's own axes only.
    axes = [np.array([1.0, 0.0, 0.0]) if kind == CONTINUOUS else axis for kind, axis in zip(kinds, axes)]
    limits = {REVOLUTE: (-1.0, 2.0)}
    no_limits = (-math.inf, math.inf)

    def fill(builder):
        for i, (kind, place, axis) in enumerate(zip(kinds, places, axes)):
            link = LinkDef()
            library.link_def_default(byref(link), sizeof(link))
            link.name, link.joint_name = f"link {i}".encode(), f"joint {i}".encode()
            link.parent, link.joint = i - 1, REVOLUTE if kind == CONTINUOUS else kind
            link.at[:] = place.homogeneous[:3].ravel()
            # Ours may be of any length; theirs must be unit.
            link.axis[:] = 3 * axis
            link.lower, link.upper = limits.get(kind, no_limits)
            library.robot_builder_add_link(builder, byref(link), None)
        return 0

    model = pin.Model()
    makers = {FREE: lambda _: pin.JointModelFreeFlyer(), SPHERICAL: lambda _: pin.JointModelSpherical(),
              PLANAR: lambda _: pin.JointModelPlanar(), CONTINUOUS: lambda _: pin.JointModelRUBX(),
              REVOLUTE: pin.JointModelRevoluteUnaligned, PRISMATIC: pin.JointModelPrismaticUnaligned}
    for i, (kind, place, axis) in enumerate(zip(kinds, places, axes)):
        joint = makers[kind](axis)
        lower, upper = (np.full(joint.nq, limit) for limit in limits.get(kind, no_limits))
        effort = speed = np.ones(joint.nv)
        index = model.addJoint(i, joint, place, f"joint {i}", effort, speed, lower, upper)
        model.addJointFrame(index)
        model.addBodyFrame(f"link {i}", index, pin.SE3.Identity(), -1)
    return Robot(library, fill), model


def compare_all(library, robots, files):
    import pinocchio

    global pin
    pin = pinocchio
    started = time.monotonic()
    # Pinocchio draws from a generator of its own.
    pin.seed(1)
    generator = np.random.default_rng(1)
    titles = " ".join(f"{kind:>11}" for kind in Errors.KINDS)
    print(f"{'robot':48} {'links':>5} {'nq':>4} {'nv':>4} {titles} {'left out':>8} {'seconds':>8}")
    results = []
    chains = {"chain of all joints": [FREE, CONTINUOUS, REVOLUTE, SPHERICAL, PRISMATIC, FREE, SPHERICAL],
              "chain with planar joints": [REVOLUTE, PLANAR, PRISMATIC, PLANAR, CONTINUOUS]}
    for name, kinds in chains.items():
        robot, model = chain(library, kinds, generator)
        results.append(compare(name, robot, model, set(), generator))
        robot.release()
    for file in sorted(files - FAULTY.keys()):
        path = os.path.join(robots, file)
        followers = {joint.get("name") for joint in ElementTree.parse(path).getroot().findall("joint[mimic]")}
        for base, suffix, root in ((FIXED, "", []), (FREE, ", free", [pin.JointModelFreeFlyer()])):
            name = f"{file.split('_description')[0].split('/')[0]}/{os.path.basename(file)[:-5]}{suffix}"
            model = pin.buildModelFromUrdf(path, *root)
            if model.nv == 0:
                # Jacobians without columns crash Pinocchio.
                continue
            try:
                robot = Robot.of_urdf(library, path, NO_GEOMETRY, base)
                results.append(compare(name, robot, model, followers, generator))
                robot.release()
            except (CstkError, AssertionError) as error:
                print(f"{name}: {error}  FAILED")
                results.append(False)
    failed = results.count(False)
    summary = f"{failed} of {len(results)} FAILED" if failed else f"all {len(results)} agree to {TOLERANCE:g}"
    print(f"pinocchio_kinematics: libcstk {library.version} and Pinocchio {pin.__version__}: {summary}; "
          f"{CONFIGURATIONS} configurations each, {time.monotonic() - started:.0f} s")
    return failed == 0


def load_all(library, robots, files, share):
    """Loads the files with their collision shapes, and prints a line about each; whether all went as it should."""
    started, failed = time.monotonic(), 0
    for file in sorted(files):
        before, expected = time.monotonic(), FAULTY.get(file)
        path = os.path.join(robots, file)
        try:
            robot = Robot.of_urdf(library, path, COLLISION, packages=[share])
            bodies = sum(robot.info(link).has_body for link in range(robot.link_count))
            result = f"ok, {bodies} of {robot.link_count} links have bodies, {time.monotonic() - before:.2f} s"
            is_right = expected is None and bodies == len(ElementTree.parse(path).getroot().findall("link[collision]"))
            robot.release()
        except CstkError as error:
            result = str(error).replace(robots + os.sep, "")
            is_right = expected is not None and expected in result
        failed += not is_right
        print(f"{file}: {result}{'' if is_right else '  FAILED'}", flush=True)
    print(f"pinocchio_kinematics: {len(files)} files, {len(FAULTY)} of them faulty; {failed} FAILED, "
          f"{time.monotonic() - started:.0f} s")
    return failed == 0


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    options = set(sys.argv[1:]) - set(arguments)
    if len(arguments) != 2 or not options <= {"--geometry"}:
        print(__doc__, file=sys.stderr)
        return 1
    library_path, packages = arguments[0], os.path.abspath(arguments[1])
    share = os.path.join(packages, "cmeel.prefix", "share")
    robots = os.path.join(share, "example-robot-data", "robots")
    modules = os.path.join(packages, "cmeel.prefix", "lib", f"python3.{sys.version_info.minor}", "site-packages")
    for folder in (robots, modules):
        if not os.path.isdir(folder):
            print(f"SKIPPED: no {folder}; see scripts/fetch_pinocchio.sh. Nothing was compared with Pinocchio.")
            return 77
    sys.path[:0] = [packages, modules]
    global np
    import numpy as np

    library = Library(library_path)
    files = {os.path.relpath(os.path.join(folder, name), robots)
             for folder, _, names in os.walk(robots) for name in names if name.endswith(".urdf")}
    if options:
        return 0 if load_all(library, robots, files, share) else 1
    return 0 if compare_all(library, robots, files) else 1


if __name__ == "__main__":
    sys.exit(main())
