"""cstk: the C-Space Toolkit.

At a configuration q of a robot: is q free, in contact, or inside (Query.classify)? how far from contact and between which features
(Query.distance, Query.witnesses)? which way is out, in joint space (Query.gradients)? which step slides along the contact
(Query.slide)? is this whole motion free, proved (Query.motion)? The same for two bodies at two poses: Query.pair_distance. For many at
once, on all processors: Batch. For a grid over some coordinates: Map.

Names are those of cstk.h without the prefix; what a call does, its units and frames are said there at length. Lengths are in your
unit, angles in radians, poses are 4 x 4 arrays from child to parent frame. A call that fails raises an `Error` that names the
argument.
"""

from ._lists import Explanation, LinkPairs, PenetrationList, PseudoNormal, SignedDistanceList, WitnessList
from ._native import ffi as _ffi
from ._native import lib as _lib
from ._progress import Progress
from ._record import Record, Records, dtype_of
from .batch import Batch, BatchAnswers, BatchClasses, BatchDistances, BatchMotions, BatchWithin
from .body import Body, BodyBuilder, Support
from .certificate import Certificate
from .cobject import AllowedPair, CObject
from .enums import *  # noqa: F403
from .environment import Change, Environment
from .errors import *  # noqa: F403
from .hierarchy import HierarchyOptions, Mesh
from .map import Map, MapAxis
from .motion import Clearance, Motion, MotionFunction, Path, PathClearance, Shortcut
from .object_pairs import ObjectPairList
from .octree import Octree
from .poses import (
    euler_from_rotation,
    euler_rates,
    euler_rates_inverse,
    euler_to_rotation,
    identity,
    jacobian_from_euler,
    jacobian_to_euler,
    pose_compose,
    pose_from_euler,
    pose_from_quaternion,
    pose_from_rpy,
    pose_inverse,
    pose_to_euler,
    pose_to_quaternion,
    pose_transform_point,
    translation,
)
from .query import Query
from .records import *  # noqa: F403
from .region import GrownRegion, Region
from .robot import CustomJoint, Robot, RobotBuilder
from .semantics import EndEffector, JointGroup, NamedState, Semantics, VirtualJoint
from .slide import Slide, SlideTo, slide_step, spring_step
from .space import Random, Range, Space, circle, default_range, interval

__version__: str = _ffi.string(_lib.cstk_version()).decode()


def version() -> str:
    """The version of the library, as "major.minor.patch"."""
    return __version__

