"""Robots from texts with what SRDF says of them, joint groups as robots of their own, and planning scenes."""

import gc
import math

import numpy as np
import pytest

import cstk


def link(name, shape='<sphere radius="0.1"/>', x=0.5):
    origin = f'<origin xyz="{x} 0 0"/>'
    return f'<link name="{name}"><collision>{origin}<geometry>{shape}</geometry></collision></link>'


def joint(name, parent, child, kind="continuous", x=1.0):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>'
    )


URDF = (
    '<robot name="arm">'
    + "".join(link(name) for name in ("base", "upper", "fore", "hand"))
    + joint("shoulder", "base", "upper")
    + joint("elbow", "upper", "fore")
    + joint("wrist", "fore", "hand")
    + "</robot>"
)
SRDF = """<robot name="arm">
  <virtual_joint name="floor" type="planar" parent_frame="odom" child_link="base"/>
  <group name="arm"><chain base_link="base" tip_link="fore"/></group>
  <group name="gripper"><joint name="wrist"/></group>
  <group_state name="bent" group="arm"><joint name="shoulder" value="0.5"/><joint name="elbow" value="-1"/></group_state>
  <end_effector name="tool" parent_link="fore" group="gripper" parent_group="arm"/>
  <passive_joint name="wrist"/>
  <disable_collisions link1="base" link2="upper" reason="Adjacent"/>
  <disable_collisions link1="upper" link2="fore" reason="Adjacent"/>
</robot>"""
SCENE = """kitchen
* the ball
1
sphere
0.5
{0} 0 0
0 0 0 1
0 0 0 0
* tray
1
box
1 1 1
0 9 0
0 0 0 1
0 0 0 0
.
"""


@pytest.fixture
def builder():
    builder = cstk.RobotBuilder()
    builder.load_urdf_text(URDF)
    builder.load_srdf_text(SRDF)
    return builder


@pytest.fixture
def robot(builder):
    return builder.build()


def test_groups_states_and_end_effectors(builder, robot):
    report, said = builder.srdf_report(), robot.semantics()
    assert (report.group_count, report.state_count, report.disabled_pair_count, report.unknown_names) == (2, 1, 2, 0)
    assert said[:4] == (2, 1, 1, 1) and said.passive_joints.tolist() == [robot.find_link("hand")]
    arm = robot.group(robot.find_group("arm"))
    assert arm.name == "arm" and arm.coordinates.tolist() == [0, 1]
    assert [robot.link_name(moved) for moved in arm.joints] == ["upper", "fore"]
    bent = robot.find_state("arm", "bent")
    state = robot.state(bent)
    assert (state.name, state.group) == ("bent", robot.find_group("arm"))
    assert state.coordinates.tolist() == [0, 1] and state.values.tolist() == [0.5, -1]
    q = np.array([7.0, 8.0, 9.0])
    assert robot.apply_state(bent, q).tolist() == [0.5, -1, 9] and q.tolist() == [7, 8, 9]
    tool = robot.end_effector(robot.find_end_effector("tool"))
    assert (tool.name, tool.group, tool.parent_group) == ("tool", 1, 0)
    assert (tool.parent_link, tool.touch_links.tolist()) == (robot.find_link("fore"), [2, 3])
    floor = robot.virtual_joint(0)
    assert floor == ("floor", "odom", cstk.JointKind.PLANAR, robot.find_link("base"))
    # The answers are copies.
    robot.release()
    assert arm.joints.tolist() == [1, 2] and state.values.tolist() == [0.5, -1]


def test_what_is_not_there_is_not_found(robot):
    with pytest.raises(cstk.NotFoundError, match="leg"):
        robot.find_group("leg")
    with pytest.raises(cstk.NotFoundError, match="home"):
        robot.find_state("arm", "home")
    with pytest.raises(cstk.NotFoundError):
        robot.find_state(None, "bent")
    for ask in robot.group, robot.state, robot.end_effector, robot.virtual_joint:
        with pytest.raises(cstk.NotFoundError, match="9"):
            ask(9)
    with pytest.raises(cstk.WrongSizeError):
        robot.apply_state(0, [0, 0])
    bare = cstk.RobotBuilder()
    bare.load_urdf_text(URDF)
    assert bare.build().semantics()[:4] == (0, 0, 0, 0)
    with pytest.raises(cstk.EmptyError):
        bare.srdf_report()


