"""What the tests share: a planar arm whose answers are closed forms, and the query context."""


import numpy as np
import pytest

import cstk


class PlanarArm:
    """Two capsules of radius 0.1 and length 1, turning about z in a planar world, and a disc of radius 0.5 at (0, y): out of
    reach at y = 3, in the way at y = 2.2.
    """

    radius, length, disc_radius = 0.1, 1.0, 0.5

    def __init__(self, y=3.0):
        self.disc = np.array([0.0, y])
        self.body = cstk.Body.capsule([0, 0, 0], [self.length, 0, 0], self.radius, dimension=2)
        builder = cstk.RobotBuilder(2)
        first = builder.add_link(cstk.JointKind.REVOLUTE, body=self.body, name="upper", joint_name="shoulder")
        at = cstk.translation(self.length, 0, 0)
        builder.add_link(cstk.JointKind.REVOLUTE, body=self.body, parent=first, at=at, name="fore", joint_name="elbow")
        self.robot = builder.build()
        self.space = cstk.Space(self.robot)
        self.environment = cstk.Environment()
        obstacle = cstk.Body.sphere(self.disc_radius, dimension=2)
        self.object = self.environment.add(obstacle, cstk.translation(*self.disc, 0), data="the disc")
        self.cobject = cstk.CObject.induced(self.space, self.environment)

    def points(self, q):
        """The elbow and the tip, of one configuration or of each of an array."""
        turns = np.cumsum(q, axis=-1)
        steps = self.length * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
        return steps[..., 0, :], steps.sum(axis=-2)

    def clearance(self, q):
        """The distance of the arm from the disc, below 0 where they overlap; as for the points."""
        elbow, tip = self.points(q)

        def to_segment(a, b):
            along, arm = b - a, self.disc - a
            t = np.clip((arm * along).sum(axis=-1) / self.length**2, 0, 1)
            return np.linalg.norm(arm - t[..., np.newaxis] * along, axis=-1)

        nearest = np.minimum(to_segment(np.zeros(2), elbow), to_segment(elbow, tip))
        return nearest - self.radius - self.disc_radius


@pytest.fixture(scope="session")
def arm():
    return PlanarArm()


@pytest.fixture
def query():
    return cstk.Query()


@pytest.fixture
def rng():
    return np.random.default_rng(1)


def random_pose(rng, spread):
    """A uniform rotation, and a shift within a cube."""
    quaternion = rng.normal(size=4)
    quaternion /= np.linalg.norm(quaternion)
    return cstk.pose_from_quaternion([*rng.uniform(-spread, spread, 3), *quaternion])


@pytest.fixture
def poses(rng):
    return lambda spread=1.0: random_pose(rng, spread)
