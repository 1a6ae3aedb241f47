"""The four samples of ISO 23509:2016, annex F: a bevel pair and hypoid pairs by methods 1, 2 and 3."""

from math import radians

from mixedlub.skew_gears.blank import ToothData
from mixedlub.skew_gears.pitch_cones import Basic

RIGHT = radians(90.0)
TWENTY = (radians(20.0), radians(20.0))
BEVEL = Basic(0, (14, 39), RIGHT, 0.0, 176.893e-3, 25.4e-3, radians(35.0), 114.3e-3)
GLEASON = Basic(1, (13, 42), RIGHT, 15e-3, 170e-3, 30e-3, radians(50.0), 63.5e-3)
OERLIKON = Basic(2, (9, 34), RIGHT, 31.75e-3, 146.7e-3, 26e-3, radians(21.009), 76e-3, 13)
KLINGELNBERG = Basic(3, (12, 49), RIGHT, 40e-3, 400e-3, 60e-3, radians(30.0), 135e-3, 5)
TEETH = {
    BEVEL: ToothData(TWENTY, 0.0, 0.50526, 1.0, 1.25, 0.04575, (radians(2.1342), radians(6.4934)), 0.127e-3),
    GLEASON: ToothData(TWENTY, 1.0, 0.3, 1.0, 1.25, 0.05, (radians(1.0), radians(4.0)), 0.2e-3),
    OERLIKON: ToothData(TWENTY, 1.0, 0.45, 1.0, 1.25, 0.05, (0.0, 0.0), 0.2e-3),
    KLINGELNBERG: ToothData((radians(19.0), radians(21.0)), 0.0, 0.2, 1.0, 1.25, 0.031),
}