def test_disabled_pairs_are_left_out(builder):
    def names(robot):
        space = cstk.Space(robot)
        return {frozenset(map(robot.link_name, pair)) for pair in space.enabled_pairs()}

    links = ["base", "upper", "fore", "hand"]
    every = {frozenset((a, b)) for a in links for b in links if a < b}
    disabled = {frozenset(("base", "upper")), frozenset(("upper", "fore"))}
    assert names(builder.build()) == every - disabled
    builder.disable_pair("hand", "fore")
    robot = builder.build()
    assert names(robot) == every - disabled - {frozenset(("hand", "fore"))}
    space = cstk.Space(robot)
    pairs = space.enabled_pairs()
    assert pairs.shape == (3, 2) and pairs.dtype == np.uint32
    # Folded into a triangle, the arm has its hand where the base is.
    cobject, query = cstk.CObject.induced_links(space, pairs), cstk.Query()
    assert query.classify(cobject, [2 * math.pi / 3] * 3) != cstk.Class.OUTSIDE
    assert query.classify(cobject, [0, 0, 0]) == cstk.Class.OUTSIDE
    with pytest.raises(cstk.NotFoundError, match="nose"):
        builder.disable_pair("hand", "nose")


def test_prefixes_and_files(tmp_path):
    (tmp_path / "arm.srdf").write_text(SRDF)
    builder = cstk.RobotBuilder()
    for side in "left_", "right_":
        builder.load_urdf_text(URDF, prefix=side)
        builder.load_srdf(tmp_path / "arm.srdf", prefix=side)
    robot = builder.build()
    assert robot.group(robot.find_group("right_arm")).joints.tolist() == [5, 6]
    partial = cstk.RobotBuilder()
    partial.load_urdf_text(URDF)
    partial.load_srdf_text('<robot><group name="g"><link name="nose"/></group></robot>', skip_unknown=True)
    assert partial.srdf_report().unknown_names == 1


def test_wrong_files_are_named(tmp_path):
    builder = cstk.RobotBuilder()
    with pytest.raises(cstk.Error, match="(?s)URDF text.*line 1.*<joint>.*twisting"):
        builder.load_urdf_text(URDF.replace("continuous", "twisting", 1))
    with pytest.raises(cstk.Error, match="(?s)URDF text.*no.stl"):
        builder.load_urdf_text(URDF.replace('<sphere radius="0.1"/>', '<mesh filename="no.stl"/>', 1), tmp_path)
    builder.load_urdf_text(URDF)
    file = tmp_path / "wrong.srdf"
    file.write_text('<robot>\n<group name="g"><link name="nose"/></group></robot>')
    with pytest.raises(cstk.NotFoundError, match='(?s)wrong.srdf.*line 2, <link>.*"nose"'):
        builder.load_srdf(file)
    with pytest.raises(cstk.NotFoundError, match='(?s)SRDF text.*<link>.*"nose"'):
        builder.load_srdf_text(file.read_text())
    with pytest.raises(cstk.IoError, match="none.srdf"):
        builder.load_srdf(tmp_path / "none.srdf")
    assert builder.build().semantics().group_count == 0
    for call in builder.load_urdf_text, builder.load_srdf_text, cstk.Environment().load_scene_text:
        with pytest.raises(TypeError, match="must be a string"):
            call(3)


def test_a_frozen_group_answers_as_the_whole_robot(robot, query, rng):
    environment = cstk.Environment()
    for at in rng.uniform(-3, 3, (8, 2)):
        environment.add(cstk.Body.sphere(0.2), cstk.translation(*at, 0))
    arm = robot.group(robot.find_group("arm"))
    alone = robot.frozen(arm.joints, [0.1, 0.2, 0.7])
    assert (alone.nq, alone.link_count) == (2, robot.link_count)
    whole_set = cstk.CObject.induced(cstk.Space(robot), environment)
    alone_set = cstk.CObject.induced(cstk.Space(alone), environment)
    for q in rng.uniform(-3, 3, (50, 2)):
        whole = alone.to_whole(q)
        assert whole.tolist() == [*q, 0.7] and alone.from_whole(whole).tolist() == q.tolist()
        for number in range(robot.link_count):
            np.testing.assert_allclose(alone.link_pose(q, number), robot.link_pose(whole, number), atol=1e-15)
        assert query.classify(alone_set, q) == query.classify(whole_set, whole)
        assert query.distance(alone_set, q).distance == pytest.approx(query.distance(whole_set, whole).distance, abs=1e-12)
    still = robot.frozen([], [0.1, 0.2, 0.7])
    assert still.nq == 0 and still.to_whole([]).tolist() == [0.1, 0.2, 0.7]
    with pytest.raises(cstk.EmptyError):
        robot.to_whole([0, 0, 0], robot)
    with pytest.raises(cstk.NotFoundError):
        robot.frozen([9], [0, 0, 0])


