"""What the README files show, run."""

import re
from pathlib import Path

import cstk

PYTHON = Path(__file__).resolve().parents[1]
URDF = """<robot name="arm"><link name="base"/><link name="bar"><collision><origin xyz="0.5 0 0"/><geometry><box size="1 .1 .1"/></geometry>
</collision></link><joint name="j" type="revolute"><parent link="base"/><child link="bar"/><origin xyz="0 0 .5"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>"""


def blocks(file):
    return re.findall(r"```python\n(.*?)```", file.read_text("utf-8"), re.DOTALL)


def test_the_first_distance(capsys):
    here, root = blocks(PYTHON / "README.md")[0], blocks(PYTHON.parent / "README.md")[0]
    assert here == root and len(here.splitlines()) <= 5
    exec(here, {})
    printed = capsys.readouterr().out.strip()
    assert f"`{printed}`" in (PYTHON.parent / "README.md").read_text("utf-8")


def test_a_robot_among_obstacles(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "panda.urdf").write_text(URDF)
    names = {}
    exec("import cstk\n" + blocks(PYTHON / "README.md")[1], names)
    assert names["environment"].object_name(names["nearest"].witness.s_object) == "table" and names["gradient"].shape == (1,)
    assert names["free"].shape == (64,)
    assert names["motion"].outcome in (cstk.MotionOutcome.FREE, cstk.MotionOutcome.HIT)
    assert capsys.readouterr().out
