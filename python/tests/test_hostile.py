"""Bad arguments: exceptions that name the argument, before or instead of anything happening."""

import numpy as np
import pytest

import cstk

NAN = float("nan")


@pytest.fixture
def world(arm, query):
    body = cstk.Body.sphere(1)
    return {"arm": arm, "query": query, "space": arm.space, "cobject": arm.cobject, "body": body, "I": cstk.identity(), "cstk": cstk,
            "np": np, "NAN": NAN, "environment": arm.environment, "builder": cstk.BodyBuilder()}


# What is called, the exception, and what its message must hold.
CASES = [
    # Shapes.
    ("query.classify(cobject, [1, 2, 3])", cstk.WrongSizeError, "the configuration has 3 entries"),
    ("query.classify(cobject, [[1, 2]])", cstk.WrongSizeError, r"q has shape \(1, 2\)"),
    ("query.classify(cobject, 1.0)", cstk.WrongSizeError, "q has shape"),
    ("query.distance(cobject, [[1], [2, 3]])", cstk.WrongSizeError, "q is no array"),
    ("query.pair_distance(body, np.eye(3), body, I)", cstk.WrongSizeError, r"pose_a has shape \(3, 3\)"),
    ("query.pair_distance(body, I, body, [0] * 7)", cstk.WrongSizeError, "pose_b"),
    ("query.classify_at_link_poses(cobject, I)", cstk.WrongSizeError, "link_poses"),
    ("query.classify_at_link_poses(cobject, [I])", cstk.WrongSizeError, "link"),
    ("query.motion(cobject, [0, 0], [1])", cstk.WrongSizeError, "q0.*q1"),
    ("query.motion_path(cobject, [0, 0])", cstk.WrongSizeError, "points"),
    ("query.motion_path(cobject, np.zeros((0, 2)))", cstk.WrongSizeError, "point"),
    ("query.motion_spline(cobject, 1, [[0, 1]], [[0, 0]])", cstk.WrongSizeError, "knots"),
    ("query.motion_spline(cobject, 1, [0, 1], [[0, 0], [1, 1]])", cstk.WrongSizeError, "knot"),
    ("query.slide(cobject, [0, 0], [1], 0.1)", cstk.WrongSizeError, "step"),
    ("query.region_classify(cobject, [0, 0], [1])", cstk.WrongSizeError, "low.*high"),
    ("query.region_grow(cobject, space, [0, 0], weights=[1])", cstk.WrongSizeError, "weights"),
    ("space.distance([0, 0], [1, 1], [1])", cstk.WrongSizeError, "weights"),
    ("space.distances([0, 0], [[1, 1, 1]])", cstk.WrongSizeError, "others"),
    ("space.step([0, 0], [1])", cstk.WrongSizeError, "v"),
    ("cstk.Space(arm.robot, None, [0, 1])", cstk.WrongSizeError, "world_box"),
    ("cstk.Body.polyhedron([1, 2, 3])", cstk.WrongSizeError, "xyz"),
    ("cstk.Body.polyhedron([[1, 2]])", cstk.WrongSizeError, "xyz"),
    ("cstk.Body.box([1, 1])", cstk.WrongSizeError, "half_extents"),
    ("cstk.Body.mesh(np.zeros((3, 3)), [0, 1, 2])", cstk.WrongSizeError, "faces"),
    ("builder.add_mesh(np.eye(3), [0, 1, 2], [3], scale=[1, 2])", cstk.WrongSizeError, "scale"),
    ("builder.add_mesh(np.eye(3), [0, 1, 2], [4])", cstk.WrongSizeError, "indices|face"),
    ("cstk.CObject.induced_links(space, [0, 1])", cstk.WrongSizeError, "pairs"),
    ("cstk.CObject.induced(space, environment, allowed=[(1,)])", cstk.WrongSizeError, r"allowed\[0\]"),
    ("cstk.pose_from_quaternion([0, 0, 0, 1])", cstk.WrongSizeError, "xyz_quaternion"),
    ("cstk.euler_from_rotation(np.eye(4))", cstk.WrongSizeError, "rotation"),
    ("cstk.jacobian_to_euler([0, 0, 0], np.eye(3))", cstk.WrongSizeError, "jacobian"),
    # Types.
    ("query.classify(cobject, ['a', 'b'])", TypeError, "q holds"),
    ("query.classify(cobject, np.array([1j, 0]))", TypeError, "q holds complex128"),
    ("query.classify(cobject, np.array([True, False]))", TypeError, "q holds bool"),
    ("query.classify(cobject, [None, 1])", TypeError, "q holds object"),
    ("query.classify(body, [0, 0])", TypeError, "cobject must be a cstk.CObject, not Body"),
    ("query.pair_distance(body, I, None, I)", TypeError, "body_b must be a cstk.Body"),
    ("query.within(cobject, [0, 0], 'near')", TypeError, "threshold"),
    ("query.within(cobject, [0, 0], None)", TypeError, "threshold"),
    ("cstk.Body.sphere('big')", TypeError, "radius"),
    ("cstk.Body.sphere(1, tag=1.5)", TypeError, "tag"),
    ("cstk.Body.load(3)", TypeError, "file"),
    ("arm.robot.find_link(3)", TypeError, "name"),
    ("arm.robot.link_pose([0, 0], 1.0)", TypeError, "link"),
    ("cstk.Space([body])", TypeError, r"robots\[0\]"),
    ("cstk.Space(arm.robot, [(0, 1), (0, 1)])", TypeError, r"ranges\[0\]"),
    ("environment.apply([3])", TypeError, r"changes\[0\]"),
    ("environment.add(arm.robot)", TypeError, "body"),
    ("cstk.CObject.union([cobject, body])", TypeError, r"parts\[1\]"),
    ("cstk.CObject.predicate(space, None)", TypeError, "classify"),
    ("cstk.BodyBuilder().add_support(3)", TypeError, "support"),
    ("cstk.BodyBuilder().build({})", TypeError, "hierarchy"),
    ("cstk.Body.mesh(np.eye(3), [[0.5, 1, 2]])", TypeError, "faces"),
    ("space.sample(1)", TypeError, "random"),
    ("cstk.slide_step(None, [0], 1)", TypeError, "witnesses"),
    ("cobject | 3", TypeError, "CObject"),
    ("cstk.Body()", TypeError, "Body.box"),
    ("arm.robot.frozen([0.5], [0, 0])", TypeError, "joints"),
    ("arm.robot.to_whole([0, 0], space)", TypeError, "whole"),
    ("query.classify(arm.cobject, np.ma.masked_invalid([0, np.nan]))", TypeError, "q is a masked array"),
    ("query.motion_path(cobject, [np.ma.array([0, 1], mask=[0, 1]), [2, 3]])", TypeError, "points is a masked array"),
    ("query.motion_path(cobject, [[2, 3], np.ma.zeros(2)])", TypeError, "points is a masked array"),
    ("query.within(cobject, [0, 0], 10**400)", cstk.InvalidArgumentError, "threshold is too large"),
    ("cstk.RobotBuilder().add_link(cstk.JointKind.CUSTOM, custom=3)", TypeError, "custom must be a CustomJoint, not int"),
    ("cstk.Batch().classify(arm.cobject, np.ma.zeros((3, 2)))", TypeError, "q is a masked array"),
    ("cstk.Body.points(np.ma.zeros((3, 3)))", TypeError, "xyz is a masked array"),
    ("query.pair_within(body, np.ma.zeros((4, 4)), body, I)", TypeError, "pose_a is a masked array"),
    ("arm.robot.frozen(np.ma.array([0], mask=[True]), [0, 0])", TypeError, "joints is a masked array"),
    ("arm.robot.to_whole([0, 0])", cstk.EmptyError, "whole"),
    ("arm.robot.to_whole(arm.robot, [0, 0])", TypeError, "q holds object"),
    ("arm.robot.frozen([0], [0, 0]).to_whole([0, 0])", cstk.WrongSizeError, "2 entries"),
    ("arm.robot.frozen([0], [0, 0]).to_whole([0], arm.robot.frozen([0], [0, 0]))", cstk.WrongSizeError, "whole has 1 entries"),
    ("cstk.RobotBuilder().load_urdf_text('<robot/>', link_forms={3: 0})", TypeError, "link_forms"),
    # Numbers that are not finite.
    ("query.classify(cobject, [0, NAN])", cstk.NotFiniteError, "configuration entry"),
    ("query.classify(cobject, [np.inf, 0])", cstk.NotFiniteError, "configuration entry"),
    ("query.within(cobject, [0, 0], NAN)", cstk.NotFiniteError, "threshold"),
    ("query.pair_distance(body, np.full((4, 4), NAN), body, I)", cstk.NotFiniteError, "pose_a"),
    ("query.pair_distance(body, I, body, np.full((3, 4), NAN))", cstk.NotFiniteError, "pose_b"),
    ("query.motion(cobject, [0, 0], [0, NAN])", cstk.NotFiniteError, "q1"),
    ("query.motion_path(cobject, [[0, 0], [0, NAN]])", cstk.NotFiniteError, "point"),
    ("query.slide(cobject, [0, 0], [NAN, 0], 0.1)", cstk.NotFiniteError, "step"),
    ("query.region_grow(cobject, space, [NAN, 0])", cstk.NotFiniteError, "configuration entry"),
    ("cstk.Body.box([1, NAN, 1])", cstk.NotFiniteError, "half extent"),
    ("cstk.Body.sphere(NAN)", cstk.NotFiniteError, "radius"),
    ("cstk.Body.height_field(np.ones((2, 2)), 1, 1, NAN)", cstk.NotFiniteError, "base"),
    ("cstk.Body.points([[0, 0, NAN]])", cstk.NotFiniteError, "point"),
    ("arm.robot.frozen([0], [0, NAN])", cstk.NotFiniteError, "configuration entry"),
    ("cstk.translation(0, NAN, 0)", cstk.NotFiniteError, "translation"),
    ("space.interpolate([0, 0], [1, 1], NAN)", cstk.NotFiniteError, "t"),
    ("cstk.CObject.ball(space, [0, 0], NAN)", cstk.NotFiniteError, "radius"),
    # Values.
    ("cstk.Body.sphere(-1)", cstk.InvalidArgumentError, "radius"),
    ("cstk.Body.sphere(1, tag=-1)", cstk.InvalidArgumentError, "tag"),
    ("cstk.Body.sphere(1, tag=2**64)", cstk.InvalidArgumentError, "tag"),
    ("cstk.BodyBuilder(4)", cstk.InvalidArgumentError, "dimension"),
    ("cstk.Body.mesh(np.eye(3), [[0, 1, -1]])", cstk.InvalidArgumentError, "faces"),
    ("cstk.Body.mesh(np.eye(3), [[0, 1, 3]])", cstk.NotFoundError, "face"),
    ("cstk.Body.load('a\\0b')", cstk.InvalidArgumentError, "file"),
    ("arm.robot.find_link('a\\0b')", cstk.InvalidArgumentError, "name"),
    ("query.within(cobject, [0, 0], -1)", cstk.InvalidArgumentError, "threshold"),
    ("query.motion(cobject, [0, 0], [1, 1], tolerance=0)", cstk.InvalidArgumentError, "tolerance"),
    ("query.set_contacts(9)", ValueError, "9"),
    ("cstk.RobotBuilder().load_urdf_text('<robot/>', mesh_form=9)", ValueError, "9"),
    ("environment.load_scene_text('s', at=2 * I)", cstk.InvalidArgumentError, "at"),
    ("query.pair_distance(body, 2 * I, body, I)", cstk.InvalidArgumentError, "pose_a"),
    ("query.pair_distance(body, np.diag([2, 1, 1, 1]), body, I)", cstk.NotARotationError, "pose_a"),
    ("arm.robot.link_pose([0, 0], 9)", cstk.NotFoundError, "link"),
    ("environment.move(10**12, I)", cstk.NotFoundError, "1000000000000"),
    ("cstk.BodyBuilder().build()", cstk.EmptyError, "primitive"),
    ("cstk.Body.load('/no/such/file')", cstk.IoError, "/no/such/file"),
    ("cstk.Body.mesh_file('a.xyz')", cstk.UnsupportedError, "a.xyz"),
    ("cstk.Body.polygon([[0, 0, 0], [1, 0, 0], [2, 0, 0]])", cstk.DegenerateError, "polygon"),
    ("cstk.Body.polygon([[0, 0, 0], [2, 0, 0], [1, 0.1, 0], [1, 2, 0]])", cstk.NotConvexError, "vertex"),
    ("cstk.BodyBuilder().build(cstk.HierarchyOptions(hull_vertex_limit=-1))", OverflowError, "hull_vertex_limit"),
]