TETRAHEDRON = "v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def test_what_meshes_stand_for(tmp_path, query):
    (tmp_path / "mesh.obj").write_text(TETRAHEDRON)
    mesh = '<mesh filename="mesh.obj"/>'
    urdf = f'<robot name="r">{link("a", mesh, 0)}{link("b", mesh, 0)}{joint("j", "a", "b", "fixed", 100)}</robot>'
    environment = cstk.Environment()
    for x in 0.5, 100.5:
        environment.add(cstk.Body.sphere(0.1), cstk.translation(x, 0.5, 0.5))

    def met(**forms):
        """The links that meet a sphere wholly inside them."""
        builder = cstk.RobotBuilder()
        builder.load_urdf_text(urdf, tmp_path, **forms)
        space = cstk.Space(builder.build())
        found = query.witnesses(cstk.CObject.induced(space, environment), [], epsilon=0)
        return builder.urdf_report().solid_body_count, {space.link_name(witness.r_link) for witness in found}

    surface, solid, hull = cstk.MeshForm.SURFACE, cstk.MeshForm.SOLID, cstk.MeshForm.HULL
    assert met() == (0, set())
    assert met(mesh_form=solid) == (1, {"a", "b"})
    assert met(mesh_form=hull)[1] == {"a", "b"}
    assert met(link_forms={"b": solid}) == (1, {"b"})
    assert met(mesh_form=hull, link_forms={"a": surface})[1] == {"b"}
    with pytest.raises(cstk.NotFoundError, match="nose"):
        met(link_forms={"nose": solid})


def test_planning_scenes(robot, query, tmp_path):
    environment = cstk.Environment()
    file = tmp_path / "kitchen.scene"
    file.write_text(SCENE.format(4))
    ids = environment.load_scene(file, at=cstk.translation(1, 0, 0))
    assert ids.dtype == np.uint64 and ids.tolist() == environment.objects().tolist() and environment.version == 1
    assert [environment.object_info(id).data for id in ids] == ["the ball", "tray"]
    nearest = query.distance(cstk.CObject.induced(cstk.Space(robot), environment), [0, 0, 0])
    # The hand's sphere is at x = 3.5.
    assert nearest.distance == pytest.approx(0.9) and nearest.witness.s_data == "the ball"
    again = environment.load_scene_text(SCENE.format(9), mesh_form=cstk.MeshForm.SOLID, hierarchy=cstk.HierarchyOptions())
    assert environment.object_count == 4 and environment.object_info(again[1]).data == "tray"
    for wrong, culprit in [("sphere\n0.5", "sphere\n"), ("sphere", "donut")]:
        file.write_text(SCENE.format(0).replace(wrong, culprit))
        with pytest.raises(cstk.Error, match='kitchen.scene: object "the ball".*line'):
            environment.load_scene(file)
    with pytest.raises(cstk.Error, match="scene text"):
        environment.load_scene_text("")
    assert environment.object_count == 4


def test_names_of_scenes_do_not_outlive_their_objects(robot, query):
    """Addresses of names are used again; an answer about an object that is gone must not tell another's."""
    cobject_space, environment = cstk.Space(robot), cstk.Environment()
    cobject = cstk.CObject.induced(cobject_space, environment)
    # What tests before this one left, which PyPy may not have freed yet.
    before = len(cstk._user_data._names)
    answers = []
    for i in range(400):
        name = f"ball {i:03}"
        (ball, tray) = environment.load_scene_text(SCENE.format(4).replace("the ball", name))
        answers.append((name, query.distance(cobject, [0, 0, 0]).witness))
        assert answers[-1][1].s_data == name
        environment.apply([cstk.Change.delete(int(ball)), cstk.Change.delete(int(tray))])
        # PyPy would free what holds the names some time later.
        gc.collect()
    assert all(witness.s_data in (name, None) for name, witness in answers)
    # Names are kept by address: of three in four at most the address was new.
    assert len(cstk._user_data._names) < before + 600
