"""A planar arm among polygons, and its C-space: the class and the distance of every cell of a grid, a proved path, and a box that is
free as a whole.

    python3 planar_slice.py [FOLDER]     # leaves planar_slice.png there
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon, Rectangle

import cstk

LINKS = 1.0, 0.8
WIDTH = 0.08
OBSTACLES = [
    [[0.9, 0.7], [1.5, 0.6], [1.4, 1.2]],
    [[-1.2, 0.6], [-0.6, 0.8], [-0.8, 1.5], [-1.3, 1.3]],
    [[-0.3, -1.4], [0.4, -1.5], [0.3, -0.9]],
]
# Joint angles that the path goes through, found by looking at the picture.
WAY = np.array([[0.0, -0.6], [-0.4, 2.2], [0.5, 2.5], [1.05, 1.9], [1.55, 0.3], [1.6, -0.6]])


def make_arm():
    builder, parent = cstk.RobotBuilder(2), -1
    for i, length in enumerate(LINKS):
        bar = cstk.Body.capsule([0, 0, 0], [length, 0, 0], WIDTH, dimension=2)
        at = cstk.translation(LINKS[i - 1], 0, 0) if i else None
        parent = builder.add_link(cstk.JointKind.REVOLUTE, body=bar, parent=parent, at=at)
    return cstk.Space(builder.build(), [cstk.interval(-np.pi, np.pi)] * 2)


def make_scene():
    environment = cstk.Environment()
    for corners in OBSTACLES:
        environment.add(cstk.Body.polygon(np.pad(corners, ((0, 0), (0, 1))), dimension=2))
    return environment


def draw_arm(axes, space, q, colour):
    poses = space.link_poses(q)
    tip = poses[-1] @ [LINKS[-1], 0, 0, 1]
    points = np.array([*(pose[:2, 3] for pose in poses), tip[:2]])
    axes.plot(*points.T, "-o", color=colour, linewidth=6, solid_capstyle="round", markersize=4, markerfacecolor="white")


def main(folder):
    space, environment, query = make_arm(), make_scene(), cstk.Query()
    cobject = cstk.CObject.induced(space, environment)
    axes = [cstk.MapAxis(joint, -np.pi, np.pi, 181) for joint in range(2)]
    ticks = axes[0].middles()
    # Of the second joint upwards; 0 where links and obstacles meet.
    distances = cstk.Map.build(cobject, [0, 0], axes, kind=cstk.MapKind.DISTANCES).values.T
    path = query.motion_path(cobject, WAY)
    box = query.region_grow(cobject, space, [-1.0, -0.2])
    print(f"{(distances == 0).mean():.1%} of {distances.size} cells are inside")
    print(f"the path is {path.motion.outcome.name}")
    print(f"a free box: {np.round(box.low, 3)} to {np.round(box.high, 3)}")
    sides = [side.stop.name for side in box.sides]
    print(f"its sides are stopped by: {', '.join(sides)}")

    figure, (workspace, slice_axes) = plt.subplots(1, 2, figsize=(13, 6.2))
    for corners in OBSTACLES:
        workspace.add_patch(Polygon(corners, color="0.35"))
    for q, colour in zip(WAY, plt.cm.viridis(np.linspace(0, 0.9, len(WAY)))):
        draw_arm(workspace, space, q, colour)
    workspace.set(xlim=(-2, 2), ylim=(-2, 2), aspect="equal", title="the arm on its way")

    cells = slice_axes.pcolormesh(ticks, ticks, np.ma.masked_equal(distances, 0), cmap="Blues_r", shading="nearest")
    slice_axes.set_facecolor("0.35")
    figure.colorbar(cells, label="distance from contact")
    slice_axes.plot(*WAY.T, "-o", color="gold", label="a path, proved free")
    edges = {"fill": False, "edgecolor": "crimson", "linewidth": 2, "label": "a box, proved free"}
    slice_axes.add_patch(Rectangle(tuple(box.low), *(box.high - box.low), **edges))
    slice_axes.set(xlabel="shoulder", ylabel="elbow", aspect="equal", title="its C-space (grey: inside)")
    slice_axes.legend(loc="lower right")
    figure.tight_layout()
    file = Path(folder) / "planar_slice.png"
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=100)
    print(f"picture: {file}")
    return path


if __name__ == "__main__":
    sys.exit(0 if main(sys.argv[1] if len(sys.argv) > 1 else ".") else 1)
