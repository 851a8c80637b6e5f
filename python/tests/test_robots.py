"""Robots, URDF, spaces and environments, against closed forms and central differences."""

import math

import numpy as np
import pytest

import cstk

URDF = """<robot name="arm">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 1"/><geometry><capsule radius="0.1" length="1.5"/></geometry></collision>
    <inertial/></link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="tool"/><origin xyz="0 0 2"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="0.5" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def urdf(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    return file


def test_poses_go_round(rng):
    for _ in range(50):
        q = rng.normal(size=4)
        q *= math.copysign(1, q[3]) / np.linalg.norm(q)
        pose = cstk.pose_from_quaternion([*rng.normal(size=3), *q])
        np.testing.assert_allclose(cstk.pose_to_quaternion(pose)[3:], q, atol=1e-14)
        np.testing.assert_allclose(cstk.pose_from_euler(cstk.pose_to_euler(pose)), pose, atol=1e-13)
        np.testing.assert_allclose(cstk.pose_compose(pose, cstk.pose_inverse(pose)), np.eye(4), atol=1e-14)
        point = rng.normal(size=3)
        np.testing.assert_allclose(cstk.pose_transform_point(pose, point), (pose @ [*point, 1])[:3], atol=1e-14)
        np.testing.assert_allclose(cstk.pose_compose(pose[:3], pose), pose @ pose, atol=1e-14)
        angles = cstk.euler_from_rotation(pose[:3, :3])
        np.testing.assert_allclose(cstk.euler_to_rotation(angles), pose[:3, :3], atol=1e-13)


def test_euler_rates_are_the_derivative_of_the_rotation(rng):
    for frame in cstk.AngularFrame:
        angles, h = rng.uniform(-1, 1, 3), 1e-6
        rates = cstk.euler_rates(angles, frame)
        for i in range(3):
            step = np.eye(3)[i] * h
            slope = (cstk.euler_to_rotation(angles + step) - cstk.euler_to_rotation(angles - step)) / (2 * h)
            rotation = cstk.euler_to_rotation(angles)
            skew = slope @ rotation.T if frame == cstk.AngularFrame.WORLD else rotation.T @ slope
            np.testing.assert_allclose([skew[2, 1], skew[0, 2], skew[1, 0]], rates[:, i], atol=1e-9)
        np.testing.assert_allclose(cstk.euler_rates_inverse(angles, frame) @ rates, np.eye(3), atol=1e-13)
    jacobian = rng.normal(size=(6, 4))
    back = cstk.jacobian_from_euler(angles, cstk.jacobian_to_euler(angles, jacobian))
    np.testing.assert_allclose(back, jacobian, atol=1e-12)


def test_forward_kinematics_of_a_planar_arm(arm, rng):
    assert (arm.robot.nq, arm.robot.nv, arm.robot.link_count) == (2, 2, 2)
    for q in rng.uniform(-3, 3, (20, 2)):
        elbow, tip = arm.points(q)
        pose = arm.robot.link_pose(q, 1)
        np.testing.assert_allclose(pose[:2, 3], elbow, atol=1e-14)
        np.testing.assert_allclose((pose @ [1, 0, 0, 1])[:2], tip, atol=1e-14)
        np.testing.assert_array_equal(arm.space.link_poses(q)[1], pose[:3])
        expected = np.zeros((6, 2))
        expected[:2] = np.array([[-tip[1], -(tip - elbow)[1]], [tip[0], (tip - elbow)[0]]])
        expected[5] = 1
        np.testing.assert_allclose(arm.robot.jacobian(q, 1, [1, 0, 0]), expected, atol=1e-13)
        np.testing.assert_array_equal(arm.space.jacobian(q, 1, [1, 0, 0]), arm.robot.jacobian(q, 1, [1, 0, 0]))


def test_names_and_links(arm):
    assert arm.robot.find_link("fore") == arm.robot.find_joint("elbow") == 1
    assert arm.robot.link_name(0) == arm.space.link_name(0) == "upper" and arm.robot.joint_name(1) == "elbow"
    info = arm.robot.link_info(1)
    assert (info.parent, info.joint, info.coordinate, info.has_body) == (0, cstk.JointKind.REVOLUTE, 1, True)
    np.testing.assert_array_equal(info.at, cstk.translation(1, 0, 0))
    with pytest.raises(cstk.NotFoundError, match="wrist"):
        arm.robot.find_link("wrist")
    assert arm.robot.body(0).statistics().primitive_count == 1


def test_a_robot_from_urdf(urdf, tmp_path):
    builder = cstk.RobotBuilder()
    heard = []
    root = builder.load_urdf(urdf, prefix="left_", cache_folder=tmp_path / "cache", progress=heard.append)
    assert builder.urdf_report().links_with_body == 2 and builder.urdf_report().link_count == 3 and heard
    robot = builder.build()
    assert robot.link_name(root) == "left_base" and robot.nq == 2
    tool = robot.link_pose([math.pi / 2, 0.25], robot.find_link("left_tool"))
    np.testing.assert_allclose(tool[:3, 3], [2.25, 0, 0.5], atol=1e-15)
    space = cstk.Space(robot)
    assert space.range(0) == cstk.interval(-1, 2) and space.range(1) == cstk.interval(0, 0.5)
    moving = cstk.Robot.load_urdf(urdf, base=cstk.JointKind.FREE, at=cstk.translation(0, 0, 1))
    assert (moving.nq, moving.nv) == (9, 8)
    cached = cstk.RobotBuilder()
    cached.load_urdf(urdf, cache_folder=tmp_path / "cache")
    assert cached.urdf_report().bodies_from_cache == 2
    bare = cstk.Robot.load_urdf(urdf, geometry=cstk.UrdfGeometry.NO_GEOMETRY)
    assert not bare.link_info(0).has_body
    urdf.write_text(URDF.replace("revolute", "twisting"))
    with pytest.raises(cstk.Error, match="twisting"):
        cstk.Robot.load_urdf(urdf)


def test_spaces_know_their_topology(arm):
    space = arm.space
    assert space.range(0).kind == cstk.RangeKind.CIRCLE
    np.testing.assert_allclose(space.difference([3, 0], [-3, 0]), [2 * math.pi - 6, 0])
    assert space.distance([3, 0], [-3, 0]) == pytest.approx(2 * math.pi - 6)
    assert space.distance([0, 0], [3, 1], [0, 2]) == pytest.approx(2)
    assert space.distances([3, 0], [[-3, 0], [3, 1]]) == pytest.approx([2 * math.pi - 6, 1])
    np.testing.assert_allclose(space.interpolate([0, 0], [1, 2], 0.25), [0.25, 0.5])
    np.testing.assert_allclose(space.step([1, 1], [0.5, -1]), [1.5, 0])
    np.testing.assert_allclose(space.wrap([-1, 7]), [2 * math.pi - 1, 7 - 2 * math.pi])
    np.testing.assert_array_equal(space.neutral(), [0, 0])
    box = [-2.1, -0.5, -1, 2.1, 0.5, 1]
    held = cstk.Space(arm.robot, [cstk.interval(-1, 1), cstk.circle()], box)
    assert held.contains([0, 0]) and not held.contains([2, 0])
    assert held.within_limits([2, 0]) == (False, 0) and held.within_limits([1, 9]) == (True, None)
    assert held.within_world([1, 0]) == (False, 1) and held.within_world([0.1, 0]) == (True, None)
    np.testing.assert_array_equal(held.clamp([3, 1]), [1, 1])
    both = cstk.Space([arm.robot, arm.robot], [cstk.default_range()] * 4)
    assert (both.offset(1).link, both.offset(1).coordinate, both.nq) == (2, 2, 4)


def test_samples_are_uniform_and_repeatable(arm):
    space = cstk.Space(arm.robot, [cstk.interval(-1, 3), cstk.interval(0, 1)])
    a, b = cstk.Random(5), cstk.Random(5)
    drawn = np.array([space.sample(a) for _ in range(4000)])
    np.testing.assert_array_equal(drawn[:10], [space.sample(b) for _ in range(10)])
    assert a.state != b.state
    np.testing.assert_allclose(drawn.mean(axis=0), [1, 0.5], atol=0.06)
    np.testing.assert_allclose(drawn.std(axis=0), [4 / math.sqrt(12), 1 / math.sqrt(12)], rtol=0.05)


def test_custom_joints_move_by_functions(query):
    def pose(q):
        return cstk.translation(math.cos(q[0]), math.sin(q[0]), 0)

    def jacobian(q):
        return [[-math.sin(q[0])], [math.cos(q[0])], [0], [0], [0], [0]]

    builder = cstk.RobotBuilder()
    joint = cstk.CustomJoint(1, pose, jacobian, linear_speed=1, angular_speed=0)
    builder.add_link(cstk.JointKind.CUSTOM, body=cstk.Body.sphere(0.1), custom=joint)
    robot = builder.build()
    np.testing.assert_allclose(robot.link_pose([0.5], 0), pose([0.5]))
    np.testing.assert_allclose(robot.jacobian([0.5], 0), jacobian([0.5]))
    environment = cstk.Environment()
    environment.add(cstk.Body.sphere(0.2), cstk.translation(0, 1, 0))
    cobject = cstk.CObject.induced(cstk.Space(robot), environment)
    hit = query.motion(cobject, [0], [3])
    # A chord of 0.3 in a circle of radius 1.
    assert hit.reached[0] == pytest.approx(math.pi / 2 - 2 * math.asin(0.15), abs=1e-5)

    def fails(q):
        raise ZeroDivisionError("mine")

    broken = cstk.RobotBuilder()
    broken.add_link(cstk.JointKind.CUSTOM, custom=cstk.CustomJoint(1, fails, jacobian))
    with pytest.raises(cstk.CallbackFailedError) as raised:
        broken.build().link_pose([0], 0)
    assert isinstance(raised.value.__cause__, ZeroDivisionError)


def test_environments_change_as_one(arm):
    environment = cstk.Environment()
    cube = cstk.Body.sphere(1, dimension=2)
    cube.set_data("of the body")
    first = environment.add(cube, data={"name": "first"})
    ids = environment.apply([cstk.Change.add(cube, cstk.translation(i, 0, 0)) for i in range(5)])
    assert environment.object_count == 6 and environment.version == 2
    np.testing.assert_array_equal(environment.objects(), [first, *ids])
    frozen = environment.snapshot()
    environment.apply([cstk.Change.delete(int(ids[0])), cstk.Change.move(first, cstk.translation(0, 9, 0))])
    np.testing.assert_array_equal(environment.object_pose(first), cstk.translation(0, 9, 0))
    np.testing.assert_array_equal(frozen.object_pose(first), cstk.identity())
    assert environment.object_info(first).data == {"name": "first"}
    assert environment.object_info(int(ids[1])).data == "of the body"
    with pytest.raises(cstk.NotFoundError):
        environment.apply([cstk.Change.delete(first), cstk.Change.delete(int(ids[0]))])
    assert environment.object_count == 5
    with pytest.raises(cstk.UnsupportedError):
        frozen.delete(first)
    environment.attach(first, arm.space, 1, cstk.translation(1, 0, 0), [0])
    info = environment.object_info(first)
    assert (info.link, info.touch_count) == (1, 1)
    environment.move(first, cstk.identity())
    assert environment.object_info(first).link is None
    environment.delete(first)
    assert environment.object_count == 4


def test_objects_have_names_and_come_attached(arm):
    cube, world = cstk.Body.box([0.1, 0.1, 0.1]), cstk.Environment()
    shelf = world.add(cube, cstk.translation(9, 0, 0), name="shelf")
    plain = world.add(cube)
    link = arm.space.link_count - 1
    cup = world.add_attached(cube, arm.space, link, cstk.identity(), [0], data="mine", name="cup")
    assert [world.object_name(id) for id in (shelf, plain, cup)] == ["shelf", "", "cup"]
    assert world.find_object("cup") == cup
    held = world.object_info(cup)
    assert held.link == link and held.touch_count == 1 and held.data == "mine"
    with pytest.raises(cstk.NotFoundError, match="spoon"):
        world.find_object("spoon")
    with pytest.raises(cstk.NotFoundError):
        world.object_name(cup + 1000)
    scene = "s\n* ball\n1\nsphere\n1\n4 0 0\n0 0 0 1\n0 0 0 0\n.\n"
    assert world.object_name(int(world.load_scene_text(scene)[0])) == "ball"


def test_spaces_find_links_and_take_several_at_once(arm):
    space = arm.space
    for link in range(space.link_count):
        assert space.find_link(space.link_name(link)) == link
    with pytest.raises(cstk.NotFoundError, match="elbow"):
        space.find_link("elbow")
    random, again = cstk.Random(3), cstk.Random(3)
    drawn = space.sample(random, 5)
    assert drawn.shape == (5, space.nq) and (drawn == [space.sample(again) for _ in range(5)]).all()
    times = [0.0, 0.25, 1.0]
    way = space.interpolate(drawn[0], drawn[1], times)
    assert (way == [space.interpolate(drawn[0], drawn[1], t) for t in times]).all()
    poses = space.link_poses(drawn)
    assert poses.shape == (5, space.link_count, 3, 4) and (poses[3] == space.link_poses(drawn[3])).all()
    assert arm.cobject.space.nq == space.nq
    with pytest.raises(cstk.WrongSizeError, match="q"):
        space.link_poses(np.zeros((2, 2, 2)))


def test_placements_of_urdf():
    roll, pitch, yaw = 0.3, -0.7, 1.1

    def about(axis, angle):
        out, (i, j) = np.eye(4), [k for k in range(3) if k != axis]
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        out[np.ix_([i, j], [i, j])] = turn if axis != 1 else turn.T
        return out

    want = cstk.translation(1, 2, 3) @ about(2, yaw) @ about(1, pitch) @ about(0, roll)
    np.testing.assert_allclose(cstk.pose_from_rpy([1, 2, 3, roll, pitch, yaw]), want, atol=1e-15)


def test_package_folders_are_folders(tmp_path):
    (tmp_path / "thing").mkdir()
    mesh = "o\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    (tmp_path / "thing" / "tri.obj").write_text(mesh)
    urdf = (
        "<robot name='r'><link name='a'><collision><geometry><mesh filename='package://thing/tri.obj'/></geometry>"
        "</collision></link></robot>"
    )
    for folders in (str(tmp_path), tmp_path, [tmp_path], tmp_path / "thing"):
        builder = cstk.RobotBuilder()
        builder.load_urdf_text(urdf, package_paths=folders)
        assert builder.urdf_report().links_with_body == 1
    with pytest.raises(TypeError, match="package_paths"):
        cstk.RobotBuilder().load_urdf_text(urdf, package_paths={"thing": tmp_path / "thing"})
    with pytest.raises(cstk.NotFoundError, match='a folder "thing" with it in /nowhere'):
        cstk.RobotBuilder().load_urdf_text(urdf, package_paths="/nowhere")
