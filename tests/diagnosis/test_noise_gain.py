"""The gain from which stated noise is inflated, measured on recordings of pure noise."""

import numpy as np
import pytest

from mixedlub.diagnosis.search.noise_inflation import inflation_gains
from mixedlub.diagnosis.settings.search import INFLATION_FACTORS, INFLATION_GAIN

RECORDINGS = 2000


@pytest.mark.parametrize("readings", [20, 200])
def test_pure_noise_gains_less_from_inflation(readings: int) -> None:
    noise = np.random.default_rng(1).standard_normal((RECORDINGS, readings))
    gains = [inflation_gains(one, INFLATION_FACTORS[:, None]).max() for one in noise]
    assert max(gains) < INFLATION_GAIN


def test_half_as_much_noise_again_gains_more() -> None:
    noise = 1.5 * np.random.default_rng(1).standard_normal(200)
    assert inflation_gains(noise, INFLATION_FACTORS[:, None]).max() > INFLATION_GAIN