@pytest.mark.parametrize("call, kind, says", CASES, ids=[case[0] for case in CASES])
def test_the_culprit_is_named(world, call, kind, says):
    with pytest.raises(kind, match=says):
        eval(call, world)


def beside_words(array):
    """The same numbers a byte off the addresses of doubles."""
    off = np.frombuffer(b"-" + array.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(array.shape)
    assert not off.flags.aligned
    return off


def test_arrays_of_all_kinds_are_taken(arm, query):
    q = np.array([0.5, 0.25])
    expected = query.distance(arm.cobject, q).distance
    spread = np.zeros((2, 3))
    spread[:, 1] = q
    fixed = q.copy()
    fixed.flags.writeable = False
    for same in [0.5, 0.25], (0.5, 0.25), q.astype(np.float32), spread[:, 1], fixed, q[::-1][::-1], q.astype(">f8"), beside_words(q):
        assert query.distance(arm.cobject, same).distance == expected
    whole = query.distance(arm.cobject, [1, 0]).distance
    assert query.distance(arm.cobject, np.array([1, 0], np.int8)).distance == whole
    pose, body = cstk.translation(3, 1, 0), cstk.Body.sphere(1)
    expected = query.pair_distance(body, pose, body, cstk.identity()).distance
    for same in pose[:3], pose[:3].ravel(), pose.tolist(), np.asfortranarray(pose), pose[:3].astype(np.float32), beside_words(pose):
        assert query.pair_distance(body, same, body, cstk.identity()).distance == expected


def test_arguments_are_not_changed(arm, query):
    q0, q1 = np.array([0.1, 0.2]), np.array([0.3, 0.4])
    query.motion(arm.cobject, q0, q1)
    query.slide(arm.cobject, q0, q1, 0.1)
    arm.space.step(q0, q1)
    jacobian = np.ones((6, 2))
    cstk.jacobian_to_euler(q0.tolist() + [0.1], jacobian)
    assert (q0 == [0.1, 0.2]).all() and (q1 == [0.3, 0.4]).all() and (jacobian == 1).all()
