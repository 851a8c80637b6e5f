"""A motion past a thin plate: samples see nothing, the proof finds the contact; with the plate moved away the motion is proved free,
with a certificate that is saved, loaded and checked.

    python3 proved_motion.py [FOLDER]     # leaves proved_motion.png there
"""

import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import cstk

START, END = [-1.1, 0.4], [1.3, -0.3]
PLATE = cstk.translation(1.85, 0.03, 0)
AWAY = cstk.translation(2.35, 0.03, 0)


def make_arm():
    """Two bars in space, turning about z."""
    builder, parent = cstk.RobotBuilder(), -1
    bar = cstk.Body.capsule([0, 0, 0], [1, 0, 0], 0.06)
    for i in range(2):
        parent = builder.add_link(cstk.JointKind.REVOLUTE, body=bar, parent=parent, at=cstk.translation(i, 0, 0))
    return cstk.Space(builder.build())


def profile(query, cobject, space, count):
    times = np.linspace(0, 1, count)
    return times, [query.distance(cobject, space.interpolate(START, END, t)).distance for t in times]


def main(folder):
    space, query, environment = make_arm(), cstk.Query(), cstk.Environment()
    plate = environment.add(cstk.Body.box([0.15, 0.001, 0.5]), PLATE)
    cobject = cstk.CObject.induced(space, environment)

    sampled, sampled_distances = profile(query, cobject, space, 13)
    dense, dense_distances = profile(query, cobject, space, 20001)
    hit = query.motion(cobject, START, END)
    print(f"{sum(d == 0 for d in sampled_distances)} of {len(sampled)} samples are in contact")
    print(f"the proof: {hit.outcome.name}, free until {hit.times[0]:.6f}, contact at {hit.times[1]:.6f}")
    truth = dense[np.argmax(np.array(dense_distances) == 0)]
    assert hit.times[0] <= truth and not any(d == 0 for d in sampled_distances)

    environment.move(plate, AWAY)
    away, away_distances = profile(query, cobject, space, 2001)
    motion, certificate = query.motion_certificate(cobject, START, END)
    clearance = query.motion_clearance(cobject, START, END, 1e-4)
    print(f"plate moved away: {motion.outcome.name}, never nearer than {clearance.lower:.4f}")
    with tempfile.TemporaryDirectory() as kept:
        certificate.save(Path(kept) / "proof")
        cstk.Certificate.load(Path(kept) / "proof").verify(cobject, START, END)
    print(f"its certificate has {certificate.summary().entry_count} entries, and is accepted")

    figure, axes = plt.subplots(figsize=(9, 5))
    axes.plot(dense, dense_distances, color="0.6", label="distance, plate in the way")
    axes.plot(sampled, sampled_distances, "o", color="steelblue", label="13 samples: all free")
    axes.axvline(hit.times[1], color="crimson", label="first contact, proved")
    axes.plot(away, away_distances, color="seagreen", label="distance, plate moved away")
    axes.axhline(clearance.lower, color="seagreen", linestyle=":", label="its least, proved for all times")
    axes.set(xlabel="time", ylabel="distance from contact", ylim=(0, 1.25), xlim=(0, 1))
    axes.legend(loc="upper center", framealpha=1)
    figure.tight_layout()
    file = Path(folder) / "proved_motion.png"
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=100)
    print(f"picture: {file}")
    return not hit and bool(motion)


if __name__ == "__main__":
    sys.exit(0 if main(sys.argv[1] if len(sys.argv) > 1 else ".") else 1)
