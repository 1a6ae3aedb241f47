"""Gear pairs of the literature, and what the tests of load sharing ask of a mesh."""

import math
from dataclasses import replace

import numpy as np

from mixedlub.gear import GearPair, LdpSharing, mesh

HONG = GearPair((17, 26), 25.4e-3 / 6, math.radians(22.5), 14e-3)
TIPPED = replace(HONG, tip_radius=(40.25e-3, 59.2e-3))
NASA = GearPair((28, 28), 3.175e-3, math.radians(20), 6.35e-3)
STANDARD = GearPair((17, 43), 1e-3, math.radians(20), 10e-3)
FZG_C = GearPair(
    (16, 24),
    4.5e-3,
    math.radians(20),
    14e-3,
    profile_shift=(0.1817, 0.1715),
    tip_radius=(41.23e-3, 59.18e-3),
    centre_distance=91.5e-3,
)
HELICAL = GearPair(
    (17, 103), 8e-3, math.radians(20), 100e-3, math.radians(15.8), (0.145, 0.0), (79.83e-3, 436.175e-3), 500e-3
)
EVERYTHING = LdpSharing(
    tip_relief=(15e-6, 10e-6),
    relief_length=(3e-3, 2e-3),
    root_relief=(5e-6, 0.0),
    root_relief_length=(2e-3, 0.0),
    lead_crown=6e-6,
    misalignment=20e-6,
)
TORQUES = np.array([50.0, 100.0, 150.0])


def spur_of(teeth, module, angle, width, shift, tips):
    """Spur gear with the transverse section of one with a helix angle of 5 degrees."""
    cosine = math.cos(math.radians(5))
    return GearPair(
        teeth,
        module / cosine,
        math.atan(math.tan(angle) / cosine),
        width,
        profile_shift=(shift[0] * cosine, shift[1] * cosine),
        tip_radius=(tips[0] / 2, tips[1] / 2),
    )


HIGH_SPEED_A = spur_of((35, 49), 4.825e-3, math.radians(22.5), 20e-3, (0.2, -0.2195), (183.93e-3, 247.69e-3))
HIGH_SPEED_B = spur_of((30, 42), 5.625e-3, math.radians(20), 14e-3, (0.3, -0.2899), (187.04e-3, 248.17e-3))


def loss_factor(pair, sharing, torque, **options):
    """Mean sliding speed weighted by load, over the base-circle speed."""
    points = mesh(pair, sharing, **options)
    carried = points.weight * points.load_share(torque) * np.abs(points.sliding_per_speed)
    return carried.sum(axis=-1) / pair.base_radius[0]


def relieved(pair, depth, fraction):
    """Linear tip relief of both wheels over a fraction of the path of contact."""
    length = fraction * (pair.path_end - pair.path_start)
    return LdpSharing(tip_relief=(depth, depth), relief_length=(length, length))
