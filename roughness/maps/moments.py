r"""Spectral moments of a map in every direction.

Moments of a homogeneous surface :math:`z(x, y)` are :math:`m_{pq} = \int\!\!\int S(k_x, k_y)\,k_x^p k_y^q`, so that
:math:`m_{20} = \langle z_x^2\rangle`, :math:`m_{11} = \langle z_x z_y\rangle`,
:math:`m_{40} = \langle z_{xx}^2\rangle`, :math:`m_{22} = \langle z_{xy}^2\rangle`.
P. R. Nayak, J. Lubr. Technol. 93 (1971) 398.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from profiles import InputError
from profiles.maps import HeightMap
from roughness.maps.prepare import checked
from roughness.moments import Moments


@dataclass(frozen=True)
class ArealMoments:
    """Moments of a surface (SI); the first index counts powers of the wavenumber along x, the second along y.

    >>> isotropic = ArealMoments(1e-14, 1e-3, 0.0, 1e-3, 3e9, 0.0, 1e9, 0.0, 3e9)
    >>> round(isotropic.profile(0.7).m4 / 1e9, 12), isotropic.anisotropy
    (3.0, 1.0)
    """

    m00: float
    m20: float
    m11: float
    m02: float
    m40: float
    m31: float
    m22: float
    m13: float
    m04: float

    def profile(self, angle: float) -> Moments:
        r"""Moments of a trace at an angle (rad) from the x axis.

        .. math:: m_2 = m_{20}c^2 + 2m_{11}cs + m_{02}s^2,\quad
                  m_4 = m_{40}c^4 + 4m_{31}c^3s + 6m_{22}c^2s^2 + 4m_{13}cs^3 + m_{04}s^4

        with the cosine c and sine s of the angle. Source: M. S. Longuet-Higgins, Phil. Trans. R. Soc. A 249 (1957) 321.
        """
        c, s = math.cos(angle), math.sin(angle)
        second = self.m20 * c**2 + 2.0 * self.m11 * c * s + self.m02 * s**2
        fourth = self.m40 * c**4 + 4.0 * self.m31 * c**3 * s + 6.0 * self.m22 * c**2 * s**2
        fourth += 4.0 * self.m13 * c * s**3 + self.m04 * s**4
        return Moments(self.m00, second, fourth, estimator="areal")

    @property
    def across_lay(self) -> float:
        """Angle (rad) from the x axis of the direction with the largest slope variance, across the lay."""
        return 0.5 * math.atan2(2.0 * self.m11, self.m20 - self.m02)

    @property
    def anisotropy(self) -> float:
        """Rms slope along the lay over that across it: 1 without a lay, 0 for a surface of parallel ridges."""
        across = self.across_lay
        return math.sqrt(self.profile(across + 0.5 * math.pi).m2 / self.profile(across).m2)


def areal_moments(area: HeightMap) -> ArealMoments:
    """Moments of a levelled map by differences between neighbours; the heights are about their mean.

    Differences with a missing height are left out. On a wave of N points the differences lose as much as along a trace
    (`roughness.moments`).

    >>> y, x = np.mgrid[0:400, 0:400]
    >>> wave = HeightMap(1e-6 * np.cos(2 * np.pi * (x * 0.6 + y * 0.8) / 100), 1e-6, 1e-6)
    >>> m = areal_moments(wave)
    >>> round(math.degrees(m.across_lay), 2), round(m.profile(m.across_lay).m2 / (2 * np.pi * 1e-2) ** 2, 2)
    (53.13, 0.5)
    """
    z, dx, dy = checked(area), area.spacing_x, area.spacing_y
    z = z - np.nanmean(z)
    xx, yy = np.diff(z, 2, axis=1) / dx**2, np.diff(z, 2, axis=0) / dy**2
    twist = (z[2:, 2:] - z[2:, :-2] - z[:-2, 2:] + z[:-2, :-2]) / (4.0 * dx * dy)
    rising, falling = z[1:, 1:] - z[:-1, :-1], z[:-1, 1:] - z[1:, :-1]
    cells = (z[1:, 1:] - z[1:, :-1] - z[:-1, 1:] + z[:-1, :-1]) / (dx * dy)
    found = ArealMoments(
        m00=_mean_square(z),
        m20=_mean_square(np.diff(z, axis=1)) / dx**2,
        m11=(_mean_square(rising) - _mean_square(falling)) / (4.0 * dx * dy),
        m02=_mean_square(np.diff(z, axis=0)) / dy**2,
        m40=_mean_square(xx),
        m31=float(np.nanmean(xx[1:-1] * twist)),
        m22=_mean_square(cells),
        m13=float(np.nanmean(yy[:, 1:-1] * twist)),
        m04=_mean_square(yy),
    )
    if min(found.m20, found.m02) <= 0.0:
        raise InputError("is flat: it has no roughness", where=f"map {area.name!r}")
    return found


def tiles(area: HeightMap, a_side: int = 3) -> list[HeightMap]:
    """Parts of a map, cut into ``a_side`` rows and columns.

    >>> [part.heights.shape for part in tiles(HeightMap(np.zeros((40, 60)), 1e-6, 1e-6), 2)]
    [(20, 30), (20, 30), (20, 30), (20, 30)]
    """
    rows = np.array_split(area.heights, a_side, axis=0)
    return [replace(area, heights=part) for row in rows for part in np.array_split(row, a_side, axis=1)]


def gaussian_scatter(area: HeightMap, *angles: float) -> np.ndarray:
    r"""Relative standard deviations of m0, m2 and m4 between maps of this size of a Gaussian surface.

    .. math:: \frac{\mathrm{sd}(m_n)^2}{m_n^2} = \frac{\sum_q k_q^{2n} P_q^2}{\left(\sum_q k_q^n P_q\right)^2}

    with the periodogram P of the map under a Hann window and the wavenumber k of differences along the angle (rad from
    the x axis); m2 and m4 are means over several angles. Valid for waves up to about an eighth of the map; too low for
    longer ones, for m0 by a sixth at half the map and by two fifths at waves as long as the map. Each ordinate of the
    periodogram is exponential, so that the mean of its square is twice the squared spectrum, which offsets the equality
    of the ordinates at k and -k.
    Source: M. B. Priestley, Spectral Analysis and Time Series, 1981, section 6.1.

    >>> white = HeightMap(1e-7 * np.random.default_rng(1).standard_normal((128, 128)), 1e-6, 1e-6)
    >>> gaussian_scatter(white, 0.0).round(3).tolist()   # sqrt(2/N) of N free heights
    [0.011, 0.014, 0.016]
    """
    z = checked(area)
    rows, columns = (np.hanning(n + 2)[1:-1] for n in z.shape)
    window = np.outer(rows, columns)
    power = np.abs(np.fft.fft2(np.nan_to_num(z - np.nanmean(z)) * window)) ** 2
    y, x = (
        2.0 * np.sin(np.pi * np.fft.fftfreq(n)) / spacing
        for n, spacing in zip(z.shape, (area.spacing_y, area.spacing_x))
    )
    along = [math.cos(a) * x[None, :] + math.sin(a) * y[:, None] for a in angles]
    weights = (1.0, *(np.mean([k**n for k in along], axis=0) for n in (2, 4)))
    return np.array([math.sqrt((w * w * power * power).sum()) / (w * power).sum() for w in weights])


def _mean_square(values: np.ndarray) -> float:
    return float(np.nanmean(np.square(values)))
