"""The load distribution against itself: a change here is a change of the physics, made on purpose or not."""

import math

import numpy as np
import pytest

from mixedlub.gear import GearPair, LdpSharing, mesh, transmission_error

pytestmark = pytest.mark.golden

HONG = GearPair((17, 26), 25.4e-3 / 6, math.radians(22.5), 14e-3)
TORQUES = np.array([50.0, 100.0, 150.0])
RELIEVED = LdpSharing(tip_relief=(15e-6, 15e-6), relief_length=(2e-3, 2e-3), lead_crown=3e-6)
SKEWED = LdpSharing(misalignment=20e-6)
RING = LdpSharing(foundation="sainsot", bore_radius=(15e-3, 25e-3))
GOLDEN = {
    "plain": (
        LdpSharing(),
        [5.422312349340433, 10.524396581867023, 15.505696207788914],
        [2.942769282932181, 5.676428028084045, 8.331288020875176],
        [0.18491453042659706, 0.1848007891972293, 0.18473139265371585],
    ),
    "relieved": (
        RELIEVED,
        [7.098559946669395, 12.459460930800695, 17.466823879370768],
        [3.17850981215036, 5.678394415559956, 8.331016214675158],
        [0.16166528958281587, 0.1674851673435294, 0.17260224272636637],
    ),
    "skewed": (
        SKEWED,
        [13.441778145955745, 19.907426543918834, 25.263118574695554],
        [4.522050414516803, 6.554198490678197, 8.612360307950242],
        [0.18545042771686832, 0.18507599856066076, 0.18483595317623502],
    ),
    "ring foundation": (
        RING,
        [6.77044191576781, 13.22083173560719, 19.550515902865914],
        [3.7509364141578794, 7.2927274868339715, 10.755704356117853],
        [0.18529148027225967, 0.18520824574576877, 0.18515787997288352],
    ),
}


@pytest.mark.parametrize("name", GOLDEN)
def test_transmission_error_in_micrometres(name):
    sharing, mean, peak_to_peak, _ = GOLDEN[name]
    solved = transmission_error(HONG, sharing, TORQUES)
    assert 1e6 * solved.approach.mean(axis=1) == pytest.approx(mean, rel=1e-8)
    assert 1e6 * solved.peak_to_peak == pytest.approx(peak_to_peak, rel=1e-8)


@pytest.mark.parametrize("name", GOLDEN)
def test_loss_factor(name):
    sharing, _, _, factor = GOLDEN[name]
    points = mesh(HONG, sharing)
    carried = points.weight * points.load_share(TORQUES) * np.abs(points.sliding_per_speed)
    assert carried.sum(axis=1) / HONG.base_radius[0] == pytest.approx(factor, rel=1e-8)
