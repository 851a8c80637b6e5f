//! A small robot with an SRDF file, for the tests of both.

use cstk::error::Error;
use cstk::robot::{Robot, RobotBuilder};
use cstk::srdf::{SrdfOptions, SrdfReport, add_srdf_text};
use cstk::urdf::{BaseJoint, UrdfOptions, add_urdf_text};

/// A base, an arm of three links with a gripper of two fingers of which one follows the other, and a mast beside it.
pub fn urdf() -> String {
    let ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
    let links: String = ["base", "a", "b", "c", "left", "right", "mast", "top"]
        .iter()
        .map(|name| format!("<link name=\"{name}\">{ball}</link>"))
        .collect();
    let joint = |name: &str, kind: &str, parent: &str, child: &str, rest: &str| {
        format!(
            "<joint name=\"{name}\" type=\"{kind}\"><origin xyz=\"1 0 0\"/><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\"/>{rest}</joint>"
        )
    };
    let joints = [
        joint("ja", "revolute", "base", "a", ""),
        joint("jb", "revolute", "a", "b", ""),
        joint("jtool", "fixed", "b", "c", ""),
        joint("jleft", "prismatic", "c", "left", ""),
        joint(
            "jright",
            "prismatic",
            "c",
            "right",
            "<mimic joint=\"jleft\" multiplier=\"-2\" offset=\"0.5\"/>",
        ),
        joint("jmast", "fixed", "base", "mast", ""),
        joint("jtop", "continuous", "mast", "top", ""),
    ];
    format!(
        "<robot name=\"r\">{links}<link name=\"tool\"/>{}{}</robot>",
        joints.concat(),
        joint("jt", "fixed", "c", "tool", "")
    )
}

pub const SRDF: &str = r#"
<virtual_joint name="world_joint" type="floating" parent_frame="odom" child_link="base"/>
<group name="both"><group name="arm"/><group name="hand"/><joint name="jtop"/></group>
<group name="arm"><chain base_link="base" tip_link="c"/></group>
<group name="hand"><link name="left"/><link name="right"/></group>
<group name="across"><chain base_link="top" tip_link="a"/></group>
<group name="all"><joint name="world_joint"/><group name="both"/><group name="arm"/></group>
<group name="none"/>
<group_state name="home" group="arm"><joint name="ja" value="0.5"/><joint name="jb" value=" -0.25 "/><joint name="jtool" value="1"/></group_state>
<group_state name="home" group="hand"><joint name="jleft" value="0.1"/><joint name="jright" value="0.7"/></group_state>
<group_state name="wide" group="hand"><joint name="jright" value="-0.5"/></group_state>
<group_state name="there"><joint name="world_joint" value="1 2 3 0 0 0.70711 0.70711"/></group_state>
<end_effector name="gripper" parent_link="c" group="hand" parent_group="arm"/>
<end_effector name="probe" parent_link="tool" group="arm"/>
<passive_joint name="jtop"/>
<disable_collisions link1="base" link2="a" reason="Adjacent"/>
<disable_collisions link1="a" link2="base" reason="Adjacent"/>
<disable_collisions link1="c" link2="mast"/>
<disable_default_collisions link="mast"/>
<enable_collisions link1="mast" link2="b"/>
<enable_collisions link1="mast" link2="c"/>
<link_sphere_approximation link="a"/>
"#;

pub fn with(
    base: BaseJoint,
    srdf: &str,
    options: &SrdfOptions,
) -> Result<(Robot, SrdfReport), Error> {
    let mut builder = RobotBuilder::new(3).unwrap();
    let of_urdf = UrdfOptions {
        base,
        prefix: options.prefix.clone(),
        ..Default::default()
    };
    add_urdf_text(&mut builder, &urdf(), None, &of_urdf, &mut |_| Ok(())).unwrap();
    let text = format!("<robot name=\"r\">{srdf}</robot>");
    let report = add_srdf_text(&mut builder, &text, options)?;
    Ok((builder.build()?, report))
}

pub fn loaded(srdf: &str) -> (Robot, SrdfReport) {
    with(BaseJoint::Free, srdf, &SrdfOptions::default()).unwrap()
}

pub fn names(robot: &Robot, group: &str) -> Vec<String> {
    let semantics = robot.semantics();
    let group = &semantics.groups[semantics.find_group(group).unwrap()];
    let names = group
        .joints
        .iter()
        .map(|&link| robot.links()[link as usize].joint_name.clone());
    names.collect()
}
